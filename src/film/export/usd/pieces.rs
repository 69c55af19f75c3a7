//! What each frame adds to the attributes that change.

use glam::DVec3;

use super::text::{integers, matrix, number, numbers, places, points, sample};
use crate::film::export::camera::Pose;
use crate::film::export::subject::{Moment, Subject};
use crate::immersion::FieldName;

/// The attributes of which every frame has a piece, in the order of the pieces. Behind them come the fields.
#[derive(Clone, Copy)]
pub(super) enum Attribute {
    Points,
    Extent,
    Normals,
    Color,
    RimPoints,
    RimCounts,
    CrossingPoints,
    CrossingCounts,
    Boundary,
    Pins,
    Camera,
    ApertureAcross,
    ApertureUp,
}

/// How many attributes there are before the fields.
pub(super) const FIELDS: usize = 13;

/// Of a picture with perspective, in tenths of a length; what counts is its ratio to the focal length.
pub(super) const APERTURE: f64 = 24.0;

/// The pieces of a frame.
pub(super) fn of_frame(subject: &Subject, moment: &Moment) -> Vec<Vec<u8>> {
    let at = |v: u32| moment.positions[v as usize];
    let at_frame = |value: String| sample(moment.number, value);
    let counts = |count: usize| at_frame(integers(vec![2; count]));
    let pose = subject.camera.poses.get(moment.place);
    let of = |attribute: Attribute| match attribute {
        Attribute::Points => at_frame(places(moment.positions.iter().copied())),
        Attribute::Extent => at_frame(places(extent(&moment.positions))),
        Attribute::Normals => at_frame(points(moment.normals.iter().copied())),
        Attribute::Color => match &moment.colors {
            Some(painted) => at_frame(points(painted.colors.iter().copied())),
            None => Vec::new(),
        },
        Attribute::RimPoints => at_frame(places(moment.rims.iter().flatten().map(|&v| at(v)))),
        Attribute::RimCounts => counts(moment.rims.len()),
        Attribute::CrossingPoints => at_frame(places(moment.crossings.iter().flatten().copied())),
        Attribute::CrossingCounts => counts(moment.crossings.len()),
        Attribute::Boundary => at_frame(places(subject.boundary.iter().flatten().map(|&v| at(v)))),
        Attribute::Pins => at_frame(places(subject.pins.iter().map(|&v| at(v)))),
        Attribute::Camera => pose.map(|pose| at_frame(matrix(pose.world_from_eye))).unwrap_or_default(),
        Attribute::ApertureAcross => pose.map(|pose| at_frame(one(aperture(pose) * pose.aspect))).unwrap_or_default(),
        Attribute::ApertureUp => pose.map(|pose| at_frame(one(aperture(pose)))).unwrap_or_default(),
    };
    let mut pieces: Vec<Vec<u8>> = ALL.map(of).into();
    pieces.extend(moment.fields.iter().map(|(name, values)| match name {
        // Generators are the same in all frames.
        FieldName::Generators if moment.place == 0 => numbers(values.all().iter().copied()).into_bytes(),
        FieldName::Generators => Vec::new(),
        _ => at_frame(numbers(values.all().iter().copied())),
    }));
    pieces
}

const ALL: [Attribute; FIELDS] = [
    Attribute::Points,
    Attribute::Extent,
    Attribute::Normals,
    Attribute::Color,
    Attribute::RimPoints,
    Attribute::RimCounts,
    Attribute::CrossingPoints,
    Attribute::CrossingCounts,
    Attribute::Boundary,
    Attribute::Pins,
    Attribute::Camera,
    Attribute::ApertureAcross,
    Attribute::ApertureUp,
];

/// The height of the picture in tenths of a length, or of what stands for it.
fn aperture(pose: &Pose) -> f64 {
    if pose.is_perspective { APERTURE } else { 20.0 * pose.half_height }
}

fn one(value: f64) -> String {
    let mut text = String::new();
    number(&mut text, value as f32);
    text
}

/// Opposite corners of the box around points.
fn extent(points: &[DVec3]) -> [DVec3; 2] {
    [
        points.iter().copied().fold(DVec3::INFINITY, DVec3::min),
        points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max),
    ]
}
