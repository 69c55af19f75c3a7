//! NumPy's `.npy` and `.npz`: faces, and what else is known, as arrays with names.

use glam::DVec3;

use crate::mesh::read::edges::{EdgeNumbers, Listed};
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::npy::{Archive, Array, Fault, Numbers, is_archive, is_array};

/// Names of the corners of faces.
const FACES: [&str; 3] = ["faces", "triangles", "F"];
/// Names of positions of vertices.
const POSITIONS: [&str; 3] = ["positions", "vertices", "V"];
/// Lengths: rows or halfedges by their number, rows, halfedges.
const LENGTHS: [&str; 3] = ["lengths", "edge_lengths", "halfedge_lengths"];
/// What a film has beside these.
const OF_FILMS: [&str; 10] =
    ["edges", "places", "file_vertex", "file_face", "pinned", "lattice", "format", "frame", "time", "face_frames"];
const MORE_OF_FILMS: [&str; 2] = ["transport", "rims"];

/// What an archive says, as far as it is known here. Faces and ends of edges count vertices from 0.
#[derive(Default)]
pub(in crate::mesh::read) struct Arrays {
    /// Corners, and the name of the array.
    pub faces: Option<(Vec<[u32; 3]>, &'static str)>,
    pub positions: Option<Vec<DVec3>>,
    /// Of a film: what x, y and z mean, which may be no positions.
    pub places: Option<Vec<DVec3>>,
    pub lengths: Option<LengthArray>,
    /// Whether it is the frame of a film.
    pub is_frame: bool,
    /// Names that mean nothing here.
    pub unread: Vec<String>,
}

/// Lengths, by what tells whose they are.
pub(in crate::mesh::read) enum LengthArray {
    /// With the ends of their edges.
    OfEdges(EdgeNumbers),
    /// One for each edge, in an order that is not said.
    InOrder(Vec<f64>),
}

impl From<Fault> for Problem {
    fn from(Fault { reason, remedy }: Fault) -> Problem {
        Problem::new(reason, remedy)
    }
}

/// The mesh of an archive.
pub(in crate::mesh::read) fn parse_npz(bytes: &[u8]) -> Result<Soup, Problem> {
    let Arrays { faces, positions, places, lengths, is_frame, unread } = Arrays::read(bytes)?;
    let Some((faces, name)) = faces else {
        let remedy = match is_frame {
            true => "name the film's mesh.npz under [mesh], and the frame under [metric] or [start]",
            false => "add an array `faces`, n x 3, of the corners of triangles, which count from 0",
        };
        return Err(Problem::new("there is no array `faces`", remedy));
    };
    let lengths = match lengths {
        Some(LengthArray::InOrder(_)) => {
            let reason = "`edge_lengths` has one column, and nothing says which edges these are";
            return Err(Problem::new(reason, "add `edges`, two columns with their ends, or give columns u, v, length"));
        }
        Some(LengthArray::OfEdges(lengths)) => Some(lengths),
        None => None,
    };
    let count = positions.as_ref().or(places.as_ref()).map(Vec::len);
    let mut soup = soup_of(faces, name, count)?;
    if !unread.is_empty() {
        soup.notes.push(format!("left out the arrays {}", unread.join(", ")));
    }
    Ok(Soup { positions, coordinates: places, lengths, ..soup })
}

/// The mesh of an array of faces.
pub(in crate::mesh::read) fn parse_npy(bytes: &[u8]) -> Result<Soup, Problem> {
    soup_of(corners("the array", Array::parse(bytes)?)?, "the array", None)
}

/// Rows u, v, length in an array that stands alone, or one length for each edge.
pub(in crate::mesh::read) fn parse_length_array(bytes: &[u8]) -> Result<LengthArray, Problem> {
    let array = Array::parse(bytes)?;
    match *array.shape {
        [_] => Ok(LengthArray::InOrder(array.numbers.into_real())),
        _ => rows("the array", array).map(LengthArray::OfEdges),
    }
}

fn soup_of(faces: Vec<[u32; 3]>, name: &str, count: Option<usize>) -> Result<Soup, Problem> {
    let named = faces.iter().flatten().copied();
    let (least, most) = named.fold((u32::MAX, 0), |(least, most), v| (least.min(v), most.max(v)));
    if least > 0 && !faces.is_empty() {
        let reason = format!("{name} names vertices from {least} on, and they count from 0");
        return Err(Problem::new(reason, format!("subtract {least} from all of them, or remove unused vertices")));
    }
    let needed = most as usize + 1;
    if count.is_none() && needed > 3 * faces.len() {
        let reason = format!("{name} names vertex {most}, but {} triangles have fewer corners", faces.len());
        return Err(Problem::new(reason, "number the vertices from 0 without gaps, or add `positions`"));
    }
    Ok(Soup { vertex_count: count.unwrap_or(needed), triangles: faces, ..Soup::default() })
}

impl Arrays {
    /// # Errors
    /// [`Problem`] for arrays of another shape or type than their names say, and for names that may mean lengths.
    pub fn read(bytes: &[u8]) -> Result<Arrays, Problem> {
        if is_array(bytes) {
            return Err(Problem::new("this is a single array, not an archive of several", "let its name end in .npy"));
        }
        if !is_archive(bytes) {
            return Err(Problem::new("this is no npz archive", "write it with numpy.savez"));
        }
        let mut archive = Archive::new(bytes)?;
        let names = archive.names();
        let mut one_of = |known: &[&'static str]| -> Result<Option<(&'static str, Array)>, Problem> {
            let found: Vec<&'static str> =
                known.iter().copied().filter(|name| names.iter().any(|given| given == name)).collect();
            match *found {
                [] => Ok(None),
                [name] => Ok(archive.array(name)?.map(|array| (name, array))),
                [a, b, ..] => {
                    let reason = format!("there are both `{a}` and `{b}`, and only one is read");
                    Err(Problem::new(reason, "leave one of them out"))
                }
            }
        };
        let faces = one_of(&FACES)?;
        let faces = faces.map(|(name, array)| Ok::<_, Problem>((corners(name, array)?, name))).transpose()?;
        let positions = one_of(&POSITIONS)?.map(|(name, array)| points(name, array)).transpose()?;
        let places = one_of(&["places"])?.map(|(name, array)| points(name, array)).transpose()?;
        let lengths = match one_of(&LENGTHS)? {
            None => None,
            Some((name, array)) => {
                let edges = if array.shape.len() == 1 { one_of(&["edges"])? } else { None };
                Some(lengths(name, array, faces.as_ref().map(|(faces, _)| faces.as_slice()), edges)?)
            }
        };
        let is_frame = ["face_frames", "transport"].iter().all(|name| names.iter().any(|given| given == name));
        let known = [&FACES[..], &POSITIONS, &LENGTHS, &OF_FILMS, &MORE_OF_FILMS].concat();
        let unread: Vec<String> = names.into_iter().filter(|name| !known.contains(&name.as_str())).collect();
        if let Some(name) = unread.iter().find(|name| name.to_lowercase().contains("length") && lengths.is_none()) {
            let reason = format!("array `{name}` is not known, and may be meant as lengths");
            return Err(Problem::new(reason, "call it edge_lengths (rows u, v, length) or halfedge_lengths (n x 3)"));
        }
        Ok(Arrays { faces, positions, places, lengths, is_frame, unread })
    }
}

fn shape(name: &str, array: &Array, wanted: &str, remedy: &str) -> Problem {
    let sides: Vec<String> = array.shape.iter().map(usize::to_string).collect();
    let sides = if sides.is_empty() { "a single number".to_owned() } else { sides.join(" x ") };
    Problem::new(format!("{name} is {sides}, it must be {wanted}"), remedy)
}

/// Corners of triangles.
fn corners(name: &str, array: Array) -> Result<Vec<[u32; 3]>, Problem> {
    let &[_, columns] = array.shape.as_slice() else {
        return Err(shape(name, &array, "n x 3", "save one row for each triangle"));
    };
    let Numbers::Whole(numbers) = &array.numbers else {
        return Err(Problem::new(format!("{name} has fractions"), "save integers, as with faces.astype(int)"));
    };
    if columns != 3 {
        let is_counted = columns == 4 && numbers.chunks_exact(4).all(|row| row[0] == 3);
        let remedy = match columns {
            4 if is_counted => "leave out the first column, which counts corners: faces[:, 1:]",
            4 => "cut quadrilaterals into triangles: numpy.vstack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])",
            _ => "save one row of three corners for each triangle",
        };
        return Err(shape(name, &array, "n x 3", remedy));
    }
    let face = |(f, row): (usize, &[i64])| {
        let corner = |k: usize| {
            u32::try_from(row[k]).map_err(|_| {
                let reason = format!("{name} has {} in row {f}, which is no vertex", row[k]);
                Problem::new(reason, "vertices count from 0; leave out rows that are padded with -1")
            })
        };
        Ok([corner(0)?, corner(1)?, corner(2)?])
    };
    numbers.chunks_exact(3).enumerate().map(face).collect()
}

/// Points in space.
fn points(name: &str, array: Array) -> Result<Vec<DVec3>, Problem> {
    let &[_, 3] = array.shape.as_slice() else {
        return Err(shape(name, &array, "n x 3", "save x, y and z of each vertex; z may be 0"));
    };
    let numbers = array.numbers.into_real();
    let points: Vec<DVec3> = numbers.as_chunks().0.iter().map(|&p| DVec3::from_array(p)).collect();
    match points.iter().position(|p| !p.is_finite()) {
        Some(v) => {
            let reason = format!("{name} has {} in row {v}, which is not finite", points[v]);
            Err(Problem::new(reason, "every coordinate must be finite"))
        }
        None => Ok(points),
    }
}

/// Lengths of an archive: by rows, halfedges, or beside the ends of their edges.
fn lengths(
    name: &'static str,
    array: Array,
    faces: Option<&[[u32; 3]]>,
    edges: Option<(&'static str, Array)>,
) -> Result<LengthArray, Problem> {
    if array.shape.len() == 1 {
        if name == "halfedge_lengths" {
            return Err(shape(name, &array, "n x 3", "save one row for each face"));
        }
        let count = array.shape[0];
        let values = array.numbers.into_real();
        let Some((_, edges)) = edges else { return Ok(LengthArray::InOrder(values)) };
        if edges.shape != [count, 2] {
            let wanted = format!("{count} x 2, the ends of the edges in {name}");
            return Err(shape("edges", &edges, &wanted, "save both in the same order"));
        }
        let ends = pairs("edges", &edges.numbers.into_real(), 2)?;
        let values = values.into_iter().map(Some).collect();
        return Ok(LengthArray::OfEdges(EdgeNumbers { what: "length", listed: Listed::Rows, ends, values }));
    }
    // A mesh has more edges than faces, so that the number of rows tells what they are.
    let is_by_face = match name {
        "lengths" => faces.is_some_and(|faces| array.shape.first() == Some(&faces.len())),
        name => name == "halfedge_lengths",
    };
    if !is_by_face {
        return rows(name, array).map(LengthArray::OfEdges);
    }
    let Some(faces) = faces else {
        let remedy = "add `faces`, whose halfedges they are, or give rows u, v, length as edge_lengths";
        return Err(Problem::new("there are `halfedge_lengths` and no `faces`", remedy));
    };
    if array.shape != [faces.len(), 3] {
        return Err(shape(name, &array, &format!("{} x 3", faces.len()), "save one row for each face"));
    }
    let ends = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let values = array.numbers.into_real().into_iter().map(Some).collect();
    Ok(LengthArray::OfEdges(EdgeNumbers { what: "length", listed: Listed::Halfedges, ends, values }))
}

/// Rows u, v, length.
fn rows(name: &str, array: Array) -> Result<EdgeNumbers, Problem> {
    let &[_, 3] = array.shape.as_slice() else {
        return Err(shape(name, &array, "m x 3", "save columns u, v and length, a row for each edge"));
    };
    let numbers = array.numbers.into_real();
    let ends = pairs(name, &numbers, 3)?;
    let values = numbers.chunks_exact(3).map(|row| Some(row[2])).collect();
    Ok(EdgeNumbers { what: "length", listed: Listed::Rows, ends, values })
}

/// The first two columns of rows, which are vertices.
fn pairs(name: &str, numbers: &[f64], columns: usize) -> Result<Vec<[u32; 2]>, Problem> {
    let pair = |(k, row): (usize, &[f64])| {
        let end = |x: f64| {
            if x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&x) {
                return Ok(x as u32);
            }
            let reason = format!("{name} has {x} in row {k}, which is no vertex");
            let remedy = "the first two columns are vertices, which count from 0; lengths of the sides of faces are \
                          halfedge_lengths";
            Err(Problem::new(reason, remedy))
        };
        Ok([end(row[0])?, end(row[1])?])
    };
    numbers.chunks_exact(columns).enumerate().map(pair).collect()
}
