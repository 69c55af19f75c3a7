//! Batch scripts of Slurm, and one that submits them.

use super::job::{Job, Step, Tasks};
use super::words::plain_name;
use super::written::Written;
use crate::cli::shell::{line, quoted};

/// All files there may be.
pub(super) const FILES: &[&str] = &["submit", "simulate.sbatch", "pictures.sbatch", "assemble.sbatch", "runs.sbatch"];

/// Runs the program with the arguments that were set, as a task that may be ended and go on.
const TASK: &str = include_str!("slurm_task.sh");

/// A script for each step, and `submit`.
pub(super) fn write(job: &Job) -> Written {
    let mut files = vec![("submit".to_owned(), submit(job))];
    files.extend(job.steps.iter().map(|step| (format!("{}.sbatch", step.name), script(job, step))));
    Written { files, start: "bash {}/submit".to_owned() }
}

fn submit(job: &Job) -> String {
    let mut text = "#!/bin/bash\n# Submits the steps of this job, each of which waits for the one before it, and prints the numbers they get.\n\
                    # Options of sbatch may follow, and take the place of those in the scripts: submit --partition=long --cpus-per-task=8\n\
                    set -euo pipefail\ncd \"$(dirname \"$0\")\"\nmkdir -p log\n\
                    submit() { sbatch --parsable --chdir=\"$PWD/log\" \"$@\"; }\n\n"
        .to_owned();
    let mut before: Option<&Step> = None;
    for step in &job.steps {
        let waits = before.map_or_else(String::new, |before| {
            // A run that fails, or whose checks do not hold, is a row of the table of its sweep.
            let when = if matches!(before.tasks, Tasks::Runs(_)) { "afterany" } else { "afterok" };
            format!("--dependency={when}:\"${{{}%%;*}}\" --kill-on-invalid-dep=yes ", before.name)
        });
        let name = step.name;
        text += &format!("{name}=$(submit {waits}\"$@\" {name}.sbatch)\necho \"{name}: ${name}\"\n");
        before = Some(step);
    }
    text
}

fn script(job: &Job, step: &Step) -> String {
    let (array, log) = match &step.tasks {
        Tasks::One => (String::new(), "%x.%j"),
        tasks => (format!("#SBATCH --array=0-{}\n", tasks.count() - 1), "%x.%A.%a"),
    };
    let hours = if matches!(step.tasks, Tasks::Frames(_)) { 4 } else { 12 };
    let arguments = match &step.tasks {
        Tasks::One => format!("set -- {}\n", line(&step.words)),
        Tasks::Frames(tasks) | Tasks::Runs(tasks) => {
            let case = |(number, task): (usize, &Vec<String>)| format!("{number}) set -- {} ;;\n", line(task));
            let cases: String = tasks.iter().enumerate().map(case).collect();
            let common = match step.words.is_empty() {
                true => String::new(),
                false => format!("set -- {} \"$@\"\n", line(&step.words)),
            };
            format!("case $SLURM_ARRAY_TASK_ID in\n{cases}esac\n{common}")
        }
    };
    format!(
        "#!/bin/bash\n# {}\n#SBATCH --job-name={}.{}\n#SBATCH --output={log}.log\n#SBATCH --open-mode=append\n{array}\
         #SBATCH --cpus-per-task=4\n#SBATCH --mem=4G\n#SBATCH --time={hours}:00:00\n#SBATCH --requeue\n\
         #SBATCH --signal=B:USR1@60\n\nimmerse={}\n{arguments}\n{TASK}",
        step.what,
        plain_name(&job.name),
        step.name,
        quoted(&job.program),
    )
}
