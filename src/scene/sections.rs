//! The sections of a scene, one function each: its keys, what they may be, and their defaults.

use super::data::*;
use super::shapes::mesh;
use super::table::Table;
use super::value::{Color, Formats};

/// Frame numbers have six digits in file names.
const MAX_FRAMES: f64 = 999_999.0;
const MAX_PIXELS: f64 = 16_384.0;

/// All sections. Name, folder and source are filled in by the caller.
pub(super) fn root(table: &mut Table) -> Scene {
    Scene {
        mesh: table.table("mesh", "The surface: a file or a generated shape.", mesh),
        metric: table.table(
            "metric",
            "Its edge lengths; left out, those of the shape or of the mesh's positions.",
            metric,
        ),
        spin: table.table("spin", "Its regular homotopy class.", spin),
        start: table.table("start", "Where the frames start; left out, random = 0.", start),
        phases: table.tables("phase", "A stage of the relaxation; without any, the default ones.", phase),
        bending: table.optional_table("bending", "Target bending angles.", bending),
        pins: table.tables("pin", "Vertices held in place.", pin),
        clock: table.table("clock", "How many frames.", clock),
        camera: table.table("camera", "The view; what is left out frames the surface by itself.", camera),
        lights: table.tables("light", "A directional light; without any, the studio's three.", light),
        look: table.table("look", "Colours and lines.", look),
        output: table.table("output", "Picture size and format.", output),
        checks: table.table("checks", "What must hold on the last frame.", checks),
        ..Scene::default()
    }
}

fn metric(table: &mut Table) -> MetricSection {
    let length = table.key::<f64>("length", "The same length for every edge.").above(0.0).optional(0.05);
    let csv =
        table.key::<String>("csv", "A file of lines `u,v,length`, every edge once.").optional("lengths.csv".into());
    let formula = table
        .key::<String>("formula", "An expression in x, y, z of the edge midpoint and `length`, the length of the mesh.")
        .optional("length * (1 + 0.2 * z)".into());
    table.only_one_of(&["length", "csv", "formula"]);
    match (length, csv, formula) {
        (Some(length), _, _) => MetricSection::Uniform(length),
        (_, Some(csv), _) => MetricSection::Csv(csv.into()),
        (_, _, Some(formula)) => MetricSection::Formula(formula),
        _ => MetricSection::OfMesh,
    }
}

fn spin(table: &mut Table) -> SpinSection {
    let doc = "One digit 0 or 1 per generator, the value of q on it; or \"immersion\": that of the mesh's positions.";
    match table.key::<String>("class", doc).optional("01".into()) {
        None => SpinSection::Automatic,
        Some(class) if class == "immersion" => SpinSection::Immersion,
        Some(class) => SpinSection::Digits(binary_digits(table, "class", class)),
    }
}

/// Passes a class on, and reports it if it is not one.
fn binary_digits(table: &Table, key: &str, class: String) -> String {
    if !class.bytes().all(|b| matches!(b, b'0' | b'1')) {
        let reason = format!("`{key}` is the string {class:?}, a class has one digit 0 or 1 per generator");
        let also = if table.title() == "[spin]" { ", or \"immersion\" for that of the mesh's positions" } else { "" };
        table.complain(key, reason, format!("write for example {key} = \"01\"{also}"));
    }
    class
}

fn start(table: &mut Table) -> StartSection {
    let random = table.key::<u64>("random", "Independent uniform frames from this seed.").optional(7);
    let from = table.choice(
        "from",
        "Frames of the mesh's positions, of their mirror image, or lowest modes of the connection Laplacian.",
        &[("mesh", StartSection::Mesh), ("mirror", StartSection::Mirror), ("spectral", StartSection::Spectral)],
    );
    table.only_one_of(&["random", "from"]);
    from.or(random.map(StartSection::Random)).unwrap_or_default()
}

