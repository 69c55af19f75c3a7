//! Colour maps, labels and legends on finished pictures.

use glam::{DVec3, Vec2, Vec3, Vec4};
use immerse::immersion::FieldName;
use immerse::render::{
    Anchor, Camera, ColorMap, Corner, Legend, Lights, Look, Output, Overlay, Picture, RenderError, Scenery, TextStyle,
    fill_in, render, text_width,
};

const MAPS: [ColorMap; 6] = [
    ColorMap::Viridis,
    ColorMap::Inferno,
    ColorMap::Cividis,
    ColorMap::Diverging,
    ColorMap::Cyclic,
    ColorMap::Categorical,
];

/// A picture of nothing.
fn blank(width: usize, height: usize) -> Picture {
    let output = Output::new(width, height, 1).unwrap();
    let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y, 30_f64.to_radians(), 1.0, &output).unwrap();
    render(&Scenery::default(), &camera, &Lights::default(), &Look::default(), &output).unwrap()
}

fn style(size: f32, anchor: Anchor) -> TextStyle {
    TextStyle { size, color: Vec3::new(0.1, 0.2, 0.3), anchor }
}

/// Columns and rows from the first to the one after the last that something is drawn on.
fn drawn(film: &Picture) -> Option<[[usize; 2]; 2]> {
    let inked = |at: &(usize, &Vec4)| at.1.w > 0.0;
    let places: Vec<usize> = film.beauty().iter().enumerate().filter(inked).map(|(at, _)| at).collect();
    let span = |of: &dyn Fn(usize) -> usize| {
        let all = || places.iter().map(|&at| of(at));
        Some([all().min()?, all().max()? + 1])
    };
    Some([span(&|at| at % film.width())?, span(&|at| at / film.width())?])
}

fn pixel(film: &Picture, x: usize, y: usize) -> Vec3 {
    film.beauty()[y * film.width() + x].truncate()
}

/// Lightness as the eye sees it, 0 to 1 (Oklab).
fn lightness(color: Vec3) -> f32 {
    let cones = [[0.4122, 0.5363, 0.0514], [0.2119, 0.6807, 0.1074], [0.0883, 0.2817, 0.6300]]
        .map(|row| color.dot(Vec3::from(row)).cbrt());
    0.2105 * cones[0] + 0.7936 * cones[1] - 0.0041 * cones[2]
}

#[test]
fn maps_are_even_to_the_eye() {
    let at = |map: ColorMap, place: f32| lightness(map.at(place));
    let steps = || (0..64).map(|k| (k as f32 / 64.0, (k + 1) as f32 / 64.0));
    for map in [ColorMap::Viridis, ColorMap::Inferno, ColorMap::Cividis] {
        assert!(steps().all(|(a, b)| at(map, b) > at(map, a)), "{map:?} does not get lighter everywhere");
    }
    for (a, b) in steps() {
        let climb = at(ColorMap::Diverging, b) - at(ColorMap::Diverging, a);
        assert!((climb.abs() - 1.0 / 64.0).abs() < 0.003 && (climb > 0.0) == (a < 0.5), "from {a}: {climb}");
        assert!((at(ColorMap::Cyclic, a) - at(ColorMap::Cyclic, 0.0)).abs() < 0.01);
    }
    for name in MAPS {
        for k in 0..=200 {
            let color = name.at(k as f32 / 100.0 - 0.5);
            assert!(color.min_element() >= 0.0 && color.max_element() <= 1.0, "{name:?} leaves the gamut: {color}");
        }
    }
}

#[test]
fn the_diverging_map_is_white_exactly_in_the_middle_and_the_cyclic_one_closes() {
    let diverging = ColorMap::Diverging;
    assert_eq!(diverging.at(0.5), Vec3::ONE);
    assert_eq!(diverging.color(0.0, [-3.0, 3.0]), Vec3::ONE);
    let (low, high) = (diverging.at(0.0), diverging.at(1.0));
    assert!(low.z > 2.0 * low.x && high.x > 2.0 * high.z, "blue below, red above");
    assert_eq!(diverging.color(-9.0, [-3.0, 3.0]), low);
    assert_eq!(diverging.color(9.0, [-3.0, 3.0]), high);

    let cyclic = ColorMap::Cyclic;
    assert!(cyclic.at(0.0).distance(cyclic.at(0.9999)) < 1e-2);
    assert_eq!(cyclic.at(1.25), cyclic.at(0.25));
}

