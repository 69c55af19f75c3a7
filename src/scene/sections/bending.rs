//! `[bending]` and its regions.

use super::selection::optional_selection;
use crate::mesh::EdgeSelection;
use crate::scene::data::{BendingFrom, BendingRegionSection, BendingSection, NumberSection};
use crate::scene::keys::{Table, files};

/// Target angles, if it says any, and the stiffness of bending.
pub(super) fn bending(table: &mut Table) -> (Option<BendingSection>, Option<f64>) {
    let stiffness = table
        .key(
            "bending_stiffness",
            "The weight of bending, epsilon[1], in the last phase and in all frames of a film; in no phase is it less. Left \
             out, it is 0.0001. With more, surfaces are smoother, come closer to target bending angles, and keep lengths \
             less well.",
        )
        .at_least(0.0)
        .optional(0.001);
    let from = table.choice(
        "from",
        "The target angles: those of the mesh (the fold angles of its FOLD file, else those of its positions), of its mirror \
         image, or of what the relaxation starts from.",
        &[("mesh", BendingFrom::Mesh), ("mirror", BendingFrom::Mirror), ("start", BendingFrom::Start)],
    );
    let file = table
        .key::<String>("file", "Angles of another mesh with the same connectivity, or the fold angles of a FOLD file.")
        .optional("bent.obj".into());
    let doc = "Angles of several meshes with the same connectivity, one after another: a list, or a pattern of names with * \
               and ?, in the order of the numbers in them. Of a FOLD file every frame is one.";
    let files = files(table, doc);
    table.only_one_of(&["from", "file", "files"]);
    let section = BendingSection {
        from: file.map(|file| BendingFrom::File(file.into())).or(files.map(BendingFrom::Files)).or(from),
        amount: table
            .key("amount", "What the angles are multiplied with: 1 that shape, 0 flat, -1 its mirror image.")
            .or(NumberSection::Constant(1.0)),
        regions: table.tables("region", "Edges with a constant angle of their own.", bending_region),
    };
    let says_no_angles = table.has_none_of(&["from", "file", "files", "region"]);
    if says_no_angles && (stiffness.is_none() || table.has("amount")) {
        table.complain(
            "from",
            "[bending] says no angles",
            "add from = \"mesh\", from = \"mirror\" or a [[bending.region]]",
        );
    }
    ((!says_no_angles).then_some(section), stiffness)
}

fn bending_region(table: &mut Table) -> BendingRegionSection {
    let edges = table
        .key::<Vec<[usize; 2]>>("edges", "Edges by the numbers of their ends in the mesh file.")
        .optional(vec![[0, 1]]);
    let vertices = optional_selection(table);
    table.only_one_of(&["edges", "vertices", "boundary", "box", "ball", "nearest"]);
    let edges = edges.map(EdgeSelection::Edges).or(vertices.map(EdgeSelection::Between));
    if edges.is_none() && table.is_given() {
        let reason = format!("{} selects nothing", table.title());
        table.complain("edges", reason, "add edges, or vertices by index, box or ball");
    }
    BendingRegionSection {
        edges: edges.unwrap_or(EdgeSelection::Edges(Vec::new())),
        angle: table
            .key("angle", "The angle between the two faces of each edge, in degrees: 0 is flat, positive is bent as on a sphere whose normals point outward.")
            .required(NumberSection::Constant(30.0)),
    }
}
