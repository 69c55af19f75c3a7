//! Fields of frames: what colours, patterns and layers show.

mod coordinates;

use self::coordinates::Chart;
use super::plan::Plan;
use crate::{
    digest::Digest,
    evolve::Frame,
    film::{
        disk::{FilmFolder, FilmMesh},
        error::FilmError,
        metric_of_frame::metric_of_frame,
    },
    immersion::{FieldInput, FieldName, FieldValues, Fields},
    mesh::Mesh,
    metric::Metric,
    render::{ColorMap, Field, FieldSpread, Legend, Look, LookName, Paint},
    scene::PatternAlong,
    spin::SpinStructure,
};

/// Fields of one frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Quantities {
    /// Shown as colour.
    pub color: Option<Field>,
    /// What the pattern runs along and across.
    pub along: [Option<Field>; 2],
    /// Recorded as layers.
    pub layers: Vec<Field>,
}

/// Computes the fields that look and output of a scene ask for.
#[derive(Debug)]
pub(super) struct Measures {
    fields: Option<Fields>,
    color: Option<FieldName>,
    along: Along,
    layers: Vec<FieldName>,
}

/// What the pattern runs along.
#[derive(Debug)]
enum Along {
    /// The same places of the mesh in all frames; none without a pattern.
    Mesh(Box<[Option<Field>; 2]>),
    /// A field of each frame, this often from its least to its greatest shown value.
    Field(FieldName, usize),
}

/// How the values that are shown are spread over a film.
#[derive(Clone, Debug, Default)]
pub(super) struct Spreads {
    color: FieldSpread,
    along: FieldSpread,
}

impl Spreads {
    pub fn merge(&mut self, other: &Spreads) {
        self.color.merge(&other.color);
        self.along.merge(&other.along);
    }
}

impl Measures {
    pub fn of(plan: &Plan, folder: &FilmFolder, surface: &FilmMesh) -> Result<Measures, FilmError> {
        let look = &plan.scene.look;
        let is_map = matches!(plan.look.paint, Paint::Map { .. });
        let color = look.color.as_ref().map(|color| color.field).or(is_map.then_some(FieldName::LengthError));
        let layers = if plan.output.has_layers() { plan.scene.output.fields.clone() } else { Vec::new() };
        let along = along(plan, folder, surface)?;
        let wanted = color.is_some() || !layers.is_empty() || matches!(along, Along::Field(..));
        let fields = if wanted {
            let first = folder.read_frame(1)?;
            // Energies are those of the reports.
            let metric = metric_of_frame(&surface.mesh, &first)?;
            Some(Fields::new(surface.mesh.clone(), metric, first.report.stiffness))
        } else {
            None
        };
        Ok(Measures { fields, color, along, layers })
    }

    /// What is shown, for the keys of pictures; layers are not.
    pub fn add_to(&self, digest: Digest) -> Digest {
        let Measures { fields: _, color, along, layers: _ } = self;
        digest.shown(color).shown(along)
    }

    /// The field that is shown as colour.
    pub fn color(&self) -> Option<FieldName> {
        self.color
    }

    /// Whether fields are shown, which are measured against the first frame.
    pub fn has_fields(&self) -> bool {
        self.fields.is_some()
    }

    /// The fields of a frame.
    pub fn at(&self, mesh: &Mesh, frame: &Frame) -> Result<Quantities, FilmError> {
        let basis = self.basis(mesh, frame)?;
        let field =
            |name: FieldName| Ok::<_, FilmError>(self.values(&basis, name, frame)?.map(|of| Field::new(name, of)));
        Ok(Quantities {
            color: self.color.map(field).transpose()?.flatten(),
            along: match &self.along {
                Along::Mesh(fields) => fields.as_ref().clone(),
                Along::Field(name, _) => [field(*name)?, None],
            },
            layers: self.layers.iter().filter_map(|&name| field(name).transpose()).collect::<Result<_, _>>()?,
        })
    }

