//! Table 1 of the paper, line by line, and Fig. 2.

use super::document::Section;
use super::pictures::{ALONE, BESIDE, Style, Tile, picture, picture_of, save, sheet};
use super::request::{Outcome, Request, own, shipped};
use super::solve::{Found, MOMENTS, Polish, rims_of, scene, solve_scene};
use super::table::{Paper, Sorted, Table, count, line, percent};
use immerse::evolve::Frame;
use immerse::render::Picture;
use immerse::scene::Scene;
use std::path::PathBuf;

/// A line of Table 1: a scene at the size of the paper.
struct Case<'a> {
    name: &'a str,
    what: &'a str,
    paper: Option<Paper>,
    scene: PathBuf,
    set: Vec<String>,
    mesh: Option<PathBuf>,
    /// Seeds of random frames; none where the scene starts at a shape.
    seeds: Vec<u64>,
}

const fn paper(faces: usize, l2_percent: f64, rims: usize) -> Option<Paper> {
    Some(Paper { faces, l2_percent, rims })
}

fn set(keys: &[&str]) -> Vec<String> {
    keys.iter().map(|key| (*key).to_owned()).collect()
}

/// What came of a case: its scene, and the surfaces found, before polish and after.
struct Made {
    scene: Scene,
    stages: Vec<(Polish, Sorted)>,
}

impl Made {
    /// Those that pictures are made of.
    fn shown(&self) -> &Found {
        self.stages[self.stages.len() - 1].1.median()
    }
}

impl<'a> Case<'a> {
    /// A scene, with some keys set, that starts at a shape.
    fn of(name: &'a str, what: &'a str, paper: Option<Paper>, scene: PathBuf, set: Vec<String>) -> Case<'a> {
        Case { name, what, paper, scene, set, mesh: None, seeds: Vec::new() }
    }

    fn make(&self, table: &mut Table) -> Outcome<Made> {
        let mut stages = Vec::new();
        let plain = scene(&self.scene, &self.set, self.mesh.as_ref())?;
        for polish in Polish::ALL {
            let mut all = Vec::new();
            for seed in &self.seeds {
                let set = [self.set.as_slice(), &[format!("start.random={seed}")]].concat();
                all.push(solve_scene(&scene(&self.scene, &set, self.mesh.as_ref())?, polish)?);
            }
            if self.seeds.is_empty() {
                all.push(solve_scene(&plain, polish)?);
            }
            let sorted = Sorted::new(all);
            let what = format!("{} {} polish", self.what, polish.name());
            if sorted.is_single() {
                table.add(&what, sorted.median());
            } else {
                table.add(&format!("{what}, median"), sorted.median());
                table.add(&format!("{what}, worst"), sorted.worst());
            }
            stages.push((polish, sorted));
        }
        Ok(Made { scene: plain, stages })
    }

    /// The section of a case that stands alone.
    fn section(&self, request: &Request, words: &str) -> Outcome<Section> {
        let mut table = Table::default();
        let made = self.make(&mut table)?;
        let found = made.shown();
        let style = Style::of_scene(&made.scene)?;
        let image = if found.reports.len() > 1 { of_film(found, &style)? } else { picture(found, &style, ALONE)? };
        let image = save(request, self.name, &image, self.what)?;
        let mut film = String::new();
        if found.reports.len() > 1 {
            let worst = found.worst();
            film = format!(
                "Of its {} frames the one with the largest error is frame {}: {}, {} rims, {} pinch points.\n\n",
                found.reports.len(),
                worst.frame,
                percent(worst.l2_length_error),
                worst.rims,
                worst.pinch_points
            );
        }
        Ok(Section {
            summary: vec![self.line(&made)],
            body: format!("{words}\n\n{}\n{table}\n{film}{image}", self.in_words(found)),
        })
    }

    fn line(&self, made: &Made) -> super::document::Line {
        let after = made.stages.get(1).map(|(_, sorted)| sorted);
        line(self.what, self.paper, &made.stages[0].1, after)
    }

    /// What the paper has, and the sizes of both meshes.
    fn in_words(&self, found: &Found) -> String {
        let mesh = &found.mesh;
        let ours = format!("({}, {}, {})", mesh.vertex_count(), mesh.edge_count(), mesh.face_count());
        let paper = self.paper.map_or(String::new(), |paper| {
            format!(
                "The paper has {} faces, an error of {} % and {}. ",
                paper.faces,
                paper.l2_percent,
                count(paper.rims, "rim")
            )
        });
        format!("{paper}Vertices, edges and faces here: {ours}.\n")
    }
}

