//! How fast the way from lengths to shape is.
//!
//! `cargo bench --bench speed` prints a table of whole runs at the sizes up to 29 thousand faces; with `-- all` also those of
//! 200 thousand and a million. `benches/run.sh` compares with NumPy/SciPy and CHOLMOD; it starts this program once for
//! each measurement, `speed COMMAND …`, and reads one line of JSON:
//!
//!     whole SURFACE [target=ERROR] [steps=N]    a whole run, or until the error, or with at most N steps a phase
//!     step SURFACE [repeats=N] [folder=DIR]     one gradient step at each Δt of the default phases
//!     problem SURFACE folder=DIR                writes a surface for paper_method.py
//!     triad                                     bytes per second that the memory gives
//!
//! Each is a process of its own, so that its peak of memory is its own; `RAYON_NUM_THREADS` says on how many threads.
#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::exit,
    clippy::disallowed_methods,
    reason = "a benchmark is a program of its own, which prints and fails by panicking"
)]

mod npy;
mod scenes;
mod step;
mod triad;
mod whole;

use std::{collections::HashMap, error::Error, path::Path, process::Command};

use serde_json::{Value, json};

fn measure(words: &[String]) -> Result<Value, Box<dyn Error>> {
    let options: HashMap<&str, &str> = words.iter().filter_map(|word| word.split_once('=')).collect();
    let surface = words.get(1).map_or("", String::as_str);
    let number = |name: &str| options.get(name).map(|value| value.parse::<f64>()).transpose();
    let folder = options.get("folder").map(Path::new);
    let mut value = match words[0].as_str() {
        "whole" => whole::run(surface, number("target")?, number("steps")?.map(|steps| steps as usize))?,
        "step" => step::run(surface, number("repeats")?.unwrap_or(3.0) as usize, folder)?,
        "problem" => {
            let simulation = scenes::scene(surface)?.simulation()?;
            step::write_problem(&simulation, folder.ok_or("say folder=DIR")?)?;
            json!({ "faces": simulation.mesh().face_count() })
        }
        "triad" => triad::run(),
        other => return Err(format!("there is no measurement `{other}`").into()),
    };
    value["threads"] = json!(rayon::current_num_threads());
    value["peak_bytes"] = json!(peak_bytes());
    Ok(value)
}

/// The most memory this process has held, where the system says.
fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
}

/// A measurement in a process of its own.
fn measured_apart(words: &[&str]) -> Result<Value, Box<dyn Error>> {
    let output = Command::new(std::env::current_exe()?).args(words).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo itself passes `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let all = words == ["all"];
    if !words.is_empty() && !all {
        println!("{}", measure(&words)?);
        return Ok(());
    }
    println!(
        "whole runs on {} threads; those above 100k faces take at most 5 steps a phase",
        rayon::current_num_threads()
    );
    println!(
        "{:>12} {:>9} {:>6} {:>7} {:>9} {:>11} {:>9}  seconds of set-up and phases",
        "surface", "seconds", "steps", "inner", "L2 error", "rims+pinch", "peak MiB"
    );
    let spheres = scenes::SPHERES.map(|(name, _)| name);
    for name in ["torus-00", "torus-01", "torus-10", "torus-11", "hare"].into_iter().chain(spheres) {
        let large = name.ends_with("200k") || name.ends_with("1M");
        if large && !all {
            continue;
        }
        let words = ["whole", name, "steps=5"];
        let value = measured_apart(&words[..if large { 3 } else { 2 }])?;
        let number = |key: &str| value[key].as_f64().unwrap_or(f64::NAN);
        let phases = value["phases"].as_array().into_iter().flatten();
        let parts: String =
            phases.map(|phase| format!(" {:.2}", phase["seconds"].as_f64().unwrap_or(f64::NAN))).collect();
        println!(
            "{name:>12} {:>9.2} {:>6} {:>7} {:>8.3}% {:>11} {:>9.0}  {:.2}{parts}",
            number("seconds"),
            value["steps"].to_string(),
            value["inner_iterations"].to_string(),
            1e2 * number("l2_length_error"),
            number("rims") + number("pinch_points"),
            number("peak_bytes") / 1048576.0,
            number("setup_seconds"),
        );
    }
    Ok(())
}
