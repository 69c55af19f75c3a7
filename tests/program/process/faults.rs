//! A fault of the program or of the machine is one sentence, and never waits for ever.

use std::fs;

use super::{as_nobody, assert_code, end_of, err, files, film, folder_with, shell, skip, start};

/// Areas of the faces are not finite: whatever comes of it, the half that makes pictures does not wait for frames.
#[test]
fn what_fails_in_the_simulating_half_ends_the_other() {
    let scene = "[mesh]\nshape = 'torus'\n[metric]\nlength = 1e154\n[output]\nsize = [32, 24]\nsamples = 1\n";
    let folder = folder_with(scene);
    for command in ["run", "simulate", "check"] {
        let output = end_of(start(folder.path(), &[command, "film.toml", "--threads", "2"]));
        let err = err(&output);
        assert!(matches!(output.status.code(), Some(1 | 2)), "{command}: {}: {err}", output.status);
        assert!(!err.contains("panicked") && !err.contains("RUST_BACKTRACE"), "{command}: {err}");
        assert!(err.contains("error: "), "{command}: {err}");
    }
}

/// Nobody may have so few processes that no thread, one or two can be started. The film is the same.
#[cfg(target_os = "linux")]
#[test]
fn few_threads_will_do() {
    let folder = folder_with(&film(3, 3, ""));
    let Some(nobody) = as_nobody(folder.path()) else {
        return skip("nobody cannot run the program here");
    };
    assert_code(&shell(folder.path(), "\"$IMMERSE\" run film.toml --out whole -q"), 0);
    let whole = files(&folder.path().join("whole"));
    for processes in [1, 2, 3, 4] {
        let script = format!(
            "{nobody} bash -c 'ulimit -u {processes}; exec \"$IMMERSE\" run film.toml --out few{processes} --threads 3'"
        );
        // Not to wait for ever is the point.
        let output = shell(folder.path(), &format!("exec timeout -k 1 60 {script}"));
        assert_code(&output, 0);
        let found = files(&folder.path().join(format!("few{processes}")));
        super::assert_same(&found, &whole);
        let is_bound = fs::read_to_string("/proc/self/status").is_ok();
        assert!(!is_bound || processes > 1 || err(&output).contains("does not give 3 threads"), "{}", err(&output));
    }
}
