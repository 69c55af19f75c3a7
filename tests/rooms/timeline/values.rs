//! What changes with time: keyframes, formulas, parameters and the clock.

use crate::support::{is_at, scene};
use immerse::scene::{NumberSection, Scene};
use immerse::timeline::{
    Clock, Ease, Extrapolation, Formula, Keyframes, LONGEST_FORMULA, MOST_PARAMETERS, Number, Parameters, PointFormula,
    TimelineError, eased,
};
use std::sync::Arc;

const EASES: [Ease; 4] = [Ease::Linear, Ease::Smooth, Ease::In, Ease::Out];
const EXTRAPOLATIONS: [Extrapolation; 3] = [Extrapolation::Hold, Extrapolation::Linear, Extrapolation::Repeat];

fn keyframes(times: &[f64], values: &[f64], ease: Ease, extrapolation: Extrapolation) -> Keyframes<f64> {
    Keyframes::new(times.to_vec(), values.to_vec(), ease, extrapolation).expect("keyframes")
}

/// A number that a formula in `t` gives.
fn formula(text: &str, parameters: &Arc<Parameters>) -> Result<Number, TimelineError> {
    Formula::parse(text, &[], parameters).map(Number::Formula)
}

/// With one more, which a formula gives.
fn with(parameters: &Arc<Parameters>, name: &str, text: &str) -> Arc<Parameters> {
    let mut all = parameters.clone();
    Parameters::add(&mut all, name, formula(text, parameters).expect(text)).expect(name);
    all
}

#[test]
fn values_at_keyframes_are_exact() {
    // None of these is a sum of few powers of two.
    let (times, values) = ([-0.3, 0.1, 0.7, 1.9], [0.1, 1e-7, -3.3, 1e9]);
    for ease in EASES {
        for extrapolation in EXTRAPOLATIONS {
            let k = keyframes(&times, &values, ease, extrapolation);
            let last = if extrapolation == Extrapolation::Repeat { values[0] } else { values[3] };
            assert_eq!(times.map(|t| k.at(t)), [values[0], values[1], values[2], last], "{ease:?} {extrapolation:?}");
            assert_eq!(k.values(), values);
        }
    }
}

#[test]
fn eases_start_at_0_end_at_1_and_never_turn_back() {
    for (ease, half, speed_at_start, speed_at_end) in [
        (Ease::Linear, 0.5, 1.0, 1.0),
        (Ease::Smooth, 0.5, 0.0, 0.0),
        (Ease::In, 0.25, 0.0, 2.0),
        (Ease::Out, 0.75, 2.0, 0.0),
    ] {
        assert_eq!([0.0, 0.5, 1.0].map(|part| eased(ease, part)), [0.0, half, 1.0], "{ease:?}");
        let values: Vec<f64> = (0..=1000).map(|k| eased(ease, f64::from(k) / 1000.0)).collect();
        assert!(values.is_sorted_by(|a, b| a < b), "{ease:?}");
        assert!((1000.0 * (values[1] - values[0]) - speed_at_start).abs() < 0.01, "{ease:?}");
        assert!((1000.0 * (values[1000] - values[999]) - speed_at_end).abs() < 0.01, "{ease:?}");
        // Each piece between two keyframes is eased by itself.
        let k = keyframes(&[0.0, 2.0, 3.0], &[10.0, 20.0, 0.0], ease, Extrapolation::Hold);
        assert_eq!((k.at(1.0), k.at(2.5)), (10.0 + 10.0 * half, 20.0 - 20.0 * half), "{ease:?}");
    }
}