/// First, middle and last frame of a film.
fn of_film(found: &Found, style: &Style) -> Outcome<Picture> {
    let tile = |frame: &std::sync::Arc<Frame>| -> Outcome<Tile> {
        let rims = rims_of(&found.mesh, frame);
        let picture = picture_of(&found.mesh, &frame.positions, &rims, style, BESIDE)?;
        let caption = format!("frame {}: {}", frame.report.frame, percent(frame.report.l2_length_error));
        Ok(Tile { picture, caption })
    };
    let tiles = found.moments.iter().step_by((MOMENTS - 1) / 2).map(tile).collect::<Outcome<Vec<_>>>()?;
    Ok(sheet(&tiles, tiles.len()))
}

pub fn figure_2(request: &Request) -> Outcome<Section> {
    let mut table = Table::default();
    let mut tiles = Vec::new();
    let mut summary = Vec::new();
    for (name, seeds) in [("flat_torus_crumpled", Vec::new()), ("flat_torus_smooth", vec![0])] {
        let what = format!("Fig. 2, {}", name.trim_start_matches("flat_torus_"));
        let keys = if request.quick { set(&["mesh.columns=16", "mesh.rows=98"]) } else { Vec::new() };
        let case = Case { name, what: &what, paper: None, scene: shipped(name), set: keys, mesh: None, seeds };
        let made = case.make(&mut table)?;
        summary.push(case.line(&made));
        let found = made.shown();
        let picture = picture(found, &Style::usual(), BESIDE)?;
        tiles.push(Tile {
            picture,
            caption: format!("{}: {}", name.trim_start_matches("flat_torus_"), percent(found.l2())),
        });
    }
    let image = save(request, "fig2", &sheet(&tiles, 2), "a flat torus, crumpled and smooth")?;
    let words = "One flat torus twice: near a small torus of revolution with noise, whose circles are too short by a third, and from \
        random frames. The paper gives no numbers for it. Each picture fills its frame: the crumpled one is the smaller.";
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}

pub fn figure_12(request: &Request) -> Outcome<Section> {
    let keys = if request.quick { set(&["mesh.subdivisions=8"]) } else { Vec::new() };
    let scene = shipped("deflated_ball");
    let case = Case::of("fig12", "Fig. 12, deflated ball", paper(8000, 1.2, 0), scene, keys);
    case.section(
        request,
        "The lengths of a round sphere, near a ball with dents, without any bending (`scenes/deflated_ball.toml`).",
    )
}

pub fn figure_13(request: &Request) -> Outcome<Section> {
    let keys = if request.quick { set(&["mesh.columns=40", "mesh.rows=25"]) } else { Vec::new() };
    let scene = shipped("soda_can");
    let case = Case::of("fig13", "Fig. 13, soda can", paper(18000, 2.13, 0), scene, keys);
    case.section(request, "The lengths of a straight cylinder between two rigid rings (`scenes/soda_can.toml`).")
}

/// The classes of a torus.
const CLASSES: [&str; 4] = ["00", "01", "10", "11"];
/// What the paper has, in its order; it does not say which error is that of which class.
const ERRORS: [(f64, usize); 4] = [(1.2, 0), (6.5, 0), (1.65, 0), (3.6, 14)];

/// The torus of Fig. 14: the paper's, whose lengths are all 0.05, or one that is 60 by 50 such triangles.
fn flat_torus(request: &Request) -> Outcome<(Option<PathBuf>, Vec<String>)> {
    Ok(match request.paper_mesh("torus.obj")? {
        Some(path) if !request.quick => (Some(path), set(&["metric.formula=\"0.05\""])),
        _ if request.quick => {
            (None, set(&["mesh.columns=30", "mesh.rows=24", "mesh.a=[1.5, 0]", "mesh.b=[0, 1.0392304845]"]))
        }
        _ => (None, Vec::new()),
    })
}

