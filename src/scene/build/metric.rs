//! `[metric]` as edge lengths over time.

use std::path::Path;
use std::sync::Arc;

use crate::mesh::{
    Keyframe, Mesh, MeshError, Surface, read_edge_lengths, read_length_keyframes, read_lengths, read_positions,
    read_vertex_numbers, select_vertices,
};
use crate::metric::{Change, Lengths, MetricError, MetricProgram, Region, RicciTarget, lengths_of_positions};
use crate::scene::{ChangeKind, LengthSource, MetricChangeSection, RicciSection, Scene, SceneError};
use crate::timeline::{Keyframes, Parameters};

/// The lengths that a file decrees, or those of its positions.
fn lengths_of_file(path: &Path, mesh: &Mesh) -> Result<Vec<f64>, MeshError> {
    match read_lengths(path, mesh)? {
        Some(lengths) => Ok(lengths),
        None => Ok(lengths_of_positions(mesh, &read_positions(path, mesh)?)),
    }
}

impl Scene {
    pub(super) fn metric_program(
        &self,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<MetricProgram, SceneError> {
        let section = &self.metric;
        let mut program = if let Some(files) = &section.files {
            let mesh = &surface.mesh;
            let lengths = |path: &Path| {
                let lengths = |key| match key {
                    Keyframe::Decreed(lengths) => Lengths::fixed(lengths),
                    Keyframe::Positions(positions) => Lengths::fixed(lengths_of_positions(mesh, &positions)),
                };
                Ok(read_length_keyframes(path, mesh)?.into_iter().map(lengths).collect())
            };
            let (times, values) = self.keyframes_of_files("metric", files, mesh, lengths)?;
            let keys = Keyframes::new(times, values, section.ease, section.extrapolation);
            let keys = keys.map_err(|error| self.complain_about("metric.files", &error))?;
            MetricProgram::new(keys, section.interpolation)
        } else if section.keys.is_empty() {
            MetricProgram::of(self.lengths("metric", &section.lengths, surface, parameters)?)
        } else {
            let (mut times, mut values) = (Vec::new(), Vec::new());
            for (k, key) in section.keys.iter().enumerate() {
                times.push(key.time);
                values.push(self.lengths(&format!("metric.key[{k}]"), &key.lengths, surface, parameters)?);
            }
            let keys = Keyframes::new(times, values, section.ease, section.extrapolation);
            MetricProgram::new(keys.map_err(|error| self.complain_about("metric.key", &error))?, section.interpolation)
        };
        for (k, change) in section.changes.iter().enumerate() {
            program = program.changed_by(self.change(&format!("metric.change[{k}]"), change, surface, parameters)?);
        }
        Ok(program)
    }

    /// The lengths that the table at a key names.
    fn lengths(
        &self,
        key: &str,
        source: &LengthSource,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<Lengths, SceneError> {
        let mesh = &surface.mesh;
        match source {
            LengthSource::OfMesh => Lengths::of_surface(surface).map_err(|error| self.no_lengths(key, &error)),
            LengthSource::Uniform(length) => Ok(Lengths::fixed(vec![*length; mesh.edge_count()])),
            LengthSource::Csv(path) => read_edge_lengths(&self.resolve(path), mesh)
                .map(Lengths::fixed)
                .map_err(|error| self.complain_about(&format!("{key}.csv"), &error)),
            LengthSource::File(path) => lengths_of_file(&self.resolve(path), mesh)
                .map(Lengths::fixed)
                .map_err(|error| self.complain_about(&format!("{key}.file"), &error)),
            LengthSource::Positions(texts) => {
                let key = format!("{key}.positions");
                let formula = self.point_formula(&key, texts, parameters)?;
                Lengths::of_moved(surface, formula).map_err(|error| self.complain_about(&key, &error))
            }
            LengthSource::Formula(text) => {
                let key = format!("{key}.formula");
                let formula = self.formula(&key, text, &Lengths::VARIABLES, parameters)?;
                Lengths::by_formula(surface, formula).map_err(|error| self.no_lengths(&key, &error))
            }
        }
    }

    /// A scene can say lengths in several ways.
    fn no_lengths(&self, key: &str, error: &MetricError) -> SceneError {
        let complaint = self.complain_about(key, error);
        match error {
            MetricError::NoPositions => SceneError {
                remedy: "add `length = …` or `csv = \"…\"` under [metric], or use a mesh with positions".into(),
                ..complaint
            },
            _ => complaint,
        }
    }

    fn change(
        &self,
        key: &str,
        section: &MetricChangeSection,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<Change, SceneError> {
        let amount = self.number(&format!("{key}.amount"), &section.amount, parameters)?;
        match &section.kind {
            ChangeKind::Conformal { log_scale } => {
                let key = format!("{key}.log_scale");
                let log_scale = self.formula(&key, log_scale, &["x", "y", "z"], parameters)?;
                Change::conformal(surface, log_scale, amount).map_err(|error| self.complain_about(&key, &error))
            }
            ChangeKind::Ricci(section) => {
                let target = self.ricci_target(key, section, surface)?;
                let change = Change::ricci(&surface.mesh, target, amount);
                change.map_err(|error| self.metric_fault(key, &error))
            }
        }
    }

    fn ricci_target(&self, key: &str, section: &RicciSection, surface: &Surface) -> Result<RicciTarget, SceneError> {
        let RicciSection { curvature, turning, free_area, .. } = *section;
        let mut regions = Vec::new();
        for (k, region) in section.regions.iter().enumerate() {
            let vertices = select_vertices(&region.vertices, &surface.mesh, surface.places())
                .map_err(|error| self.complain_about(&format!("{key}.region[{k}]"), &error))?;
            regions.push(Region { vertices, curvature: region.total.to_radians() });
        }
        let cones = match &section.csv {
            None => Vec::new(),
            Some(path) => read_vertex_numbers(&self.resolve(path), &surface.mesh)
                .map_err(|error| self.complain_about(&format!("{key}.csv"), &error))?,
        };
        let cones = cones.into_iter().map(|(v, degrees)| (v, degrees.to_radians())).collect();
        Ok(RicciTarget { curvature, regions, cones, turning: turning.map(f64::to_radians), free_area })
    }
}
