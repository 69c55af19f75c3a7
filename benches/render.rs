//! How long a frame takes: a bumpy torus of 30 thousand and of a million triangles at 1920 x 1080 with 4 samples, from
//! positions to 8-bit bytes, on a turntable.
//!
//! `cargo bench --bench render` prints a table (of the cases that are named, or of all). `cargo bench --bench render -- serve FOLDER` writes the meshes and
//! cameras there and then renders what it is asked for on standard input, for `benches/llvmpipe.sh`, which
//! compares with Mesa.
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

use std::{
    error::Error,
    f64::consts::TAU,
    io::{BufRead, Write},
    path::Path,
    time::Instant,
};

use glam::{DMat4, DVec3};
use immerse::render::{Camera, Extent, Lights, Lines, Look, Output, Scenery, View, render};

const SIZE: [usize; 2] = [1920, 1080];
const SAMPLES: usize = 4;
/// Positions of the turntable.
const VIEWS: usize = 12;
const REPEATS: usize = 9;

struct Mesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// A torus of revolution with bumps, of 2 · columns · rows triangles.
fn bumpy_torus(columns: u32, rows: u32) -> Mesh {
    let point = |index: u32| {
        let (u, v) =
            (TAU * f64::from(index / rows) / f64::from(columns), TAU * f64::from(index % rows) / f64::from(rows));
        let tube = 0.45 + 0.03 * (7.0 * u).sin() * (5.0 * v).cos();
        let ring = 1.0 + tube * v.cos();
        DVec3::new(ring * u.cos(), ring * u.sin(), tube * v.sin())
    };
    let corner = |u: u32, v: u32| (u % columns) * rows + v % rows;
    let squares = (0..columns).flat_map(|u| (0..rows).map(move |v| (u, v)));
    let triangles = squares.flat_map(|(u, v)| {
        let [a, b, c, d] = [corner(u, v), corner(u + 1, v), corner(u + 1, v + 1), corner(u, v + 1)];
        [[a, b, c], [a, c, d]]
    });
    Mesh { positions: (0..columns * rows).map(point).collect(), triangles: triangles.collect() }
}

/// Area-weighted unit normals, for the peer, which does not make its own.
fn normals(mesh: &Mesh) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|vertex| mesh.positions[vertex as usize]);
        corners.iter().for_each(|&vertex| sums[vertex as usize] += (b - a).cross(c - a));
    }
    sums.iter().map(|sum| sum.normalize()).collect()
}

struct Case {
    name: &'static str,
    mesh: Mesh,
    look: Look,
    cameras: Vec<Camera>,
    output: Output,
}

impl Case {
    fn new(name: &'static str, mesh: Mesh, look: Look) -> Result<Self, Box<dyn Error>> {
        let output = Output::new(SIZE[0], SIZE[1], SAMPLES)?;
        let extent = Extent::of(&mesh.positions);
        let view = |view: usize| {
            let (sin, cos) = (TAU * view as f64 / (12 * VIEWS) as f64).sin_cos();
            let seen = View::default().with_direction(DVec3::new(cos, sin, 0.9))?.with_up(DVec3::Z)?;
            Camera::framing(&seen, &extent, &output)
        };
        let cameras = (0..VIEWS).map(view).collect::<Result<_, _>>()?;
        Ok(Self { name, mesh, look, cameras, output })
    }

    /// Milliseconds from positions to bytes.
    fn time(&self, view: usize) -> Result<f64, Box<dyn Error>> {
        let start = Instant::now();
        let scenery =
            Scenery { triangles: &self.mesh.triangles, positions: &self.mesh.positions, ..Scenery::default() };
        let film = render(&scenery, &self.cameras[view % VIEWS], &Lights::default(), &self.look, &self.output)?;
        let bytes = film.srgb_bytes();
        let time = start.elapsed().as_secs_f64() * 1e3;
        assert_eq!(bytes.len(), SIZE[0] * SIZE[1] * 3);
        Ok(time)
    }

    /// Positions and normals, triangles, and for each view the matrix from world to clip space and that to view
    /// space, by columns: little-endian single precision, indices 32 bits.
    fn write(&self, folder: &Path) -> Result<(), Box<dyn Error>> {
        let bytes =
            |values: &[f64]| -> Vec<u8> { values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect() };
        let vertices: Vec<f64> = self
            .mesh
            .positions
            .iter()
            .zip(normals(&self.mesh))
            .flat_map(|(position, normal)| [position.to_array(), normal.to_array()].concat())
            .collect();
        let matrices: Vec<f64> = self
            .cameras
            .iter()
            .flat_map(|camera| {
                let view = DMat4::from(camera.view_from_world());
                [(camera.clip_from_view() * view).to_cols_array(), view.to_cols_array()].concat()
            })
            .collect();
        let indices: Vec<u8> = self.mesh.triangles.iter().flatten().flat_map(|index| index.to_le_bytes()).collect();
        std::fs::write(folder.join(format!("{}.vertices", self.name)), bytes(&vertices))?;
        std::fs::write(folder.join(format!("{}.matrices", self.name)), bytes(&matrices))?;
        std::fs::write(folder.join(format!("{}.indices", self.name)), indices)?;
        Ok(())
    }
}

fn cases() -> Result<Vec<Case>, Box<dyn Error>> {
    let plain = || Look { occlusion_reach: 0.0, shadows: false, lines: Lines::NONE, ..Look::default() };
    Ok(vec![
        Case::new("30k", bumpy_torus(150, 100), plain())?,
        Case::new("1M", bumpy_torus(1000, 500), plain())?,
        Case::new("30k-studio", bumpy_torus(150, 100), Look::default())?,
    ])
}

/// Answers every line `case view` with the milliseconds it took.
fn serve(cases: &[Case], folder: &Path) -> Result<(), Box<dyn Error>> {
    cases.iter().try_for_each(|case| case.write(folder))?;
    let mut answers = std::io::stdout();
    writeln!(answers, "ready")?;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let (name, view) = line.split_once(' ').ok_or("write a case and a view")?;
        let case = cases.iter().find(|case| case.name == name).ok_or("there is no such case")?;
        writeln!(answers, "{}", case.time(view.parse()?)?)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo itself passes `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let cases = cases()?;
    if let [command, folder] = &words[..]
        && command == "serve"
    {
        return serve(&cases, Path::new(folder));
    }
    println!("{} x {}, {SAMPLES} samples, {} threads", SIZE[0], SIZE[1], rayon::current_num_threads());
    for case in cases.iter().filter(|case| words.is_empty() || words.iter().any(|word| word == case.name)) {
        case.time(0)?;
        let mut times = (0..REPEATS).map(|view| case.time(view)).collect::<Result<Vec<_>, _>>()?;
        times.sort_by(f64::total_cmp);
        println!("{:>12} {:8.1} ms  ({:.1} to {:.1})", case.name, times[REPEATS / 2], times[0], times[REPEATS - 1]);
    }
    Ok(())
}
