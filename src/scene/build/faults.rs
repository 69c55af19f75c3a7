//! Which key of a scene is at fault when one of the rooms complains.

use crate::advice::Advice;
use crate::evolve::{EvolveError, FarMove, SetupError};
use crate::immersion::{BendingPart, NoAngle, PinError};
use crate::metric::{MetricError, MetricPart, NoMetric};
use crate::scene::{Scene, SceneError};
use crate::spin::SpinError;

impl Scene {
    /// Shows why a simulation cannot start where the scene says what is at fault.
    pub fn setup_fault(&self, error: &SetupError) -> SceneError {
        match error {
            SetupError::Metric(no_metric) => self.metric_fault(&self.metric_key(no_metric), &no_metric.error),
            SetupError::Spin(error) => self.spin_fault(error),
            SetupError::Pin(error) => self.pin_fault(error),
            SetupError::Bending(error) => self.complain_about(&bending_key(error), error),
            SetupError::Surface(_) => self.complain_about("mesh", error),
            SetupError::StartCount { .. } | SetupError::StartPlace { .. } => self.complain_about("start", error),
            SetupError::Shell(_) => self.complain_about("bending", error),
            SetupError::Pass(_) => self.complain_about("clock.both_ways", error),
            SetupError::Poisson(_) => self.complain_about("metric", error),
        }
    }

    /// Shows why a simulation ended where the scene says what is at fault, if it does.
    pub fn fault(&self, error: &EvolveError) -> Option<SceneError> {
        Some(match error {
            EvolveError::Metric(no_metric) => {
                let key = self.metric_key(no_metric);
                let inner = self.metric_fault(&key, &no_metric.error);
                SceneError { reason: no_metric.reason(), ..inner }
            }
            EvolveError::Pin(error) => self.pin_fault(error),
            EvolveError::Bending(error) => self.complain_about(&bending_key(error), error),
            EvolveError::Folds { .. } => self.complain_about("clock.fold", error),
            EvolveError::Pass { .. } => self.complain_about("clock.both_ways", error),
            EvolveError::TooFar { what: FarMove::Pin { .. }, .. } => self.complain_about("pin", error),
            EvolveError::TooFar { what: FarMove::Edge { .. }, .. } => self.complain_about("clock.max_strain", error),
            _ => return None,
        })
    }

    /// A fault of edge lengths that the table at a key is to blame for, or a region in it.
    pub(super) fn metric_fault(&self, key: &str, error: &MetricError) -> SceneError {
        match error {
            MetricError::TargetRegion { region, .. } => self.complain_about(&format!("{key}.region[{region}]"), error),
            _ => self.complain_about(key, error),
        }
    }

    fn metric_key(&self, error: &NoMetric) -> String {
        match error.part {
            MetricPart::Lengths if self.metric.files.is_some() => "metric.files".into(),
            MetricPart::Lengths if self.metric.keys.is_empty() => "metric".into(),
            MetricPart::Lengths => "metric.key".into(),
            MetricPart::Change(number) => format!("metric.change[{number}]"),
        }
    }

    fn pin_fault(&self, error: &PinError) -> SceneError {
        let key = error.group().map_or_else(|| "pin".to_owned(), |group| format!("pin[{group}]"));
        self.complain_about(&key, error)
    }

    fn spin_fault(&self, error: &SpinError) -> SceneError {
        let complaint = self.complain_about("spin.class", error);
        match error {
            SpinError::NoPositions => {
                SceneError { reason: "class = \"immersion\" needs vertex positions".into(), ..complaint }
            }
            _ => complaint,
        }
    }
}

fn bending_key(error: &NoAngle) -> String {
    match error.part {
        BendingPart::Amount => "bending.amount".into(),
        BendingPart::Region(number) => format!("bending.region[{number}].angle"),
    }
}
