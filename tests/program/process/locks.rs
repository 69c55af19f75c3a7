//! One writer in one folder: the second waits, or says who is there and ends with 75.

use std::fs;
use std::process::Output;
use std::time::{Duration, SystemTime};

use super::{assert_code, assert_same, assert_tidy, end_of, err, files, film, folder_with, start, wait_until};

/// A film that takes a while.
fn long() -> String {
    film(24, 400, "")
}

/// As the second one, while the first one is at work for longer than anybody waits.
fn second(arguments: &[&str]) -> Output {
    let folder = folder_with(&long());
    let at = folder.path();
    fs::write(at.join("other.toml"), film(3, 3, "")).expect("a scene");
    let mut first = start(at, &["simulate", "film.toml", "--out", "out", "-q"]);
    wait_until("the first frame is there", || at.join("out/frames/000001.json").exists());
    let output = end_of(start(at, arguments));
    // A killed one leaves its file, and no lock.
    first.kill().expect("killed");
    first.wait().expect("an end");
    assert!(fs::read_to_string(at.join("out/.lock")).is_ok_and(|text| text.contains("simulate film.toml")));
    let after = end_of(start(at, &["simulate", "other.toml", "--out", "out", "--restart", "-q"]));
    assert_code(&after, 0);
    assert_tidy(&at.join("out"));
    output
}

#[test]
fn the_second_one_says_who_is_there() {
    for arguments in [
        &["run", "film.toml", "--out", "out"][..],
        &["simulate", "other.toml", "--out", "out", "--restart"],
        &["render", "film.toml", "--out", "out"],
    ] {
        let output = second(arguments);
        assert_code(&output, 75);
        let err = err(&output);
        assert_eq!(err.lines().count(), 2, "{err}");
        for part in
            ["waiting up to", "another process is at work in this folder", "immerse simulate film.toml", "try again"]
        {
            assert!(err.contains(part), "no `{part}` in {err}");
        }
    }
}

/// Twenty times two at once, of one scene or of two.
#[test]
fn two_at_once_make_one_film() {
    let folder = folder_with(&film(3, 3, ""));
    let at = folder.path();
    fs::write(at.join("other.toml"), film(2, 4, "")).expect("a scene");
    let mut whole = Vec::new();
    for scene in ["film", "other"] {
        let toml = format!("{scene}.toml");
        assert_code(&end_of(start(at, &["run", &toml, "--out", scene, "-q"])), 0);
        whole.push(files(&at.join(scene)));
    }
    for k in 0..20 {
        let out = format!("out{k}");
        let second = if k % 2 == 0 { "film.toml" } else { "other.toml" };
        let both = ["film.toml", second].map(|scene| start(at, &["run", scene, "--out", &out, "-q"]));
        let codes = both.map(|child| {
            let output = end_of(child);
            assert!(!err(&output).contains("panicked"), "{}", err(&output));
            output.status.code().expect("a code")
        });
        let found = files(&at.join(&out));
        if second == "film.toml" {
            assert_eq!(codes, [0, 0], "try {k}");
            assert_same(&found, &whole[0]);
        } else {
            // The film of the one that was first; the other one was refused.
            assert!(codes == [0, 2] || codes == [2, 0], "try {k}: {codes:?}");
            assert_same(&found, &whole[usize::from(codes[0] != 0)]);
        }
    }
}

#[test]
fn a_lock_without_a_holder_is_no_obstacle() {
    let folder = folder_with(&film(2, 2, ""));
    let at = folder.path();
    fs::create_dir(at.join("out")).expect("a folder");
    fs::write(at.join("out/.lock"), "process 1 on moon, since ever: immerse run film.toml\n").expect("a file");
    // What was begun by this version of the program goes, by a former one after a while; what others put there stays.
    let begin = |name: &str, age: u64| {
        let file = fs::File::create(at.join("out").join(name)).expect("a file");
        file.set_modified(SystemTime::now() - Duration::from_secs(age)).expect("a time");
    };
    let gone = [(".immerse-aB3xYz.part", 0), (".aB3xYz.part", 4000), (".immerse-aB3xYz", 4000)];
    gone.iter().for_each(|(name, age)| begin(name, *age));
    let staying = [(".aB3xYz.part", 60), (".notes.part", 60), (".immerse-notes.part.txt", 4000), (".part", 4000)];
    assert_code(&end_of(start(at, &["run", "film.toml", "--out", "out", "-q"])), 0);
    assert_tidy(&at.join("out"));
    staying.iter().for_each(|(name, age)| begin(name, *age));
    assert_code(&end_of(start(at, &["run", "film.toml", "--out", "out", "-q"])), 0);
    assert!(staying.iter().all(|(name, _)| at.join("out").join(name).exists()), "something of others is gone");
}

#[test]
fn what_is_refused_leaves_nothing() {
    let folder = folder_with("[mesh]\nfile = 'none.obj'\n");
    let output = end_of(start(folder.path(), &["run", "film.toml", "--out", "a/b/c", "-q"]));
    assert_code(&output, 2);
    assert_eq!(files(folder.path()).len(), 1);
    assert!(!folder.path().join("a").exists());
}
