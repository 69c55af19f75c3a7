//! Small pictures for the page, drawn by the library's renderer.

use super::request::{Outcome, Request};
use super::solve::Found;
use glam::{DVec3, Vec2};
use immerse::immersion::{FieldValues, length_errors, pinch_points};
use immerse::mesh::Mesh;
use immerse::render::{
    Anchor, Camera, ColorMap, Extent, Field, Lights, Look, LookName, Metadata, Output, Paint, Picture, Png, Scenery,
    TextStyle, View, render, text_width,
};
use immerse::scene::Scene;
use immerse::scene::build::view;

/// Pixels of a picture that stands alone, and of one among others.
pub const ALONE: [usize; 2] = [960, 720];
pub const BESIDE: [usize; 2] = [560, 420];

/// How a surface is looked at.
#[derive(Clone, Debug)]
pub struct Style {
    pub view: View,
    pub look: Look,
}

impl Style {
    /// From where a scene looks. Colours are the same in all pictures of the page.
    pub fn of_scene(scene: &Scene) -> Outcome<Style> {
        Ok(Style { view: view(scene)?, look: Look::default() })
    }

    /// Seen from a direction, z upward.
    pub fn from(direction: [f64; 3], name: LookName) -> Outcome<Style> {
        let view = View::default().with_up(DVec3::Z)?.with_direction(DVec3::from_array(direction))?;
        Ok(Style { view, look: Look::preset(name) })
    }

    /// From where the surface suits best.
    pub fn usual() -> Style {
        Style { view: View::default(), look: Look::default() }
    }
}

/// A picture with what is written under it.
pub struct Tile {
    pub picture: Picture,
    pub caption: String,
}

/// The picture of a surface that was found.
pub fn picture(found: &Found, style: &Style, size: [usize; 2]) -> Outcome<Picture> {
    picture_of(&found.mesh, &found.positions, &found.rims, style, size)
}

/// The picture of a surface with rims and pinch points in red.
pub fn picture_of(
    mesh: &Mesh,
    positions: &[DVec3],
    rims: &[[u32; 2]],
    style: &Style,
    size: [usize; 2],
) -> Outcome<Picture> {
    draw(mesh, positions, rims, None, style, size)
}

/// A small picture whose colours are length errors, up to a largest one.
pub fn picture_of_errors(found: &Found, positions: &[DVec3], most: f32) -> Outcome<Picture> {
    let (mesh, metric) = (&found.mesh, &found.metric);
    let errors = length_errors(mesh, metric, positions);
    let around = |v| {
        let (sum, count) = mesh
            .outgoing(v)
            .fold((0.0, 0.0), |(sum, count), h| (sum + errors[mesh.edge(h).index()].abs(), count + 1.0));
        (sum / count) as f32
    };
    let values = FieldValues::PerVertex(mesh.vertices().map(around).collect());
    let field = Field { name: "length_error".into(), values, period: None };
    let paint = Paint::Map { map: ColorMap::Viridis, range: [0.0, most] };
    let style = Style { look: Look { paint, ..Look::default() }, ..Style::usual() };
    draw(mesh, positions, &[], Some(&field), &style, [420, 315])
}

fn draw(
    mesh: &Mesh,
    positions: &[DVec3],
    rims: &[[u32; 2]],
    color: Option<&Field>,
    style: &Style,
    [width, height]: [usize; 2],
) -> Outcome<Picture> {
    let triangles = mesh.triangles();
    let pinches: Vec<u32> = pinch_points(mesh, positions).into_iter().map(|v| v.0).collect();
    let halfedges = mesh.boundary_loops().concat();
    let boundary: Vec<[u32; 2]> = halfedges.into_iter().map(|h| [mesh.tail(h).0, mesh.tip(h).0]).collect();
    let output = Output::new(width, height, 8)?;
    let camera = Camera::framing(&style.view, &Extent::of_surface(positions, &triangles), &output)?;
    let scenery = Scenery {
        triangles: &triangles,
        positions,
        rims,
        boundary: &boundary,
        pinch_points: &pinches,
        color,
        ..Scenery::default()
    };
    Ok(render(&scenery, &camera, &Lights::default(), &style.look, &output)?)
}

/// Space below a picture for what is written under it, as a share of its width.
const CAPTION: f64 = 0.075;

/// Pictures beside each other in rows, each with its caption below.
pub fn sheet(tiles: &[Tile], columns: usize) -> Picture {
    let [width, height] = tiles.first().map_or([1, 1], |tile| [tile.picture.width(), tile.picture.height()]);
    let below = ((width as f64 * CAPTION) as usize).max(28);
    let background = Look::default().background[0];
    let mut whole = Picture::blank(columns * width, tiles.len().div_ceil(columns) * (height + below), background);
    let ink = whole.ink();
    for (k, tile) in tiles.iter().enumerate() {
        let corner = [k % columns * width, k / columns * (height + below)];
        whole.paste(&tile.picture, corner);
        // As large as fits.
        let size = (0.62 * below as f32).min(0.92 * width as f32 / text_width(&tile.caption, 1.0));
        let style = TextStyle { size, color: ink, anchor: Anchor::Middle };
        let at = [corner[0] + width / 2, corner[1] + height + below / 2];
        whole.draw_text(&tile.caption, Vec2::new(at[0] as f32, at[1] as f32), &style);
    }
    whole
}

/// Writes a picture for the page, and gives the line that shows it.
pub fn save(request: &Request, name: &str, picture: &Picture, alternative: &str) -> Outcome<String> {
    let path = request.pictures().join(format!("{name}.png"));
    picture.write_png(&path, Png { small: true, ..Png::default() }, &Metadata::default())?;
    Ok(format!("![{alternative}](renders/reproduction/{name}.png)\n"))
}
