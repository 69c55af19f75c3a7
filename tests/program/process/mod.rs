//! The program as a process: signals, locks, streams, panics, limits, trouble with disks, paths.

mod disk_trouble;
mod faults;
mod locks;
mod paths;
mod progress;
mod signals;
mod streams;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A ball that swells, shown in so few pixels that its pictures cost little.
pub fn film(subdivisions: usize, frames: usize, output: &str) -> String {
    format!(
        "[mesh]\nshape = 'sphere'\nsubdivisions = {subdivisions}\n[start]\nfrom = 'mesh'\n\
         [metric]\nformula = 'length * (1 + 0.2 * t * z^2)'\n[[phase]]\nmax_steps = 20\n\
         [clock]\nframes = {frames}\n[output]\nsize = [64, 48]\nsamples = 4\n{output}"
    )
}

/// A folder with a scene, film.toml.
pub fn folder_with(scene: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("film.toml"), scene).expect("a scene");
    folder
}

/// The program, about to start in a folder. Tests that run in the background of a shell ignore SIGINT, which the program
/// would take over from them.
pub fn immerse(folder: &Path, arguments: &[&str]) -> Command {
    const PROGRAM: &str = env!("CARGO_BIN_EXE_immerse");
    let mut command = if are_signals_ignored() {
        let mut command = Command::new("env");
        command.args(["--default-signal=INT,TERM,HUP", PROGRAM]);
        command
    } else {
        Command::new(PROGRAM)
    };
    command.current_dir(folder).args(arguments).env_remove("NO_COLOR").env_remove("RUST_BACKTRACE");
    command.stdin(Stdio::null());
    command
}

/// Whether SIGHUP, SIGINT or SIGTERM are ignored by the tests themselves.
fn are_signals_ignored() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| [1, 2, 15].iter().any(|signal| mask >> (signal - 1) & 1 == 1))
}

/// The program in a shell that knows it as $IMMERSE.
pub fn shell(folder: &Path, script: &str) -> Output {
    let mut command = Command::new("bash");
    command.current_dir(folder).args(["-c", script]).env("IMMERSE", env!("CARGO_BIN_EXE_immerse"));
    command.env_remove("RUST_BACKTRACE").stdin(Stdio::null()).output().expect("a shell")
}

pub fn start(folder: &Path, arguments: &[&str]) -> Child {
    immerse(folder, arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
}

/// Waits for the end, but not for ever.
pub fn end_of(mut child: Child) -> Output {
    let begin = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if begin.elapsed() > Duration::from_secs(120) {
            child.kill().expect("killed");
            panic!("the program does not end: {}", err(&child.wait_with_output().expect("an end")));
        }
        thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().expect("an end")
}

pub fn out(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[track_caller]
pub fn assert_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}: {}", described(output.status), err(output));
    assert!(!err(output).contains("panicked"), "{}", err(output));
}

fn described(status: ExitStatus) -> String {
    status.to_string()
}

/// Waits until something holds.
#[track_caller]
pub fn wait_until(what: &str, holds: impl Fn() -> bool) {
    let begin = Instant::now();
    while !holds() {
        assert!(begin.elapsed() < Duration::from_secs(60), "it never comes that {what}");
        thread::sleep(Duration::from_millis(1));
    }
}

/// All files below a folder, with their bytes.
pub fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let bytes = fs::read(&path).expect("a file");
                files.insert(path.strip_prefix(folder).expect("it is below").to_owned(), bytes);
            }
        }
    }
    files
}

/// Files of the same names and bytes, named if they are not.
#[track_caller]
pub fn assert_same(found: &BTreeMap<PathBuf, Vec<u8>>, expected: &BTreeMap<PathBuf, Vec<u8>>) {
    let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(found), names(expected));
    for (name, bytes) in expected {
        assert!(&found[name] == bytes, "{} has other bytes", name.display());
    }
}

/// Nothing that was begun and not finished, and no lock.
#[track_caller]
pub fn assert_tidy(folder: &Path) {
    let left: Vec<PathBuf> = files(folder).into_keys().filter(|path| is_hidden(path)).collect();
    assert_eq!(left, Vec::<PathBuf>::new());
}

fn is_hidden(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'))
}

pub fn skip(why: &str) {
    eprintln!("SKIPPED: {why}");
}

/// Whether this is root, whom no rights and few limits bind.
#[cfg(unix)]
pub fn is_root() -> bool {
    use std::os::unix::fs::MetadataExt;
    fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0)
}

/// Lets everybody write into a folder, and gives the words before a command that run it as nobody; `None` where that
/// cannot be done.
#[cfg(unix)]
pub fn as_nobody(folder: &Path) -> Option<&'static str> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(folder, fs::Permissions::from_mode(0o777)).ok()?;
    if !is_root() {
        return Some("");
    }
    let words = "setpriv --reuid=65534 --regid=65534 --clear-groups";
    let script = format!("{words} \"$IMMERSE\" --version");
    shell(folder, &script).status.success().then_some(words)
}
