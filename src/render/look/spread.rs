//! Which of the values of a field pictures show.

use crate::immersion::FieldName;

/// How the values of a field are spread, over as many frames as are added, in little memory.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldSpread {
    extremes: [f32; 2],
    /// Numbers of absolute values by their first 16 bits: the sign, which is 0, the exponent and 7 digits.
    counts: Vec<u64>,
    finite: u64,
}

impl Default for FieldSpread {
    fn default() -> Self {
        Self { extremes: [f32::INFINITY, f32::NEG_INFINITY], counts: vec![0; 1 << 15], finite: 0 }
    }
}

/// Share of the values that the usual range takes in: a few spikes would leave all others one colour.
const SHOWN: f64 = 0.98;

impl FieldSpread {
    /// Adds the values of a frame. Those that are not finite do not count.
    pub fn add(&mut self, values: &[f32]) {
        for &value in values.iter().filter(|value| value.is_finite()) {
            self.extremes = [self.extremes[0].min(value), self.extremes[1].max(value)];
            self.counts[(value.abs().to_bits() >> 16) as usize] += 1;
            self.finite += 1;
        }
    }

    /// Adds all the values that were added to another.
    pub fn merge(&mut self, other: &FieldSpread) {
        self.extremes = [self.extremes[0].min(other.extremes[0]), self.extremes[1].max(other.extremes[1])];
        self.counts.iter_mut().zip(&other.counts).for_each(|(count, more)| *count += more);
        self.finite += other.finite;
    }

    /// The least and the greatest value; `None` if there was none.
    pub fn extremes(&self) -> Option<[f32; 2]> {
        (self.finite > 0).then_some(self.extremes)
    }

    /// The values to show at the ends of a colour map: from 0 to what 98 % of the values stay below, rounded up to a
    /// number that reads well; for fields with a sign, from minus that to that; for numbers of things, from 0 to the
    /// last one.
    pub fn range(&self, field: FieldName) -> [f32; 2] {
        match field {
            // Where all lengths are exact the map ends at one per cent.
            FieldName::LengthError => [0.0, self.bound_or(0.01 * ROUNDING, 0.01)],
            FieldName::BendingAngle => [0.0, self.bound(ROUNDING)],
            FieldName::EnergyDensity => [0.0, self.bound(ROUNDING * ROUNDING)],
            FieldName::ConformalFactor => [-self.bound(ROUNDING), self.bound(ROUNDING)],
            // Curvatures are small in small units; that of what is flat is 0.
            FieldName::GaussianCurvature | FieldName::MeanCurvature => {
                [-self.bound(f32::MIN_POSITIVE), self.bound(f32::MIN_POSITIVE)]
            }
            FieldName::Generators => [0.0, self.extremes().map_or(1.0, |[_, last]| last.max(1.0))],
        }
    }

    /// The first of 1, 1.2, 1.5, 2, … times a power of ten that is not below most absolute values; 1 if all are less than
    /// the least one that means anything.
    fn bound(&self, least: f32) -> f32 {
        self.bound_or(least, 1.0)
    }

    /// The same, with another number in place of 1.
    fn bound_or(&self, least: f32, otherwise: f32) -> f32 {
        let wanted = (self.finite as f64 * SHOWN).ceil() as u64;
        let mut below = 0;
        let bin = self.counts.iter().position(|count| {
            below += count;
            below >= wanted
        });
        let greatest = self.extremes().map_or(0.0, |[least, greatest]| greatest.max(-least));
        // Everything in the bin is below the next one.
        let bound = bin.map_or(0.0, |bin| f32::from_bits((bin as u32 + 1) << 16)).min(greatest);
        if bound < least { otherwise } else { read_well_above(f64::from(bound)) as f32 }
    }
}

/// Numbers without a unit that are the rounding of 0.
const ROUNDING: f32 = 1e-12;

fn read_well_above(value: f64) -> f64 {
    let decade = libm::pow(10.0, libm::log10(value).floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    // 0.3 in single precision is a little more than 0.3.
    let step = steps.into_iter().find(|step| step * decade >= value * (1.0 - 1e-6)).unwrap_or(10.0);
    step * decade
}
