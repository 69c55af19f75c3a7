//! `[mesh]`: files, generated shapes and solids.

use std::path::PathBuf;

/// `[mesh]`: a file or a generated shape.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSection {
    /// `file = "…"`: OBJ, PLY, OFF or STL, by its ending.
    File(PathBuf),
    /// `shape = "…"` with that shape's parameters.
    Shape(Shape),
}

/// `weld` under `[mesh]`: whether boundary edges that lie upon each other of a file become one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weld {
    /// `"none"`
    None,
    /// `"exact"`: where coordinates are equal.
    Exact,
    /// A number: where ends are no farther apart than this, in the units of the file.
    Within(f64),
}

impl MeshSection {
    /// The file, if it is one.
    pub fn file(&self) -> Option<&PathBuf> {
        match self {
            MeshSection::File(path) => Some(path),
            MeshSection::Shape(_) => None,
        }
    }
}

impl Default for MeshSection {
    fn default() -> Self {
        MeshSection::Shape(Shape::Sphere { radius: 1.0, subdivisions: 16 })
    }
}

/// Generated shapes with their parameters (defaults in parentheses).
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Icosphere: `radius` (1), `subdivisions` of an icosahedron's edges into this many parts (16).
    Sphere { radius: f64, subdivisions: usize },
    /// Meridians and parallels: `radius` (1), `meridians` (48), `parallels` (24).
    UvSphere { radius: f64, meridians: usize, parallels: usize },
    /// A parallelogram with opposite sides glued, known by its lengths alone: lattice vectors `a`
    /// ([3, 0]) and `b` ([0, 2.5]), `columns` (60) along a and `rows` (50) along b, `grid`
    /// ("equilateral": every second row is shifted by half a cell where the rows are even, or "square").
    FlatTorus { a: [f64; 2], b: [f64; 2], columns: usize, rows: usize, grid: Grid },
    /// Torus of revolution: `major_radius` (1), `minor_radius` (0.4), `columns` (96), `rows` (40).
    Torus { major_radius: f64, minor_radius: f64, columns: usize, rows: usize },
    /// Cylinder without lids: `radius` (1), `height` (2), `columns` (64) around, `rows` (24) up.
    Cylinder { radius: f64, height: f64, columns: usize, rows: usize },
    /// Flat annulus: `inner_radius` (0.5), `outer_radius` (1), `columns` (64) around, `rows` (12).
    Annulus { inner_radius: f64, outer_radius: f64, columns: usize, rows: usize },
    /// Flat disk of equilateral-like triangles: `radius` (1), `rings` (24).
    Disk { radius: f64, rings: usize },
    /// Disk of constant negative curvature with geodesic edge lengths: `curvature` (−1), geodesic
    /// `radius` (3), about `faces` triangles (5000).
    HyperbolicDisk { curvature: f64, radius: f64, faces: usize },
    /// Polyhedron with every edge divided into `subdivisions` (8) parts: a `name` ("tetrahedron",
    /// "cube", "octahedron", "dodecahedron", "icosahedron", "genus_two", "genus_two_saddle") or `vertices` and `polygons`.
    Polyhedron { source: PolyhedronSource, subdivisions: usize },
    /// Isosurface of a tree of solids, remeshed to `edge_length` (0.05).
    Implicit { solid: Solid, edge_length: f64 },
}

/// How the cells of a flat torus are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grid {
    /// Rows shifted by half a cell, so that a lattice of the right proportions is equilateral.
    Equilateral,
    /// Parallelograms cut along a diagonal.
    Square,
}

/// Where the polyhedron comes from.
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum PolyhedronSource {
    /// A built-in one.
    Named(String),
    /// Explicit corners and polygons (counterclockwise seen from outside, any number of sides).
    Explicit { vertices: Vec<[f64; 3]>, polygons: Vec<Vec<usize>> },
}

/// A solid: a primitive or a group, and how it joins what stands before it in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// What it is.
    pub body: Body,
    /// How it joins the solids before it (the first one ignores this).
    pub operation: Operation,
    /// Width over which the joint is rounded, 0 for a sharp one.
    pub blend: f64,
}

/// Primitives by signed distance, and groups.
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A ball.
    Sphere { center: [f64; 3], radius: f64 },
    /// A tube with round ends; with two radii a round cone.
    Capsule { from: [f64; 3], to: [f64; 3], radii: [f64; 2] },
    /// A ring around `axis`.
    Torus { center: [f64; 3], axis: [f64; 3], major_radius: f64, minor_radius: f64 },
    /// An ellipsoid with semi-axes `radii`, turned by `rotation` degrees about x, then y, then z.
    Ellipsoid { center: [f64; 3], radii: [f64; 3], rotation: [f64; 3] },
    /// Several solids, joined in order.
    Group(Vec<Solid>),
}

/// How a solid joins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Added.
    Union,
    /// Cut away.
    Difference,
    /// Only what both have.
    Intersection,
}
