//! FOLD 1.2 (`.fold`), the format of origami: JSON with arrays of vertices, edges and faces.
//!
//! As a mesh the first frame is read that has faces, usually the key frame at the top. As keyframes it and all that come after
//! it are read.

use std::borrow::Cow;

use glam::DVec3;

use super::fold_frames::{Frame, frames};
use super::polygons::Polygons;
use crate::mesh::limits::MOST_KEYFRAMES;
use crate::mesh::read::edges::{EdgeNumbers, Listed};
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::text::decode;

/// The mesh of a file.
pub(in crate::mesh::read) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    let text = text(bytes)?;
    let frames = frames(&text)?;
    let number = first_with_faces(&frames)?;
    let mut soup = Typed::of(&frames[number]).and_then(Typed::soup).map_err(|problem| problem.of_frame(number))?;
    if number > 0 {
        soup.notes.push(format!("took frame {number} of the file, the first that has faces"));
    }
    let left = frames.len() - 1 - number;
    if left > 0 {
        soup.notes.push(format!(
            "left out the {left} frames after it; `files` under [metric] or [bending] takes all of them, as keyframes"
        ));
    }
    Ok(soup)
}

/// What `read` finds in each frame, from the first one that has faces. One after another, so that no more than one is in
/// memory.
///
/// # Errors
/// [`Problem`] with the number of the frame, and for frames in different units.
pub(in crate::mesh::read) fn each_frame<T>(
    bytes: &[u8],
    mut read: impl FnMut(Soup) -> Result<T, Problem>,
) -> Result<Vec<T>, Problem> {
    let text = text(bytes)?;
    let frames = frames(&text)?;
    let first = first_with_faces(&frames)?;
    if frames.len() - first > MOST_KEYFRAMES {
        let reason = format!("there are {} frames, {MOST_KEYFRAMES} are the limit", frames.len() - first);
        return Err(Problem::new(reason, "take fewer of them; what is between is interpolated"));
    }
    let unit = unit(&frames[first]).map_err(|problem| problem.of_frame(first))?;
    let mut of_frame = |frame: &Frame| match self::unit(frame)? {
        other if other != unit => {
            let reason = format!("it is measured in \"{other}\", and frame {first} in \"{unit}\"");
            Err(Problem::new(reason, "bring all frames to one unit, and say which in `frame_unit`"))
        }
        _ => read(Typed::of(frame)?.soup()?),
    };
    let numbered = frames.iter().enumerate().skip(first);
    numbered.map(|(number, frame)| of_frame(frame).map_err(|problem| problem.of_frame(number))).collect()
}

fn text(bytes: &[u8]) -> Result<Cow<'_, str>, Problem> {
    let text = decode(bytes);
    match text.is_text() {
        true => Ok(text.text),
        false => Err(Problem::new("the file is not text", "save it as JSON in UTF-8")),
    }
}

/// What a frame measures in. One that says nothing has no unit, which is "unit".
fn unit(frame: &Frame) -> Result<String, Problem> {
    let unit = frame.unit.read("frame_unit", "write for example \"unit\" or \"mm\"")?;
    Ok(unit.unwrap_or_else(|| "unit".to_owned()))
}

/// The number of the first frame with faces; 0 is that at the top level.
fn first_with_faces(frames: &[Frame]) -> Result<usize, Problem> {
    frames.iter().position(|frame| frame.faces_vertices.is_there()).ok_or_else(|| {
        match frames.iter().any(|frame| frame.edges_vertices.is_there()) {
            true => Problem::new(
                "the file has edges, but no `faces_vertices`",
                "export faces, too; FOLD's own library finds them (edges_vertices_to_faces_vertices)",
            ),
            false => Problem::new("there is no `faces_vertices`", "export a FOLD file with vertices and faces"),
        }
    })
}

/// What is read of a frame.
struct Typed {
    vertices_coords: Option<Vec<Option<Vec<f64>>>>,
    faces_vertices: Option<Vec<Vec<u32>>>,
    edges_vertices: Option<Vec<[u32; 2]>>,
    edges_length: Option<Vec<Option<f64>>>,
    edges_fold_angle: Option<Vec<Option<f64>>>,
    edges_assignment: Option<Vec<Option<String>>>,
}

impl Typed {
    fn of(frame: &Frame) -> Result<Typed, Problem> {
        const NUMBERS: &str = "give a number for each edge";
        Ok(Typed {
            vertices_coords: (frame.vertices_coords)
                .read("vertices_coords", "give two or three coordinates for each vertex")?,
            faces_vertices: (frame.faces_vertices)
                .read("faces_vertices", "give a list of vertices for each face, which count from 0")?,
            edges_vertices: (frame.edges_vertices)
                .read("edges_vertices", "give two vertices for each edge, which count from 0")?,
            edges_length: frame.edges_length.read("edges_length", NUMBERS)?,
            edges_fold_angle: frame.edges_fold_angle.read("edges_foldAngle", NUMBERS)?,
            edges_assignment: (frame.edges_assignment)
                .read("edges_assignment", "give a letter such as \"M\" or \"V\" for each edge")?,
        })
    }

