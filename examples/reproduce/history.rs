//! The curves of Fig. 8, a relaxation step by step, and of Fig. 1 and 20, an eversion.

use super::document::{Line, Section};
use super::pictures::{BESIDE, Style, Tile, picture_of, picture_of_errors, save, sheet};
use super::plots::{self, BLUE, Curve, INK, ORANGE, Panel};
use super::request::{Outcome, Request, shipped};
use super::solve::{Found, MOMENTS, Polish, rims_of, scene, solve_scene};
use super::table::{Sorted, Table, line, percent};
use immerse::Simulation;
use immerse::evolve::{FrameReport, Unobserved};
use immerse::scene::Scene;
use std::path::PathBuf;

fn curve(
    name: &str,
    color: plotters::style::RGBColor,
    reports: &[FrameReport],
    value: fn(&FrameReport) -> f64,
) -> Curve {
    let points = reports.iter().map(|report| (report.frame as f64 - 1.0, value(report))).collect();
    Curve { name: name.into(), color, points }
}

/// The bunny of the paper, or nothing, for a hare to stand in.
fn bunny(request: &Request) -> Outcome<Option<PathBuf>> {
    Ok(request.paper_mesh("bunny.obj")?.filter(|_| !request.quick))
}

/// Length errors from here on have the colour of the largest.
const MOST_SHOWN: f32 = 0.1;
/// Steps of each stage of Fig. 8, and its ε.
const STEPS: usize = 15;
const STAGES: [&str; 4] = ["ε = (1, 1, 1, 1)", "(1, 0.1, 1, 0.1)", "(1, 0.01, 1, 0.1)", "(1, 0.001, 1, 0.1)"];

pub fn figure_8(request: &Request) -> Outcome<Section> {
    let mesh = bunny(request)?;
    let keys = if request.quick { vec!["mesh.edge_length=0.12".to_owned()] } else { Vec::new() };
    let mut made = Vec::new();
    let mut table = Table::default();
    for (name, words) in [("error_history", "with feedback"), ("error_history_without_feedback", "without feedback")] {
        let scene = scene(&shipped(name), &keys, mesh.as_ref())?;
        let found = solve_scene(&scene, Polish::Before)?;
        table.add(&format!("Fig. 8, {words}"), &found);
        made.push((words, found));
    }
    let errors =
        |color, (words, found): &(&str, Found)| curve(words, color, &found.reports, |report| report.l2_length_error);
    let stages: Vec<(f64, String)> =
        STAGES.iter().enumerate().map(|(k, name)| ((k * STEPS) as f64, (*name).to_owned())).collect();
    let panels = [Panel {
        title: "L2 length error".into(),
        is_logarithmic: true,
        curves: vec![errors(ORANGE, &made[1]), errors(BLUE, &made[0])],
        stages,
    }];
    let plot = plots::save(request, "fig8", "step", &panels, "length error over steps, with and without feedback")?;
    let mut tiles = Vec::new();
    for (words, found) in &made {
        for frame in &found.moments[1..] {
            let picture = picture_of_errors(found, &frame.positions, MOST_SHOWN)?;
            let steps = frame.report.frame - 1;
            tiles.push(Tile {
                picture,
                caption: format!("{words}, {steps} steps: {}", percent(frame.report.l2_length_error)),
            });
        }
    }
    let image = save(
        request,
        "fig8_surfaces",
        &sheet(&tiles, MOMENTS - 1),
        "the surface after each stage, coloured by length error",
    )?;
    let name = if mesh.is_some() { "the paper's bunny" } else { "a hare in the bunny's place" };
    let mut ends = String::from("| stage | with feedback | without |\n|---|--:|--:|\n");
    for (k, stage) in STAGES.iter().enumerate() {
        let at = |found: &Found| percent(found.reports[(k + 1) * STEPS].l2_length_error);
        ends += &format!("| after {} steps, {stage} | {} | {} |\n", (k + 1) * STEPS, at(&made[0].1), at(&made[1].1));
    }
    let summary = made
        .iter()
        .map(|(words, found)| line(&format!("Fig. 8, {words}"), None, &Sorted::new(vec![found.clone()]), None));
    Ok(Section {
        summary: summary.collect(),
        body: format!(
            "Sixty steps from random frames in the four stages of Eq. 21, fifteen each, on {name}, with and without the feedback of the integrated \
            surface of Sec. 5.4.1. In the paper, too, the error falls from stage to stage and is lower with feedback. Colours are mean errors of the edges around each vertex, from none, dark, to {} and more, yellow.\n\n{plot}\n{image}\n{ends}\n{table}",
            percent(MOST_SHOWN.into()),
        ),
    })
}

