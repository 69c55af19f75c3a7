//! Everything that keeps a list of triangles from being an oriented surface, found at once.

use super::error::{Fault, MeshError};
use super::union_find::root;

/// So many faults of a kind are listed; beyond that they are counted.
const LISTED: usize = 20;

/// The faults of a list of faces.
#[derive(Default)]
pub(super) struct Faults {
    pub listed: Vec<Fault>,
    /// Per kind, in the order of finding: its name, and the number of all faults of it.
    kinds: Vec<(&'static str, usize)>,
}

impl Faults {
    fn begin(&mut self, kind: &'static str) {
        self.kinds.push((kind, 0));
    }

    /// A fault of the kind that was begun last. `faces` are those to point at.
    fn add(&mut self, error: MeshError, faces: Vec<usize>) {
        if let Some((_, count)) = self.kinds.last_mut() {
            *count += 1;
            if *count <= LISTED {
                self.listed.push(Fault { error, faces, lines: Vec::new() });
            }
        }
    }

    fn are_none(&self) -> bool {
        self.listed.is_empty()
    }

    /// One fault is an error as it is.
    pub fn into_error(mut self) -> MeshError {
        if self.listed.len() == 1 {
            return self.listed.remove(0).error;
        }
        let count = self.kinds.iter().map(|(_, count)| count).sum();
        let unlisted = self.kinds.iter().filter(|(_, count)| *count > LISTED);
        let unlisted =
            unlisted.map(|(kind, count)| format!("{} more {kind}, {count} in all", count - LISTED)).collect();
        MeshError::Several { count, faults: self.listed, unlisted }
    }
}

/// Two faces with a common edge.
pub(super) struct Pair {
    pub faces: [usize; 2],
    pub edge: [u32; 2],
    /// Both run along the edge in the same direction, so one of them has to be reversed.
    pub clash: bool,
}

/// A surface that can be oriented.
pub(super) struct Orientable {
    /// Which faces to reverse, so that neighbours agree and most faces of a component stay.
    pub reversed: Vec<bool>,
    /// How many components have such faces.
    pub components: usize,
    /// All interior edges, sorted by their vertices.
    pub pairs: Vec<Pair>,
}

/// Checks everything about faces by sorting, in n log n. There must be few enough of them, see [`super::limits`].
pub(super) fn orient(vertex_count: usize, faces: &[[u32; 3]]) -> Result<Orientable, Faults> {
    let mut faults = Faults::default();
    // What cannot be looked at further, and whose corners are not judged.
    let mut out = vec![false; faces.len()];
    let mut unjudged = vec![false; vertex_count];
    faults.begin("faces with a vertex that does not exist");
    for (face, corners) in faces.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertex_count) {
            faults.add(MeshError::VertexOutOfRange { face, vertex: vertex.into(), vertex_count }, vec![face]);
            out[face] = true;
        }
    }
    faults.begin("faces with two equal corners");
    for (face, &corners) in faces.iter().enumerate().filter(|(face, _)| !out[*face]).collect::<Vec<_>>() {
        let [a, b, c] = corners;
        if a == b || b == c || c == a {
            faults.add(MeshError::DegenerateFace { face, corners }, vec![face]);
            out[face] = true;
        }
    }
    let in_range = |&&v: &&u32| (v as usize) < vertex_count;
    let lost = faces.iter().zip(&out).filter(|(_, out)| **out).flat_map(|(corners, _)| corners.iter().filter(in_range));
    lost.for_each(|&v| unjudged[v as usize] = true);

    duplicates(faces, &mut out, &mut faults);
    let pairs = adjacent_faces(faces, &out, &mut unjudged, &mut faults);
    fans(faces, &out, &unjudged, &pairs, &mut faults);
    let (reversed, components) = orientation(faces.len(), &pairs, &mut faults);
    if faults.are_none() { Ok(Orientable { reversed, components, pairs }) } else { Err(faults) }
}

/// Takes out all faces but the first of those with the same corners in any order.
fn duplicates(faces: &[[u32; 3]], out: &mut [bool], faults: &mut Faults) {
    faults.begin("faces with the corners of another");
    let key = |(f, corners): (usize, &[u32; 3])| {
        let mut key = *corners;
        key.sort_unstable();
        (key, f)
    };
    let mut sorted: Vec<([u32; 3], usize)> = faces.iter().enumerate().filter(|(f, _)| !out[*f]).map(key).collect();
    sorted.sort_unstable();
    let mut twice: Vec<[usize; 2]> = Vec::new();
    for group in sorted.chunk_by(|a, b| a.0 == b.0) {
        twice.extend(group[1..].iter().map(|(_, again)| [group[0].1, *again]));
    }
    twice.sort_unstable_by_key(|[_, again]| *again);
    for faces in twice {
        faults.add(MeshError::DuplicateFace { faces }, faces.to_vec());
        out[faces[1]] = true;
    }
}

