//! Sweeps: every combination of values, a table and a picture of all, and going on where one was stopped.

use std::fs;
use std::path::Path;

use crate::support::program;
use tempfile::TempDir;

const SCENE: &str = "[mesh]\nshape = 'torus'\ncolumns = 16\nrows = 8\n[start]\nrandom = 0\n[clock]\nframes = 1\n\
                     [checks]\nmax_l2_length_error = 0.5\n[output]\nsize = [48, 36]\nsamples = 1\nreport = false\n";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("torus.toml"), SCENE).unwrap();
    folder
}

fn table(folder: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("sweep.csv")).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn all_combinations_are_those_of_runs_by_hand() {
    let folder = folder();
    let sets = ["sweep", "torus.toml", "--set", "spin.class=00,01", "--set", "start.random=3,4", "--out", "all"];
    let (code, out, err) = program(folder.path(), &sets);
    assert_eq!(code, 0, "{err}");
    assert!(out.lines().next().unwrap().contains("spin.class  start.random"), "{out}");
    let all = folder.path().join("all");
    assert!(fs::read(all.join("sweep.png")).unwrap().starts_with(b"\x89PNG"));
    let text = fs::read_to_string(all.join("sweep.csv")).unwrap();
    assert_eq!(text.lines().count(), 5, "{text}");
    assert!(text.lines().nth(2).unwrap().starts_with("\"spin.class=00,start.random=4\",00,4,1,"), "{text}");

    let by_hand = ["run", "torus.toml", "--set", "spin.class=01", "--set", "start.random=3", "--out", "one"];
    assert_eq!(program(folder.path(), &by_hand).0, 0);
    for file in ["frames/000001.npz", "000001.png", "mesh.npz"] {
        let [one, other] = ["one", "all/spin.class=01,start.random=3"]
            .map(|film| fs::read(folder.path().join(film).join(file)).unwrap());
        assert!(one == other, "{file} differs");
    }
}

#[test]
fn what_is_there_is_kept_and_what_is_not_is_made() {
    let folder = folder();
    let arguments = ["sweep", "torus.toml", "--set", "start.random=1,2,3", "--out", "all"];
    assert_eq!(program(folder.path(), &arguments).0, 0);
    let frame = |seed: usize| folder.path().join(format!("all/start.random={seed}/frames/000001.npz"));
    let before = [1, 2].map(|seed| fs::metadata(frame(seed)).unwrap().modified().unwrap());
    let first = table(&folder.path().join("all"));
    fs::remove_dir_all(folder.path().join("all/start.random=3")).unwrap();
    assert_eq!(program(folder.path(), &arguments).0, 0);
    assert_eq!([1, 2].map(|seed| fs::metadata(frame(seed)).unwrap().modified().unwrap()), before);
    let seconds = first[0].iter().position(|title| title == "seconds").unwrap();
    for (one, other) in first.iter().zip(&table(&folder.path().join("all"))) {
        assert_eq!(one[..seconds], other[..seconds]);
    }
}

#[test]
fn a_mistake_in_one_run_begins_none() {
    let folder = folder();
    let (code, _, err) = program(folder.path(), &["sweep", "torus.toml", "--set", "start.random=1,-2", "--out", "all"]);
    assert_eq!(code, 2);
    assert!(err.contains("--set start.random=-2"), "{err}");
    assert!(!folder.path().join("all").exists());
}

#[test]
fn a_check_that_does_not_hold_ends_the_sweep_with_1_and_with_all_runs() {
    let folder = folder();
    let sets = ["sweep", "torus.toml", "--set", "checks.max_l2_length_error=0.5,1e-30", "--out", "all"];
    let (code, out, _) = program(folder.path(), &sets);
    assert_eq!(code, 1, "{out}");
    let column = |line: usize| table(&folder.path().join("all"))[line].last().unwrap().clone();
    assert_eq!([column(1), column(2)], ["yes", "NO"]);
}

#[test]
fn a_sweep_has_a_page_with_its_table_and_pictures() {
    let folder = folder();
    let sets = ["--set", "start.random=3,4", "--set", "spin.class=01", "--set", "output.report=true", "--out", "all"];
    let (code, out, err) = program(folder.path(), &[&["sweep", "torus.toml"][..], &sets].concat());
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("all: table, page and picture written"), "{out}");
    let path = folder.path().join("all/report.html");
    let page = fs::read_to_string(&path).unwrap();
    let facts = facts_of(&page);
    assert_eq!(facts["keys"], serde_json::json!(["start.random"]));
    assert_eq!(facts["common"], serde_json::json!(["spin.class = 01", "output.report = true"]));
    let runs = facts["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 2);
    for (run, seed) in runs.iter().zip(["3", "4"]) {
        assert_eq!(run["values"], serde_json::json!([seed]));
        assert_eq!(run["page"], format!("start.random={seed}/report.html"));
        assert!(folder.path().join("all").join(run["page"].as_str().unwrap()).is_file());
        assert!(run["picture"].as_str().unwrap().starts_with("data:image/png;base64,"));
        assert!(run["last"]["l2_length_error"].as_f64().unwrap() > 0.0);
    }
    // Of a film that is gone the page says so, and the others stay.
    fs::remove_dir_all(folder.path().join("all/start.random=4")).unwrap();
    let (code, out, err) = program(folder.path(), &["report", "all"]);
    assert_eq!((code, out.as_str()), (0, "all: report.html written\n"), "{err}");
    let runs = facts_of(&fs::read_to_string(&path).unwrap())["runs"].clone();
    assert!(runs[1]["last"].is_null() && runs[1]["picture"].is_null() && !runs[0]["last"].is_null());
    // And the sweep makes what is gone, and the same page.
    assert_eq!(program(folder.path(), &[&["sweep", "torus.toml"][..], &sets].concat()).0, 0);
    assert!(fs::read_to_string(&path).unwrap() == page, "the page differs");
}

fn facts_of(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("id=\"facts\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn all_classes_are_those_of_the_surface() {
    let folder = folder();
    let (code, _, err) = program(folder.path(), &["sweep", "torus.toml", "--set", "spin.class=all", "--out", "all"]);
    assert_eq!(code, 0, "{err}");
    let rows = table(&folder.path().join("all"));
    let column = |title: &str| rows[0].iter().position(|name| name == title).unwrap();
    for title in ["spin.class", "asked_class"] {
        let classes: Vec<&str> = rows[1..].iter().map(|row| row[column(title)].as_str()).collect();
        assert_eq!(classes, ["00", "01", "10", "11"], "{title}");
    }
}
