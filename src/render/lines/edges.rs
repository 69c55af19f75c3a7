//! Which edges of the mesh are drawn, and as what.

use rayon::prelude::*;

use crate::render::{Lines, Scenery, stage::Stage};

/// Edges of the drawn faces, by what they are drawn as.
pub struct Edges {
    /// Between a face whose front is seen and one whose back is.
    pub silhouettes: Vec<[u32; 2]>,
    /// Bent by more than the angle of the look.
    pub creases: Vec<[u32; 2]>,
    /// Ends of what is shown.
    pub boundary: Vec<[u32; 2]>,
    /// All of them in order, if some faces are hidden.
    shown: Option<Vec<[u32; 2]>>,
}

impl Edges {
    pub fn new(scenery: &Scenery, stage: &Stage, lines: &Lines) -> Self {
        let hidden = scenery.shown.iter().any(|shown| !shown);
        let whole =
            Self { silhouettes: Vec::new(), creases: Vec::new(), boundary: scenery.boundary.to_vec(), shown: None };
        if lines.silhouette == 0.0 && lines.crease == 0.0 && !hidden {
            return whole;
        }
        let mut sides: Vec<([u32; 2], u32)> = stage
            .faces
            .par_iter()
            .enumerate()
            .flat_map_iter(|(face, corners)| {
                [0, 1, 2].map(|k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 3]);
                    ([a.min(b), a.max(b)], face as u32)
                })
            })
            .collect();
        sides.par_sort_unstable();
        let front = |side: &([u32; 2], u32)| stage.shows_front[side.1 as usize];
        let normal = |side: &([u32; 2], u32)| stage.face_normals[side.1 as usize];
        let flattest = libm::cosf(lines.crease_angle);
        let mut edges = whole;
        let mut ends_here = Vec::new();
        let mut all = Vec::new();
        for edge in sides.chunk_by(|a, b| a.0 == b.0) {
            if edge.iter().any(|side| front(side) != front(&edge[0])) {
                edges.silhouettes.push(edge[0].0);
            } else if lines.crease > 0.0
                && let [one, other] = edge
                && normal(one).dot(normal(other)) < flattest
            {
                edges.creases.push(edge[0].0);
            }
            if hidden {
                all.push(edge[0].0);
                ends_here.extend((edge.len() == 1).then_some(edge[0].0));
            }
        }
        if hidden {
            edges.boundary = ends_here;
            edges.shown = Some(all);
        }
        edges
    }

    pub fn is_shown(&self, [a, b]: [u32; 2]) -> bool {
        self.shown.as_ref().is_none_or(|shown| shown.binary_search(&[a.min(b), a.max(b)]).is_ok())
    }
}