#[test]
fn numbers_of_things_have_distinct_colors_and_nothing_is_grey() {
    let map = ColorMap::suiting(FieldName::Generators);
    let colors: Vec<Vec3> = (0..10).map(|n| map.color(n as f32, [0.0, 4.0])).collect();
    for (a, first) in colors.iter().enumerate() {
        assert!(colors[a + 1..].iter().all(|second| first.distance(*second) > 0.1), "{a} is like another one");
    }
    assert!(colors[0].max_element() - colors[0].min_element() < 0.1, "0 is not grey");
    assert_eq!(map.color(10.0, [0.0, 20.0]), colors[1]);
    for map in MAPS {
        assert_eq!(map.color(f32::NAN, [0.0, 1.0]), colors[0]);
        assert!(map.color(f32::INFINITY, [0.0, 1.0]).is_finite() && map.color(1.0, [1.0, 1.0]).is_finite());
    }
}

#[test]
fn text_lies_in_its_box() {
    for (anchor, left) in [(Anchor::Left, 0.0), (Anchor::Middle, 0.5), (Anchor::Right, 1.0)] {
        let mut film = blank(700, 100);
        let text = "Hgjp 0.47 μ = λ₁²";
        let width = text_width(text, 30.0);
        film.draw_text(text, Vec2::new(300.0, 60.0), &style(30.0, anchor));
        let [[x0, x1], [y0, y1]] = drawn(&film).unwrap();
        let start = 300.0 - left * width;
        // Letters begin a little after the origin and end a little before the next one.
        assert!((x0 as f32 - start - 2.5).abs() < 2.5, "{anchor:?}: from {x0}, box from {start}");
        assert!((x1 as f32 - start - width + 1.5).abs() < 3.0, "{anchor:?}: to {x1}, box to {}", start + width);
        // Capitals are 0.73 of the size high, superscripts reach a little higher, and nothing but descenders is below the baseline.
        assert!((34..=39).contains(&y0) && (63..=69).contains(&y1), "rows {y0} to {y1}");
    }
    let mut film = blank(200, 50);
    film.draw_text("H", Vec2::new(20.0, 40.0), &style(40.0, Anchor::Left));
    let [_, rows] = drawn(&film).unwrap();
    assert_eq!(rows, [10, 40], "an H of size 40 is 29.1 pixels high, and stands on its baseline");
}

#[test]
fn letters_are_of_the_ink_and_cover_what_is_below() {
    let mut film = blank(60, 60);
    film.draw_text("I", Vec2::new(20.0, 50.0), &style(60.0, Anchor::Left));
    let full = film.beauty().iter().filter(|pixel| pixel.w == 1.0).count();
    assert!(full > 100, "{full} pixels are covered in full");
    for pixel in film.beauty() {
        // Premultiplied: as much light as coverage.
        assert!(pixel.truncate().distance(Vec3::new(0.1, 0.2, 0.3) * pixel.w) < 1e-6);
    }
}

#[test]
fn all_digits_are_equally_wide_and_letters_are_kerned() {
    let width = |text: &str| text_width(text, 20.0);
    for digits in ["0000000000", "1234567890", "1111111111", "7419203856"] {
        assert_eq!(width(digits), width("8888888888"));
    }
    assert_eq!(width("t = 11.11"), width("t = 47.04"));
    assert!(width("AV") < width("A") + width("V") - 0.5, "A and V do not move together");
    assert_eq!(width("\u{2212}1"), width("\u{2212}") + width("1"));
    assert_eq!(text_width("abc", 40.0), 2.0 * text_width("abc", 20.0));
}

#[test]
fn the_signs_of_labels_are_all_there() {
    let boxed = {
        let mut film = blank(40, 40);
        film.draw_text("\u{4e2d}", Vec2::new(5.0, 30.0), &style(24.0, Anchor::Left));
        film
    };
    assert!(drawn(&boxed).is_some(), "a character without a glyph is a box");
    let signs = "%°±×·−–—…≈≤≥≠∞√∂∑∫←→′″⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺₀₁₂₃₄₅₆₇₈₉αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΦΨΩéüñßøçłšž";
    for sign in signs.chars() {
        let mut film = blank(40, 40);
        film.draw_text(&sign.to_string(), Vec2::new(5.0, 30.0), &style(24.0, Anchor::Left));
        assert!(film.beauty() != boxed.beauty() && drawn(&film).is_some(), "{sign} is missing");
    }
}

