//! ParaView: a `.vtu` of each frame, with arrays as base64 behind it, which every reader takes, and the `.pvd` of all.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::layout::{Layout, Mark, Part, file_of_frame};
use super::subject::{Moment, Subject};

pub(super) struct Vtk<'a>(pub &'a Subject);

/// The number of triangles among the shapes of cells.
const TRIANGLE: u8 = 5;

impl Layout for Vtk<'_> {
    fn ending(&self) -> Option<&'static str> {
        Some("vtu")
    }

    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        let subject = self.0;
        let mut arrays = Arrays::default();
        let points =
            arrays.add("points", 3, "Float64", moment.positions.iter().flat_map(|p| p.to_array()), f64::to_le_bytes);
        let corners = subject.triangles.iter().flatten().map(|&v| i64::from(v));
        let mut cells = arrays.add("connectivity", 1, "Int64", corners, i64::to_le_bytes);
        let faces = subject.triangles.len();
        cells += &arrays.add("offsets", 1, "Int64", (1..=faces as i64).map(|f| 3 * f), i64::to_le_bytes);
        cells += &arrays.add("types", 1, "UInt8", vec![TRIANGLE; faces], u8::to_le_bytes);

        let normals = moment.normals.iter().flat_map(|normal| normal.to_array());
        let mut of_points = arrays.add("normal", 3, "Float32", normals, f32::to_le_bytes);
        let marked = |vertices: &mut dyn Iterator<Item = u32>| {
            let mut marks = vec![0_u8; subject.vertices];
            vertices.for_each(|v| marks[v as usize] = 1);
            marks
        };
        let marks = [
            ("rim", marked(&mut moment.rims.iter().flatten().copied())),
            ("boundary", marked(&mut subject.boundary.iter().flatten().copied())),
            ("pinned", marked(&mut subject.pins.iter().copied())),
        ];
        for (name, marks) in marks {
            of_points += &arrays.add(name, 1, "UInt8", marks, u8::to_le_bytes);
        }
        let file_vertex = subject.file_vertices.iter().map(|&v| i64::from(v));
        of_points += &arrays.add("file_vertex", 1, "Int64", file_vertex, i64::to_le_bytes);
        let mut component = vec![0_i32; faces];
        for (number, of) in (1..).zip(&subject.components) {
            of.iter().for_each(|&f| component[f as usize] = number);
        }
        let mut of_cells = arrays.add("component", 1, "Int32", component, i32::to_le_bytes);
        let file_face = subject.file_faces.iter().map(|&f| i64::from(f));
        of_cells += &arrays.add("file_face", 1, "Int64", file_face, i64::to_le_bytes);
        for (name, values) in &moment.fields {
            let of = if values.is_per_face() { &mut of_cells } else { &mut of_points };
            *of += &arrays.add(name.name(), 1, "Float32", values.all().iter().copied(), f32::to_le_bytes);
        }
        let (vertices, data) = (subject.vertices, arrays.data);
        let made_by = comment(&subject.made_by);
        let text = format!(
            "<?xml version=\"1.0\"?>\n<!-- {made_by}, frame {}, time {} -->\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <UnstructuredGrid>\n<Piece NumberOfPoints=\"{vertices}\" NumberOfCells=\"{faces}\">\n\
             <Points>\n{points}</Points>\n<Cells>\n{cells}</Cells>\n\
             <PointData Normals=\"normal\">\n{of_points}</PointData>\n<CellData>\n{of_cells}</CellData>\n\
             </Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"base64\">\n_{data}\n</AppendedData>\n</VTKFile>\n",
            moment.number, moment.time
        );
        Ok(vec![text.into_bytes()])
    }

    fn end(&self, frames: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for &Mark { number, time } in frames {
            let file = file_of_frame(number, "vtu");
            // Writing to a string does not fail.
            let _ = writeln!(text, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>");
        }
        text += "</Collection>\n</VTKFile>\n";
        vec![("film.pvd", vec![Part::Bytes(text.into_bytes())])]
    }
}

/// What may stand in a comment.
fn comment(text: &str) -> String {
    text.replace("--", "- -").replace(['<', '>'], " ")
}

/// Arrays one after another, each as the number of its bytes and the bytes themselves.
#[derive(Default)]
struct Arrays {
    data: String,
}

impl Arrays {
    /// Appends one, and gives the element that describes it.
    fn add<T, const N: usize>(
        &mut self,
        name: &str,
        components: usize,
        kind: &str,
        values: impl IntoIterator<Item = T>,
        bytes: fn(T) -> [u8; N],
    ) -> String {
        let values: Vec<u8> = values.into_iter().flat_map(bytes).collect();
        let offset = self.data.len();
        STANDARD.encode_string([&(values.len() as u64).to_le_bytes(), &*values].concat(), &mut self.data);
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{offset}\"/>\n"
        )
    }
}
