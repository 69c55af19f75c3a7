//! What curvature a conformal change of metric aims at.

use super::triangulation::{Shape, Triangulation};
use crate::mesh::{Mesh, VertexId};
use crate::metric::error::degrees;
use crate::metric::{Metric, MetricError};
use std::f64::consts::{PI, TAU};

/// How far the sum of all target curvatures may be from `2π χ`.
pub const GAUSS_BONNET_TOLERANCE: f64 = 1e-10;

/// The curvature that [`super::uniformize`] and [`super::RicciFlow`] aim at.
///
/// The curvature of an interior vertex is `2π` minus the sum of its angles. The area of a vertex is a third of
/// the areas of the faces around it, in the metric that is reached, not in the one given.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvatureTarget {
    /// What is wanted inside.
    pub interior: InteriorCurvature,
    /// What is wanted on the boundary. Without a boundary it does not matter.
    pub boundary: BoundaryCondition,
    /// Whether the total area stays what it is (the default). Otherwise the mean of the log scale factors is 0.
    /// Where a condition decides the scale ([`BoundaryCondition::Isometric`] on a surface with boundary,
    /// [`InteriorCurvature::Density`] other than 0) that holds instead.
    pub keep_area: bool,
}

/// Curvature of the interior vertices.
#[derive(Clone, Debug, PartialEq)]
pub enum InteriorCurvature {
    /// In proportion to vertex area. Gauss–Bonnet says how much: the total is `2π χ` minus the turning angles
    /// of the boundary. Where the boundary is isometric, interior curvature only moves about, and its total stays.
    Constant,
    /// This number times vertex area: Gaussian curvature, of unit 1/length². For example −1 for the hyperbolic
    /// metric of a surface of genus two or more, the total area then being `2π |χ|`.
    Density(f64),
    /// In radians, one per vertex, |V|; entries of boundary vertices are not read. Each below `2π`.
    PerVertex(Vec<f64>),
    /// As much as each region says, within it in proportion to vertex area. What Gauss–Bonnet leaves is spread over
    /// all other interior vertices in the same way.
    PerRegion(Vec<Region>),
}

/// A part of the surface with the curvature it is to have.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Vertices, each in one region only. Those on the boundary are passed over.
    pub vertices: Vec<VertexId>,
    /// The sum of their curvatures in radians.
    pub curvature: f64,
}

/// What happens on the boundary.
#[derive(Clone, Debug, PartialEq)]
pub enum BoundaryCondition {
    /// Boundary edges keep their lengths.
    Isometric,
    /// Turning angles, `π` minus the sum of the angles of a boundary vertex, in radians, one per vertex, |V|;
    /// entries of interior vertices are not read. Each below `π`. Discrete geodesic curvature.
    TurningAngles(Vec<f64>),
}

impl Default for CurvatureTarget {
    /// Constant curvature, isometric on the boundary, otherwise of the same total area.
    fn default() -> Self {
        CurvatureTarget {
            interior: InteriorCurvature::Constant,
            boundary: BoundaryCondition::Isometric,
            keep_area: true,
        }
    }
}

impl CurvatureTarget {
    /// The given curvature of every interior vertex, see [`InteriorCurvature::PerVertex`].
    pub fn per_vertex(curvature: Vec<f64>) -> Self {
        CurvatureTarget { interior: InteriorCurvature::PerVertex(curvature), ..Default::default() }
    }

    /// The given total curvature of each region, see [`InteriorCurvature::PerRegion`].
    pub fn per_region(regions: Vec<Region>) -> Self {
        CurvatureTarget { interior: InteriorCurvature::PerRegion(regions), ..Default::default() }
    }
}

/// A target checked against a mesh.
#[derive(Clone, Debug)]
pub(super) struct Goal {
    interior: Interior,
    /// Per vertex: the turning angle, 0 inside.
    turning: Vec<f64>,
    /// Per vertex: whether its scale factor may change.
    pub free: Vec<bool>,
    scale: Scale,
}

#[derive(Clone, Debug)]
enum Interior {
    PerVertex(Vec<f64>),
    /// Per vertex its group, and per group this much curvature, in proportion to area.
    Totals {
        groups: Vec<usize>,
        totals: Vec<f64>,
    },
    /// This much per area; only where the boundary is held, so that there is a scale.
    Density(f64),
}

