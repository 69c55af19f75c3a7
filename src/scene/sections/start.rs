//! `[start]`

use crate::evolve::Orientation;
use crate::immersion::Noise;
use crate::mesh::shapes::limits::{LEAST_LOBES, MOST_LOBES};
use crate::scene::data::{StartFrom, StartSection};
use crate::scene::keys::Table;

pub(super) fn start(table: &mut Table) -> StartSection {
    let random = table
        .key::<u64>("random", "Every face begins turned at random, by this seed; another one may find another shape.")
        .optional(7);
    let from = table.choice(
        "from",
        "Begins with the mesh's positions, with their mirror image, with the smoothest face frames that there are \
         (the lowest modes of the connection Laplacian), or with a torus as a ring whose cross-section is a figure eight, \
         the halfway model of a torus eversion.",
        &[
            ("mesh", StartFrom::Mesh),
            ("mirror", StartFrom::Mirror),
            ("spectral", StartFrom::Spectral),
            ("figure eight", StartFrom::FigureEight),
        ],
    );
    let file = table
        .key::<String>(
            "file",
            "Begins with the positions of another mesh with the same connectivity, or of a frame of a film.",
        )
        .optional("deformed.obj".into());
    let halfway = table
        .key::<usize>(
            "halfway",
            "Begins with the halfway model of a sphere eversion, with so many lobes: 2 is Morin's surface, 3 Boy's surface twice covered.",
        )
        .at_least(LEAST_LOBES as f64)
        .at_most(MOST_LOBES as f64)
        .optional(2);
    table.only_one_of(&["random", "from", "file", "halfway"]);
    let section = StartSection {
        from: file
            .map(|file| StartFrom::File(file.into()))
            .or(halfway.map(StartFrom::Halfway))
            .or(from)
            .or(random.map(StartFrom::Random))
            .unwrap_or_default(),
        formula: table
            .key("formula", "Where each vertex is moved first: three formulas of its x, y and z and the parameters.")
            .optional(["x", "y", "0.5 * z"].map(str::to_owned)),
        noise: table.optional_table("noise", "Smooth random displacement of those positions.", noise),
        orientation: table.choice_or(
            "orientation",
            "Which of two mirror images random frames end in: that of the mesh's positions, else the one whose \
                 front is outside.",
            &[("outward", Orientation::Outward), ("as it comes", Orientation::AsItComes)],
            Orientation::default(),
        ),
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
        seed: table.key("seed", "Another seed gives another displacement.").at_most(4_294_967_295.0).or(0),
        along_normals: table
            .key("along_normals", "Whether vertices move along their normals only; else in all directions.")
            .or(false),
    }
}
