//! Parameters, formulas, and numbers that change with time.

use std::sync::Arc;

use crate::scene::{NumberSection, Scene, SceneError};
use crate::timeline::{Formula, Keyframes, Number, Parameters, PointFormula, TimelineError};

impl Scene {
    /// The `[parameters]`, in their order.
    ///
    /// # Errors
    /// At the parameter that is at fault.
    pub fn parameters(&self) -> Result<Arc<Parameters>, SceneError> {
        let mut parameters = Arc::new(Parameters::default());
        for (name, section) in &self.parameters {
            let complain = |error: TimelineError| self.complain_about(&format!("parameters.{name}"), &error);
            // Before its value, which may be wrong because of the name.
            parameters.check_name(name).map_err(complain)?;
            let number = number(section, &parameters).map_err(complain)?;
            Parameters::add(&mut parameters, name, number).map_err(complain)?;
        }
        Ok(parameters)
    }

    /// The number that stands at a key.
    pub(super) fn number(
        &self,
        key: &str,
        section: &NumberSection,
        parameters: &Arc<Parameters>,
    ) -> Result<Number, SceneError> {
        number(section, parameters).map_err(|error| self.complain_about(key, &error))
    }

    /// The formula that stands at a key, in variables of its own.
    ///
    /// # Errors
    /// At the key.
    pub fn formula(
        &self,
        key: &str,
        text: &str,
        variables: &[&str],
        parameters: &Arc<Parameters>,
    ) -> Result<Formula, SceneError> {
        Formula::parse(text, variables, parameters).map_err(|error| self.complain_about(key, &error))
    }

    /// The three formulas that stand at a key.
    pub(super) fn point_formula(
        &self,
        key: &str,
        texts: &[String; 3],
        parameters: &Arc<Parameters>,
    ) -> Result<PointFormula, SceneError> {
        PointFormula::parse(texts, parameters).map_err(|error| self.complain_about(key, &error))
    }
}

fn number(section: &NumberSection, parameters: &Arc<Parameters>) -> Result<Number, TimelineError> {
    Ok(match section {
        NumberSection::Constant(value) => Number::Constant(*value),
        NumberSection::Formula(text) => Number::Formula(Formula::parse(text, &[], parameters)?),
        NumberSection::Keyframes { times, values, ease, extrapolation } => {
            Number::Keyframes(Keyframes::new(times.clone(), values.clone(), *ease, *extrapolation)?)
        }
    })
}
