//! `[metric]`, its keys and changes.

use super::selection::selection;
use crate::metric::Interpolation;
use crate::scene::data::{
    ChangeKind, CurvatureRegionSection, LengthSource, MetricChangeSection, MetricKeySection, MetricSection,
    NumberSection, RicciSection,
};
use crate::scene::keys::Table;
use crate::scene::keys::{ease, extrapolation, files};
use crate::timeline::{Ease, Extrapolation};

pub(super) fn metric(table: &mut Table) -> MetricSection {
    let lengths = length_source(table);
    let doc = "Meshes with the same connectivity, or arrays, whose lengths are taken one after another: a list, or a \
               pattern of names with * and ?, in the order of the numbers in them. Of a FOLD file every frame is one.";
    let files = files(table, doc);
    let keys = table.tables("key", "The metric at a time; what is between is interpolated.", key);
    let interpolation = table.choice_or(
        "interpolation",
        "What changes evenly between keys: lengths, their squares or their logarithms.",
        &[
            ("lengths", Interpolation::Lengths),
            ("squared", Interpolation::Squared),
            ("logarithms", Interpolation::Logarithms),
        ],
        Interpolation::default(),
    );
    let section = MetricSection {
        lengths,
        files,
        interpolation,
        ease: ease(table),
        extrapolation: extrapolation(table),
        changes: table.tables("change", "What is done to the lengths, one after another.", change),
        keys,
    };
    if let Some([a, b]) = section.keys.array_windows().find(|[a, b]| b.time <= a.time) {
        let reason = format!("keys are out of order: time {} comes after {}", b.time, a.time);
        table.complain("key", reason, "sort them, each time greater than the last");
    }
    if !section.keys.is_empty() && section.files.is_some() {
        table.complain("key", "[metric] has both `files` and [[metric.key]]", "put one of the files into each key");
    }
    if !section.keys.is_empty() && section.lengths != LengthSource::OfMesh {
        let reason = "[metric] has both lengths and [[metric.key]], which exclude each other";
        table.complain("key", reason, "put the lengths into a [[metric.key]] of their own");
    }
    if section.keys.is_empty() && section.files.is_none() {
        for name in ["interpolation", "ease", "extrapolation"].into_iter().filter(|name| table.has(name)) {
            table.complain(
                name,
                format!("`{name}` is about [[metric.key]] or `files`, and there is none"),
                "remove it, or add keys",
            );
        }
    }
    section
}

const FILE_DOC: &str = "Another mesh with the same connectivity, whose lengths are taken: those that it decrees (FOLD, npz), else \
                        those of its positions. Or an array: npy or npz with rows u, v, length, or a frame of a film.";

fn length_source(table: &mut Table) -> LengthSource {
    let length = table.key::<f64>("length", "The same length for every edge.").above(0.0).optional(0.05);
    let csv =
        table.key::<String>("csv", "A file of lines `u,v,length`, every edge once.").optional("lengths.csv".into());
    let file = table.key::<String>("file", FILE_DOC).optional("other.obj".into());
    let doc = "The lengths that the mesh has when each vertex is moved to the place that three formulas of its x, y and z, \
               the time `t` and the parameters give.";
    let positions = table.key::<[String; 3]>("positions", doc).optional(["2 * x", "y", "z"].map(str::to_owned));
    let doc = "The length of an edge as a formula of `length`, what it is in the mesh; x, y and z, its middle; dx, dy and dz, \
               from end to end; the time `t` and the parameters.";
    let formula = table.key::<String>("formula", doc).optional("length * (1 + 0.2 * z)".into());
    // Of `files` only [metric] itself knows.
    table.only_one_of(&["length", "csv", "file", "files", "positions", "formula"]);
    match (length, csv, file, positions, formula) {
        (Some(length), ..) => LengthSource::Uniform(length),
        (_, Some(csv), ..) => LengthSource::Csv(csv.into()),
        (_, _, Some(file), ..) => LengthSource::File(file.into()),
        (_, _, _, Some(positions), _) => LengthSource::Positions(positions),
        (.., Some(formula)) => LengthSource::Formula(formula),
        _ => LengthSource::OfMesh,
    }
}

fn key(table: &mut Table) -> MetricKeySection {
    MetricKeySection {
        time: table.key("time", "The time at which these lengths hold.").required(0.0),
        lengths: length_source(table),
    }
}

fn change(table: &mut Table) -> MetricChangeSection {
    let kind = table.variants(
        "kind",
        "What is done to the lengths.",
        &[
            ("conformal", "Every length is multiplied by exp(u), where u is the mean of `log_scale` at its two ends.", conformal),
            ("ricci", "Discrete Ricci flow: lengths are scaled at their ends until every vertex has the curvature that is asked for.", ricci),
        ],
    );
    if !table.has("kind") && table.is_given() {
        table.complain("kind", "[[change]] has no `kind`", "add kind = \"conformal\" or kind = \"ricci\"");
    }
    let kind = kind.unwrap_or(ChangeKind::Ricci(RicciSection::default()));
    let doc = "How much of it is done, 0 to 1. Of a Ricci flow 1 is the limit, and a smaller amount a is the state at \
               time -ln(1 - a) of the flow.";
    let default = match kind {
        ChangeKind::Conformal { .. } => NumberSection::Constant(1.0),
        ChangeKind::Ricci(_) => NumberSection::Keyframes {
            times: vec![0.0, 1.0],
            values: vec![0.0, 1.0],
            ease: Ease::Linear,
            extrapolation: Extrapolation::Hold,
        },
    };
    MetricChangeSection { kind, amount: table.key("amount", doc).or(default) }
}

fn conformal(table: &mut Table) -> ChangeKind {
    let doc = "The logarithm of the factor at a vertex: a formula of its x, y and z, the time `t` and the parameters.";
    ChangeKind::Conformal { log_scale: table.key("log_scale", doc).required("0.3 * t * z".to_owned()) }
}

fn ricci(table: &mut Table) -> ChangeKind {
    table.only_one_of(&["curvature", "region"]);
    table.only_one_of(&["curvature", "csv"]);
    ChangeKind::Ricci(RicciSection {
        curvature: table
            .key("curvature", "Gaussian curvature inside, per length squared; left out, the one constant that the theorem of Gauss and Bonnet allows.")
            .optional(-1.0),
        regions: table.tables("region", "Vertices with a total curvature of their own.", curvature_region),
        csv: table
            .key::<String>("csv", "A file of lines `v,degrees`: vertices with a curvature of their own.")
            .optional("cones.csv".into())
            .map(Into::into),
        turning: table
            .key("turning", "Total turning angle of every boundary loop in degrees, spread in proportion to length; left out, the boundary keeps its lengths.")
            .optional(360.0),
        free_area: table.key("free_area", "Whether the total area may change; it is kept otherwise.").or(false),
    })
}

fn curvature_region(table: &mut Table) -> CurvatureRegionSection {
    CurvatureRegionSection {
        vertices: selection(table),
        total: table.key("total", "Total curvature in degrees, spread in proportion to area.").required(90.0),
    }
}
