//! Meshes, maps and random numbers that several tests use.
#![allow(dead_code)] // every test uses another part of this

pub mod npy;

use glam::{DQuat, DVec3};
use immerse::mesh::{FaceId, HalfedgeId, Mesh, Surface};
use immerse::metric::Metric;
use immerse::render::{Camera, Extent, View};
use immerse::scene::{Scene, SceneError};
use immerse::spin::Strip;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::collections::HashMap;
use std::path::Path;
use std::process::{Command, Output};

pub struct Random(ChaCha8Rng);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(ChaCha8Rng::seed_from_u64(seed))
    }
    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }
    pub fn bit(&mut self) -> bool {
        self.below(2) == 1
    }
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }
    pub fn frame(&mut self) -> DQuat {
        loop {
            let (v, s) = (self.vector(), 2.0 * self.unit() - 1.0);
            let q = DQuat::from_xyzw(v.x, v.y, v.z, s);
            if q.length() < 1.0 && q.length() > 0.1 {
                return q.normalize();
            }
        }
    }
    pub fn shuffled(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for k in (1..n).rev() {
            order.swap(k, self.below(k + 1));
        }
        order
    }
}

/// The boundary of a row of cubes with `genus` square holes, triangulated, corners at integers.
pub fn block_with_holes(genus: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (nx, ny) = (2 * genus as i32 + 1, 3);
    let solid =
        |x: i32, y: i32, z: i32| (0..nx).contains(&x) && (0..ny).contains(&y) && z == 0 && !(x % 2 == 1 && y == 1);
    let mut index = HashMap::new();
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    for x in 0..nx {
        for y in 0..ny {
            if !solid(x, y, 0) {
                continue;
            }
            for axis in 0..3 {
                for side in [0, 1] {
                    let mut there = [x, y, 0];
                    there[axis] += 2 * side - 1;
                    if solid(there[0], there[1], there[2]) {
                        continue;
                    }
                    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                    let mut quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| {
                        let mut corner = [x, y, 0];
                        corner[axis] += side;
                        corner[u] += a;
                        corner[v] += b;
                        *index.entry(corner).or_insert_with(|| {
                            positions.push(DVec3::new(corner[0] as f64, corner[1] as f64, corner[2] as f64));
                            positions.len() as u32 - 1
                        })
                    });
                    if side == 0 {
                        quad.reverse();
                    }
                    let [a, b, c, d] = quad;
                    faces.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    (positions, faces)
}

/// Every triangle into four, by edge midpoints.
pub fn subdivide(positions: &mut Vec<DVec3>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            positions.push(0.5 * (positions[a as usize] + positions[b as usize]));
            positions.len() as u32 - 1
        })
    };
    let mut finer = Vec::with_capacity(4 * faces.len());
    for &[a, b, c] in faces {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    finer
}

/// A surface of the given genus, with that many boundary loops.
pub fn surface(genus: usize, boundaries: usize) -> (Mesh, Vec<DVec3>) {
    let (mut positions, faces) = block_with_holes(genus);
    let mut faces = subdivide(&mut positions, &faces);
    if boundaries > 0 {
        faces = subdivide(&mut positions, &faces);
    }
    // Take out faces far apart from each other; none shares a vertex with another.
    let mut taken: Vec<[u32; 3]> = Vec::new();
    let mut k = 0;
    while taken.len() < boundaries {
        let face = faces[k];
        let apart = taken.iter().all(|t| !t.iter().any(|v| face.contains(v)));
        if apart {
            taken.push(face);
        }
        k += 37;
        k %= faces.len();
    }
    faces.retain(|f| !taken.contains(f));
    let mesh = Mesh::from_faces(positions.len(), &faces).expect("a manifold");
    assert_eq!((mesh.genus(), mesh.boundary_loops().len()), (genus, boundaries));
    (mesh, positions)
}

/// Lengths that satisfy every triangle inequality and belong to no position of anything.
pub fn random_metric(mesh: &Mesh, random: &mut Random) -> Metric {
    let lengths = (0..mesh.edge_count()).map(|_| 1.0 + 0.9 * random.unit()).collect();
    Metric::new(mesh, lengths).expect("triangle inequality")
}

/// A closed strip from a walk over faces that never turns back, cut where it first meets itself.
pub fn random_strip(mesh: &Mesh, random: &mut Random) -> Strip {
    loop {
        let mut exits: Vec<HalfedgeId> = vec![FaceId::new(random.below(mesh.face_count())).halfedge(random.below(3))];
        while let Some(twin) = mesh.twin(exits[exits.len() - 1]) {
            if let Some(start) = exits.iter().position(|h| h.face() == twin.face()) {
                if let Some(strip) = Strip::new(mesh, exits[start..].to_vec()) {
                    return strip;
                }
                break;
            }
            let turn = if random.bit() { twin.next() } else { twin.previous() };
            exits.push(turn);
        }
    }
}

/// Largest distance between corresponding points after the best rigid motion of `a` onto `b`.
pub fn distance_up_to_rigid_motion(a: &[DVec3], b: &[DVec3]) -> f64 {
    let n = a.len() as f64;
    let (ca, cb) = (a.iter().sum::<DVec3>() / n, b.iter().sum::<DVec3>() / n);
    let mut h = nalgebra::Matrix3::<f64>::zeros();
    for (p, q) in a.iter().zip(b) {
        let (p, q) = (*p - ca, *q - cb);
        h += nalgebra::Vector3::new(q.x, q.y, q.z) * nalgebra::Vector3::new(p.x, p.y, p.z).transpose();
    }
    let svd = h.svd(true, true);
    let (u, vt) = (svd.u.expect("u"), svd.v_t.expect("v"));
    let sign = (u * vt).determinant().signum();
    let r = u * nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(1.0, 1.0, sign)) * vt;
    a.iter()
        .zip(b)
        .map(|(p, q)| {
            let p = *p - ca;
            let turned = r * nalgebra::Vector3::new(p.x, p.y, p.z);
            (DVec3::new(turned.x, turned.y, turned.z) - (*q - cb)).length()
        })
        .fold(0.0, f64::max)
}

