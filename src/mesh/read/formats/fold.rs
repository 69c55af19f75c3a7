//! FOLD 1.2 (`.fold`), the format of origami: JSON with arrays of vertices, edges and faces.
//!
//! A file has a frame at its top level, and may have more of them, which inherit from each other. The first one that has
//! faces is read.

use glam::DVec3;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::polygons::Polygons;
use crate::mesh::read::edges::{EdgeNumbers, Listed};
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::text::decode;

/// What is read of a frame.
#[derive(Deserialize)]
struct Frame {
    vertices_coords: Option<Vec<Option<Vec<f64>>>>,
    faces_vertices: Option<Vec<Vec<u32>>>,
    edges_vertices: Option<Vec<[u32; 2]>>,
    edges_length: Option<Vec<Option<f64>>>,
    #[serde(rename = "edges_foldAngle")]
    edges_fold_angle: Option<Vec<Option<f64>>>,
    edges_assignment: Option<Vec<Option<String>>>,
}

pub(in crate::mesh::read) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    let text = decode(bytes);
    if !text.is_text() {
        return Err(Problem::new("the file is not text", "save it as JSON in UTF-8"));
    }
    let no_json = |error: serde_json::Error| {
        let reason = error.to_string();
        let reason = reason.rsplit_once(" at line ").map_or(reason.as_str(), |(reason, _)| reason).to_owned();
        Problem::at(error.line(), format!("this is not JSON: {reason}"), "export it again as FOLD")
    };
    let file: Value = serde_json::from_str(text.text.trim_start_matches('\u{feff}')).map_err(no_json)?;
    let Value::Object(mut file) = file else {
        return Err(Problem::new("this is JSON, but no FOLD file: it is no object", "export it again as FOLD"));
    };
    let frames = match file.remove("file_frames") {
        None | Some(Value::Null) => Vec::new(),
        Some(Value::Array(frames)) => frames,
        Some(_) => return Err(Problem::new("`file_frames` is no list", "export it again as FOLD")),
    };
    let (number, frame) = first_with_faces(file, &frames)?;
    let mut soup = frame.soup()?;
    if number > 0 {
        soup.notes.push(format!("took frame {number} of the file, the first that has faces"));
    } else if !frames.is_empty() {
        soup.notes.push(format!("left out {} more frames of the file", frames.len()));
    }
    Ok(soup)
}

/// The first frame with faces, and its number; 0 is that at the top level.
fn first_with_faces(top: Map<String, Value>, more: &[Value]) -> Result<(usize, Frame), Problem> {
    let faces = "faces_vertices";
    let has_faces = |frame: &Map<String, Value>| frame.get(faces).is_some_and(|faces| !faces.is_null());
    if has_faces(&top) {
        return Ok((0, typed(top, 0)?));
    }
    for (k, frame) in more.iter().enumerate() {
        let number = k + 1;
        let Value::Object(frame) = frame else {
            return Err(Problem::new(format!("frame {number} is no object"), "export it again as FOLD"));
        };
        if !has_faces(frame) {
            continue;
        }
        // With what it does not say for itself, from the frame that it inherits from, and so on.
        let mut whole = frame.clone();
        let mut below = frame;
        for _ in 0..=more.len() {
            if below.get("frame_inherit").and_then(Value::as_bool) != Some(true) {
                break;
            }
            let parent = below.get("frame_parent").and_then(Value::as_u64).unwrap_or(0) as usize;
            below = match (parent, parent.checked_sub(1).and_then(|parent| more.get(parent))) {
                (0, _) => &top,
                (_, Some(Value::Object(parent))) => parent,
                _ => {
                    let reason = format!("frame {number} inherits from frame {parent}, which is not there");
                    return Err(Problem::new(reason, "correct `frame_parent`"));
                }
            };
            for (key, value) in below.iter().filter(|(key, _)| !key.starts_with("frame_")) {
                whole.entry(key).or_insert_with(|| value.clone());
            }
        }
        return Ok((number, typed(whole, number)?));
    }
    let edges = "edges_vertices";
    let has_edges = top.contains_key(edges) || more.iter().any(|frame| frame.get(edges).is_some());
    Err(match has_edges {
        true => Problem::new(
            "the file has edges, but no `faces_vertices`",
            "export faces, too; FOLD's own library finds them (edges_vertices_to_faces_vertices)",
        ),
        false => Problem::new("there is no `faces_vertices`", "export a FOLD file with vertices and faces"),
    })
}

fn typed(frame: Map<String, Value>, number: usize) -> Result<Frame, Problem> {
    const KEYS: [&str; 6] =
        ["vertices_coords", "faces_vertices", "edges_vertices", "edges_length", "edges_foldAngle", "edges_assignment"];
    let known: Map<String, Value> = frame.into_iter().filter(|(key, _)| KEYS.contains(&key.as_str())).collect();
    // One after another, so that the key at fault is named.
    for (key, value) in &known {
        let alone: Map<String, Value> = [(key.clone(), value.clone())].into_iter().collect();
        serde_json::from_value::<Frame>(Value::Object(alone)).map_err(|error| {
            let place = if number == 0 { String::new() } else { format!(" of frame {number}") };
            let remedy = match key.as_str() {
                "vertices_coords" => "give two or three coordinates for each vertex",
                "faces_vertices" => "give a list of vertices for each face, which count from 0",
                "edges_vertices" => "give two vertices for each edge, which count from 0",
                "edges_assignment" => "give a letter such as \"M\" or \"V\" for each edge",
                _ => "give a number for each edge",
            };
            Problem::new(format!("`{key}`{place} is not what FOLD has there: {error}"), remedy)
        })?;
    }
    serde_json::from_value(Value::Object(known))
        .map_err(|error| Problem::new(format!("this is no FOLD file: {error}"), "export it again as FOLD"))
}

impl Frame {
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