#[test]
fn outside_of_keyframes() {
    let (times, values) = ([1.0, 2.0, 4.0], [5.0, 7.0, 13.0]);
    for ease in EASES {
        let at = |extrapolation, time: f64| keyframes(&times, &values, ease, extrapolation).at(time);
        for time in [1.0, 1.25, 2.0, 3.0, 3.5] {
            let inside = at(Extrapolation::Hold, time);
            assert!(EXTRAPOLATIONS.iter().all(|e| at(*e, time) == inside), "{ease:?} {time}");
            for periods in [-2.0, -1.0, 1.0, 5.0] {
                assert_eq!(at(Extrapolation::Repeat, time + 3.0 * periods), inside, "{ease:?} {time}");
            }
        }
        assert_eq!([0.9, -1e300].map(|time| at(Extrapolation::Hold, time)), [5.0; 2]);
        assert_eq!([4.1, 1e300].map(|time| at(Extrapolation::Hold, time)), [13.0; 2]);
        // At the mean speed of the nearest two keyframes: 2 before, 3 after.
        assert_eq!([0.0, -9.0].map(|time| at(Extrapolation::Linear, time)), [3.0, -15.0]);
        assert_eq!([5.0, 14.0].map(|time| at(Extrapolation::Linear, time)), [16.0, 43.0]);
    }
    for extrapolation in [Extrapolation::Hold, Extrapolation::Linear] {
        let k = keyframes(&[2.0], &[7.0], Ease::Smooth, extrapolation);
        assert_eq!([-5.0, 2.0, 9.0].map(|time| k.at(time)), [7.0; 3]);
    }
}

#[test]
fn keyframes_that_are_none() {
    let new = |times: &[f64], values: &[f64], extrapolation| {
        Keyframes::new(times.to_vec(), values.to_vec(), Ease::Linear, extrapolation).map(|_| ())
    };
    for extrapolation in [Extrapolation::Hold, Extrapolation::Linear] {
        for (times, values) in [(0, 0), (0, 1), (1, 0), (2, 1), (2, 3)] {
            let of = |count| (0..count).map(|k| k as f64).collect::<Vec<_>>();
            assert_eq!(new(&of(times), &of(values), extrapolation), Err(TimelineError::Count { times, values }));
        }
        for (times, earlier, later) in
            [([0.0, 2.0, 1.0], 2.0, 1.0), ([0.0, 0.0, 1.0], 0.0, 0.0), ([0.0, 1.0, -1.0], 1.0, -1.0)]
        {
            assert_eq!(new(&times, &[1.0; 3], extrapolation), Err(TimelineError::Order { earlier, later }));
        }
        assert_eq!(new(&[0.0], &[1.0], extrapolation), Ok(()));
        for times in [[0.0, f64::NAN, 1.0], [f64::NEG_INFINITY, 0.0, 1.0], [f64::NAN; 3]] {
            assert!(matches!(new(&times, &[1.0; 3], extrapolation), Err(TimelineError::NotFinite { .. })), "{times:?}");
        }
    }
    assert_eq!(new(&[3.0], &[1.0], Extrapolation::Repeat), Err(TimelineError::NothingToRepeat));
    for error in [new(&[], &[], Extrapolation::Hold), new(&[1.0, 0.0], &[0.0; 2], Extrapolation::Hold)] {
        assert!(error.expect_err("refused").to_string().contains("; "), "a message says what to do");
    }
}

#[test]
fn numbers_that_change() {
    let text = |text: &str| formula(text, &Arc::default()).expect("a formula");
    let of_keyframes =
        |values: [f64; 2]| Number::Keyframes(keyframes(&[0.0, 2.0], &values, Ease::Linear, Extrapolation::Linear));
    for (number, at_three, changes) in [
        (Number::Constant(0.3), 0.3, false),
        (text("2 + 1"), 3.0, false),
        (text("t^2 - 1"), 8.0, true),
        (of_keyframes([1.0, 5.0]), 7.0, true),
        (of_keyframes([4.0, 4.0]), 4.0, false),
    ] {
        assert_eq!((number.at(3.0), number.changes()), (at_three, changes), "{number:?}");
    }
    assert!(text("0/0").at(0.0).is_nan() && text("ln(-1)").at(0.0).is_nan());
}

/// Each kind of number that a scene can say, and one that it says wrongly.
#[test]
fn numbers_of_a_scene() {
    let of_keyframes = |times: [f64; 2]| NumberSection::Keyframes {
        times: times.to_vec(),
        values: vec![1.0, 5.0],
        ease: Ease::Linear,
        extrapolation: Extrapolation::Linear,
    };
    let say = |section: NumberSection| {
        let scene = Scene { parameters: vec![("a".to_owned(), section)], ..Scene::default() };
        scene.parameters().map(|parameters| (parameters.at(3.0), parameters.changes(0)))
    };
    for (section, at_three, changes) in [
        (NumberSection::Constant(0.3), 0.3, false),
        (NumberSection::Formula("2 + 1".to_owned()), 3.0, false),
        (NumberSection::Formula("t^2 - 1".to_owned()), 8.0, true),
        (of_keyframes([0.0, 2.0]), 7.0, true),
    ] {
        assert_eq!(say(section.clone()), Ok((vec![at_three], changes)), "{section:?}");
    }
    let error = say(of_keyframes([1.0, 0.0])).expect_err("out of order");
    assert_eq!(error.reason, "keyframes are out of order: 0 comes after 1");
}