/// All interior edges, sorted by their vertices. Ends of edges with more than two faces become unjudged.
fn adjacent_faces(faces: &[[u32; 3]], out: &[bool], unjudged: &mut [bool], faults: &mut Faults) -> Vec<Pair> {
    faults.begin("edges with more than two faces");
    let mut sides: Vec<([u32; 2], usize, bool)> = Vec::with_capacity(3 * faces.len());
    for (f, corners) in faces.iter().enumerate().filter(|(f, _)| !out[*f]) {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push(([a.min(b), a.max(b)], f, a < b));
        }
    }
    sides.sort_unstable();
    let mut pairs = Vec::with_capacity(sides.len() / 2);
    let mut crowded = Vec::new();
    for group in sides.chunk_by(|s, t| s.0 == t.0) {
        match *group {
            [_] => {}
            [(edge, f, up), (_, g, also_up)] => pairs.push(Pair { faces: [f, g], edge, clash: up == also_up }),
            _ => {
                group[0].0.iter().for_each(|&v| unjudged[v as usize] = true);
                crowded.push((group[0].0, group.iter().map(|side| side.1).collect::<Vec<_>>()));
            }
        }
    }
    crowded.sort_unstable_by(|a, b| a.1.cmp(&b.1));
    for (edge, faces) in crowded {
        faults.add(MeshError::NonManifoldEdge { edge, faces: faces.clone() }, faces);
    }
    pairs
}

/// Reports vertices whose faces hang together in more than one fan.
fn fans(faces: &[[u32; 3]], out: &[bool], unjudged: &[bool], pairs: &[Pair], faults: &mut Faults) {
    faults.begin("vertices with more than one fan of faces");
    // Corners hang together across edges.
    let mut parents: Vec<u32> = (0..3 * faces.len() as u32).collect();
    for pair in pairs {
        for v in pair.edge {
            let [a, b] = pair.faces.map(|f| faces[f].iter().position(|&w| w == v).map(|k| (3 * f + k) as u32));
            if let (Some(a), Some(b)) = (a, b) {
                let (a, b) = (root(&mut parents, a), root(&mut parents, b));
                parents[a.max(b) as usize] = a.min(b);
            }
        }
    }
    // A fan is named by the first of its corners.
    let mut first: Vec<Option<u32>> = vec![None; unjudged.len()];
    let mut more: Vec<(u32, usize)> = Vec::new();
    for (f, corners) in faces.iter().enumerate().filter(|(f, _)| !out[*f]) {
        for (k, &v) in corners.iter().enumerate().filter(|(_, v)| !unjudged[**v as usize]) {
            let fan = root(&mut parents, (3 * f + k) as u32);
            match first[v as usize] {
                None => first[v as usize] = Some(fan),
                Some(known) if known != fan && fan == (3 * f + k) as u32 => more.push((v, f)),
                Some(_) => {}
            }
        }
    }
    more.sort_unstable();
    for group in more.chunk_by(|a, b| a.0 == b.0) {
        let vertex = group[0].0 as usize;
        let first = first[vertex].map(|corner| corner as usize / 3);
        let faces = first.into_iter().chain(group.iter().map(|(_, f)| *f)).collect();
        faults.add(MeshError::NonManifoldVertex { vertex }, faces);
    }
}

/// Which faces to reverse, and in how many components there are any.
fn orientation(face_count: usize, pairs: &[Pair], faults: &mut Faults) -> (Vec<bool>, usize) {
    faults.begin("components that cannot be oriented");
    let mut neighbours: Vec<[u32; 3]> = vec![[u32::MAX; 3]; face_count];
    for (p, pair) in pairs.iter().enumerate() {
        for f in pair.faces {
            if let Some(slot) = neighbours[f].iter_mut().find(|slot| **slot == u32::MAX) {
                *slot = p as u32;
            }
        }
    }
    let mut reversed: Vec<Option<bool>> = vec![None; face_count];
    let mut changed = 0;
    for seed in 0..face_count {
        if reversed[seed].is_some() {
            continue;
        }
        reversed[seed] = Some(false);
        let mut component = vec![(seed, false)];
        let mut conflict = None;
        let mut next = 0;
        while let Some(&(f, reverse)) = component.get(next) {
            next += 1;
            for pair in neighbours[f].iter().filter(|p| **p != u32::MAX).map(|&p| &pairs[p as usize]) {
                let g = if pair.faces[0] == f { pair.faces[1] } else { pair.faces[0] };
                let wanted = reverse ^ pair.clash;
                match reversed[g] {
                    None => {
                        reversed[g] = Some(wanted);
                        component.push((g, wanted));
                    }
                    Some(found) if found != wanted => {
                        conflict = conflict.or(Some((pair.edge, [f, g])));
                    }
                    Some(_) => {}
                }
            }
        }
        if let Some((edge, faces)) = conflict {
            faults.add(MeshError::NonOrientable { edge, faces }, faces.to_vec());
        }
        let minority = component.iter().filter(|f| f.1).count();
        let invert = 2 * minority > component.len();
        for (f, reverse) in &component {
            reversed[*f] = Some(reverse ^ invert);
        }
        changed += usize::from(minority > 0 && minority < component.len());
    }
    (reversed.into_iter().map(|r| r == Some(true)).collect(), changed)
}
