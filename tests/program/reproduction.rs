//! The example that makes the paper's figures again: what a part says, and that parts of earlier runs stay.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The built example; it lies beside the folder of the tests. `cargo test` builds it, `cargo test --test program` does not.
fn example() -> Option<PathBuf> {
    let test = std::env::current_exe().expect("this test");
    let name = format!("reproduce{}", std::env::consts::EXE_SUFFIX);
    let path = test.parent()?.parent()?.join("examples").join(name);
    path.is_file().then_some(path)
}

fn reproduce(example: &Path, folder: &Path, parts: &[&str]) -> String {
    let only = parts.iter().flat_map(|part| ["--only", part]);
    let output = Command::new(example).arg("--quick").args(only).arg("--out").arg(folder).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    fs::read_to_string(folder.join("REPRODUCTION.md")).expect("a page")
}

#[test]
fn parts_are_put_beside_those_that_are_there() {
    let Some(example) = example() else {
        eprintln!("SKIPPED: the example `reproduce` is not built; cargo build --release --example reproduce");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let first = reproduce(&example, folder.path(), &["fig12"]);
    assert!(first.contains("\n| Fig. 12, deflated ball | 8000 | 1.2 % | 0 | 1280 | 0."), "{first}");
    assert!(first.contains("- Fig. 14: a flat torus in its four classes: `--only fig14`"), "{first}");
    assert!(!first.contains("**miss**"), "{first}");
    assert!(folder.path().join("renders/reproduction/fig12.png").is_file());

    let second = reproduce(&example, folder.path(), &["convex", "fig6"]);
    for part in ["fig12", "convex", "fig6"] {
        assert_eq!(second.matches(&format!("<!-- part {part} -->")).count(), 1, "{second}");
    }
    assert!(second.contains("1920 of 1920"), "every hinge of the ellipsoid is convex: {second}");
    assert!(second.contains("with 0 exceptions"), "rims end at pinch points: {second}");
    // In the order of the page, whatever order they were made in.
    assert!(second.find("<!-- part fig6").expect("a part") < second.find("<!-- part fig12").expect("a part"));

    let unknown = Command::new(&example).args(["--only", "fig3"]).output().expect("it starts");
    assert!(!unknown.status.success());
    assert!(String::from_utf8_lossy(&unknown.stderr).contains("there is no part `fig3`"));
}