    /// Whether the look depends on how the values of all frames are spread.
    pub fn spreads_matter(&self, plan: &Plan) -> bool {
        self.free_color(plan).is_some() || matches!(self.along, Along::Field(..))
    }

    /// The field that is shown as colour, if its spread over the film is shown too.
    fn free_color(&self, plan: &Plan) -> Option<FieldName> {
        let is_free = plan.scene.look.color.as_ref().is_none_or(|color| color.range.is_none() || color.legend);
        self.color.filter(|_| is_free)
    }

    /// How the values of a frame are spread, as far as the look depends on it.
    pub fn spreads(&self, plan: &Plan, mesh: &Mesh, frame: &Frame) -> Result<Spreads, FilmError> {
        let mut spreads = Spreads::default();
        let basis = self.basis(mesh, frame)?;
        if let Some(name) = self.free_color(plan)
            && let Some(values) = self.values(&basis, name, frame)?
        {
            spreads.color.add(values.all());
        }
        if let Along::Field(name, _) = self.along
            && let Some(values) = self.values(&basis, name, frame)?
        {
            spreads.along.add(values.all());
        }
        Ok(spreads)
    }

    /// The look with the ranges of what it shows, and the key to its colours.
    pub fn complete(&self, plan: &Plan, spreads: &Spreads) -> (Look, Option<Legend>) {
        let mut look = plan.look.clone();
        let mut legend = None;
        if let Some(name) = self.color {
            let section = plan.scene.look.color.as_ref();
            let map = section.and_then(|section| section.map).unwrap_or_else(|| ColorMap::suiting(name));
            let given = section.and_then(|section| section.range).map(|range| range.map(|value| value as f32));
            let range = given.unwrap_or_else(|| spreads.color.range(name));
            look.paint = Paint::Map { map, range };
            if section.is_none_or(|section| section.legend) {
                legend = Some(Legend::new(name, map, range, spreads.color.extremes()));
            }
        }
        if let (Along::Field(name, count), Some(pattern)) = (&self.along, &mut look.pattern) {
            let [low, high] = spreads.along.range(*name);
            pattern.periods = [(high - low) / *count as f32; 2];
        }
        (look, legend)
    }

    /// What the fields of a frame are computed from, if any are asked for.
    fn basis(&self, mesh: &Mesh, frame: &Frame) -> Result<Option<Basis>, FilmError> {
        if self.fields.is_none() {
            return Ok(None);
        }
        Ok(Some(Basis { metric: metric_of_frame(mesh, frame)?, spin: frame.spin.clone() }))
    }

    fn values(&self, basis: &Option<Basis>, name: FieldName, frame: &Frame) -> Result<Option<FieldValues>, FilmError> {
        let (Some(fields), Some(Basis { metric, spin })) = (&self.fields, basis) else { return Ok(None) };
        let input = FieldInput { metric, positions: &frame.positions, frames: &frame.face_frames, spin };
        fields.of(name, &input).map(Some).map_err(FilmError::field)
    }
}

/// What the frame on disk says of its metric.
struct Basis {
    metric: Metric,
    spin: SpinStructure,
}

fn along(plan: &Plan, folder: &FilmFolder, surface: &FilmMesh) -> Result<Along, FilmError> {
    let scene = plan.scene;
    let (along, count) = match (&scene.look.pattern, scene.look.preset) {
        (Some(pattern), _) => (&pattern.along, pattern.count),
        (None, LookName::Bands) => (&PatternAlong::Parallels, BANDS),
        _ => return Ok(Along::Mesh(Box::default())),
    };
    if let PatternAlong::Field(name) = along {
        return Ok(Along::Field(*name, count));
    }
    let first = folder.read_frame(1)?;
    let chart = Chart { surface, edge_lengths: &first.edge_lengths };
    let parameters = scene.parameters()?;
    let fields = chart.coordinates(along, count, &parameters);
    let fields = fields.map_err(|error| scene.complain_about("look.pattern.along", &error))?;
    Ok(Along::Mesh(Box::new(fields)))
}

/// Bands of the look that is named for them, if the scene says nothing else.
const BANDS: usize = 12;