#[test]
fn formulas_know_their_variables_time_and_parameters() {
    let shared = with(&with(&Arc::default(), "a", "10"), "b", "a * t");
    let parse = |text: &str| Formula::parse(text, &["x", "length"], &shared);
    // 3x + 5 length + 7t + 11a + 13b: every variable with a factor of its own.
    let formula = parse("3*x + 5*length\n   + 7*t + 11*a\t+ 13*b").expect("a formula");
    assert_eq!(formula.at(2.0).value(&[100.0, 1000.0]), 300.0 + 5000.0 + 14.0 + 110.0 + 260.0);
    assert_eq!(formula.at(-1.0).value(&[0.0, 0.0]), -7.0 + 110.0 - 130.0);
    assert_eq!(formula.text(), "3*x + 5*length + 7*t + 11*a + 13*b");
    for (text, uses, changes) in [
        ("x + a", [true, false], false),
        ("length", [false, true], false),
        ("t", [false, false], true),
        ("b", [false, false], true),
        ("a", [false, false], false),
        ("x * length * b", [true, true], true),
        ("1", [false, false], false),
    ] {
        let formula = parse(text).expect("a formula");
        assert_eq!(([0, 1].map(|k| formula.uses(k)), formula.changes()), (uses, changes), "{text}");
    }
    for (text, reason) in [("x + q", "there is no `q`"), ("y", "there is no `y`"), ("dx", "there is no `dx`")] {
        match parse(text) {
            Err(TimelineError::Formula { formula, reason: found, known }) => {
                assert_eq!((formula.as_str(), found.as_str()), (text, reason));
                assert_eq!(known, "x, length, t, a, b and the usual functions");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    for text in ["", "x +", "(x", "x)", "2x 3", "x ** ", "sin", "x,y", "\"x\"", "é"] {
        assert!(matches!(parse(text), Err(TimelineError::Formula { .. })), "`{text}`");
    }
}

/// What a formula is worth is what it says, to the last digit but one.
#[test]
fn formulas_compute_what_they_say() {
    let value = |text: &str| Formula::parse(text, &["x"], &Arc::default()).expect(text).at(0.25).value(&[0.75]);
    let (x, t) = (0.75f64, 0.25f64);
    for (text, expected) in [
        ("-x^2", -x * x),
        ("2 - 3 - 4", -5.0),
        ("2^3^2", 64.0),
        ("2 * -x^2 + -x^2", -3.0 * x * x),
        ("t--x^2", t + x * x),
        ("2^-x", 2f64.powf(-x)),
        ("1/-x", -1.0 / x),
        ("atan2(-t, -x^2)", (-t).atan2(-x * x)),
        ("-sin(-x)", x.sin()),
        ("x / t / 3", x / t / 3.0),
        ("1 - -x", 1.0 + x),
        ("sin(PI * x) + cos(t)", (std::f64::consts::PI * x).sin() + t.cos()),
        ("exp(x) * ln(2) - sqrt(x)", x.exp() * 2f64.ln() - x.sqrt()),
        ("tanh(x) / atan2(t, x)", x.tanh() / t.atan2(x)),
        ("abs(t - x) + max(x, t) - min(x, t)", 2.0 * (x - t)),
        ("1e-3 + 2.5 - .5E+1 + 2. + 1e3", 1000.0 + 2.0 - 5.0 + 2.501),
        ("-1e-3*e", -1e-3 * std::f64::consts::E),
    ] {
        assert!(
            (value(text) - expected).abs() <= 1e-15 * expected.abs().max(1.0),
            "{text}: {} {expected}",
            value(text)
        );
    }
}

#[test]
fn parameters_may_use_those_before_them() {
    let all = scene(
        "[parameters]\nradius = { times = [0, 1], values = [2, 4] }\narea = 'PI * radius^2'\n\
         growth = 'area / (4 * PI) - t'\nfixed = 1.5\ntwice = '2 * fixed'\n",
    )
    .parameters()
    .expect("parameters");
    assert_eq!(all.names().collect::<Vec<_>>(), ["radius", "area", "growth", "fixed", "twice"]);
    let at = all.at(0.5);
    for (value, expected) in at.iter().zip([3.0, 9.0 * std::f64::consts::PI, 9.0 / 4.0 - 0.5, 1.5, 3.0]) {
        assert!((value - expected).abs() < 1e-14, "{at:?}");
    }
    assert_eq!((0..6).map(|k| all.changes(k)).collect::<Vec<_>>(), [true, true, true, false, false, false]);

    // Not those after them, nor themselves.
    for (named, culprit) in [("b = '2 * a'\na = 1.0", "b"), ("a = 1.0\nb = 'b + 1'", "b"), ("a = 'x'\nb = 1.0", "a")] {
        let scene = scene(&format!("[parameters]\n{named}\n"));
        let error = scene.parameters().expect_err("no such name yet");
        let key = format!("parameters.{culprit}");
        assert!(is_at(&scene, &key, &error) && error.reason.contains("there is no"), "{named}: {error}");
    }
}

#[test]
fn names_of_parameters() {
    let parameters = |name: &str| {
        let mut all = Arc::default();
        Parameters::add(&mut all, name, Number::Constant(0.125)).map(|()| all)
    };
    // A name may begin like a function or a constant.
    for name in ["a", "k", "height", "sinus", "expo", "PIe", "tau", "e1", "tt", "lengths", "x1", "E_0"] {
        let all = parameters(name).expect(name);
        let formula = Formula::parse(&format!("1 + 2*{name} + sin(0)*{name}"), &["x"], &all).expect(name);
        assert_eq!(formula.at(9.0).value(&[7.0]), 1.25, "{name}");
    }
    for name in [
        "t",
        "x",
        "y",
        "z",
        "dx",
        "dy",
        "dz",
        "length",
        "e",
        "E",
        "PI",
        "pi",
        "TAU",
        "τ",
        "π",
        "sin",
        "exp",
        "ln",
        "max",
        "min",
        "atan2",
        "",
        "1a",
        "a b",
        "a-b",
        "a.b",
        "é",
        "_a",
        "a+",
        "max_height",
        "minor", // the parser takes `max` and `min` out of these
    ] {
        let outcome = parameters(name);
        assert_eq!(outcome.map(|_| ()), Err(TimelineError::Name { name: name.to_owned() }), "`{name}`");
        // A scene says so before it looks at the value, which may be wrong because of the name.
        for section in [NumberSection::Constant(0.125), NumberSection::Formula(format!("{name} + q"))] {
            let scene = Scene { parameters: vec![(name.to_owned(), section)], ..Scene::default() };
            let error = scene.parameters().expect_err(name);
            assert!(error.reason.contains(&format!("`{name}` cannot name a parameter")), "{error}");
        }
    }
    // Nor is a name given twice.
    let mut all = parameters("a").expect("a name");
    let twice = Parameters::add(&mut all, "a", Number::Constant(1.0));
    assert_eq!(twice, Err(TimelineError::Name { name: "a".to_owned() }));
}

#[test]
fn points_move_by_three_formulas() {
    let shared = with(&Arc::default(), "s", "1 + t");
    let parse = |texts: [&str; 3]| PointFormula::parse(&texts.map(str::to_owned), &shared);
    let moving = parse(["s * x", "y - z", "x * y * z"]).expect("formulas");
    assert_eq!(moving.at(1.0).point([2.0, 3.0, 5.0].into()).to_array(), [4.0, -2.0, 30.0]);
    assert!(moving.changes() && !parse(["x", "z", "y"]).expect("formulas").changes());
    assert!(!parse(["1/x", "y", "z"]).expect("formulas").at(0.0).point([0.0; 3].into()).is_finite());
    for texts in [["q", "y", "z"], ["x", "q", "z"], ["x", "y", "q"], ["x", "y", "length"]] {
        assert!(matches!(parse(texts), Err(TimelineError::Formula { .. })), "{texts:?}");
    }
}

#[test]
fn a_clock_has_frames_and_goes_forward() {
    // A film of no frames had the times of 2^64 - 1 intervals.
    for frames in [0, Clock::MOST_FRAMES + 1, usize::MAX] {
        assert!(
            matches!(Clock::new(frames, [0.0, 1.0], false), Err(TimelineError::Frames { frames: f, .. }) if f == frames)
        );
    }
    for times in [[1.0, 1.0], [1.0, 0.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
        assert!(matches!(Clock::new(2, times, false), Err(TimelineError::Backwards { .. })), "{times:?}");
    }
    let one = Clock::new(1, [3.0, 4.0], false).expect("a clock");
    assert_eq!((one.time(0), one.time(1), one.times().count()), (3.0, 3.0, 1));
}

#[test]
fn the_clock_meets_its_ends() {
    let clock = |text: &str| {
        let scene = scene(&format!("[clock]\n{text}"));
        let clock = scene.times(&scene.clock).expect("a clock");
        let (frames, looping) = (scene.clock.frames, scene.clock.looping);
        assert_eq!(clock, Clock::new(frames, [scene.clock.start, scene.clock.end], looping).expect("a clock"));
        clock
    };
    for (start, end) in [(0.0, 1.0), (-0.3, 0.7), (0.1, 1.1)] {
        for frames in [2, 3, 7, 10, 49] {
            let open = clock(&format!("frames = {frames}\nstart = {start}\nend = {end}\n"));
            let times: Vec<f64> = open.times().collect();
            assert_eq!((times.len(), times[0], times[frames - 1]), (frames, start, end), "exactly");
            assert!(!open.is_looping());
            let closed = clock(&format!("frames = {frames}\nstart = {start}\nend = {end}\nloop = true\n"));
            assert!(closed.is_looping());
            assert_eq!((closed.time(1), closed.time(frames + 1)), (start, end), "the first frame is at the end again");
            for (clock, intervals) in [(open, frames - 1), (closed, frames)] {
                for frame in 1..=frames {
                    let expected = start + (end - start) * (frame - 1) as f64 / intervals as f64;
                    assert!((clock.time(frame) - expected).abs() < 1e-15, "{frame} of {frames}");
                }
                assert!(clock.times().collect::<Vec<_>>().is_sorted_by(|a, b| a < b));
            }
        }
    }
    assert_eq!(clock("frames = 1\nstart = 0.25\n").times().collect::<Vec<_>>(), [0.25]);
    assert_eq!(clock("frames = 1\nstart = 0.25\nloop = true\n").times().collect::<Vec<_>>(), [0.25]);
}

#[test]
fn formulas_and_parameters_have_limits_and_cost_what_they_are_long() {
    // Each parameter uses the one before: evaluated once each, not once for every use.
    let mut all: Arc<Parameters> = Arc::default();
    let time = formula("t", &all).expect("t");
    Parameters::add(&mut all, "p0", time).expect("p0");
    for k in 1..MOST_PARAMETERS {
        let number = formula(&format!("p{} + p{}", k - 1, k.saturating_sub(2)), &all).expect("a sum");
        Parameters::add(&mut all, &format!("p{k}"), number).expect("a name");
    }
    let last = Formula::parse("p40 - p39 - p38", &[], &all).expect("known names");
    assert_eq!((last.at(1.0).value(&[]), last.changes()), (0.0, true));
    let one_more = Parameters::add(&mut all, "q", Number::Constant(1.0));
    assert_eq!(one_more, Err(TimelineError::TooManyParameters { most: MOST_PARAMETERS }));
    // Not all of a thousand names are listed.
    let unknown = Formula::parse("nobody", &[], &all).expect_err("no such name").to_string();
    assert!(unknown.contains("p19, 980 more parameters"), "{unknown}");

    let sum = |terms: usize| format!("1{}", "+t".repeat(terms));
    let longest = (LONGEST_FORMULA - 1) / 2;
    let value = Formula::parse(&sum(longest), &[], &Arc::default()).expect("as long as it may be").at(1.0).value(&[]);
    assert_eq!(value, 1.0 + longest as f64);
    let too_long = Formula::parse(&sum(longest + 1), &[], &Arc::default());
    assert_eq!(too_long.map(|_| ()), Err(TimelineError::TooLong { characters: 5001, most: LONGEST_FORMULA }));
    // As deep as the length allows.
    let (open, close) = ("(".repeat(2499), ")".repeat(2499));
    let deep = Formula::parse(&format!("{open}t{close}"), &[], &Arc::default()).expect("deep").at(3.0).value(&[]);
    assert_eq!(deep, 3.0);
}