#[derive(Clone, Copy, Debug)]
enum Scale {
    /// Vertices that are held decide.
    Held,
    Area(f64),
    MeanZero,
}

impl Goal {
    /// # Errors
    /// [`MetricError::TargetCount`], [`MetricError::TargetCurvature`], [`MetricError::TargetRegion`],
    /// [`MetricError::GaussBonnet`], [`MetricError::Disconnected`].
    pub fn new(target: &CurvatureTarget, mesh: &Mesh, metric: &Metric) -> Result<Goal, MetricError> {
        let vertices = mesh.vertex_count();
        let on_boundary: Vec<bool> = mesh.vertices().map(|v| mesh.is_boundary_vertex(v)).collect();
        let bounded = on_boundary.contains(&true);
        let components = mesh.components().len();
        if components > 1 {
            return Err(MetricError::Disconnected { components });
        }
        let mut goal = Goal {
            interior: Interior::Density(0.0),
            turning: vec![0.0; vertices],
            free: vec![true; vertices],
            scale: if target.keep_area { Scale::Area(metric.total_area()) } else { Scale::MeanZero },
        };
        let mut faces = vec![0; vertices];
        mesh.faces().flat_map(|f| mesh.corners(f)).for_each(|v| faces[v.index()] += 1);
        let check = |values: &[f64], boundary: bool| -> Result<(), MetricError> {
            if values.len() != vertices {
                return Err(MetricError::TargetCount { vertices, values: values.len() });
            }
            let limit = if boundary { PI } else { TAU };
            let bad =
                (0..vertices).find(|&v| on_boundary[v] == boundary && !(values[v].is_finite() && values[v] < limit));
            if let Some(v) = bad {
                let vertex = mesh.file_vertex(VertexId::new(v));
                return Err(MetricError::TargetCurvature { vertex, value: values[v], limit });
            }
            let low = (0..vertices).find(|&v| on_boundary[v] == boundary && values[v] <= limit - PI * faces[v] as f64);
            match low {
                Some(v) => Err(MetricError::TooFewFaces {
                    vertex: mesh.file_vertex(VertexId::new(v)),
                    faces: faces[v],
                    value: values[v],
                    limit: limit - PI * faces[v] as f64,
                }),
                None => Ok(()),
            }
        };
        let held = match &target.boundary {
            BoundaryCondition::Isometric => {
                goal.free.iter_mut().zip(&on_boundary).for_each(|(free, boundary)| *free = !boundary);
                bounded
            }
            BoundaryCondition::TurningAngles(angles) => {
                check(angles, true)?;
                for v in (0..vertices).filter(|&v| on_boundary[v]) {
                    goal.turning[v] = angles[v];
                }
                false
            }
        };
        let whole = TAU * mesh.euler_characteristic() as f64;
        let inside = |v: &usize| !on_boundary[*v];
        // What Gauss-Bonnet leaves for the interior.
        let total = if held {
            goal.scale = Scale::Held;
            (0..vertices).filter(inside).map(|v| metric.curvature(mesh, VertexId::new(v))).sum()
        } else {
            whole - goal.turning.iter().sum::<f64>()
        };
        let gauss_bonnet = |sum: f64, density: Option<f64>| {
            let excess = sum - total;
            if !held && (excess.is_nan() || excess.abs() > GAUSS_BONNET_TOLERANCE) {
                return Err(MetricError::GaussBonnet {
                    sum: sum + whole - total,
                    expected: whole,
                    excess,
                    density: density.map(|density| (density, total)),
                    surface: kind(mesh),
                });
            }
            Ok(())
        };
        goal.interior = match &target.interior {
            InteriorCurvature::PerVertex(values) => {
                check(values, false)?;
                gauss_bonnet((0..vertices).filter(inside).map(|v| values[v]).sum(), None)?;
                Interior::PerVertex(values.clone())
            }
            InteriorCurvature::Constant => Interior::evenly(vertices, total),
            InteriorCurvature::PerRegion(regions) => {
                let groups = groups(regions, &on_boundary, &faces, mesh)?;
                let mut totals: Vec<f64> = regions.iter().map(|region| region.curvature).collect();
                let sum = totals.iter().sum::<f64>();
                if (0..vertices).filter(inside).all(|v| groups[v] < regions.len()) {
                    gauss_bonnet(sum, None)?;
                }
                totals.push(total - sum);
                Interior::Totals { groups, totals }
            }
            InteriorCurvature::Density(density) if !density.is_finite() => {
                return Err(MetricError::TargetDensity { density: *density });
            }
            InteriorCurvature::Density(density) if held => Interior::Density(*density),
            InteriorCurvature::Density(density) => {
                // Any area does for a flat metric; otherwise the total, of the right sign, decides it.
                if density * total <= 0.0 || total.abs() <= GAUSS_BONNET_TOLERANCE {
                    gauss_bonnet(density * metric.total_area(), Some(*density))?;
                } else {
                    goal.scale = Scale::Area(total / density);
                }
                Interior::evenly(vertices, total)
            }
        };
        if (0..vertices).filter(inside).count() == 0 && !held {
            gauss_bonnet(0.0, None)?;
        }
        Ok(goal)
    }

