//! `immerse.render`.

use glam::DVec3;
use immerse::immersion::{FieldValues, pinch_points};
use immerse::render::{
    CameraMotion, ColorMap, Extent, Field, Lights, Look, LookName, Output, Paint, Picture, Plane, Scenery, View,
};
use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray3};
use pyo3::prelude::*;

use super::arrays::{Given, doubles, finite, points, rows, tuple};
use super::errors::{raised, refused};
use super::mesh::Mesh;
use super::shape::ImmersedSurface;

/// Looks that show the surface alone, and no field of a film.
const LOOKS: [&str; 4] = ["studio", "clay", "soap", "blueprint"];
/// A picture over its background: uint8, (height, width, 4), sRGB. The last channel is 255.
pub fn pixels(py: Python<'_>, picture: &Picture) -> PyResult<Py<PyArray3<u8>>> {
    let (width, height) = (picture.width(), picture.height());
    let bytes = py.detach(|| {
        let opaque = |&[r, g, b]: &[u8; 3]| [r, g, b, 255];
        picture.srgb_bytes().as_chunks().0.iter().flat_map(opaque).collect::<Vec<u8>>()
    });
    let array = Array3::from_shape_vec((height, width, 4), bytes)
        .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))?;
    Ok(array.into_pyarray(py).unbind())
}

/// A picture of a surface, made by the renderer of films.
///
/// Parameters
/// ----------
/// surface : ImmersedSurface or Mesh
///     What `Immersion.relax` or a film gave, or a mesh with `positions` beside it.
/// positions : array of float, (|V|, 3), optional
///     Where the vertices are, if not where the surface has them.
/// size : (int, int)
///     Width and height in pixels.
/// look : str
///     "studio", "clay", "soap" or "blueprint". The others show fields of a film, see `Film.picture`.
/// color : array of float, (|V|,) or (|F|,), optional
///     A value per vertex or face, shown as colour.
/// color_map : str
///     "viridis", "inferno", "cividis", "diverging", "cyclic" or "categorical".
/// color_range : (float, float), optional
///     The values at both ends of the map; left out, the least and the greatest, and for "diverging" the greatest absolute
///     value on both sides of 0.
/// direction, up : (float, float, float), optional
///     From the surface to the eye, and upward in the picture; left out, from where the surface is seen best.
/// fill : float
///     Share of the picture that the surface fills.
/// field_of_view : float
///     Vertical, in degrees; 0 for no perspective.
/// samples : int
///     Samples per pixel: 1, 4, 8 or 16.
///
/// Returns
/// -------
/// array of uint8, (height, width, 4)
///     sRGB over the background of the look, rows from the top; the last channel is 255.
#[pyfunction]
#[pyo3(signature = (
    surface, positions=None, *, size=(960, 720), look="studio", color=None, color_map="viridis", color_range=None,
    direction=None, up=None, fill=0.85, field_of_view=30.0, samples=8
), text_signature = "(surface, positions=None, *, size=(960, 720), look='studio', color=None, color_map='viridis', \
                     color_range=None, direction=None, up=None, fill=0.85, field_of_view=30.0, samples=8)")]
