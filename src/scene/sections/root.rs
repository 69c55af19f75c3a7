//! All sections of a scene.

use super::bending::bending;
use super::checks::checks;
use super::clock::clock;
use super::look::look;
use super::mesh::mesh;
use super::metric::metric;
use super::phase::phase;
use super::picture::{camera, light, output};
use super::pin::pin;
use super::polish::polish;
use super::spin::spin;
use super::start::start;
use crate::scene::data::{RelaxationSection, Scene, SpinSection};
use crate::scene::keys::Table;

/// All sections. Name, folder and source are filled in by the caller.
pub(in crate::scene) fn root(table: &mut Table) -> Scene {
    let (mesh, weld) = table.table("mesh", "The surface: a file or a generated shape.", mesh);
    let mut bending_stiffness = None;
    let mut scene = Scene {
        mesh,
        weld,
        parameters: table.map("parameters", "Numbers by name, for formulas; each may use those before it and `t`."),
        metric: table.table(
            "metric",
            "The edge lengths of the surface; left out, those of the shape or of the mesh's positions.",
            metric,
        ),
        spin: table.table("spin", "Its regular homotopy class: in which of the essentially different ways it lies in space; left out, that of the mesh's positions, else zeros.", spin),
        start: table.table("start", "What the relaxation begins with; left out, random = 0.", start),
        phases: table.tables("phase", PHASES, phase),
        bending: table
            .optional_table("bending", "How the surface bends, and target bending angles.", bending)
            .and_then(|(angles, stiffness)| {
                bending_stiffness = stiffness;
                angles
            }),
        pins: table.tables("pin", "Vertices held in place or led along.", pin),
        clock: table.table("clock", "Frames and their times.", clock),
        polish: table.table("polish", "Positions made isometric when frames have settled.", polish),
        camera: table.table("camera", "The view; what is left out frames the surface by itself.", camera),
        lights: table.tables("light", "A directional light; without any, the studio's three.", light),
        look: table.table("look", "Colours, materials, patterns, lines and labels. What is left out is as `preset` has it.", look),
        output: table.table("output", "Which files are made of the film, and how large.", output),
        checks: table.table("checks", "What must hold of the last frame, else the run fails with code 1; `film` is about all frames.", checks),
        ..Scene::default()
    };
    // Has been followed where it names a file.
    let doc = "Another scene file, relative to this one: its keys count where this one does not say otherwise.";
    if table.key::<String>("extends", doc).optional("common.toml".into()).is_some_and(|file| file.is_empty()) {
        table.complain("extends", "`extends` is empty", "name a scene file, or remove it");
    }
    scene.relaxation = RelaxationSection { bending_stiffness };
    scene.clock.a_frame_for_each_class &= scene.spin == SpinSection::All;
    scene
}

const PHASES: &str = "A part of the relaxation. Without any there are five: epsilon = [1, 1, 1, 1] with dt = faces / 28, \
     [1, 0.1, 1, 0.1] with dt = 100 (rims resolve here), [1, 0.01, 1, 0.1] and [1, 0.001, 1, 0.1] with dt = 30, and \
     [1, 0.0001, 1, 0.1] with dt = 10; frames that start from a shape go through the last one only, and so do frames \
     that follow in a film. `immerse check SCENE --phases` prints those of a scene. A [[phase]] with `index` or `like` \
     changes default ones; others replace them. `bending_stiffness` under [bending] is epsilon[1] of the last.";
