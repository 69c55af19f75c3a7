//! A picture of a surface, drawn by the renderer alone: `cargo run --release --example picture`.

use glam::DVec3;
use immerse::evolve::Orientation;
use immerse::mesh::shapes;
use immerse::metric::lengths_of_positions;
use immerse::render::{Camera, Extent, Lights, Look, LookName, Metadata, Output, Png, Scenery, View, render};
use immerse::{Immersion, Metric};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The lengths of a doughnut, in the class of a ring whose cross-section is an eight.
    let torus = shapes::torus(1.0, 0.42, 120, 50)?;
    let positions = torus.positions.unwrap_or_default();
    let metric = Metric::new(&torus.mesh, lengths_of_positions(&torus.mesh, &positions))?;
    let shape =
        Immersion::of(&torus.mesh, &metric).class("10".parse()?).orientation(Orientation::AsItComes).seed(1).relax()?;

    let triangles = torus.mesh.triangles();
    let rims: Vec<[u32; 2]> = shape.frame().rims.iter().map(|&e| torus.mesh.edge_vertices(e).map(|v| v.0)).collect();
    let extent = Extent::of_surface(shape.positions(), &triangles);
    let output = Output::new(1600, 1200, 8)?;
    let view = View::default().with_up(DVec3::Z)?.with_direction(DVec3::new(0.3, -1.0, 0.9))?;
    let camera = Camera::framing(&view, &extent, &output)?;
    let scenery = Scenery { triangles: &triangles, positions: shape.positions(), rims: &rims, ..Scenery::default() };
    let picture = render(&scenery, &camera, &Lights::default(), &Look::preset(LookName::Soap), &output)?;
    picture.write_png("torus.png".as_ref(), Png::default(), &Metadata::default())?;
    Ok(())
}