    fn soup(self) -> Result<Soup, Problem> {
        let faces = self.faces_vertices.unwrap_or_default();
        let positions = self.vertices_coords.map(positions).transpose()?;
        let named = faces.iter().flatten().map(|&v| v as usize + 1).max().unwrap_or(0);
        let corners: usize = faces.iter().map(Vec::len).sum();
        if positions.is_none() && named > corners {
            let reason = format!("vertex {} is named, but all faces together have {corners} corners", named - 1);
            return Err(Problem::new(reason, "number the vertices from 0 without gaps, or give `vertices_coords`"));
        }
        let mut polygons = Polygons::default();
        for (f, face) in faces.iter().enumerate() {
            if face.len() < 3 {
                let reason = format!("face {f} has {} corners", face.len());
                return Err(Problem::new(reason, "give it three or more, or remove it"));
            }
            polygons.add(face, None);
        }
        let count = positions.as_ref().map_or(named, Vec::len);
        let mut soup = match polygons.len() {
            0 => return Err(Problem::new("`faces_vertices` is empty", "give at least one triangle")),
            _ => polygons.cut(count, positions)?,
        };
        let Some(edges) = self.edges_vertices else {
            let without =
                [("edges_length", self.edges_length.is_some()), ("edges_foldAngle", self.edges_fold_angle.is_some())];
            return match without.into_iter().find(|(_, is_there)| *is_there) {
                Some((key, _)) => {
                    let reason = format!("there is `{key}`, and no `edges_vertices` that says of which edges");
                    Err(Problem::new(reason, "add `edges_vertices`, or leave it out"))
                }
                None => Ok(soup),
            };
        };
        let fits = |key: &str, count: usize| match count == edges.len() {
            true => Ok(()),
            false => Err(Problem::new(
                format!("`{key}` has {count} entries, and `edges_vertices` has {}", edges.len()),
                "give one for each edge",
            )),
        };
        if let Some(values) = self.edges_length {
            fits("edges_length", values.len())?;
            // A length that is not known is that of an edge which no face has, or it is missed later.
            let known = edges.iter().zip(values).filter(|(_, value)| value.is_some());
            let (ends, values) = known.map(|(&ends, value)| (ends, value)).unzip();
            soup.lengths = Some(EdgeNumbers { what: "length", listed: Listed::Edges, ends, values });
        }
        if let Some(letters) = &self.edges_assignment {
            fits("edges_assignment", letters.len())?;
            soup.has_creases = letters.iter().flatten().any(|letter| ["M", "V"].contains(&letter.as_str()));
        }
        if let Some(values) = self.edges_fold_angle {
            fits("edges_foldAngle", values.len())?;
            for (k, degrees) in values.iter().enumerate().filter_map(|(k, value)| Some((k, (*value)?))) {
                let letter = self.edges_assignment.as_ref().and_then(|letters| letters[k].as_deref());
                let wrong = match letter {
                    _ if !(-180.0..=180.0).contains(&degrees) => Some("an angle is from -180 to 180 degrees"),
                    Some("M") if degrees > 0.0 => Some("it is a mountain (M), whose angle is not positive"),
                    Some("V") if degrees < 0.0 => Some("it is a valley (V), whose angle is not negative"),
                    _ => None,
                };
                if let Some(why) = wrong {
                    let [u, v] = edges[k];
                    let reason = format!("edge {k}, from vertex {u} to {v}, has fold angle {degrees}, and {why}");
                    return Err(Problem::new(reason, "correct `edges_foldAngle` or `edges_assignment`"));
                }
            }
            if values.iter().flatten().any(|degrees| *degrees != 0.0) {
                soup.notes.push("its fold angles are targets where [bending] has from = \"mesh\"".to_owned());
            }
            // Between the normals of its faces a valley closes; here positive is as on a sphere, whose normals point apart.
            let values = values.into_iter().map(|value| value.map(|degrees| -degrees.to_radians())).collect();
            soup.angles = Some(EdgeNumbers { what: "fold angle", listed: Listed::Edges, ends: edges, values });
        }
        Ok(soup)
    }
}

fn positions(rows: Vec<Option<Vec<f64>>>) -> Result<Vec<DVec3>, Problem> {
    let point = |(v, row): (usize, Option<Vec<f64>>)| match row.as_deref() {
        Some(&[x, y]) => Ok(DVec3::new(x, y, 0.0)),
        Some(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
        row => {
            let reason = format!("vertex {v} has {} coordinates", row.map_or(0, <[f64]>::len));
            Err(Problem::new(reason, "give two or three for each vertex"))
        }
    };
    rows.into_iter().enumerate().map(point).collect()
}