/// Pictures of the eversion, of moments evenly over it.
const PICTURES: usize = 9;

pub fn figure_20(request: &Request) -> Outcome<Section> {
    let mesh = bunny(request)?;
    let name = if mesh.is_some() { "bunny_eversion" } else { "hare_eversion" };
    let keys =
        if request.quick { vec!["mesh.edge_length=0.12".to_owned(), "clock.frames=30".into()] } else { Vec::new() };
    let scene = scene(&shipped(name), &keys, mesh.as_ref())?;
    let begin = std::time::Instant::now();
    let (reports, tiles) = film(&scene)?;
    let seconds = begin.elapsed().as_secs_f64();
    let panel =
        |title: &str, is_logarithmic, curves| Panel { title: title.into(), is_logarithmic, curves, stages: Vec::new() };
    let panels = [
        panel(
            "length error",
            true,
            vec![
                curve("max", ORANGE, &reports, |report| report.max_length_error),
                curve("L2", BLUE, &reports, |report| report.l2_length_error),
            ],
        ),
        panel("rims", false, vec![curve("rims", INK, &reports, |report| report.rims as f64)]),
    ];
    let plot = plots::save(request, "fig20", "frame", &panels, "length error and rims over the eversion")?;
    let image = save(request, "fig1", &sheet(&tiles, 3), "moments of the eversion")?;
    let last = &reports[reports.len() - 1];
    let largest = reports.iter().map(|report| report.l2_length_error).fold(0.0, f64::max);
    let mut sizes: Vec<f64> = reports.iter().map(|report| report.l2_length_error).collect();
    sizes.sort_by(f64::total_cmp);
    let most = reports.iter().map(|report| report.rims).max().unwrap_or(0);
    let what = if mesh.is_some() { "The paper's bunny" } else { "The hare that ships, in place of the bunny," };
    let distance = last
        .mean_distance
        .map_or(String::new(), |distance| format!(", {} of its diameter from where it should be", percent(distance)));
    let miss = if last.rims + last.pinch_points > 0 {
        format!("{} rims, {} pinch points in the end", last.rims, last.pinch_points)
    } else {
        String::new()
    };
    let summary = Line {
        what: format!("Fig. 1 and 20, eversion of {}", if mesh.is_some() { "the bunny" } else { "a hare" }),
        paper: ["28576".into(), "curve".into(), "curve".into()],
        ours: [tiles.len().to_string(), percent(last.l2_length_error), "–".into()],
        state: format!("{}, {}; on the way {} L2 at most", last.rims, last.pinch_points, percent(largest)),
        miss,
    };
    let faces = scene.surface()?.mesh.face_count();
    Ok(Section {
        summary: vec![Line { ours: [faces.to_string(), summary.ours[1].clone(), "–".into()], ..summary }],
        body: format!(
            "{what} of {faces} faces, given its lengths and bending angles, starts at its mirror image and turns itself inside out \
            (`scenes/{name}.toml`, {} frames). The L2 error is at most {} on the way, {} in the median of frames and {} in the end, when there are {} rims{distance}; \
            at most there are {most} rims. It took {seconds:.0} s.\n\n{plot}\n{image}",
            reports.len(),
            percent(largest),
            percent(sizes[sizes.len() / 2]),
            percent(last.l2_length_error),
            last.rims,
        ),
    })
}

/// Goes through a film, taking pictures now and then.
fn film(scene: &Scene) -> Outcome<(Vec<FrameReport>, Vec<Tile>)> {
    let mut simulation: Simulation = scene.simulation()?;
    let (frames, style) = (simulation.clock().frames(), Style::of_scene(scene)?);
    let (mut reports, mut tiles) = (Vec::new(), Vec::new());
    for number in 1..=frames {
        let frame = simulation.next_frame(&mut Unobserved)?;
        if (number - 1) * (PICTURES - 1) / (frames - 1).max(1) >= tiles.len() {
            let mesh = simulation.mesh();
            let picture = picture_of(mesh, &frame.positions, &rims_of(mesh, &frame), &style, BESIDE)?;
            let caption =
                format!("frame {number}: {}, {} rims", percent(frame.report.l2_length_error), frame.report.rims);
            tiles.push(Tile { picture, caption });
        }
        reports.push(frame.report.clone());
    }
    Ok((reports, tiles))
}
