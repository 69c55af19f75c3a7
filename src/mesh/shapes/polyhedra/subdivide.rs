//! Triangles cut into small ones.

use std::collections::HashMap;

use glam::DVec3;

/// Divides every edge into `n` equal parts and every triangle into `n²`. The corners keep their numbers.
pub(in crate::mesh::shapes) fn subdivide(
    corners: &[DVec3],
    triangles: &[[u32; 3]],
    n: usize,
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut positions = corners.to_vec();
    let mut faces = Vec::with_capacity(triangles.len() * n * n);
    // Per edge, from its smaller corner: the first of the n − 1 vertices inside it.
    let mut inside_edges: HashMap<[u32; 2], u32> = HashMap::new();
    for &[a, b, c] in triangles {
        let at = |i: usize, j: usize| {
            // Exact at the corners and the same from both sides of an edge.
            let k = n - i - j;
            let mut terms = [(a, k), (b, i), (c, j)];
            terms.sort_unstable();
            terms.iter().map(|&(v, weight)| corners[v as usize] * weight as f64).sum::<DVec3>() / n as f64
        };
        let mut on_edge = |from: u32, to: u32, step: usize| {
            let (key, step) = if from < to { ([from, to], step) } else { ([to, from], n - step) };
            let first = *inside_edges.entry(key).or_insert_with(|| {
                let first = positions.len() as u32;
                let [p, q] = key.map(|v| corners[v as usize]);
                positions.extend((1..n).map(|s| (p * (n - s) as f64 + q * s as f64) / n as f64));
                first
            });
            first + step as u32 - 1
        };
        // Vertex (i, j) is a + i/n (b − a) + j/n (c − a).
        let mut numbers = Vec::with_capacity((n + 1) * (n + 2) / 2);
        let mut interior = Vec::new();
        for j in 0..=n {
            for i in 0..=n - j {
                numbers.push(match (i, j) {
                    (0, 0) => a,
                    _ if i == n => b,
                    _ if j == n => c,
                    (_, 0) => on_edge(a, b, i),
                    (0, _) => on_edge(a, c, j),
                    _ if i + j == n => on_edge(b, c, j),
                    _ => {
                        interior.push((numbers.len(), at(i, j)));
                        0
                    }
                });
            }
        }
        for (slot, p) in interior {
            numbers[slot] = positions.len() as u32;
            positions.push(p);
        }
        let number = |i: usize, j: usize| numbers[j * (n + 1) - j * j.saturating_sub(1) / 2 + i];
        for j in 0..n {
            for i in 0..n - j {
                faces.push([number(i, j), number(i + 1, j), number(i, j + 1)]);
                if i + j + 1 < n {
                    faces.push([number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]);
                }
            }
        }
    }
    (positions, faces)
}
