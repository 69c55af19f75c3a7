//! Perceptual colour maps.

use std::{array, f32::consts::TAU, sync::LazyLock};

use glam::Vec3;

use super::color::linear_from_srgb;
use crate::immersion::FieldName;

/// Perceptual colour maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorMap {
    /// From dark blue over green to yellow.
    Viridis,
    /// From black over red to pale yellow.
    Inferno,
    /// From dark blue over grey to yellow, for the colour-blind.
    Cividis,
    /// From blue over white to red, for values with a sign.
    Diverging,
    /// Once around the hues, for angles.
    Cyclic,
    /// Distinct colours, for numbers that name things.
    Categorical,
}

/// Entries of a table; their number is odd, so that one lies exactly in the middle.
const ENTRIES: usize = 257;

type Table = [Vec3; ENTRIES];

static VIRIDIS: LazyLock<Table> = LazyLock::new(|| of_gradient(colorous::VIRIDIS));
static INFERNO: LazyLock<Table> = LazyLock::new(|| of_gradient(colorous::INFERNO));
static CIVIDIS: LazyLock<Table> = LazyLock::new(|| of_gradient(colorous::CIVIDIS));
static DIVERGING: LazyLock<Table> = LazyLock::new(|| table(diverging));
static CYCLIC: LazyLock<Table> =
    LazyLock::new(|| table(|place| in_gamut(CYCLIC_LIGHTNESS, CYCLIC_CHROMA, place * TAU)));
static CATEGORIES: LazyLock<[Vec3; 10]> = LazyLock::new(|| {
    // The tenth of the ten is grey, and stands for nothing.
    array::from_fn(|k| linear_from_srgb(colorous::TABLEAU10[(k + 9) % 10].as_array()))
});

impl ColorMap {
    /// All of them by the names.
    pub const ALL: [(&'static str, ColorMap); 6] = [
        ("viridis", ColorMap::Viridis),
        ("inferno", ColorMap::Inferno),
        ("cividis", ColorMap::Cividis),
        ("diverging", ColorMap::Diverging),
        ("cyclic", ColorMap::Cyclic),
        ("categorical", ColorMap::Categorical),
    ];

    /// Its name, as in `viridis`.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, map)| *map == self).map_or("", |(name, _)| name)
    }

    /// A map that suits a field: diverging for values with a sign, categorical for numbers of things.
    pub fn suiting(field: FieldName) -> ColorMap {
        match field {
            FieldName::LengthError | FieldName::BendingAngle => ColorMap::Viridis,
            FieldName::EnergyDensity => ColorMap::Inferno,
            FieldName::GaussianCurvature | FieldName::MeanCurvature | FieldName::ConformalFactor => ColorMap::Diverging,
            FieldName::Generators => ColorMap::Categorical,
        }
    }

    /// Linear light of a value, where `range` are the values at the ends of the map. Values outside have the colours of
    /// the ends; those of the cyclic map go on around. The categorical map has no range: a value n has the n-th of nine
    /// colours, which then repeat, and 0 is grey, as is what is not a number in any map.
    pub fn color(self, value: f32, range: [f32; 2]) -> Vec3 {
        if self == ColorMap::Categorical {
            return category(value);
        }
        let [low, high] = range;
        self.at(if high > low { (value - low) / (high - low) } else { value - low + 0.5 })
    }

    /// Linear light at a place from 0 to 1 between the ends of the map; places outside are those of the nearer end, or
    /// go on around in the cyclic map. The categorical map has its colours 0 to 9 there.
    pub fn at(self, place: f32) -> Vec3 {
        let table = match self {
            ColorMap::Viridis => &*VIRIDIS,
            ColorMap::Inferno => &*INFERNO,
            ColorMap::Cividis => &*CIVIDIS,
            ColorMap::Diverging => &*DIVERGING,
            ColorMap::Cyclic => &*CYCLIC,
            ColorMap::Categorical => return category((place * 9.0).clamp(0.0, 9.0)),
        };
        let place = if self == ColorMap::Cyclic { place - place.floor() } else { place.clamp(0.0, 1.0) };
        if place.is_nan() {
            return CATEGORIES[0];
        }
        let entry = place * (ENTRIES - 1) as f32;
        let below = (entry as usize).min(ENTRIES - 2);
        table[below].lerp(table[below + 1], entry - below as f32)
    }
}

fn category(value: f32) -> Vec3 {
    let number = value.round();
    if number >= 1.0 { CATEGORIES[1 + (number as usize - 1) % 9] } else { CATEGORIES[0] }
}

fn table(color: impl Fn(f32) -> Vec3) -> Table {
    array::from_fn(|entry| color(entry as f32 / (ENTRIES - 1) as f32))
}

fn of_gradient(gradient: colorous::Gradient) -> Table {
    array::from_fn(|entry| linear_from_srgb(gradient.eval_rational(entry, ENTRIES).as_array()))
}

/// Lightness at the ends of the diverging map, where white in the middle has 1: dark, but not black under light.
const END_LIGHTNESS: f32 = 0.5;
/// Chroma and hue (radians) at the ends: blue and red.
const ENDS: [[f32; 2]; 2] = [[0.14, 4.45], [0.19, 0.44]];
/// The most that all hues have at this lightness.
const CYCLIC_LIGHTNESS: f32 = 0.74;
const CYCLIC_CHROMA: f32 = 0.118;

/// Lightness falls evenly to both sides; chroma grows fast at first, so that signs are told apart near 0.
fn diverging(place: f32) -> Vec3 {
    let [chroma, hue] = ENDS[usize::from(place > 0.5)];
    let out = (2.0 * place - 1.0).abs();
    if out == 0.0 {
        return Vec3::ONE;
    }
    in_gamut(1.0 - (1.0 - END_LIGHTNESS) * out, chroma * libm::sinf(out * TAU / 4.0), hue)
}

/// Linear sRGB of a colour of the Oklab space in polar coordinates.
fn in_gamut(lightness: f32, chroma: f32, hue: f32) -> Vec3 {
    let (a, b) = (chroma * libm::cosf(hue), chroma * libm::sinf(hue));
    let cones = Vec3::new(
        lightness + 0.396_337_78 * a + 0.215_803_76 * b,
        lightness - 0.105_561_346 * a - 0.063_854_17 * b,
        lightness - 0.089_484_18 * a - 1.291_485_5 * b,
    );
    let cubes = cones * cones * cones;
    Vec3::new(
        cubes.dot(Vec3::new(4.076_741_7, -3.307_711_6, 0.230_969_94)),
        cubes.dot(Vec3::new(-1.268_438, 2.609_757_4, -0.341_319_38)),
        cubes.dot(Vec3::new(-0.004_196_086, -0.703_418_6, 1.707_614_7)),
    )
    .clamp(Vec3::ZERO, Vec3::ONE)
}
