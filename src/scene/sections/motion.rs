//! `[spin]`, `[start]`, `[bending]`, `[[pin]]` and `[clock]`.

use super::data::*;
use super::names::Boundary;
use super::number::{one_per_time, times};
use super::table::Table;
use crate::evolve::Orientation;
use crate::immersion::Noise;
use crate::mesh::{EdgeSelection, Selection};
use crate::timeline::Clock;

const MAX_FRAMES: f64 = Clock::MOST_FRAMES as f64;

pub(super) fn spin(table: &mut Table) -> SpinSection {
    let doc = "One digit 0 or 1 per generator, the value of q on it; or \"immersion\": that of the mesh's positions; or \"all\": one a frame.";
    match table.key::<String>("class", doc).optional("01".into()) {
        None => SpinSection::Automatic,
        Some(class) if class == "immersion" => SpinSection::Immersion,
        Some(class) if class == "all" => SpinSection::All,
        Some(class) => SpinSection::Digits(binary_digits(table, "class", class)),
    }
}

/// Passes a class on, and reports it if it is not one.
pub(super) fn binary_digits(table: &Table, key: &str, class: String) -> String {
    if !class.bytes().all(|b| matches!(b, b'0' | b'1')) {
        let reason = format!("`{key}` is the string {class:?}, a class has one digit 0 or 1 per generator");
        let also = if table.title() == "[spin]" { ", or \"immersion\" for that of the mesh's positions" } else { "" };
        table.complain(key, reason, format!("write for example {key} = \"01\"{also}"));
    }
    class
}

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

/// The keys that select vertices.
pub(super) fn selection(table: &mut Table) -> Selection {
    let section = optional_selection(table);
    if section.is_none() && table.is_given() {
        let reason = format!("{} selects nothing", table.title());
        table.complain("vertices", reason, "add vertices, boundary, box, ball or nearest");
    }
    section.unwrap_or(Selection::Vertices(Vec::new()))
}

fn optional_selection(table: &mut Table) -> Option<Selection> {
    let vertices =
        table.key("vertices", "Vertices by their numbers in the mesh file, counted from 0.").optional(vec![0, 1]);
    let boundary = table
        .key::<Boundary>(
            "boundary",
            "All vertices of these boundary loops, counted from 0 as `immerse check` lists them; or \"outer\", the one \
             around the others, or \"longest\", of each component.",
        )
        .optional(Boundary::Loops(vec![0]));
    let corners = table
        .key("box", "Vertices in the box with these opposite corners.")
        .optional([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]);
    let ball = table.key("ball", "Vertices in the ball [x, y, z, radius].").optional([0.0, 0.0, 1.0, 0.5]);
    let nearest = table.key("nearest", "The vertex nearest to each of these points.").optional(vec![[0.0, 0.0, 1.0]]);
    let names = ["vertices", "boundary", "box", "ball", "nearest"];
    table.only_one_of(&names);
    let section = match (vertices, boundary, corners, ball, nearest) {
        (Some(vertices), ..) => Selection::Vertices(vertices),
        (_, Some(loops), ..) => loops.into(),
        (_, _, Some(corners), ..) => Selection::Box(corners),
        (_, _, _, Some(ball), _) => Selection::Ball(ball),
        (.., Some(points)) => Selection::Nearest(points),
        _ => return None,
    };
    let empty = match &section {
        Selection::Vertices(list) | Selection::Boundary(list) => list.is_empty(),
        Selection::Nearest(points) => points.is_empty(),
        _ => false,
    };
    if empty && let Some(name) = names.into_iter().find(|name| table.has(name)) {
        table.complain(
            name,
            format!("`{name}` is empty"),
            format!("name at least one, or remove this {}", table.title()),
        );
    }
    Some(section)
}

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
        "Angles of the mesh's positions, of their mirror image, or of what frames start from.",
        &[("mesh", BendingFrom::Mesh), ("mirror", BendingFrom::Mirror), ("start", BendingFrom::Start)],
    );
    let file =
        table.key::<String>("file", "Angles of another mesh with the same connectivity.").optional("bent.obj".into());
    table.only_one_of(&["from", "file"]);
    let section = BendingSection {
        from: file.map(|file| BendingFrom::File(file.into())).or(from),
        amount: table
            .key("amount", "What the angles are multiplied with: 1 that shape, 0 flat, -1 its mirror image.")
            .or(NumberSection::Constant(1.0)),
        regions: table.tables("region", "Edges with a constant angle of their own.", bending_region),
    };
    let says_no_angles = table.has_none_of(&["from", "file", "region"]);
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
            .key("angle", "In degrees; positive as on a sphere whose normals point outward.")
            .required(NumberSection::Constant(30.0)),
    }
}