    /// Target curvature per vertex for a shape; what is held gets the curvature it has.
    pub fn curvature(&self, triangulation: &Triangulation, shape: &Shape) -> Vec<f64> {
        let densities = self.densities(triangulation, shape);
        (0..self.free.len())
            .map(|v| match &self.interior {
                _ if !self.free[v] => shape.curvature[v],
                _ if triangulation.on_boundary[v] => self.turning[v],
                Interior::PerVertex(values) => values[v],
                _ => densities[v] * shape.areas[v],
            })
            .collect()
    }

    /// Replaces positive curvature in proportion to area by that of the shape at the end.
    pub fn settle_positive(&mut self, end: &Triangulation, shape: &Shape) {
        if self.densities(end, shape).iter().any(|&density| density > 0.0) {
            self.interior = Interior::PerVertex(shape.curvature.clone());
        }
    }

    /// Spreads what is left beside regions by the areas of the metric that the change starts from. `false` if there are no
    /// regions, and nothing is done.
    pub fn spread_by_areas_of(&mut self, start: &Triangulation, shape: &Shape) -> bool {
        let several = matches!(&self.interior, Interior::Totals { totals, .. } if totals.len() > 1);
        if several {
            self.interior = Interior::PerVertex(self.curvature(start, shape));
        }
        several
    }

    /// Derivative of [`Goal::curvature`] of the free vertices in the direction `x`, 0 for the others.
    pub fn curvature_change(&self, triangulation: &Triangulation, shape: &Shape, x: &[f64]) -> Vec<f64> {
        let densities = self.densities(triangulation, shape);
        let mut change = match &self.interior {
            Interior::PerVertex(_) => return vec![0.0; x.len()],
            _ => triangulation.area_change(shape, x),
        };
        if let Interior::Totals { groups, totals } = &self.interior {
            // Where a group grows as a whole, its density falls.
            let growth = ratios(
                &sums(groups, totals.len(), &change, triangulation),
                &sums(groups, totals.len(), &shape.areas, triangulation),
            );
            change.iter_mut().enumerate().for_each(|(v, change)| *change -= growth[groups[v]] * shape.areas[v]);
        }
        change.iter().zip(densities).map(|(change, density)| density * change).collect()
    }

    /// Curvature per area at each vertex, 0 on the boundary and where each vertex has its own.
    pub fn densities(&self, triangulation: &Triangulation, shape: &Shape) -> Vec<f64> {
        let mut densities = match &self.interior {
            Interior::PerVertex(_) => vec![0.0; self.free.len()],
            Interior::Density(density) => vec![*density; self.free.len()],
            Interior::Totals { groups, totals } => {
                let of_groups = ratios(totals, &sums(groups, totals.len(), &shape.areas, triangulation));
                groups.iter().map(|&group| of_groups[group]).collect()
            }
        };
        let boundary = densities.iter_mut().zip(&triangulation.on_boundary).filter(|(_, boundary)| **boundary);
        boundary.for_each(|(density, _)| *density = 0.0);
        densities
    }

