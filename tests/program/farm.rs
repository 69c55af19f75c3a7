//! Job files for farms: what they make is what one run makes, byte by byte.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use crate::process::{
    assert_code, assert_same, assert_tidy, end_of, err, files, film, folder_with, immerse, out, shell, start,
    wait_until,
};

/// As a shell would stumble over.
const ODD: &str = "a b'c $d";

/// All files of a film or a sweep but job files, what runs had to say, and times.
fn made(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut made = files(folder);
    made.retain(|path, _| {
        !path.starts_with("farm")
            && !path.ends_with("sweep.json")
            && path.extension().is_none_or(|ending| ending != "log")
    });
    if let Some(table) = made.get_mut(Path::new("sweep.csv")) {
        // Seconds are the last but one of its columns.
        let text = String::from_utf8_lossy(table).into_owned();
        let cut = |line: &str| {
            let mut columns: Vec<&str> = line.rsplitn(3, ',').collect();
            columns.remove(1);
            columns.join("|")
        };
        *table = text.lines().map(cut).collect::<Vec<_>>().join("\n").into_bytes();
    }
    made
}

/// The text of a job file.
fn job_file(film: &Path, name: &str) -> String {
    fs::read_to_string(film.join("farm").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Starts a line of a list of commands, from elsewhere.
fn begin(line: &str) -> Child {
    let mut shell = Command::new("sh");
    shell.current_dir("/").args(["-c", &format!("exec {line} --quiet")]).stdin(Stdio::null());
    shell.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a shell")
}

fn scene() -> String {
    film(
        4,
        12,
        "format = ['png', 'exr']\nanimation = ['gif']\nsheet = 4\nexport = ['obj']\n[checks]\nmax_l2_length_error = 0.9\n",
    )
}

/// Writes job files; gives what was said.
fn farm(at: &Path, arguments: &[&str]) -> String {
    let output = end_of(start(at, &[&["farm"], arguments].concat()));
    assert_code(&output, 0);
    out(&output)
}

#[test]
fn commands_make_what_a_run_makes_though_one_is_killed() {
    let folder = folder_with(&scene());
    let at = folder.path().join(ODD);
    fs::create_dir(&at).expect("a folder");
    fs::rename(folder.path().join("film.toml"), at.join("film.toml")).expect("moved");
    assert_code(&end_of(start(&at, &["run", "film.toml", "--out", "direct", "-q"])), 0);
    let said = farm(&at, &["film.toml", "--engine", "commands", "--out", "film"]);
    assert!(said.contains("tasks: 1 simulate, 2 pictures, 1 assemble"), "{said}");
    assert!(said.contains("parallel") && said.contains(r"'\''c $d"), "{said}");
    let film = at.join("film");
    assert_eq!(files(&film).len(), 3);

    assert_code(&end_of(begin(&job_file(&film, "1-simulate.txt"))), 0);
    let pictures = job_file(&film, "2-pictures.txt");
    assert_eq!(pictures.lines().map(|line| line.rsplit(' ').next()).collect::<Vec<_>>(), [Some("1-6"), Some("7-12")]);
    let mut killed = begin(pictures.lines().next().expect("a line"));
    wait_until("the first picture is there", || film.join("000001.png").exists());
    killed.kill().expect("killed");
    killed.wait().expect("an end");
    let tasks: Vec<Child> = pictures.lines().map(begin).collect();
    tasks.into_iter().for_each(|task| assert_code(&end_of(task), 0));
    assert_tidy(&film);
    assert!(film.join(".immerse/pictures.000007.jsonl").exists());
    assert_code(&end_of(begin(&job_file(&film, "3-assemble.txt"))), 0);
    assert_same(&made(&film), &made(&at.join("direct")));
}

#[test]
fn pictures_that_were_made_side_by_side_are_kept() {
    let folder = folder_with(&film(3, 4, "format = ['png']\nreport = false\n"));
    let at = folder.path();
    assert_code(&end_of(start(at, &["simulate", "film.toml", "--out", "out", "-q"])), 0);
    for frames in ["1-2", "2,4"] {
        assert_code(
            &end_of(start(at, &["render", "film.toml", "--out", "out", "--share", "--frames", frames, "-q"])),
            0,
        );
    }
    let times = || {
        ["000001.png", "000002.png", "000004.png"]
            .map(|name| fs::metadata(at.join("out").join(name)).expect("a picture").modified().expect("a time"))
    };
    let before = times();
    let output = end_of(start(at, &["run", "film.toml", "--out", "out", "-q"]));
    assert!(out(&output).contains("1 pictures made, 3 were there"), "{}", out(&output));
    assert_eq!(times(), before);

    // A picture of a look that is no more, and one that was made side by side, in whatever order they were entered.
    fs::write(at.join("film.toml"), film(3, 4, "format = ['png']\nreport = false\n[look]\npreset = 'soap'\n"))
        .expect("a scene");
    assert_code(&end_of(start(at, &["render", "film.toml", "--out", "out", "--share", "--frames", "2-3", "-q"])), 0);
    let output = end_of(start(at, &["run", "film.toml", "--out", "out", "-q"]));
    assert!(out(&output).contains("2 pictures made, 2 were there"), "{}", out(&output));
    assert_code(&end_of(start(at, &["run", "film.toml", "--out", "other", "-q"])), 0);
    assert_same(&files(&at.join("out")), &files(&at.join("other")));
    // What parts say is forgotten with the rest.
    assert_code(&end_of(start(at, &["render", "film.toml", "--out", "out", "--share", "--frames", "2", "-q"])), 0);
    let output = end_of(start(at, &["render", "film.toml", "--out", "out", "--restart", "-q"]));
    assert!(out(&output).contains("4 pictures made"), "{}", out(&output));
}

#[test]
fn pictures_beside_others_leave_the_film_as_it_is() {
    let folder = folder_with(&film(2, 3, ""));
    let at = folder.path();
    assert_code(&end_of(start(at, &["simulate", "film.toml", "--out", "out", "-q"])), 0);
    let before = files(at);
    let share =
        |more: &[&str]| end_of(start(at, &[&["render", "film.toml", "--out", "out", "--share", "-q"], more].concat()));
    let output = share(&["--set", "phase.0.max_steps=21"]);
    assert_code(&output, 2);
    assert!(
        err(&output).contains("does not hold the film of the scene as it is now; run `immerse simulate` first"),
        "{}",
        err(&output)
    );
    let output = share(&["--restart"]);
    assert_code(&output, 2);
    assert_same(&files(at), &before);
}

#[test]
fn whoever_shares_a_folder_waits_for_whoever_has_it_alone_and_the_other_way_round() {
    let folder = folder_with(&film(2, 12, "format = ['png']\n"));
    let at = folder.path();
    for out in ["one", "two"] {
        assert_code(&end_of(start(at, &["simulate", "film.toml", "--out", out, "-q"])), 0);
        farm(at, &["film.toml", "--engine", "slurm", "--out", out]);
    }
    let lock = |out: &str| File::create(at.join(out).join(".lock")).expect("a file");
    let (alone, shared) = (lock("one"), lock("two"));
    alone.lock().expect("a lock");
    shared.lock_shared().expect("a lock");
    let share = ["render", "film.toml", "--share", "--frames", "1-2", "-q", "--out"];
    let waiting = start(at, &[&share[..], &["one"]].concat());
    let waiting_for_others = start(at, &["run", "film.toml", "--out", "two", "-q"]);
    // A task of Slurm is queued again then, if it was not so too often.
    let task = |restarts: usize| {
        let script = "mkdir -p bin; printf 'echo \"$@\" >>../../asked\\n' >bin/scontrol; chmod +x bin/scontrol; \
                      PATH=$PWD/bin:$PATH SLURM_JOB_ID=";
        let script =
            format!("{script}{restarts} SLURM_RESTART_COUNT={restarts} SLURM_ARRAY_TASK_ID=1 bash pictures.sbatch");
        let mut shell = Command::new("bash");
        let shell = shell.current_dir(at.join("one/farm")).args(["-c", &script]);
        shell.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a shell")
    };
    let tasks = [9, 10].map(task);
    assert_code(&end_of(start(at, &[&share[..], &["two"]].concat())), 0);
    assert!(at.join("two/000002.png").exists());
    for child in [waiting, waiting_for_others].into_iter().chain(tasks) {
        let output = end_of(child);
        assert_code(&output, 75);
        assert!(err(&output).contains("another process is at work in this folder"), "{}", err(&output));
    }
    assert_eq!(fs::read_to_string(at.join("asked")).expect("what was asked"), "requeue 9\n");
}

/// Tells the program that it is submitted, runs each task of a script at once, and says which number it has.
const SBATCH: &str = r#"
script=${!#}
echo "$*" >>"$ASKED"
tasks=$(sed -n 's/^#SBATCH --array=0-//p' "$script")
for task in $(seq 0 "${tasks:-0}"); do
  SLURM_JOB_ID=7 SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=2 bash "$script" >>"$ASKED.log" 2>&1 || exit
done
wc -l <"$ASKED"
"#;

fn submitted(at: &Path, job: &str) -> Output {
    fs::create_dir_all(at.join("bin")).expect("a folder");
    fs::write(at.join("bin/sbatch"), format!("#!/bin/bash{SBATCH}")).expect("a script");
    let script = format!(
        "chmod +x bin/sbatch; export ASKED=$PWD/asked; PATH=$PWD/bin:$PATH bash {job}/farm/submit --partition=long"
    );
    shell(at, &script)
}

#[test]
fn batch_scripts_make_what_a_run_makes() {
    let folder = folder_with(&film(2, 24, "format = ['png']\nanimation = ['gif']\n"));
    let at = folder.path();
    let direct =
        ["run", "film.toml", "--frames", "1-20,21-24:3", "--set", "look.preset=bands", "-q", "--out", "direct"];
    assert_code(&end_of(start(at, &direct)), 0);
    let said = farm(
        at,
        &["film.toml", "--engine", "slurm", "--frames", "1-20,21-24:3", "--set", "look.preset=bands", "--out", "film"],
    );
    assert!(said.contains("submit, simulate.sbatch, pictures.sbatch, assemble.sbatch written"), "{said}");
    let pictures = job_file(&at.join("film"), "pictures.sbatch");
    for part in ["--array=0-2\n", "0) set -- --frames 1-7 ;;", "2) set -- --frames 15-21:1,24 ;;", "--requeue\n"] {
        let part = part.replace(":1", "");
        assert!(pictures.contains(&part), "no `{part}` in {pictures}");
    }
    let output = submitted(at, "film");
    assert_code(&output, 0);
    assert_eq!(out(&output), "simulate: 1\npictures: 2\nassemble: 3\n");
    let asked = fs::read_to_string(at.join("asked")).expect("what was asked");
    let waits = |before: usize, name: &str| {
        format!("--dependency=afterok:{before} --kill-on-invalid-dep=yes --partition=long {name}.sbatch")
    };
    for part in ["--partition=long simulate.sbatch", &waits(1, "pictures"), &waits(2, "assemble")] {
        assert!(asked.contains(part), "no `{part}` in {asked}");
    }
    assert_same(&made(&at.join("film")), &made(&at.join("direct")));
}

const TORUS: &str = "[mesh]\nshape = 'torus'\ncolumns = 16\nrows = 8\n[start]\nrandom = 0\n[[phase]]\nmax_steps = 20\n[clock]\nframes = 1\n\
                     [checks]\nmax_l2_length_error = 0.5\n[output]\nsize = [48, 36]\nsamples = 1\nreport = false\n";
const SETS: [&str; 6] =
    ["--set", "spin.class=00,01", "--set", "checks.max_l2_length_error=0.5,1e-12", "--set", "start.random=3"];

#[test]
fn sweeps_are_made_by_batch_scripts_and_by_commands() {
    let folder = folder_with(TORUS);
    let at = folder.path();
    // A check of two of them does not hold.
    assert_code(&end_of(start(at, &[&["sweep", "film.toml", "--out", "direct", "-q"], &SETS[..]].concat())), 1);
    let said = farm(at, &[&["film.toml", "--engine", "commands", "--out", ODD], &SETS[..]].concat());
    assert!(said.contains("tasks: 4 runs, 1 assemble"), "{said}");
    let runs = job_file(&at.join(ODD), "1-runs.txt");
    let codes = runs.lines().map(|line| end_of(begin(line)).status.code());
    assert_eq!(codes.collect::<Vec<_>>(), [Some(0), Some(1), Some(0), Some(1)]);
    assert_code(&end_of(begin(&job_file(&at.join(ODD), "2-assemble.txt"))), 1);
    assert_same(&made(&at.join(ODD)), &made(&at.join("direct")));

    farm(at, &[&["film.toml", "--engine", "slurm", "--out", "slurm"], &SETS[..]].concat());
    let runs = job_file(&at.join("slurm"), "runs.sbatch");
    assert!(runs.contains("--array=0-3\n") && runs.contains("set -- run "), "{runs}");
    assert!(job_file(&at.join("slurm"), "submit").contains("--dependency=afterany:"));
}

#[test]
fn a_template_says_what_is_done() {
    let folder = folder_with(&scene());
    let at = folder.path();
    let said = farm(at, &["film.toml", "--engine", "openjd", "--out", "film"]);
    assert!(said.contains("openjd run ") && said.contains("job.yaml written"), "{said}");
    let job = job_file(&at.join("film"), "job.yaml");
    for part in [
        "extensions: [TASK_CHUNKING]",
        "default: \"1-12\"",
        "type: CHUNK[INT]",
        "defaultTaskCount: 6",
        "dependsOn: Pictures",
        "- \"--share\"",
    ] {
        assert!(job.contains(part), "no `{part}` in {job}");
    }
    farm(at, &["film.toml", "--engine", "openjd", "--out", "sweep", "--set", "start.random=1,2"]);
    let job = job_file(&at.join("sweep"), "job.yaml");
    assert!(job.contains("range: \"0-1\"") && !job.contains("TASK_CHUNKING"), "{job}");
}

#[test]
fn what_cannot_be_a_job_is_refused_before_anything_is_written() {
    let folder = folder_with(&film(2, 3, ""));
    let at = folder.path();
    for (arguments, said) in [
        (&["film.toml", "--engine", "slurm", "--set", "clock.frames=2,-1"][..], "--set clock.frames=-1"),
        (&["film.toml", "--engine", "slurm", "--frames", "1-4"], "frame 4 is asked for"),
        (
            &["film.toml", "--engine", "slurm", "--frames", "1", "--set", "start.random=1,2"],
            "a sweep makes pictures of all frames",
        ),
        (&["film.toml", "--engine", "commands", "--out", "two\nlines"], "name another file or folder"),
        (&["film.toml", "--engine", "openjd", "--out", "{{Param.X}}"], "two braces"),
        (&["none.toml", "--engine", "openjd"], "none.toml"),
    ] {
        let output = end_of(start(at, &[&["farm"], arguments].concat()));
        assert_code(&output, 2);
        assert!(err(&output).contains(said), "no `{said}` in {}", err(&output));
    }
    assert_eq!(files(at).len(), 1);
}

#[test]
fn slurm_says_how_many_threads_there_are() {
    let folder = folder_with(TORUS);
    let sweep = |name: &str, cpus: &str, more: &[&str]| {
        let arguments = [&["sweep", "film.toml", "--set", "start.random=1,2,3", "--out", name], more].concat();
        err(&immerse(folder.path(), &arguments).env("SLURM_CPUS_PER_TASK", cpus).output().expect("an end"))
    };
    assert!(sweep("one", "1", &[]).contains("3 runs, 1 at a time"));
    assert!(sweep("one", "3", &[]).contains("3 runs, 3 at a time"));
    assert!(sweep("one", "3", &["--threads", "2"]).contains("3 runs, 2 at a time"));
    for nonsense in ["0", "-1", "many", "1000000", ""] {
        let said = sweep("one", nonsense, &[]);
        assert!(
            said.contains(&format!("SLURM_CPUS_PER_TASK is {nonsense:?}, which is no number of processors")),
            "{said}"
        );
    }
}
