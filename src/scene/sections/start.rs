//! `[start]`

use crate::evolve::Orientation;
use crate::immersion::Noise;
use crate::scene::data::{StartFrom, StartSection};
use crate::scene::keys::Table;

pub(super) fn start(table: &mut Table) -> StartSection {
    let random = table.key::<u64>("random", "Independent uniform frames from this seed.").optional(7);
    let from = table.choice(
        "from",
        "Frames of the mesh's positions, of their mirror image, or lowest modes of the connection Laplacian.",
        &[("mesh", StartFrom::Mesh), ("mirror", StartFrom::Mirror), ("spectral", StartFrom::Spectral)],
    );
    let file = table
        .key::<String>("file", "Frames of another mesh with the same connectivity.")
        .optional("deformed.obj".into());
    table.only_one_of(&["random", "from", "file"]);
    let section = StartSection {
        from: file
            .map(|file| StartFrom::File(file.into()))
            .or(from)
            .or(random.map(StartFrom::Random))
            .unwrap_or_default(),
        formula: table
            .key("formula", "Where each vertex of those positions is moved: expressions in x, y, z and the parameters.")
            .optional(["x", "y", "0.5 * z"].map(str::to_owned)),
        noise: table.optional_table("noise", "Smooth random displacement of those positions.", noise),
        orientation: table
            .choice(
                "orientation",
                "Which of two mirror images random frames end in: that of the mesh's positions, else the one whose \
                 front is outside.",
                &[("outward", Orientation::Outward), ("as it comes", Orientation::AsItComes)],
            )
            .unwrap_or_default(),
    };
    if matches!(section.from, StartFrom::Random(_) | StartFrom::Spectral) {
        for name in ["formula", "noise"].into_iter().filter(|name| table.has(name)) {
            let reason = format!("`{name}` moves positions, and these frames come from none");
            table.complain(name, reason, "add from = \"mesh\", or remove it");
        }
    }
    section
}

fn noise(table: &mut Table) -> Noise {
    Noise {
        amplitude: table
            .key("amplitude", "Root mean square displacement of the first layer.")
            .at_least(0.0)
            .required(0.1),
        wavelength: table.key("wavelength", "Length of the waves of the first layer.").above(0.0).required(0.5),
        octaves: table
            .key("octaves", "Layers, each of half the wavelength and half the amplitude of the one before.")
            .at_least(1.0)
            .at_most(16.0)
            .or(1),
        seed: table.key("seed", "Which of the many.").at_most(4_294_967_295.0).or(0),
        along_normals: table.key("along_normals", "Whether vertices move along their normals only.").or(false),
    }
}
