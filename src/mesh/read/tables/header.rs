//! Which column is which, by the names that people and programs write over them.

use crate::mesh::read::problem::Problem;

/// The columns that a table may have.
pub(super) enum Columns {
    /// The ends of an edge and its length.
    Edges,
    /// A vertex and a number in degrees.
    Vertices,
}

/// Names of the two ends of an edge.
const ENDS: [[&str; 2]; 18] = [
    ["u", "v"],
    ["i", "j"],
    ["a", "b"],
    ["p", "q"],
    ["from", "to"],
    ["v0", "v1"],
    ["v1", "v2"],
    ["i0", "i1"],
    ["i1", "i2"],
    ["vi", "vj"],
    ["vertex0", "vertex1"],
    ["vertex1", "vertex2"],
    ["node1", "node2"],
    ["start", "end"],
    ["source", "target"],
    ["src", "dst"],
    ["tail", "tip"],
    ["tail", "head"],
];
const LENGTHS: [&str; 7] = ["length", "l", "len", "lengths", "edgelength", "distance", "dist"];
const VERTICES: [&str; 7] = ["v", "vertex", "vertexid", "i", "id", "index", "node"];
const NUMBERS: [&str; 9] =
    ["number", "degrees", "degree", "deg", "curvature", "curvaturedegrees", "curvaturedeg", "angle", "value"];

impl Columns {
    /// Where the columns stand that are asked for, in the order in which they are named above.
    ///
    /// # Errors
    /// [`Problem`] for a header that names not all of them, or one of them twice: whoever guesses reads one column as
    /// another.
    pub fn places(&self, header: &[&str], line: usize) -> Result<Vec<usize>, Problem> {
        let words: Vec<String> = header.iter().map(|name| plain(name)).collect();
        let place = |name: &str| words.iter().position(|word| word == name);
        let any_of = |names: &[&str]| {
            let found: Vec<usize> = (0..words.len()).filter(|&k| names.contains(&words[k].as_str())).collect();
            if let [only] = *found { Some(only) } else { None }
        };
        let places = match self {
            Columns::Edges => {
                let pairs: Vec<[usize; 2]> = ENDS.iter().filter_map(|[a, b]| Some([place(a)?, place(b)?])).collect();
                match (&*pairs, any_of(&LENGTHS)) {
                    (&[[a, b]], Some(length)) => Some(vec![a, b, length]),
                    _ => None,
                }
            }
            Columns::Vertices => {
                if let Some(k) = words.iter().position(|word| word.contains("radian") || word == "rad") {
                    let reason = format!("column `{}` is in radians", header[k]);
                    return Err(Problem::at(line, reason, "write degrees, under the name degrees"));
                }
                any_of(&VERTICES).zip(any_of(&NUMBERS)).map(|(vertex, number)| vec![vertex, number])
            }
        };
        let is_repeated = |k: &usize| words.iter().filter(|word| **word == words[*k]).count() > 1;
        places.filter(|places| !places.iter().any(is_repeated)).ok_or_else(|| {
            let reason = format!("the header `{}` does not say which column is which", header.join(","));
            let remedy = match self {
                Columns::Edges => {
                    "name the columns u,v,length (or i,j,length; from,to,length), in any order, or remove the line"
                }
                Columns::Vertices => "name the columns v,degrees, in any order, or remove the line",
            };
            Problem::at(line, reason, remedy)
        })
    }
}

/// A name in small letters, without blanks, signs and the unit in parentheses behind it.
fn plain(name: &str) -> String {
    let name = name.split(['(', '[']).next().unwrap_or_default();
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
