//! Edge lengths in, surface out: `cargo run --release --example shape`.
#![allow(clippy::print_stdout, reason = "an example talks")]

use immerse::{Immersion, Mesh, Metric};

/// Vertices around.
const U: usize = 40;
/// Vertices along.
const V: usize = 24;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A flat torus has no positions to take lengths from: a rectangle of 5 by 3, opposite sides glued.
    let vertex = |u: usize, v: usize| (u % U + v % V * U) as u32;
    let cells = (0..U * V).map(|k| (k % U, k / U));
    let triangles: Vec<[u32; 3]> = cells
        .flat_map(|(u, v)| {
            let [a, b, c, d] = [vertex(u, v), vertex(u + 1, v), vertex(u + 1, v + 1), vertex(u, v + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let mesh = Mesh::from_faces(U * V, &triangles)?;
    let metric = Metric::from_fn(&mesh, |a, b| {
        let apart = |a: usize, b: usize| f64::from(u8::from(a != b));
        let [du, dv] = [5.0 / U as f64 * apart(a % U, b % U), 3.0 / V as f64 * apart(a / U, b / U)];
        (du * du + dv * dv).sqrt()
    })?;
    let shape = Immersion::of(&mesh, &metric).class("01".parse()?).seed(0).relax()?;
    let report = shape.report();
    println!("length error {:.3} %, class {}, {} rims", 100.0 * report.l2_length_error, report.spin_class, report.rims);
    shape.write_obj("shape.obj")?;
    Ok(())
}
