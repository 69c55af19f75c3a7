//! Standard output or standard error that is full, closed, or that nobody reads, changes no exit code and loses no work.

use std::fs;

use super::{assert_code, assert_same, err, files, film, folder_with, shell};

/// A film whose check does not hold.
fn failing() -> tempfile::TempDir {
    folder_with(&film(2, 2, "[checks]\nmax_l2_length_error = 1e-30\n"))
}

const NO_READER: &str = "| true; exit ${PIPESTATUS[0]}";

#[cfg(unix)]
#[test]
fn a_failing_check_fails_whoever_reads() {
    let folder = failing();
    assert_code(&shell(folder.path(), "\"$IMMERSE\" run film.toml --out whole -q"), 1);
    let whole = files(&folder.path().join("whole"));
    let full = if cfg!(target_os = "linux") { &["> /dev/full", "> /dev/full 2>&1", "2> /dev/full"][..] } else { &[] };
    let streams = [NO_READER, ">&-", "2>&-", ">&- 2>&-", "2>&1 | true; exit ${PIPESTATUS[0]}"];
    for (k, stream) in streams.iter().chain(full).enumerate() {
        let output = shell(folder.path(), &format!("\"$IMMERSE\" run film.toml --out out{k} -q {stream}"));
        assert_eq!(output.status.code(), Some(1), "{stream}: {}", err(&output));
        assert!(!err(&output).contains("panicked"), "{stream}: {}", err(&output));
        assert_same(&files(&folder.path().join(format!("out{k}"))), &whole);
    }
}

#[cfg(unix)]
#[test]
fn a_damaged_frame_is_one_whoever_reads() {
    let folder = folder_with(&film(2, 2, ""));
    assert_code(&shell(folder.path(), "\"$IMMERSE\" simulate film.toml --out out -q"), 0);
    fs::write(folder.path().join("out/frames/000001.npz"), "?").expect("a file");
    for stream in ["", NO_READER, ">&-", "2>&-", "2>&1 | true; exit ${PIPESTATUS[0]}"] {
        for json in ["", "--json"] {
            let output = shell(folder.path(), &format!("\"$IMMERSE\" inspect out {json} {stream}"));
            assert_eq!(output.status.code(), Some(1), "{stream}: {}", err(&output));
        }
    }
}

/// Mistakes are mistakes, and what is well is well, whether or not anybody hears of it.
#[cfg(target_os = "linux")]
#[test]
fn full_and_closed_streams_change_no_exit_code() {
    let folder = folder_with(&film(2, 2, ""));
    fs::write(folder.path().join("wrong.toml"), "[mesh]\nshape = 'spere'\n").expect("a scene");
    let well = ["check film.toml", "simulate film.toml", "run film.toml", "render film.toml", "inspect renders/film"];
    let well = well.iter().chain(&["schema", "man", "completions bash", "--help", "gallery film.toml"]);
    let wrong = ["check wrong.toml", "run wrong.toml", "run none.toml", "inspect none", "simulat film.toml", ""];
    let wrong = wrong.iter().chain(&["new film", "gallery wrong.toml", "render film.toml --frames 9"]);
    for (commands, code) in [(well.collect::<Vec<_>>(), 0), (wrong.collect(), 2)] {
        for command in commands {
            for stream in ["2> /dev/full", "2>&-", ">&- 2>&-", "2>&1 | true; exit ${PIPESTATUS[0]}", NO_READER] {
                let output = shell(folder.path(), &format!("\"$IMMERSE\" {command} {stream}"));
                assert_eq!(output.status.code(), Some(code), "{command} {stream}: {}", err(&output));
            }
            // Results that are lost are a failure, and mistakes have none.
            let output = shell(folder.path(), &format!("\"$IMMERSE\" {command} > /dev/full"));
            assert_eq!(output.status.code(), Some(code.max(1)), "{command}: {}", err(&output));
            assert!(code == 2 || err(&output).contains("standard output cannot be written"), "{}", err(&output));
        }
    }
    // One picture that cannot be told of does not keep the others from being made.
    fs::write(folder.path().join("other.toml"), film(2, 1, "")).expect("a scene");
    let script = "\"$IMMERSE\" gallery film.toml other.toml --out gallery > /dev/full";
    assert_code(&shell(folder.path(), script), 1);
    assert!(folder.path().join("gallery/other.png").exists());
}
