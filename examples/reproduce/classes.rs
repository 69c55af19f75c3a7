//! All regular homotopy classes of a surface, the same lengths in each.

use super::document::{Line, Section};
use super::pictures::{Style, Tile, picture, save, sheet};
use super::request::{Outcome, Request, shipped};
use super::solve::{Found, Polish, scene, solve_scene};
use super::table::{ours, percent};
use immerse::spin::Class;
use std::fmt::Write;

pub fn genus_2(request: &Request) -> Outcome<Section> {
    // Nearest to 6000 faces.
    let keys: &[&str] = if request.quick { &["mesh.edge_length=0.2"] } else { &["mesh.edge_length=0.0687"] };
    all_classes(request, "class_gallery", "genus2", keys, [4, 460, 345])
}

pub fn genus_3(request: &Request) -> Outcome<Section> {
    let keys: &[&str] = if request.quick { &["mesh.edge_length=0.2"] } else { &[] };
    all_classes(request, "class_gallery_3", "genus3", keys, [8, 240, 180])
}

fn all_classes(
    request: &Request,
    name: &str,
    part: &str,
    keys: &[&str],
    [columns, width, height]: [usize; 3],
) -> Outcome<Section> {
    let keys: Vec<String> = keys.iter().map(|key| (*key).to_owned()).collect();
    let plain = scene(&shipped(name), &keys, None)?;
    let style = Style::of_scene(&plain)?;
    let betti = plain.surface()?.mesh.betti();
    let count = if request.quick { 2 } else { 1 << betti };
    let mut tiles = Vec::new();
    let mut stages: Vec<Vec<Found>> = Polish::ALL.map(|_| Vec::new()).into();
    for number in 0..count {
        let class = Class::of_number(number, betti).to_string();
        let keys = [keys.as_slice(), &[format!("spin.class=\"{class}\"")]].concat();
        let scene = scene(&shipped(name), &keys, None)?;
        for (polish, stage) in Polish::ALL.into_iter().zip(&mut stages) {
            stage.push(solve_scene(&scene, polish)?);
        }
        let last = &stages[stages.len() - 1];
        let found = &last[last.len() - 1];
        let caption = format!("{class}  {}", percent(found.l2()));
        tiles.push(Tile { picture: picture(found, &style, [width, height])?, caption });
    }
    let image = save(request, part, &sheet(&tiles, columns), &format!("all classes of genus {}", betti / 2))?;
    let mut body = format!(
        "`scenes/{name}.toml` in each of its {count} classes, from random frames of seed 0, the same lengths in each. No two of these surfaces can be deformed into one \
        another without a pinch. Under each are its class and its L2 error.\n\n| polish | faces | L2: least | median | largest | rims | pinch points | in the class asked for | seconds |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n"
    );
    let (mut summary, mut errors_of_stages) = (Vec::new(), Vec::new());
    for (polish, stage) in Polish::ALL.into_iter().zip(&stages) {
        let mut errors: Vec<f64> = stage.iter().map(Found::l2).collect();
        errors.sort_by(f64::total_cmp);
        let (rims, pinches) = stage
            .iter()
            .fold((0, 0), |(rims, pinches), found| (rims + found.report().rims, pinches + found.report().pinch_points));
        let right = stage.iter().filter(|found| found.report().spin_class == found.report().asked_class).count();
        let seconds: f64 = stage.iter().map(|found| found.seconds).sum();
        let (faces, median, largest) =
            (stage[0].mesh.face_count(), percent(errors[errors.len() / 2]), percent(errors[errors.len() - 1]));
        writeln!(
            body,
            "| {} | {faces} | {} | {median} | {largest} | {rims} | {pinches} | {right} of {count} | {seconds:.0} |",
            polish.name(),
            percent(errors[0]),
        )?;
        let bad: Vec<String> = stage
            .iter()
            .filter(|found| found.report().rims + found.report().pinch_points > 0)
            .map(|found| {
                format!(
                    "{} ({} rims, {} pinch points)",
                    found.report().asked_class,
                    found.report().rims,
                    found.report().pinch_points
                )
            })
            .collect();
        let miss = if bad.is_empty() { String::new() } else { bad.join(", ") };
        errors_of_stages.push(format!("{median}, worst {largest}"));
        summary.push(Line {
            what: format!("all {count} classes of genus {}", betti / 2),
            paper: ["–", "–", "–"].map(str::to_owned),
            ours: ours(faces, &errors_of_stages),
            state: format!("{rims}, {pinches}, {right} of {count} classes"),
            miss,
        });
    }
    summary.drain(..summary.len() - 1);
    Ok(Section { summary, body: format!("{body}\n{image}") })
}
