//! The frames of a FOLD file: the key frame at its top, number 0, and those in `file_frames`, each of which may inherit from
//! another one what it does not say itself.

use std::collections::HashMap;

use serde::de::DeserializeOwned;
use serde_json::value::RawValue;

use crate::mesh::read::problem::Problem;

/// What is read of a frame, as the text of each value.
#[derive(Clone, Copy, Default)]
pub(super) struct Frame<'a> {
    pub vertices_coords: Entry<'a>,
    pub faces_vertices: Entry<'a>,
    pub edges_vertices: Entry<'a>,
    pub edges_length: Entry<'a>,
    pub edges_fold_angle: Entry<'a>,
    pub edges_assignment: Entry<'a>,
    pub unit: Entry<'a>,
}

/// The value of a key, if it is there.
#[derive(Clone, Copy, Default)]
pub(super) struct Entry<'a>(Option<&'a RawValue>);

impl<'a> Entry<'a> {
    pub fn is_there(self) -> bool {
        self.0.is_some()
    }

    /// The value as what FOLD has there.
    pub fn read<T: DeserializeOwned>(self, key: &str, remedy: &str) -> Result<Option<T>, Problem> {
        let Some(raw) = self.0 else { return Ok(None) };
        serde_json::from_str(raw.get()).map(Some).map_err(|error| {
            Problem::new(format!("`{key}` is not what FOLD has there: {}", without_place(&error)), remedy)
        })
    }

    fn or(self, inherited: Entry<'a>) -> Entry<'a> {
        Entry(self.0.or(inherited.0))
    }
}

/// What is wrong, without line and column.
fn without_place(error: &serde_json::Error) -> String {
    let reason = error.to_string();
    reason.rsplit_once(" at line ").map_or(reason.as_str(), |(reason, _)| reason).to_owned()
}

type Keys<'a> = HashMap<String, &'a RawValue>;

/// All frames of a file, by their numbers.
pub(super) fn frames(text: &str) -> Result<Vec<Frame<'_>>, Problem> {
    let no_json = |error: serde_json::Error| {
        Problem::at(error.line(), format!("this is not JSON: {}", without_place(&error)), "export it again as FOLD")
    };
    let whole: &RawValue = serde_json::from_str(text).map_err(no_json)?;
    let Ok(mut top) = serde_json::from_str::<Keys>(whole.get()) else {
        return Err(Problem::new("this is JSON, but no FOLD file: it is no object", "export it again as FOLD"));
    };
    let more = match top.remove("file_frames") {
        None => Vec::new(),
        Some(list) => serde_json::from_str::<Option<Vec<&RawValue>>>(list.get())
            .map_err(|_| Problem::new("`file_frames` is no list", "export it again as FOLD"))?
            .unwrap_or_default(),
    };
    let (mut own, mut parents) = (vec![own(&mut top)], vec![None]);
    for (k, text) in more.into_iter().enumerate() {
        let number = k + 1;
        let Ok(mut keys) = serde_json::from_str::<Keys>(text.get()) else {
            return Err(Problem::new("it is no object", "export it again as FOLD").of_frame(number));
        };
        parents.push(parent(&mut keys).map_err(|problem| problem.of_frame(number))?);
        own.push(self::own(&mut keys));
    }
    inherited(own, &parents)
}

fn own<'a>(keys: &mut Keys<'a>) -> Frame<'a> {
    // A value that is null is none.
    let mut entry = |key| Entry(keys.remove(key).filter(|value| value.get() != "null"));
    Frame {
        vertices_coords: entry("vertices_coords"),
        faces_vertices: entry("faces_vertices"),
        edges_vertices: entry("edges_vertices"),
        edges_length: entry("edges_length"),
        edges_fold_angle: entry("edges_foldAngle"),
        edges_assignment: entry("edges_assignment"),
        unit: entry("frame_unit"),
    }
}

/// The number of the frame that one inherits from.
fn parent(keys: &mut Keys) -> Result<Option<usize>, Problem> {
    let mut entry = |key| Entry(keys.remove(key));
    let inherits: Option<Option<bool>> = entry("frame_inherit").read("frame_inherit", "write true or false")?;
    let parent: Option<Option<usize>> = entry("frame_parent").read("frame_parent", "give the number of a frame")?;
    Ok((inherits.flatten() == Some(true)).then_some(parent.flatten().unwrap_or(0)))
}

/// Each frame with what it does not say itself from its parent, and so on.
fn inherited<'a>(mut frames: Vec<Frame<'a>>, parents: &[Option<usize>]) -> Result<Vec<Frame<'a>>, Problem> {
    // In chains from those that inherit from nobody, or from one that is whole.
    let mut is_whole: Vec<bool> = parents.iter().map(Option::is_none).collect();
    let mut is_waiting = vec![false; frames.len()];
    for number in 0..frames.len() {
        let (mut chain, mut at) = (Vec::new(), number);
        while let Some(parent) = parents[at].filter(|_| !is_whole[at]) {
            let wrong = match is_waiting.get(parent) {
                None => Some(format!("it inherits from frame {parent}, which is not there")),
                _ if parent == at || is_waiting[parent] => Some("it inherits from itself".to_owned()),
                Some(_) => None,
            };
            if let Some(reason) = wrong {
                return Err(Problem::new(reason, "correct `frame_parent`").of_frame(at));
            }
            is_waiting[at] = true;
            chain.push((at, parent));
            at = parent;
        }
        for (at, parent) in chain.into_iter().rev() {
            let (own, from) = (frames[at], frames[parent]);
            frames[at] = Frame {
                vertices_coords: own.vertices_coords.or(from.vertices_coords),
                faces_vertices: own.faces_vertices.or(from.faces_vertices),
                edges_vertices: own.edges_vertices.or(from.edges_vertices),
                edges_length: own.edges_length.or(from.edges_length),
                edges_fold_angle: own.edges_fold_angle.or(from.edges_fold_angle),
                edges_assignment: own.edges_assignment.or(from.edges_assignment),
                unit: own.unit.or(from.unit),
            };
            (is_whole[at], is_waiting[at]) = (true, false);
        }
    }
    Ok(frames)
}
