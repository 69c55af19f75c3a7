//! The zero set of a function as a closed triangle mesh, by marching tetrahedra.
//!
//! Every cube of a grid is cut into six tetrahedra around its diagonal. Since neighbouring cubes cut their
//! common square alike, the result is a closed manifold whatever the values are.

use std::collections::HashMap;

use glam::DVec3;

/// The axes in the order in which a tetrahedron's path from corner 0 to corner 7 takes them; the last
/// number says whether the tetrahedron is positively oriented.
const PATHS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([0, 2, 1], false),
    ([2, 1, 0], false),
    ([1, 0, 2], false),
];

/// For each set of corners inside (bit k for corner k): the corners in an even permutation, those inside
/// first; or for three inside, the one outside first.
const INSIDE_FIRST: [[usize; 4]; 16] = [
    [0, 1, 2, 3],
    [0, 1, 2, 3],
    [1, 0, 3, 2],
    [0, 1, 2, 3],
    [2, 0, 1, 3],
    [0, 2, 3, 1],
    [1, 2, 0, 3],
    [3, 0, 2, 1],
    [3, 0, 2, 1],
    [0, 3, 1, 2],
    [1, 3, 2, 0],
    [2, 0, 1, 3],
    [2, 3, 0, 1],
    [1, 0, 3, 2],
    [0, 1, 2, 3],
    [0, 1, 2, 3],
];

/// A box of `cells` cubes of edge `spacing`.
pub(super) struct CubeGrid {
    pub(super) low: DVec3,
    pub(super) spacing: f64,
    pub(super) cells: [usize; 3],
}

impl CubeGrid {
    fn point(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        self.low + self.spacing * DVec3::new(i as f64, j as f64, k as f64)
    }

    fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * (self.cells[1] + 1) + j) * (self.cells[0] + 1) + i
    }
}

/// Vertices and triangles between negative (inside) and other values, oriented outward. The function has
/// to be positive on the boundary of the grid for the surface to be closed.
pub(super) fn isosurface(grid: &CubeGrid, value: impl Fn(DVec3) -> f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let [nx, ny, nz] = grid.cells;
    let mut values = Vec::with_capacity((nx + 1) * (ny + 1) * (nz + 1));
    for k in 0..=nz {
        for j in 0..=ny {
            values.extend((0..=nx).map(|i| value(grid.point([i, j, k]))));
        }
    }
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let mut crossings: HashMap<[usize; 2], u32> = HashMap::new();
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let corner = |bits: usize| [i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2)];
                let inside = |bits: usize| values[grid.number(corner(bits))] < 0.0;
                if (1..8).all(|bits| inside(bits) == inside(0)) {
                    continue;
                }
                for (axes, positive) in PATHS {
                    let (first, second) = (1 << axes[0], 1 << axes[0] | 1 << axes[1]);
                    let tetrahedron = if positive { [0, first, second, 7] } else { [0, first, 7, second] };
                    let set = (0..4).filter(|&c| inside(tetrahedron[c])).fold(0, |set, c| set | 1 << c);
                    let [a, b, c, d] = INSIDE_FIRST[set].map(|c| corner(tetrahedron[c]));
                    let mut crossing = |p: [usize; 3], q: [usize; 3]| {
                        let (m, n) = (grid.number(p), grid.number(q));
                        *crossings.entry([m.min(n), m.max(n)]).or_insert_with(|| {
                            let share = values[m] / (values[m] - values[n]);
                            positions.push(grid.point(p).lerp(grid.point(q), share));
                            positions.len() as u32 - 1
                        })
                    };
                    match set.count_ones() {
                        1 => triangles.push([crossing(a, b), crossing(a, c), crossing(a, d)]),
                        2 => {
                            let quad = [crossing(a, c), crossing(a, d), crossing(b, d), crossing(b, c)];
                            triangles.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
                        }
                        3 => triangles.push([crossing(a, b), crossing(a, d), crossing(a, c)]),
                        _ => {}
                    }
                }
            }
        }
    }
    (positions, triangles)
}
