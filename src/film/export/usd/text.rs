//! Numbers, points and samples of time as USD writes them.

use std::fmt::Write;

use glam::{DAffine3, DVec3, Vec3};

/// The shortest text that gives the same number in single precision.
pub(super) fn number(text: &mut String, x: f32) {
    if !x.is_finite() {
        text.push_str(if x.is_nan() {
            "nan"
        } else if x > 0.0 {
            "inf"
        } else {
            "-inf"
        });
        return;
    }
    let start = text.len();
    text.push_str(zmij::Buffer::new().format_finite(x));
    if text.ends_with(".0") && text.len() > start + 2 {
        text.truncate(text.len() - 2);
    }
}

/// `[1, 2]`
pub(super) fn numbers(values: impl IntoIterator<Item = f32>) -> String {
    list(values, 14, number)
}

/// `[(1, 2, 3)]`
pub(super) fn points(points: impl IntoIterator<Item = Vec3>) -> String {
    list(points, 40, |text, point| {
        text.push('(');
        number(text, point.x);
        text.push_str(", ");
        number(text, point.y);
        text.push_str(", ");
        number(text, point.z);
        text.push(')');
    })
}

/// As [`points`], of double precision.
pub(super) fn places(places: impl IntoIterator<Item = DVec3>) -> String {
    points(places.into_iter().map(|place| place.as_vec3()))
}

/// `[1, 2]`, of whole numbers.
pub(super) fn integers(values: impl IntoIterator<Item = usize>) -> String {
    list(values, 8, |text, value| {
        let _ = write!(text, "{value}");
    })
}

/// A transformation as a matrix whose rows are where the axes go, and the origin.
pub(super) fn matrix(of: DAffine3) -> String {
    let row = |v: DVec3, w: u8| format!("({:?}, {:?}, {:?}, {w})", v.x, v.y, v.z);
    let axes = of.matrix3;
    format!("( {}, {}, {}, {} )", row(axes.x_axis, 0), row(axes.y_axis, 0), row(axes.z_axis, 0), row(of.translation, 1))
}

/// The value of an attribute at a frame.
pub(super) fn sample(frame: usize, mut value: String) -> Vec<u8> {
    value.insert_str(0, &format!("            {frame}: "));
    value.push_str(",\n");
    value.into_bytes()
}

/// A list of values of about so many letters each.
fn list<T>(values: impl IntoIterator<Item = T>, letters: usize, mut write: impl FnMut(&mut String, T)) -> String {
    let values = values.into_iter();
    let mut text = String::with_capacity(64 + values.size_hint().0 * letters);
    text.push('[');
    for (k, value) in values.enumerate() {
        if k > 0 {
            text.push_str(", ");
        }
        write(&mut text, value);
    }
    text.push(']');
    text
}

/// A name for a prim: letters, digits and underscores.
pub(super) fn identifier(name: &str) -> String {
    let fits = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = name.chars().map(fits).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("film_{name}") }
}

/// A text in quotes.
pub(super) fn quoted(text: &str) -> String {
    format!("{:?}", text.chars().filter(|c| c.is_ascii() && !c.is_control()).collect::<String>())
}
