//! What a run will take: time, found by a short trial, memory and disk.

mod space;
mod trial;

use std::time::{Duration, Instant};

use super::failure::PipelineError;
use crate::evolve::Pace;
use crate::film;
use crate::scene::Scene;

pub(super) use self::space::memory_of_run;
use self::space::{disk_of_film, in_words as bytes_in_words};
use self::trial::{Costs, try_some_steps};

/// Says what a run of the scene will take.
pub(super) fn forecast(scene: &Scene) -> Result<Vec<String>, PipelineError> {
    let begin = Instant::now();
    let surface = scene.surface()?;
    let (faces, frames) = (surface.mesh.face_count(), scene.clock.frames);
    let counts = [surface.mesh.vertex_count(), surface.mesh.edge_count(), faces];
    let program = scene.program(&surface)?;
    let pace = program.pace;
    let Costs { first, next } =
        try_some_steps(surface, program).map_err(|error| PipelineError::from(scene.setup_fault(&error)))?;
    let later = match pace {
        Pace::EachClass => first,
        Pace::Steps(_) | Pace::Settle(_) | Pace::BothWays(_) => next,
    };
    let simulation = match pace {
        // The first frame is the first steps.
        Pace::Steps(_) => later.saturating_mul(frames as u32),
        _ => first + later.saturating_mul(frames.saturating_sub(1) as u32),
    };
    let picture = film::try_a_picture(scene, faces)?;
    let pictures = picture.time.saturating_mul(frames as u32);
    let threads = rayon::current_num_threads();
    let [of_frames, of_pictures] = match frames {
        1 => ["1 frame", "its picture"].map(str::to_owned),
        _ => [format!("{frames} frames"), format!("{frames} pictures")],
    };
    let [bytes_of_frames, of_disk] = disk_of_film(scene, counts, picture.bytes);
    Ok(vec![
        format!(
            "time: {} with {threads} threads, {} for {of_frames} of {faces} faces and {} for {of_pictures} (from a trial of \
             {:.1} s; surfaces that tangle take several times as long)",
            about(simulation + pictures),
            in_words(simulation),
            in_words(pictures),
            begin.elapsed().as_secs_f64(),
        ),
        format!(
            "memory: about {}; disk: about {}, of which frames {}",
            bytes_in_words(memory_of_run(scene, faces)),
            bytes_in_words(of_disk),
            bytes_in_words(bytes_of_frames),
        ),
    ])
}

/// No more exactly than it is known.
fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    match seconds {
        ..0.95 => "less than 1 s".to_owned(),
        ..10.0 => format!("{seconds:.0} s"),
        ..90.0 => format!("{:.0} s", (seconds / 10.0).round() * 10.0),
        ..5400.0 => format!("{:.0} min", seconds / 60.0),
        ..172_800.0 => format!("{:.1} h", seconds / 3600.0),
        _ => format!("{:.0} days", seconds / 86_400.0),
    }
}

fn about(time: Duration) -> String {
    let words = in_words(time);
    if words.starts_with("less") { words } else { format!("about {words}") }
}