#[test]
fn nothing_is_drawn_of_nothing_and_outside() {
    let empty = blank(50, 50);
    for (text, x, y, size) in [
        ("", 10.0, 20.0, 12.0),
        ("   ", 10.0, 20.0, 12.0),
        ("\n\t\u{7}", 10.0, 20.0, 12.0),
        ("outside", 90.0, 20.0, 12.0),
        ("outside", 10.0, -1e9, 12.0),
        ("nowhere", f32::NAN, 20.0, 12.0),
        ("nowhere", 10.0, f32::INFINITY, 12.0),
        ("of no size", 10.0, 20.0, 0.0),
        ("of no size", 10.0, 20.0, f32::NAN),
        ("of no use", 10.0, 20.0, 1e30),
    ] {
        let mut film = blank(50, 50);
        film.draw_text(text, Vec2::new(x, y), &style(size, Anchor::Left));
        assert_eq!(film, empty, "{text:?} at {x}, {y} of size {size}");
    }
    let mut film = blank(50, 50);
    film.draw_overlay(&Overlay::default(), Vec3::ZERO);
    assert_eq!(film, empty);
}

fn length_error(range: [f32; 2], greatest: f32) -> Legend {
    let ratio = |percent: f32| percent / 100.0;
    Legend::new(FieldName::LengthError, ColorMap::Viridis, range.map(ratio), Some([0.0, ratio(greatest)]))
}

fn with_legend(width: usize, height: usize, legend: Legend) -> Picture {
    let mut film = blank(width, height);
    let ink = film.ink();
    film.draw_overlay(&Overlay { legend: Some(legend), ..Overlay::default() }, ink);
    film
}

#[test]
fn a_bar_has_the_colors_of_the_map() {
    // Labels are 1080/42 = 25.7 high; the bar is half of that wide, 0.42 of 1080 high, and 1.5 of that from the edge.
    let film = with_legend(1920, 1080, length_error([0.0, 0.5], 0.4));
    let (right, top, bottom) = (1881, 326, 780);
    let map = ColorMap::Viridis;
    for y in top + 3..bottom - 3 {
        let place = (bottom as f32 - y as f32 - 0.5) / (bottom - top) as f32;
        assert_eq!(pixel(&film, right - 6, y), map.at(place), "row {y}");
    }
    assert_ne!(pixel(&film, right - 6, bottom + 3), map.at(0.0), "the bar goes on below");
    assert_eq!(film.beauty()[(top - 8) * 1920 + right - 6], Vec4::ZERO, "nothing is beyond this range");
    // Without ticks there would be nothing to the left of the bar.
    let ticks = (top..bottom).filter(|y| film.beauty()[y * 1920 + right - 22].w > 0.5).count();
    assert_eq!(ticks, 6, "ticks at 0, 0.1, … 0.5, one pixel each");
}

#[test]
fn an_arrow_tells_of_values_beyond_the_range() {
    let arrow = |legend: Legend, y: usize| pixel(&with_legend(1920, 1080, legend), 1881 - 7, y);
    let map = ColorMap::Viridis;
    let (above, below) = (326 - 9, 780 + 8);
    assert_eq!(arrow(length_error([0.0, 0.5], 0.7), above), map.at(1.0));
    assert_eq!(arrow(length_error([0.0, 0.5], 0.5), above), Vec3::ZERO);
    assert_eq!(arrow(length_error([0.1, 0.5], 0.5), below), map.at(0.0));
    assert_eq!(arrow(length_error([0.0, 0.5], 0.5), below), Vec3::ZERO);
}

#[test]
fn things_have_patches() {
    let map = ColorMap::suiting(FieldName::Generators);
    let film = with_legend(1920, 1080, Legend::new(FieldName::Generators, map, [0.0, 4.0], Some([0.0, 4.0])));
    let column: Vec<Vec3> = (0..1080).map(|y| pixel(&film, 1881 - 10, y)).collect();
    let rows: Vec<usize> = (1..=4)
        .map(|n| column.iter().position(|color| *color == map.color(n as f32, [0.0, 4.0])).expect("a patch"))
        .collect();
    assert!(rows.windows(2).all(|pair| pair[1] - pair[0] == 35), "patches from row {rows:?} on");
    assert!(!column.contains(&map.color(5.0, [0.0, 4.0])));
}

