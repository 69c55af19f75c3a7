//! A job template of Open Job Description.

use super::job::{Job, Step, Tasks};
use super::words::plain_name;
use super::written::Written;
use crate::cli::failure::Failure;
use crate::cli::shell::line;

/// All files there may be.
pub(super) const FILES: &[&str] = &["job.yaml"];

/// One template.
pub(super) fn write(job: &Job) -> Result<Written, Failure> {
    let mut text = String::from(
        "# The steps of this job. Paths in it are the same on all machines.\nspecificationVersion: jobtemplate-2023-09\n",
    );
    if job.frames.is_some() {
        text += "extensions: [TASK_CHUNKING]\n";
    }
    text += &format!("name: {}\nparameterDefinitions:\n", string_of(&plain_name(&job.name)));
    text += &format!("  - {{name: Immerse, type: STRING, default: {}}}\n", string(&job.program)?);
    if let Some((frames, _)) = &job.frames {
        text += &format!("  - {{name: Frames, type: STRING, default: {}}}\n", string(frames)?);
    }
    text += "steps:\n";
    let mut before: Option<&Step> = None;
    for step in &job.steps {
        text += &format!("  # {}\n  - name: {}\n", step.what, title(step));
        if let Some(before) = before {
            text += &format!("    dependencies: [{{dependsOn: {}}}]\n", title(before));
        }
        text += &match &step.tasks {
            Tasks::One => one(step)?,
            Tasks::Frames(_) => pictures(step, job.frames.as_ref().map_or(1, |(_, at_a_time)| *at_a_time))?,
            Tasks::Runs(tasks) => runs(step, tasks)?,
        };
        before = Some(step);
    }
    Ok(Written { files: vec![("job.yaml".to_owned(), text)], start: "openjd run {}/job.yaml".to_owned() })
}

fn one(step: &Step) -> Result<String, Failure> {
    let mut words = strings(&step.words)?;
    // Pictures of these frames are put together; all of them are what is asked for anyway if nobody says anything.
    if step.name == "assemble" && step.words.first().is_some_and(|name| name == "run") {
        let own = step.words.iter().position(|word| word == "--frames").unwrap_or(words.len());
        words.truncate(own);
        words.extend(["--frames".to_owned(), string_of("{{Param.Frames}}")]);
    }
    Ok(script("", &words))
}

/// Tasks of some frames each, cut by the engine.
fn pictures(step: &Step, at_a_time: usize) -> Result<String, Failure> {
    let mut words = strings(&step.words)?;
    words.extend(["--frames".to_owned(), string_of("{{Task.Param.Frame}}")]);
    let space = format!(
        "    parameterSpace:\n      taskParameterDefinitions:\n        - name: Frame\n          type: CHUNK[INT]\n          \
         range: \"{{{{Param.Frames}}}}\"\n          chunks: {{defaultTaskCount: {at_a_time}, rangeConstraint: NONCONTIGUOUS}}\n"
    );
    Ok(script(&space, &words))
}

/// Tasks by number. What each is stands in a script, which takes a check that does not hold for an end like any other: a row of the
/// table that the next step makes.
fn runs(step: &Step, tasks: &[Vec<String>]) -> Result<String, Failure> {
    let mut cases = String::new();
    for (number, task) in tasks.iter().enumerate() {
        no_braces(task)?;
        cases += &format!("              {number}) set -- {} ;;\n", line(&[&*step.words, task].concat()));
    }
    Ok(format!(
        "    parameterSpace:\n      taskParameterDefinitions:\n        - {{name: Run, type: INT, range: \"0-{last}\"}}\n    \
         script:\n      actions:\n        onRun:\n          command: bash\n          \
         args: [\"{{{{Task.File.Run}}}}\", \"{{{{Param.Immerse}}}}\", \"{{{{Task.Param.Run}}}}\"]\n      \
         embeddedFiles:\n        - name: Run\n          type: TEXT\n          data: |\n            immerse=$1\n            \
         case $2 in\n{cases}            esac\n            \
         # A check that does not hold (1) is a row of the table.\n            \
         \"$immerse\" \"$@\" || [ $? = 1 ]\n",
        last = tasks.len() - 1,
    ))
}

fn script(space: &str, words: &[String]) -> String {
    let arguments: String = words.iter().map(|word| format!("            - {word}\n")).collect();
    format!(
        "{space}    script:\n      actions:\n        onRun:\n          command: \"{{{{Param.Immerse}}}}\"\n          args:\n{arguments}"
    )
}

fn title(step: &Step) -> String {
    let mut letters = step.name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn strings(words: &[String]) -> Result<Vec<String>, Failure> {
    words.iter().map(|word| string(word)).collect()
}

/// A text that stands for itself.
fn string(text: &str) -> Result<String, Failure> {
    no_braces(&[text.to_owned()])?;
    Ok(string_of(text))
}

/// Two braces are where a value is put in.
fn no_braces(words: &[String]) -> Result<(), Failure> {
    match words.iter().find(|word| word.contains("{{")) {
        Some(word) => Err(Failure::Farm(format!(
            "`{word}` has two braces, which Open Job Description puts a value for; name it otherwise"
        ))),
        None => Ok(()),
    }
}

/// Quoted as YAML and JSON have it.
fn string_of(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