fn phase(table: &mut Table) -> PhaseSection {
    let default = PhaseSection::default();
    let method = table.choice(
        "method",
        "The step: implicit with the norm's basis frozen, Alg. 5 as printed, or Alg. 6.",
        &[("implicit", MethodName::Implicit), ("gradient", MethodName::Gradient), ("newton", MethodName::Newton)],
    );
    let phase = PhaseSection {
        method: method.unwrap_or(default.method),
        epsilon: table
            .key("epsilon", "(length, bending, normal rotation, torsion) weights, Eq. 20.")
            .at_least(0.0)
            .or(default.epsilon),
        dt: table.key("dt", "Time step in units of the mean face area.").above(0.0).or(default.dt),
        feedback: table
            .key("feedback", "How far frames move toward those of the integrated surface after each step, Alg. 8.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.feedback),
        periods: table
            .key("periods", "How far frames move toward those of edge vectors without periods after each step.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.periods),
        crease: table
            .key("crease", "Stiffness of creases that are about to fold over.")
            .at_least(0.0)
            .or(default.crease),
        accelerate: table
            .key("accelerate", "Whether steps are combined with earlier ones once they shrink.")
            .or(default.accelerate),
        tolerance: table
            .key("tolerance", "The stage ends when the mean turn of a frame per step is below this, in degrees.")
            .above(0.0)
            .at_most(180.0)
            .or(default.tolerance),
        min_steps: table.key("min_steps", "The least number of steps.").or(default.min_steps),
        max_steps: table
            .key("max_steps", "After this many steps the stage is said not to have converged.")
            .at_least(1.0)
            .or(default.max_steps),
        untangle_steps: table
            .key("untangle_steps", "So many more steps are taken as long as there are rims.")
            .or(default.untangle_steps),
    };
    if phase.epsilon.iter().all(|&weight| weight == 0.0) {
        table.complain("epsilon", "all weights are 0, so that nothing is minimized", "make the first one 1");
    }
    if phase.min_steps > phase.max_steps {
        let (least, most) = (phase.min_steps, phase.max_steps);
        let reason = format!("`min_steps` is {least}, more than `max_steps`, which is {most}");
        table.complain("min_steps", reason, format!("write at most {most}, or raise `max_steps`"));
    }
    phase
}

fn bending(table: &mut Table) -> BendingSection {
    let doc = "Angles of the mesh's positions, or of their mirror image.";
    let from = table.choice("from", doc, &[("mesh", BendingSection::Mesh), ("mirror", BendingSection::Mirror)]);
    if table.has_none_of(&["from"]) {
        table.complain("from", "[bending] has no `from`", "add from = \"mesh\" or from = \"mirror\"");
    }
    from.unwrap_or(BendingSection::Mesh)
}

fn pin(table: &mut Table) -> PinSection {
    let pin = PinSection {
        vertices: table.key("vertices", "Vertices by index, counted from 0.").required(vec![0, 1]),
        positions: table
            .key("positions", "Where they belong, one [x, y, z] per vertex; left out, where the mesh's positions are.")
            .or(Vec::new()),
    };
    let (vertices, positions) = (pin.vertices.len(), pin.positions.len());
    if vertices == 0 {
        table.complain("vertices", "`vertices` is empty", "name at least one vertex, or remove this [[pin]]");
    } else if positions > 0 && positions != vertices && table.has("vertices") {
        let reason = format!("there are {positions} positions for {vertices} vertices");
        table.complain("positions", reason, "give one [x, y, z] per vertex");
    }
    pin
}

fn clock(table: &mut Table) -> ClockSection {
    let default = ClockSection::default();
    ClockSection {
        frames: table
            .key("frames", "Number of frames; 1 is a static scene, the relaxed surface.")
            .at_least(1.0)
            .at_most(MAX_FRAMES)
            .or(default.frames),
        steps_per_frame: table
            .key("steps_per_frame", "Steps between the frames of a film of the relaxation.")
            .at_least(1.0)
            .or(default.steps_per_frame),
    }
}

fn camera(table: &mut Table) -> CameraSection {
    let camera = CameraSection {
        direction: table
            .key("direction", "From the surface to the eye; left out, the best view along the principal axes.")
            .optional([1.0, 0.5, 2.0]),
        up: table.key("up", "Up in the picture.").optional([0.0, 1.0, 0.0]),
        field_of_view: table
            .key("field_of_view", "Vertical, in degrees; 0 is orthographic.")
            .at_least(0.0)
            .below(180.0)
            .optional(30.0),
        fill: table.key("fill", "Share of the picture the surface fills.").above(0.0).at_most(1.0).optional(0.8),
    };
    not_zero(table, "direction", camera.direction);
    not_zero(table, "up", camera.up);
    camera
}

fn not_zero(table: &Table, name: &str, vector: Option<[f64; 3]>) {
    if vector == Some([0.0; 3]) {
        let reason = format!("`{name}` is the zero vector, which points nowhere");
        table.complain(name, reason, format!("write for example {name} = [0, 1, 0]"));
    }
}

fn light(table: &mut Table) -> LightSection {
    let light = LightSection {
        direction: table
            .key("direction", "Toward the light; x right, y up, z toward the eye.")
            .required([-0.5, 1.0, 1.0]),
        color: table.key("color", "Linear colour times strength.").at_least(0.0).or([1.0; 3]),
        shadow: table.key("shadow", "Whether it casts shadows.").or(true),
    };
    not_zero(table, "direction", Some(light.direction));
    light
}

fn look(table: &mut Table) -> LookSection {
    let default = LookSection::default();
    LookSection {
        front: table.key("front", "Colour of the side the normal points from.").or(Color(default.front)).0,
        back: table.key("back", "Colour of the other side.").or(Color(default.back)).0,
        background: table.key("background", "Colour behind the surface.").or(Color(default.background)).0,
        wireframe: table
            .key("wireframe", "Strength of the mesh edges.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.wireframe),
        lines: table.key("lines", "Whether silhouettes, boundary and rims are drawn.").or(default.lines),
    }
}

fn output(table: &mut Table) -> OutputSection {
    let default = OutputSection::default();
    let size = table.key("size", "Width and height in pixels.").at_least(1.0).at_most(MAX_PIXELS).or(default.size);
    let samples = table.key("samples", "Samples per pixel: 1, 4, 8 or 16.").or(default.samples);
    if ![1, 4, 8, 16].contains(&samples) {
        table.complain("samples", format!("`samples` is {samples}, it must be 1, 4, 8 or 16"), "write samples = 8");
    }
    let formats = Formats { png: default.png, exr: default.exr };
    let Formats { png, exr } = table.key("format", "Picture formats: \"png\", \"exr\" or both in a list.").or(formats);
    OutputSection { size, samples, png, exr }
}

fn checks(table: &mut Table) -> ChecksSection {
    ChecksSection {
        max_l2_length_error: table
            .key("max_l2_length_error", "Bound on the root mean square relative length error; 0.01 is one percent.")
            .at_least(0.0)
            .optional(0.01),
        max_rims: table.key("max_rims", "Bound on the number of rims.").optional(0),
        max_pinch_points: table.key("max_pinch_points", "Bound on the number of pinch points.").optional(0),
        class: table
            .key::<String>("class", "The class the result must have, one digit 0 or 1 per generator.")
            .optional("01".into())
            .map(|class| binary_digits(table, "class", class)),
    }
}