pub(super) fn pin(table: &mut Table) -> PinSection {
    let pin = PinSection {
        vertices: selection(table),
        positions: table
            .key("positions", "Where they belong, one [x, y, z] per vertex; left out, where the mesh's positions are.")
            .or(Vec::new()),
        formula: table
            .key("formula", "Where each goes from there: expressions in x, y, z, time `t` and the parameters.")
            .optional(["x", "y", "z - 0.2 * t"].map(str::to_owned)),
        motion: table.optional_table("motion", "Keyframed rigid motion about their centroid.", motion),
    };
    let positions = pin.positions.len();
    if positions > 0 {
        let selected = match &pin.vertices {
            Selection::Vertices(vertices) => vertices.len(),
            Selection::Nearest(points) => points.len(),
            _ => 0,
        };
        if selected == 0 {
            table.complain(
                "positions",
                "`positions` are in order of a list, and there is none",
                "list `vertices`, or use `formula`",
            );
        } else if positions != selected {
            let reason = format!("there are {positions} positions for {selected} vertices");
            table.complain("positions", reason, "give one [x, y, z] per vertex");
        }
    }
    pin
}

fn motion(table: &mut Table) -> MotionSection {
    let (times, ease) = times(table);
    let still = vec![[0.0; 3]; times.len()];
    let motion = MotionSection {
        translations: table.key("translations", "Displacement, one [x, y, z] per time.").or(still.clone()),
        rotations: table.key("rotations", "Degrees about x, then y, then z, one per time.").or(still),
        times,
        ease,
    };
    one_per_time(table, "translations", motion.translations.len(), motion.times.len());
    one_per_time(table, "rotations", motion.rotations.len(), motion.times.len());
    motion
}

pub(super) fn clock(table: &mut Table) -> ClockSection {
    let default = ClockSection::default();
    let clock = ClockSection {
        frames: table
            .key("frames", "Number of frames; 1 is a static scene. With class = \"all\" there is one for each class if it is left out.")
            .at_least(1.0)
            .at_most(MAX_FRAMES)
            .or(default.frames),
        a_frame_for_each_class: !table.has("frames"),
        start: table.key("start", "Time of the first frame.").or(default.start),
        end: table.key("end", "Time of the last frame or, in a film that loops, of the one after it.").or(default.end),
        looping: table.key("loop", "Whether the first frame comes after the last one again.").or(default.looping),
        steps_per_frame: table
            .key("steps_per_frame", "Steps between the frames of a film of the relaxation; left out, frames of a scene that changes with time relax until they have settled.")
            .at_least(1.0)
            .optional(2),
        tolerance: table
            .key("tolerance", "A frame has settled when the mean turn of its face frames per step is below this, in degrees,")
            .above(0.0)
            .at_most(180.0)
            .or(default.tolerance),
        max_steps: table.key("max_steps", "or after this many steps.").at_least(1.0).or(default.max_steps),
        accuracy: table
            .key("accuracy", "A frame is done as soon as its L2 length error is at most this and it has no rims; left out, when it has settled.")
            .above(0.0)
            .optional(0.005),
        max_strain: table
            .key("max_strain", "No edge changes its length by more than this share at once; a frame that brings more is reached in parts.")
            .above(0.0)
            .or(default.max_strain),
    };
    if clock.end <= clock.start {
        let reason = format!("the clock ends at {}, not after its start at {}", clock.end, clock.start);
        table.complain("end", reason, "make `end` greater than `start`");
    }
    clock
}
