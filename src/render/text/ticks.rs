//! Round numbers along a scale.

/// Places on a scale and what is written there.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Values from the least to the greatest, both ends included, with their text.
    pub marks: Vec<(f64, String)>,
    /// The numbers that are written have to be multiplied by this power of ten.
    pub exponent: i32,
}

/// Intervals between round numbers.
const INTERVALS: f64 = 6.0;
/// Round numbers nearer to an end than this share of an interval give way to it.
const ROOM: f64 = 0.4;

impl Ticks {
    /// The ends of a finite range and the multiples of 1, 2 or 5 times a power of ten between them.
    pub fn new([low, high]: [f64; 2]) -> Ticks {
        let largest = low.abs().max(high.abs());
        let span = high - low;
        if !(span > 0.0 && span.is_finite()) {
            return Ticks { marks: vec![(low, number(low, 3))], exponent: 0 };
        }
        // A hundredth in single precision is a little less than one.
        let exponent = match libm::log10(largest * (1.0 + 1e-6)).floor() as i32 {
            -2..=3 => 0,
            exponent => exponent,
        };
        let unit = libm::pow(10.0, f64::from(exponent));
        let step = round_step(span / unit);
        let mut decimals = (-libm::log10(step)).ceil().max(0.0) as usize;
        // Ends that are no multiples get up to two digits more.
        let is_rough = |value: f64, decimals: usize| {
            let scale = libm::pow(10.0, decimals as f64);
            ((value / unit * scale).round() / scale - value / unit).abs() > 5e-3 * step
        };
        for _ in 0..2 {
            decimals += usize::from(is_rough(low, decimals) || is_rough(high, decimals));
        }
        let (first, last) = ((low / unit / step).ceil() as i64, (high / unit / step).floor() as i64);
        let room = ROOM * step * unit;
        let inner =
            (first..=last).map(|k| k as f64 * step * unit).filter(|value| value - low > room && high - value > room);
        let values = [low].into_iter().chain(inner).chain([high]);
        Ticks { marks: values.map(|value| (value, number(value / unit, decimals))).collect(), exponent }
    }
}

/// The least of 1, 2, 5 times a power of ten that divides a span into few enough intervals.
fn round_step(span: f64) -> f64 {
    let least = span / INTERVALS;
    let decade = libm::pow(10.0, libm::log10(least).floor());
    [1.0, 2.0, 5.0].into_iter().map(|k| k * decade).find(|step| *step >= least * (1.0 - 1e-6)).unwrap_or(10.0 * decade)
}

/// With a true minus sign, and none at 0.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().any(|digit| (b'1'..=b'9').contains(&digit)) => format!("\u{2212}{digits}"),
        Some(digits) => digits.to_owned(),
        None => text,
    }
}

/// A whole number in superscripts.
pub fn superscript(number: i32) -> String {
    let raised = |character: char| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(digit),
    };
    number.to_string().chars().map(raised).collect()
}