#[test]
fn labels_stand_in_their_corners_at_any_size() {
    for (width, height) in [(1920, 1080), (960, 540)] {
        for (corner, right, low) in [
            (Corner::TopLeft, false, false),
            (Corner::TopRight, true, false),
            (Corner::BottomLeft, false, true),
            (Corner::BottomRight, true, true),
        ] {
            let mut film = blank(width, height);
            let texts = vec![(corner, "frame 12".to_owned()), (corner, "error\n0.3 %".to_owned())];
            film.draw_overlay(&Overlay { texts, ..Overlay::default() }, Vec3::ZERO);
            let [[x0, x1], [y0, y1]] = drawn(&film).unwrap();
            let margin = 1.5 * height as f32 / 42.0;
            let near = |a: usize, b: f32| (a as f32 - b).abs() < 4.0;
            assert!(if right { near(x1, width as f32 - margin) } else { near(x0, margin) }, "{corner:?}: {x0} to {x1}");
            assert!(if low { near(y1, height as f32 - margin) } else { near(y0, margin) }, "{corner:?}: {y0} to {y1}");
            // Three lines, the last without a descender.
            let lines = (2.0 * 1.45 + 0.73) * height as f32 / 42.0;
            assert!(near(y1 - y0, lines), "{corner:?}: {} rows", y1 - y0);
        }
    }
}

#[test]
fn ink_is_read_on_any_background() {
    let on = |background: f32| {
        let look = Look { background: [Vec3::splat(background); 2], ..Look::default() };
        let output = Output::new(4, 4, 1).unwrap();
        let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y, 30_f64.to_radians(), 1.0, &output).unwrap();
        let film = render(&Scenery::default(), &camera, &Lights::default(), &look, &output).unwrap();
        lightness(film.ink()) - lightness(Vec3::splat(background))
    };
    assert!(on(1.0) < -0.5 && on(0.25) < -0.3 && on(0.0) > 0.8 && on(0.1) > 0.4);
}

#[test]
fn pictures_of_any_size_take_any_overlay() {
    let ranges =
        [[0.0, 1.0], [-1e-30, 1e30], [0.0, 0.0], [5.0, -5.0], [f32::NAN, 1.0], [0.0, f32::INFINITY], [0.0, 1e9]];
    for (width, height) in [(1, 1), (1, 900), (700, 2), (13, 17), (400, 300)] {
        for map in MAPS {
            for range in ranges {
                for text_size in [0.0, 0.3, 1.0, 40.0, f32::NAN] {
                    let legend = Legend { title: "τ".repeat(300), unit: "%".into(), map, range, beyond: [true; 2] };
                    let texts = vec![
                        (Corner::TopRight, "中\u{301}🦊\0 long ".repeat(20)),
                        (Corner::BottomLeft, "\n\n\n".into()),
                    ];
                    let mut film = blank(width, height);
                    film.draw_overlay(&Overlay { texts, legend: Some(legend), text_size }, Vec3::ONE);
                    assert!(film.beauty().iter().all(|pixel| pixel.is_finite() && pixel.w <= 1.0 + 1e-5));
                }
            }
        }
    }
}

#[test]
fn templates_are_filled_in() {
    let values = [("frame", "12".to_owned()), ("error", "0.3 %".to_owned())];
    let filled = |template: &str| fill_in(template, &values);
    assert_eq!(filled("frame {frame}: {error}").unwrap(), "frame 12: 0.3 %");
    assert_eq!(filled("{{x}} μ {frame}{frame}").unwrap(), "{x} μ 1212");
    assert_eq!(filled("").unwrap(), "");
    let message = |template: &str| match filled(template) {
        Err(error @ RenderError::Label { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert_eq!(message("{fame}"), "text = \"{fame}\" asks for `{fame}`; there are {frame}, {error}");
    for (template, brace) in [("a { b", "{"), ("a } b", "}"), ("{frame", "{"), ("}}}", "}")] {
        assert!(message(template).contains(&format!("has a `{brace}` without its partner; write `{brace}{brace}`")));
    }
}
