//! Shapes as values: which one, and its parameters.

/// A generated shape with its parameters.
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// An icosphere of this `radius`. The edges of an icosahedron are divided into `subdivisions` parts.
    Sphere { radius: f64, subdivisions: usize },
    /// A sphere of this `radius`, cut along `meridians` and `parallels`.
    UvSphere { radius: f64, meridians: usize, parallels: usize },
    /// A sphere of this `radius` that is an octahedron bent, or another bipyramid over so many `sides`. Its edges are divided into
    /// `subdivisions` parts.
    Octasphere { radius: f64, subdivisions: usize, sides: usize },
    /// The halfway model of a sphere eversion with so many `lobes`, in the place of an octasphere with twice as many sides whose edges are
    /// divided into `subdivisions` parts.
    Halfway { lobes: usize, subdivisions: usize },
    /// A parallelogram with opposite sides glued, known by its lengths alone. It is spanned by `a` and `b`, and has
    /// `columns` along `a` and `rows` along `b`.
    FlatTorus { a: [f64; 2], b: [f64; 2], columns: usize, rows: usize, grid: Grid },
    /// A torus of revolution. Its tube of `minor_radius` has the middle at distance `major_radius` from the axis;
    /// `columns` go around the axis and `rows` around the tube.
    Torus { major_radius: f64, minor_radius: f64, columns: usize, rows: usize },
    /// A cylinder without lids, with `columns` around and `rows` up.
    Cylinder { radius: f64, height: f64, columns: usize, rows: usize },
    /// A flat annulus, with `columns` around and `rows` outward.
    Annulus { inner_radius: f64, outer_radius: f64, columns: usize, rows: usize },
    /// A flat disk of triangles that are nearly equilateral, in `rings`.
    Disk { radius: f64, rings: usize },
    /// A disk of constant negative `curvature` with geodesic edge lengths. It has a geodesic `radius` and about as many
    /// triangles as `faces` says.
    HyperbolicDisk { curvature: f64, radius: f64, faces: usize },
    /// A polyhedron with every edge divided into `subdivisions` parts.
    Polyhedron { source: PolyhedronSource, subdivisions: usize },
    /// The surface of a tree of solids, remeshed to edges of about `edge_length`.
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

/// Where a polyhedron comes from.
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum PolyhedronSource {
    /// A built-in one, whose name is one of [`super::polyhedron_names`].
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
