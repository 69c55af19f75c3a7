//! glTF 2.0 in one binary file: the first frame, morph targets that lead from it to each other one, and an animation that
//! goes from target to target.

use glam::Vec3;
use serde_json::{Value, json};

use super::layout::{Layout, Mark, Part};
use super::subject::{Moment, Subject};
use crate::render::smooth_normals;

/// Of a subject, with its first frame.
pub(super) struct Gltf<'a> {
    subject: &'a Subject,
    points: Vec<Vec3>,
    normals: Vec<Vec3>,
}

/// Viewers hold all targets in memory.
pub(super) const MOST_FRAMES: usize = 60;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
/// What views of the buffer are for.
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
/// Bytes of a point.
const POINT: usize = 12;

impl<'a> Gltf<'a> {
    pub fn of(subject: &'a Subject) -> Gltf<'a> {
        let points = subject.first.iter().map(|place| place.as_vec3()).collect();
        Gltf { subject, points, normals: smooth_normals(&subject.triangles, &subject.first) }
    }

    /// The description of an array of points, which readers want to know the box of.
    fn accessor(&self, view: usize, offset: usize, points: Option<&[Vec3]>) -> Value {
        let mut accessor = json!({
            "bufferView": view, "byteOffset": offset, "componentType": FLOAT, "count": self.subject.vertices, "type": "VEC3",
        });
        if let Some(points) = points {
            let low = points.iter().copied().fold(Vec3::INFINITY, Vec3::min);
            let high = points.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
            accessor["min"] = json!(low.to_array());
            accessor["max"] = json!(high.to_array());
        }
        accessor
    }

    /// Colours of vertices; where faces have them, the mean of those around.
    fn vertex_colors(&self, moment: &Moment) -> Option<Vec<Vec3>> {
        let painted = moment.colors.as_ref()?;
        if !painted.per_face {
            return Some(painted.colors.clone());
        }
        let mut sums = vec![(Vec3::ZERO, 0.0_f32); self.subject.vertices];
        for (corners, &color) in self.subject.triangles.iter().zip(&painted.colors) {
            for &v in corners {
                let (sum, count) = &mut sums[v as usize];
                *sum += color;
                *count += 1.0;
            }
        }
        Some(sums.into_iter().map(|(sum, count)| sum / count.max(1.0)).collect())
    }
}

impl Layout for Gltf<'_> {
    /// Three parts: what stands in the buffer of the first frame, of the others, and their descriptions.
    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        let place = moment.place;
        let bytes =
            |points: &[Vec3]| points.iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
        if place == 0 {
            let corners = self.subject.triangles.iter().flatten().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
            let colors = self.vertex_colors(moment).map(|colors| bytes(&colors)).unwrap_or_default();
            return Ok(vec![[corners, bytes(&self.points), bytes(&self.normals), colors].concat(), vec![], vec![]]);
        }
        let moved: Vec<Vec3> =
            moment.positions.iter().zip(&self.points).map(|(to, from)| to.as_vec3() - from).collect();
        let turned: Vec<Vec3> = moment.normals.iter().zip(&self.normals).map(|(to, from)| *to - *from).collect();
        let offset = 2 * (place - 1) * POINT * self.subject.vertices;
        let moves = self.accessor(MORPHS, offset, Some(&moved));
        let turns = self.accessor(MORPHS, offset + POINT * self.subject.vertices, None);
        let text = format!(",{moves},{turns}").into_bytes();
        Ok(vec![vec![], [bytes(&moved), bytes(&turned)].concat(), text])
    }

    fn end(&self, frames: &[Mark], pieces: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        let Subject { vertices, triangles, colors, name, made_by, frame_rate, .. } = self.subject;
        let targets = frames.len().saturating_sub(1);
        let [corners, points] = [3 * 4 * triangles.len(), POINT * vertices];
        // Nothing has been written yet where only names are asked for.
        let base = pieces.first().map_or(corners, |written| *written as usize);
        let has_colors = base > corners + 2 * points;
        let morphs = pieces.get(1).copied().unwrap_or(0) as usize;
        // When each frame is seen, and how much of each target then.
        let times: Vec<f32> = (0..frames.len()).map(|k| (k as f64 / frame_rate) as f32).collect();
        let weights = (0..frames.len()).flat_map(|k| (1..=targets).map(move |target| f32::from(u8::from(k == target))));
        let moving: Vec<u8> = match targets {
            0 => Vec::new(),
            _ => times.iter().copied().chain(weights).flat_map(f32::to_le_bytes).collect(),
        };
        let length = base + morphs + moving.len();

        let mut accessors = vec![
            json!({"bufferView": 0, "componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR"}),
            self.accessor(1, 0, Some(&self.points)),
            self.accessor(1, points, None),
            json!({"bufferView": 3, "componentType": FLOAT, "count": frames.len(), "type": "SCALAR",
                   "min": [0.0], "max": [times.last().copied().unwrap_or(0.0)]}),
            json!({"bufferView": 3, "byteOffset": 4 * times.len(), "componentType": FLOAT, "count": frames.len() * targets,
                   "type": "SCALAR"}),
        ];
        let mut attributes = json!({"POSITION": 1, "NORMAL": 2});
        if has_colors {
            attributes["COLOR_0"] = accessors.len().into();
            accessors.push(self.accessor(1, 2 * points, None));
        }
        let first = accessors.len();
        let mut primitive = json!({"attributes": attributes, "indices": 0, "material": 0});
        let mut views = vec![
            json!({"buffer": 0, "byteOffset": 0, "byteLength": corners, "target": INDICES}),
            json!({"buffer": 0, "byteOffset": corners, "byteLength": base - corners, "byteStride": POINT, "target": VERTICES}),
        ];
        let mut document = json!({
            "asset": {"version": "2.0", "generator": made_by},
            "scene": 0,
            "scenes": [{"nodes": [0], "name": name}],
            "nodes": [{"mesh": 0, "name": name}],
            "materials": [{
                "doubleSided": true,
                "pbrMetallicRoughness": {
                    "baseColorFactor": if has_colors { [1.0; 4] } else { colors.sides[0].extend(1.0).to_array() },
                    "metallicFactor": 0.0, "roughnessFactor": 0.6,
                },
            }],
            "buffers": [{"byteLength": length}],
        });
        if targets > 0 {
            let of = |k: usize| json!({"POSITION": first + 2 * k, "NORMAL": first + 2 * k + 1});
            primitive["targets"] = (0..targets).map(of).collect();
            views.push(
                json!({"buffer": 0, "byteOffset": base, "byteLength": morphs, "byteStride": POINT, "target": VERTICES}),
            );
            views.push(json!({"buffer": 0, "byteOffset": base + morphs, "byteLength": moving.len()}));
            document["animations"] = json!([{
                "name": name,
                "samplers": [{"input": 3, "output": 4, "interpolation": "LINEAR"}],
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
            }]);
        } else {
            accessors.drain(3..5);
            if has_colors {
                primitive["attributes"]["COLOR_0"] = 3.into();
            }
        }
        document["bufferViews"] = views.into();
        document["meshes"] = json!([{"primitives": [primitive], "name": name, "weights": vec![0.0; targets]}]);
        if targets == 0
            && let Some(mesh) = document["meshes"][0].as_object_mut()
        {
            mesh.remove("weights");
        }
        // The descriptions of targets are pieces, so accessors come last.
        let mut text = document.to_string();
        text.pop();
        text += ",\"accessors\":[";
        text += &accessors.iter().map(Value::to_string).collect::<Vec<_>>().join(",");
        let described = pieces.get(2).copied().unwrap_or(0) as usize;
        let json_length = (text.len() + described + "]}".len()).next_multiple_of(4);
        let padding = json_length - text.len() - described - "]}".len();
        let tail = format!("]}}{}", " ".repeat(padding));

        let chunk = |length: usize, kind: &[u8; 4]| [&(length as u32).to_le_bytes()[..], kind].concat();
        // Everything in the buffer is a multiple of four bytes.
        let all = 12 + 8 + json_length + 8 + length;
        let head = [b"glTF".to_vec(), 2_u32.to_le_bytes().to_vec(), (all as u32).to_le_bytes().to_vec()].concat();
        vec![(
            "film.glb",
            vec![
                Part::Bytes([head, chunk(json_length, b"JSON"), text.into_bytes()].concat()),
                Part::Pieces(2),
                Part::Bytes([tail.into_bytes(), chunk(length, b"BIN\0")].concat()),
                Part::Pieces(0),
                Part::Pieces(1),
                Part::Bytes(moving),
            ],
        )]
    }
}

/// The view of the buffer in which targets are.
const MORPHS: usize = 2;