    /// What to add to `u` to give the metric its scale, at a time of the flow, or at its end if that is infinite.
    /// What the area was at the start matters only before the end.
    pub fn scale_shift(
        &self,
        triangulation: &Triangulation,
        u: &[f64],
        initial_area: f64,
        time: f64,
    ) -> Result<f64, MetricError> {
        Ok(match self.scale {
            Scale::Held => 0.0,
            Scale::MeanZero => -u.iter().sum::<f64>() / u.len() as f64,
            Scale::Area(goal) => {
                let log_area = libm::log(goal) + libm::log(initial_area / goal) * libm::exp(-time);
                0.5 * (log_area - libm::log(triangulation.shape(u)?.areas.iter().sum::<f64>()))
            }
        })
    }
}

/// A surface in words.
fn kind(mesh: &Mesh) -> String {
    match (mesh.genus(), mesh.boundary_loops().len()) {
        (0, 0) => "a sphere".to_owned(),
        (1, 0) => "a torus".to_owned(),
        (genus, 0) => format!("a closed surface of genus {genus}"),
        (0, 1) => "a disk".to_owned(),
        (0, 2) => "an annulus".to_owned(),
        (genus, loops) => format!("a surface of genus {genus} with {loops} boundary loops"),
    }
}

impl Interior {
    fn evenly(vertices: usize, total: f64) -> Interior {
        Interior::Totals { groups: vec![0; vertices], totals: vec![total] }
    }
}

/// Per vertex the region it is in, or the number of regions if it is in none.
fn groups(regions: &[Region], on_boundary: &[bool], faces: &[usize], mesh: &Mesh) -> Result<Vec<usize>, MetricError> {
    let mut groups = vec![regions.len(); on_boundary.len()];
    let file = |v: usize| mesh.file_vertex(VertexId::new(v));
    for (number, region) in regions.iter().enumerate() {
        let refuse = |reason: String| Err(MetricError::TargetRegion { region: number, reason });
        if !region.curvature.is_finite() {
            return refuse(format!("its curvature is {}", region.curvature));
        }
        // How many vertices, one of them, and what their curvatures stay above.
        let (mut count, mut one, mut low) = (0, 0, 0.0);
        for v in region.vertices.iter().map(|v| v.index()) {
            match groups.get(v) {
                None => return refuse(format!("vertex {v} is none of the {} of the mesh", groups.len())),
                Some(_) if on_boundary[v] => continue,
                Some(&other) if other == number => return refuse(format!("it names vertex {} twice", file(v))),
                Some(&other) if other < regions.len() => {
                    return refuse(format!("vertex {} is in region {other} already", file(v)));
                }
                Some(_) => {
                    (groups[v], count) = (number, count + 1);
                    low += TAU - PI * faces[v] as f64;
                    one = v;
                }
            }
        }
        if count == 0 {
            return refuse("it has no interior vertices".to_owned());
        }
        if region.curvature >= TAU * count as f64 {
            let which = if count == 1 { format!(" (vertex {})", file(one)) } else { String::new() };
            return refuse(format!("{} degrees are too many for {count} vertices{which}", degrees(region.curvature)));
        }
        if region.curvature <= low && count == 1 {
            let (vertex, faces) = (file(one), faces[one]);
            return Err(MetricError::TooFewFaces { vertex, faces, value: region.curvature, limit: low });
        }
        if region.curvature <= low {
            let (asked, low) = (degrees(region.curvature), degrees(low));
            return refuse(format!(
                "{asked} degrees are too few for {count} vertices, whose curvatures 360 - 180 d, d the number of faces of \
                 a vertex, add up to {low} degrees"
            ));
        }
    }
    Ok(groups)
}

/// Sum of values over the interior vertices of each group.
fn sums(groups: &[usize], count: usize, values: &[f64], triangulation: &Triangulation) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for (v, &group) in groups.iter().enumerate().filter(|(v, _)| !triangulation.on_boundary[*v]) {
        sums[group] += values[v];
    }
    sums
}

/// Quotients, 0 for a group that is empty.
fn ratios(values: &[f64], areas: &[f64]) -> Vec<f64> {
    values.iter().zip(areas).map(|(value, area)| if *area > 0.0 { value / area } else { 0.0 }).collect()
}
