//! A triangle mesh whose edges can be flipped, split and collapsed while it stays a manifold.

/// Triangles with, per vertex, the triangles around it. Removed triangles are `None`.
pub(super) struct Editable {
    faces: Vec<Option<[u32; 3]>>,
    stars: Vec<Vec<u32>>,
}

/// An interior edge `ends[0] ends[1]` with the opposite corners: to its left and to its right.
#[derive(Clone, Copy)]
pub(super) struct Diamond {
    pub(super) ends: [u32; 2],
    pub(super) opposite: [u32; 2],
    faces: [u32; 2],
}

impl Editable {
    pub(super) fn new(vertex_count: usize, faces: &[[u32; 3]]) -> Self {
        let mut stars = vec![Vec::with_capacity(8); vertex_count];
        for (f, corners) in faces.iter().enumerate() {
            for &v in corners {
                stars[v as usize].push(f as u32);
            }
        }
        Self { faces: faces.iter().copied().map(Some).collect(), stars }
    }

    /// The triangles that are left, in order.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        self.faces.iter().flatten().copied().collect()
    }

    /// The corners of the triangles around a vertex.
    pub(super) fn star(&self, v: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.stars[v as usize].iter().filter_map(|&f| self.faces[f as usize])
    }

    /// Number of triangles around a vertex.
    pub(super) fn degree(&self, v: u32) -> usize {
        self.stars[v as usize].len()
    }

    /// Every edge once, as the triangles meet it, from its smaller vertex.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let mut edges: Vec<[u32; 2]> = (self.faces.iter().flatten())
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[u, v]| [u.min(v), u.max(v)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The two triangles at an edge; `None` if there is no such edge or it lies on the boundary.
    pub(super) fn diamond(&self, u: u32, v: u32) -> Option<Diamond> {
        let (mut left, mut right) = (None, None);
        for &f in &self.stars[u as usize] {
            let corners = self.faces[f as usize]?;
            let k = corners.iter().position(|&c| c == u)?;
            if corners[(k + 1) % 3] == v {
                left = Some((f, corners[(k + 2) % 3]));
            } else if corners[(k + 2) % 3] == v {
                right = Some((f, corners[(k + 1) % 3]));
            }
        }
        let ((f, c), (g, d)) = (left?, right?);
        Some(Diamond { ends: [u, v], opposite: [c, d], faces: [f, g] })
    }

    fn joined(&self, u: u32, v: u32) -> bool {
        self.star(u).any(|corners| corners.contains(&v))
    }

    /// Whether the other diagonal is not an edge already. Around an end with three triangles it is.
    pub(super) fn can_flip(&self, d: &Diamond) -> bool {
        !self.joined(d.opposite[0], d.opposite[1])
    }

    /// Replaces the edge by the other diagonal of its diamond.
    pub(super) fn flip(&mut self, diamond: &Diamond) {
        let ([a, b], [c, d], [f, g]) = (diamond.ends, diamond.opposite, diamond.faces);
        self.faces[f as usize] = Some([c, a, d]);
        self.faces[g as usize] = Some([d, b, c]);
        self.stars[a as usize].retain(|&s| s != g);
        self.stars[b as usize].retain(|&s| s != f);
        self.stars[c as usize].push(g);
        self.stars[d as usize].push(f);
    }

    /// Puts a new vertex on an interior edge and returns its number.
    pub(super) fn split(&mut self, diamond: &Diamond) -> u32 {
        let ([a, b], [c, d], [f, g]) = (diamond.ends, diamond.opposite, diamond.faces);
        let m = self.stars.len() as u32;
        let (f2, g2) = (self.faces.len() as u32, self.faces.len() as u32 + 1);
        self.faces[f as usize] = Some([a, m, c]);
        self.faces[g as usize] = Some([m, a, d]);
        self.faces.extend([Some([m, b, c]), Some([b, m, d])]);
        self.stars.push(vec![f, g, f2, g2]);
        self.stars[c as usize].push(f2);
        self.stars[d as usize].push(g2);
        for face in &mut self.stars[b as usize] {
            if *face == f {
                *face = f2;
            } else if *face == g {
                *face = g2;
            }
        }
        m
    }

    /// Whether the surface stays a manifold when the edge becomes a point: its ends have no common
    /// neighbours but the opposite corners, and those keep at least three triangles.
    pub(super) fn can_collapse(&self, d: &Diamond) -> bool {
        let [a, b] = d.ends;
        let neighbours = |v: u32| {
            let mut all: Vec<u32> = self.star(v).flatten().filter(|&w| w != v).collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let around = neighbours(b);
        let common = neighbours(a).iter().filter(|v| around.binary_search(v).is_ok()).count();
        common == 2 && d.opposite.iter().all(|&v| self.degree(v) > 3)
    }

    /// Moves all triangles of `ends[1]` to `ends[0]` and removes the two at the edge.
    pub(super) fn collapse(&mut self, diamond: &Diamond) {
        let ([a, b], [f, g]) = (diamond.ends, diamond.faces);
        for face in diamond.faces {
            for v in self.faces[face as usize].take().into_iter().flatten() {
                self.stars[v as usize].retain(|&s| s != face);
            }
        }
        for face in std::mem::take(&mut self.stars[b as usize]) {
            debug_assert!(face != f && face != g);
            for v in self.faces[face as usize].iter_mut().flatten().filter(|v| **v == b) {
                *v = a;
            }
            self.stars[a as usize].push(face);
        }
    }
}
