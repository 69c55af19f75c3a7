//! How far a run is: lines where it is written to a file, one line that changes on a terminal, or JSON.

use serde_json::Value as Json;

use super::{assert_code, end_of, err, film, folder_with, out, shell, skip, start};

/// A film that takes some seconds.
fn some_seconds() -> String {
    film(24, 24, "").replace("size = [64, 48]", "size = [640, 480]")
}

#[test]
fn a_log_file_says_how_far_it_is() {
    let folder = folder_with(&some_seconds());
    let output = end_of(start(folder.path(), &["run", "film.toml", "--out", "out"]));
    assert_code(&output, 0);
    let err = err(&output);
    let lines: Vec<&str> = err.lines().collect();
    assert!((2..20).contains(&lines.len()), "{err}");
    assert!(lines.iter().all(|line| !line.contains(['\r', '\u{1b}', '\u{8}'])), "{err}");
    assert!(err.contains(" of 24") && err.contains("pictures 24 of 24"), "{err}");
    assert!(err.contains(" left"), "{err}");
    // Messages are not silenced, progress is.
    let output = end_of(start(folder.path(), &["run", "film.toml", "--out", "out", "--quiet", "--restart"]));
    assert_eq!((output.status.code(), super::err(&output).as_str()), (Some(0), ""));
}

fn records(text: &str) -> Vec<Json> {
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error} in {line}"))).collect()
}

#[test]
fn a_program_reads_json() {
    let folder = folder_with(&film(4, 5, ""));
    let output = end_of(start(folder.path(), &["run", "film.toml", "--out", "out", "--log", "json"]));
    assert_code(&output, 0);
    let records = records(&err(&output));
    let of = |event: &str| records.iter().filter(|record| record["event"] == event).cloned().collect::<Vec<_>>();
    let frames = of("frame");
    assert_eq!(frames.len(), 5);
    for (k, frame) in frames.iter().enumerate() {
        assert_eq!((&frame["frame"], &frame["frames"]), (&(k + 1).into(), &5.into()));
        assert!(frame["error"].is_f64() && frame["rims"].is_u64() && frame["seconds"].is_f64(), "{frame}");
    }
    let pictures = of("picture");
    assert_eq!(pictures.len(), 5);
    assert_eq!((&pictures[4]["pictures_done"], &pictures[4]["pictures"]), (&5.into(), &5.into()));
    let end = records.last().expect("a record");
    assert_eq!((&end["event"], &end["code"], &end["frames_done"]), (&"end".into(), &0.into(), &5.into()));

    // Mistakes and failures are records, too.
    std::fs::write(folder.path().join("film.toml"), "[mesh]\nshape = 'spere'\n").expect("a scene");
    let output = end_of(start(folder.path(), &["run", "film.toml", "--log", "json"]));
    assert_code(&output, 2);
    let records = self::records(&err(&output));
    assert_eq!(
        (&records[0]["event"], &records[0]["line"], &records[0]["column"]),
        (&"error".into(), &2.into(), &9.into())
    );
    assert!(records[0]["remedy"].as_str().is_some_and(|text| text.contains("did you mean `sphere`?")));
    assert_eq!(records[1]["code"], 2);
    let output = end_of(start(folder.path(), &["inspect", "none", "--log", "json"]));
    let records = self::records(&err(&output));
    assert!(records[0]["text"].as_str().is_some_and(|text| text.contains("there is no film here")));
}

/// On a terminal, which `script` makes.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_has_one_line_that_goes() {
    let folder = folder_with(&some_seconds());
    let script = "script -qec '\"$IMMERSE\" run film.toml --out out' /dev/null";
    let output = shell(folder.path(), script);
    if !output.status.success() && err(&output).contains("script") {
        return skip("there is no `script` to make a terminal with");
    }
    assert_code(&output, 0);
    let text = out(&output);
    assert!(text.contains("frame ") && text.contains(" of 24") && text.contains("pictures "), "{text:?}");
    // What is left to read is the results.
    let left: Vec<&str> =
        text.lines().map(|line| line.rsplit('\r').find(|part| !part.is_empty()).unwrap_or("")).collect();
    assert!(left.iter().any(|line| line.contains("24 frames computed")), "{left:?}");
    assert!(!left.iter().any(|line| line.contains("pictures 2")), "{left:?}");
}