#[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn render(
    py: Python<'_>,
    surface: &Bound<'_, PyAny>,
    positions: Option<&Bound<'_, PyAny>>,
    size: (i64, i64),
    look: &str,
    color: Option<&Bound<'_, PyAny>>,
    color_map: &str,
    color_range: Option<(f32, f32)>,
    direction: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    fill: f64,
    field_of_view: f64,
    samples: usize,
) -> PyResult<Py<PyArray3<u8>>> {
    let fault = |error| raised(py, &error);
    let immersed = surface.cast::<ImmersedSurface>().ok();
    let mesh = match (immersed, surface.cast::<Mesh>()) {
        (Some(shape), _) => shape.get().connectivity().clone(),
        (None, Ok(mesh)) => mesh.get().mesh.clone(),
        (None, Err(_)) => {
            let reason = format!("the surface is of type {}", surface.get_type().name()?);
            return Err(refused(py, reason, "give what `Immersion.relax` or a film gave, or a Mesh and positions"));
        }
    };
    let given: Option<Given<'_, f64>> = positions.map(|positions| doubles("positions", positions)).transpose()?;
    let own = immersed.map(|shape| shape.get().places(py)).transpose()?;
    let places: &[DVec3] = match (&given, &own) {
        (Some(array), _) => {
            points(py, "positions", array, mesh.vertex_count())?;
            finite(py, "positions", array.entries()?)?;
            rows(array.entries()?)
        }
        (None, Some(array)) => rows(array.as_slice()?),
        (None, None) => {
            return Err(refused(py, "a mesh alone has no positions", "give them as well: `render(mesh, positions)`"));
        }
    };
    let rims = match (immersed, &given) {
        (Some(shape), None) => shape.get().rim_ends(py)?,
        _ => Vec::new(),
    };
    let mut look = look_of(py, look)?;
    let field = color.map(|color| field_of(py, &mesh, color)).transpose()?;
    if let Some(field) = &field {
        let Some(&(_, map)) = ColorMap::ALL.iter().find(|(name, _)| *name == color_map) else {
            let names = ColorMap::ALL.map(|(name, _)| name).join(", ");
            return Err(refused(py, format!("there is no colour map {color_map:?}"), format!("write one of {names}")));
        };
        let range = color_range.map_or_else(|| range_of(map, field.values.all()), |(low, high)| [low, high]);
        look.paint = Paint::Map { map, range };
    }
    let mut view = View::default().with_fill(fill).map_err(fault)?;
    view = view.with_field_of_view(field_of_view.to_radians()).map_err(fault)?;
    if let Some(direction) = direction {
        view = view.with_direction(DVec3::from_array(direction)).map_err(fault)?;
    }
    if let Some(up) = up {
        view = view.with_up(DVec3::from_array(up)).map_err(fault)?;
    }
    let output = Output::new(side(size.0), side(size.1), samples).map_err(fault)?;
    let picture = py.detach(|| {
        let triangles = mesh.triangles();
        let extent = Extent::of_surface(places, &triangles);
        let camera = CameraMotion::framing(&view, &extent, &output, [0.0, 1.0])?;
        let boundary: Vec<[u32; 2]> =
            mesh.edges().filter(|&e| mesh.is_boundary_edge(e)).map(|e| mesh.edge_vertices(e).map(|v| v.0)).collect();
        let pinch_points: Vec<u32> = pinch_points(&mesh, places).into_iter().map(|v| v.0).collect();
        let up = camera.up();
        let scenery = Scenery {
            triangles: &triangles,
            positions: places,
            rims: &rims,
            boundary: &boundary,
            pinch_points: &pinch_points,
            ground: Some(Plane { normal: up, offset: extent.lowest(up) }),
            color: field.as_ref(),
            ..Scenery::default()
        };
        immerse::render::render(&scenery, &camera.at(0.0, 0.0), &Lights::default(), &look, &output)
    });
    pixels(py, &picture.map_err(fault)?)
}

/// What is below 0 is refused as 0 is.
fn side(pixels: i64) -> usize {
    usize::try_from(pixels).unwrap_or(0)
}

fn look_of(py: Python<'_>, name: &str) -> PyResult<Look> {
    let known = LookName::ALL.iter().find(|(known, _)| *known == name);
    match known {
        Some(&(_, preset)) if LOOKS.contains(&name) => Ok(Look::preset(preset)),
        Some(_) => {
            let reason = format!("the look {name:?} shows fields of a film");
            Err(refused(py, reason, format!("take one of {}, or a picture of a Film", LOOKS.join(", "))))
        }
        None => Err(refused(py, format!("there is no look {name:?}"), format!("write one of {}", LOOKS.join(", ")))),
    }
}

/// A value per vertex or per face.
fn field_of(py: Python<'_>, mesh: &immerse::Mesh, color: &Bound<'_, PyAny>) -> PyResult<Field> {
    let array = doubles("color", color)?;
    finite(py, "color", array.entries()?)?;
    let (vertices, faces) = (mesh.vertex_count(), mesh.face_count());
    let values: Vec<f32> = array.entries()?.iter().map(|&value| value as f32).collect();
    let values = match *array.shape() {
        [found] if found == vertices => FieldValues::PerVertex(values),
        [found] if found == faces => FieldValues::PerFace(values),
        _ => {
            let reason = format!("color has shape {}", tuple(array.shape()));
            return Err(refused(py, reason, format!("give one value per vertex, ({vertices},), or face, ({faces},)")));
        }
    };
    Ok(Field { name: "color".into(), values, period: None })
}

/// From the least to the greatest value, or as far on both sides of 0.
fn range_of(map: ColorMap, values: &[f32]) -> [f32; 2] {
    let low = values.iter().copied().fold(f32::INFINITY, f32::min);
    let high = values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    if map == ColorMap::Diverging { [-low.abs().max(high.abs()), low.abs().max(high.abs())] } else { [low, high] }
}