/// A scene from its text.
pub fn scene(text: &str) -> Scene {
    Scene::parse(text, "test", Path::new(".")).expect("a valid scene")
}

/// Whether an error of a scene points to what stands at a key, or to its table where it was left out.
pub fn is_at(scene: &Scene, key: &str, error: &SceneError) -> bool {
    let there = scene.complain(key, "", "");
    (error.line, error.column, error.span) == (there.line, there.column, there.span)
}

/// A surface that is known by its positions.
pub fn embedded(mesh: Mesh, positions: Vec<DVec3>) -> Surface {
    Surface { mesh, positions: Some(positions), coordinates: None, edge_lengths: None, repairs: Vec::new() }
}

/// Largest distance between two points of a set.
pub fn diameter(points: &[DVec3]) -> f64 {
    let far = |p: &DVec3| points.iter().map(|q| p.distance(*q)).fold(0.0, f64::max);
    points.iter().map(far).fold(0.0, f64::max)
}

/// Runs the program in a folder: exit code, standard output, standard error. How much it tells of its progress depends on
/// how fast the machine is, so that it is asked not to.
pub fn program(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_immerse"));
    command.current_dir(folder).args(arguments);
    if !arguments.iter().any(|argument| matches!(*argument, "-q" | "--quiet")) {
        command.arg("--quiet");
    }
    let output = command.output();
    let Output { status, stdout, stderr } = output.expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (status.code().expect("an exit code"), text(stdout), text(stderr))
}

/// Straight down the z axis, without perspective, of what fills this share of the picture.
pub fn from_above(fill: f64) -> View {
    let view = seen_from(DVec3::Z, DVec3::Y).with_field_of_view(0.0);
    view.and_then(|view| view.with_fill(fill)).expect("a view")
}

/// From a direction, with another one upward in the picture.
pub fn seen_from(direction: DVec3, up: DVec3) -> View {
    View::default().with_direction(direction).and_then(|view| view.with_up(up)).expect("a view")
}

/// One unit per pixel, x to the right and y up, the origin in the lower left corner of the picture, higher z nearer.
pub fn plan_view(output: &immerse::render::Output) -> Camera {
    let extent = Extent::of(&[DVec3::ZERO, DVec3::new(output.width() as f64, output.height() as f64, 0.0)]);
    Camera::framing(&from_above(1.0), &extent, output).expect("a plan view")
}