pub fn figure_14(request: &Request) -> Outcome<Section> {
    let (mesh, keys) = flat_torus(request)?;
    let mut table = Table::default();
    let (mut tiles, mut summary) = (Vec::new(), Vec::new());
    for (class, (l2_percent, rims)) in CLASSES.into_iter().zip(ERRORS) {
        let what = format!("Fig. 14, class {class}");
        let keys = [keys.as_slice(), &[format!("spin.class=\"{class}\"")]].concat();
        let scene = own("flat_torus_6000");
        let paper = paper(6000, l2_percent, rims);
        let case =
            Case { name: "fig14", what: &what, paper, scene, set: keys, mesh: mesh.clone(), seeds: request.seeds() };
        let made = case.make(&mut table)?;
        summary.push(case.line(&made));
        let found = made.shown();
        let picture = picture(found, &Style::usual(), BESIDE)?;
        tiles.push(Tile { picture, caption: format!("class {class}: {}", percent(found.l2())) });
    }
    let image = save(request, "fig14", &sheet(&tiles, 2), "a flat torus in its four classes")?;
    let mesh = if mesh.is_some() { "the paper's own mesh, `torus.obj`" } else { "a rectangle of 60 by 50 vertices" };
    let words = format!(
        "A flat torus of 6000 equilateral triangles of side 0.05, {mesh}, in its four regular homotopy classes, from random frames of seeds 0 to 4 \
        by the default phases. The paper has errors of 1.2, 6.5, 1.65 and 3.6 %, the last with 14 rims, and does not say which is which class; \
        in the table they stand in its order. Pictures show the median seed."
    );
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}

pub fn figure_15(request: &Request) -> Outcome<Section> {
    let keys: &[&str] = if request.quick { &["mesh.columns=30", "mesh.rows=24", "clock.frames=6"] } else { &[] };
    let scene = shipped("ricci_torus");
    let case = Case::of("fig15", "Fig. 15, Ricci torus", paper(6174, 5.24, 2), scene, set(keys));
    case.section(request, "A torus of revolution of 62 by 50 vertices (the paper's 3087 are perhaps 63 by 49; ours takes an even number of rows) flows to a flat one (`scenes/ricci_torus.toml`); the pictures are its first, middle and last frame.")
}

pub fn figure_16(request: &Request) -> Outcome<Section> {
    let keys: &[&str] = if request.quick { &["mesh.faces=2000", "mesh.radius=3"] } else { &[] };
    let scene = own("hyperbolic_disk_5");
    let seeds = request.seeds();
    let case = Case { seeds, ..Case::of("fig16", "Fig. 16, hyperbolic disk", paper(19220, 7.0, 0), scene, set(keys)) };
    case.section(
        request,
        "A disk of radius 5 in the hyperbolic plane of curvature −1 from random frames; its mesh is the one whose size is nearest to the paper's. The paper does not say how large its disk is; \
        `scenes/hyperbolic_disk.toml` is a film that grows to the same metric.",
    )
}

pub fn figure_17(request: &Request) -> Outcome<Section> {
    let keys: &[&str] = if request.quick { &["mesh.subdivisions=5", "clock.frames=6"] } else { &[] };
    let scene = shipped("genus_two_polyhedron");
    let case = Case::of("fig17", "Fig. 17, polyhedron of genus 2", paper(8298, 1.15, 1), scene, set(keys));
    case.section(
        request,
        "A polyhedron of genus 2 with negative curvature at its 12 corners, each of its 28 triangles cut into 17², flows to curvature −1 \
        (`scenes/genus_two_polyhedron.toml`). The paper's polyhedron is another one, so that the number of faces cannot be the same.",
    )
}

/// Nearest to 11 608 faces.
const DUCK: &str = "mesh.edge_length=0.04486";

pub fn figure_18(request: &Request) -> Outcome<Section> {
    let keys: &[&str] = if request.quick { &["mesh.edge_length=0.09", "clock.frames=6"] } else { &[DUCK] };
    let scene = shipped("double_duck");
    let case = Case::of("fig18", "Fig. 18, double duck", paper(11608, 0.7, 8), scene, set(keys));
    case.section(
        request,
        "Two ducks of genus 2, sculpted anew (`scenes/double_duck.toml`), flow to curvature −1, with a little bending left as in the paper; \
        the pictures are its first, middle and last frame.",
    )
}

pub fn figure_19(request: &Request) -> Outcome<Section> {
    let keys: &[&str] = if request.quick { &["mesh.edge_length=0.09"] } else { &[DUCK] };
    let scene = shipped("double_duck_random");
    let seeds = request.seeds();
    let case =
        Case { seeds, ..Case::of("fig19", "Fig. 19, double duck at random", paper(11608, 2.4, 4), scene, set(keys)) };
    case.section(
        request,
        "The metric of Fig. 18 from random frames (`scenes/double_duck_random.toml`). The paper's Table 1 says 2.4 %, its caption 2.13 %.",
    )
}
