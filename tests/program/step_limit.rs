//! Films whose frames run into the limit of steps say so once, and can be held to a bound.

use crate::support::program;
use immerse::cli::{checks_of, step_limit_line};
use immerse::evolve::FrameReport;
use immerse::scene::{ChecksSection, FilmChecksSection};

fn film(converged: &[bool]) -> Vec<FrameReport> {
    let report = |(k, &converged): (usize, &bool)| FrameReport { frame: k + 1, converged, ..FrameReport::default() };
    converged.iter().enumerate().map(report).collect()
}

#[test]
fn one_line_says_which_frames_and_what_to_try() {
    let mut states = vec![true; 30];
    assert_eq!(step_limit_line(&film(&states)), None);
    states[8..30].fill(false);
    let line = step_limit_line(&film(&states)).unwrap();
    assert!(line.contains("22 of 30 frames ran into the step limit") && line.contains("9-30"), "{line}");
    assert!(line.contains("`max_steps` under [clock]") && !line.contains('\n'), "{line}");
    states[20] = true;
    states[0] = false;
    let line = step_limit_line(&film(&states)).unwrap();
    assert!(line.contains("22 of 30") && line.contains("(1,9-20,22-30)"), "{line}");
    assert!(line.contains("[[phase]]"), "{line}");
    // Every other one of a thousand: a line is no list.
    let states: Vec<bool> = (0..1000).map(|k| k % 2 == 0).collect();
    assert!(step_limit_line(&film(&states)).unwrap().len() < 400);
    let line = step_limit_line(&film(&[false])).unwrap();
    assert!(line.contains("ran into the step limit"), "{line}");
}

#[test]
fn films_can_be_held_to_a_bound() {
    let checks = |most| ChecksSection {
        film: FilmChecksSection { max_unconverged: Some(most), ..FilmChecksSection::default() },
        ..ChecksSection::default()
    };
    let film = film(&[true, false, false, true]);
    let found = checks_of(&checks(2), &film);
    assert_eq!((found[0].name, found[0].holds, &found[0].value), ("film.max_unconverged", true, &2.into()));
    assert!(!checks_of(&checks(1), &film)[0].holds);
    assert!(!checks_of(&checks(1), &[])[0].holds, "no film holds to nothing");
    // Frames of a film of the relaxation were not to converge.
    let film: Vec<_> = film.into_iter().map(|report| FrameReport { on_the_way: true, ..report }).collect();
    assert!(checks_of(&checks(0), &film)[0].holds);
    assert_eq!(step_limit_line(&film), None);
}

const BREATHING: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 5\n[start]\nfrom = 'mesh'\n\
                         [metric]\nformula = 'length * (1 + 0.3 * t * x)'\n[output]\nsize = [16, 12]\nsamples = 1\n";

#[test]
fn the_program_says_it_at_the_end() {
    let folder = tempfile::TempDir::new().unwrap();
    let short = format!("{BREATHING}[clock]\nframes = 6\nmax_steps = 1\n[checks.film]\nmax_unconverged = 4\n");
    std::fs::write(folder.path().join("short.toml"), &short).unwrap();
    std::fs::write(folder.path().join("long.toml"), short.replace("max_steps = 1", "max_steps = 1000")).unwrap();
    for command in ["simulate", "run"] {
        let (code, out, err) = program(folder.path(), &[command, "short.toml", "--out", command]);
        let lines: Vec<&str> = err.lines().filter(|line| line.contains("step limit")).collect();
        assert_eq!(lines.len(), 1, "{err}");
        assert!(lines[0].contains("5 of 6 frames") && lines[0].contains("2-6"), "{err}");
        assert_eq!(code, i32::from(command == "run"), "{err}");
        assert!(command == "simulate" || out.contains("film.max_unconverged"), "{out}");
    }
    let (code, _, err) = program(folder.path(), &["run", "long.toml", "--out", "long"]);
    assert_eq!((code, err.as_str()), (0, ""));
    // Nor are frames of so many steps to converge, however many a phase may take in all.
    let steps =
        short.replace("max_steps = 1\n", "steps_per_frame = 2\n").replace("max_unconverged = 4", "max_unconverged = 0")
            + "[[phase]]\nmin_steps = 1\nmax_steps = 3\n";
    std::fs::write(folder.path().join("steps.toml"), steps).unwrap();
    let (code, _, err) = program(folder.path(), &["run", "steps.toml", "--out", "steps", "-q"]);
    assert_eq!((code, err.as_str()), (0, ""));
    // A film of the relaxation shows frames that are not done, and that is what it is for.
    let text = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[clock]\nframes = 3\nsteps_per_frame = 1\n[output]\nsize = [16, 12]\nsamples = 1\n";
    std::fs::write(folder.path().join("relaxation.toml"), text).unwrap();
    let (code, _, err) = program(folder.path(), &["run", "relaxation.toml", "--out", "relaxation"]);
    assert_eq!((code, err.as_str()), (0, ""));
}
