//! The faces of a file as they stand in it, and how they become triangles.

use glam::DVec3;

use crate::mesh::limits::check_size;
use crate::mesh::polygon;
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;

/// Polygons with any number of corners, which may name vertices that come later in the file.
#[derive(Default)]
pub(super) struct Polygons {
    corners: Vec<u32>,
    /// Per polygon the end of its corners, and its line.
    ends: Vec<(usize, Option<usize>)>,
    /// Corners that name the vertex before them once more, and the first polygon that has one.
    repeated: usize,
    first_repeated: usize,
    /// The number of the first polygon in messages.
    counted_from: usize,
}

impl Polygons {
    pub fn counted_from(counted_from: usize) -> Polygons {
        Polygons { counted_from, ..Polygons::default() }
    }

    /// Adds a polygon. A corner that repeats the one before it is dropped, if three are left.
    pub fn add(&mut self, corners: &[u32], line: Option<usize>) {
        let start = self.corners.len();
        for (k, corner) in corners.iter().enumerate() {
            let before = if k == 0 { corners.last() } else { corners.get(k - 1) };
            if before != Some(corner) {
                self.corners.push(*corner);
            }
        }
        if self.corners.len() < start + 3 {
            // Nothing of it is left. What it is will be said of the triangles that it is written as.
            self.corners.truncate(start);
            self.corners.extend(corners);
        }
        let dropped = corners.len() - (self.corners.len() - start);
        if dropped > 0 && self.repeated == 0 {
            self.first_repeated = self.ends.len();
        }
        self.repeated += dropped;
        self.ends.push((self.corners.len(), line));
    }

    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Triangles with as many corners in all as the polygons have sides, at most.
    pub fn triangle_count(&self) -> usize {
        self.corners.len() - 2 * self.ends.len()
    }

    /// Cuts all of them, in their order.
    ///
    /// # Errors
    /// [`Problem`] for an outline that crosses itself, for no polygons at all, and for more elements than a mesh may have.
    pub fn cut(self, vertex_count: usize, positions: Option<Vec<DVec3>>) -> Result<Soup, Problem> {
        check_size(vertex_count, self.triangle_count()).map_err(|error| Problem::of_size(&error))?;
        let mut soup = Soup { vertex_count, positions, ..Soup::default() };
        let mut start = 0;
        for (n, &(end, line)) in (0_u32..).zip(&self.ends) {
            polygon::cut(&self.corners[start..end], soup.positions.as_deref(), &mut soup.triangles).map_err(
                |polygon::CrossesItself| Problem {
                    line,
                    reason: format!("the outline of face {} crosses or touches itself", n as usize + self.counted_from),
                    remedy: "cut the face into simple polygons, or correct the order of its corners".into(),
                },
            )?;
            soup.polygons.resize(soup.triangles.len(), n);
            if let Some(line) = line {
                soup.lines.resize(soup.triangles.len(), line);
            }
            start = end;
        }
        if self.repeated > 0 {
            let first = self.first_repeated + self.counted_from;
            let place = match self.ends[self.first_repeated].1 {
                Some(line) => format!("face {first}, line {line}"),
                None => format!("face {first}"),
            };
            soup.notes.push(match self.repeated {
                1 => format!("dropped a corner that repeats the one before it ({place})"),
                many => format!("dropped {many} corners that repeat the one before them (the first is in {place})"),
            });
        }
        Ok(soup)
    }
}
