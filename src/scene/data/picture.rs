//! Camera, lights and output.

use crate::immersion::FieldName;
use crate::timeline::Ease;

/// `[camera]`: everything left out frames the surface by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSection {
    /// Direction from the surface to the eye; left out, the best view along the principal axes.
    pub direction: Option<[f64; 3]>,
    /// Up in the picture.
    pub up: Option<[f64; 3]>,
    /// Vertical field of view in degrees; 0 is orthographic.
    pub field_of_view: Option<f64>,
    /// Share of the picture the surface fills, 0 to 1.
    pub fill: Option<f64>,
    /// What is in the middle of the picture; left out, the middle of the surface over the whole film.
    pub target: Option<[f64; 3]>,
    /// Degrees that the eye goes round `up` from the first frame to one past the last.
    pub turntable: f64,
    /// Places of the eye at some times; left out values are those above.
    pub keys: Vec<CameraKeySection>,
    /// How the eye moves from key to key.
    pub ease: Ease,
    /// Share of the time between two frames for which the shutter is open; 0 is no motion blur.
    pub shutter: f64,
    /// Pictures that are averaged into one while the shutter is open.
    pub shutter_samples: usize,
    /// What the camera is set up to see.
    pub framed: Framed,
}

/// What a camera is set up to see.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Framed {
    /// All frames of the film.
    #[default]
    Film,
    /// The first frame, so that pictures can be made before the last one is computed.
    First,
}

impl Default for CameraSection {
    fn default() -> Self {
        Self {
            direction: None,
            up: None,
            field_of_view: None,
            fill: None,
            target: None,
            turntable: 0.0,
            keys: Vec::new(),
            ease: Ease::default(),
            shutter: 0.0,
            shutter_samples: 8,
            framed: Framed::Film,
        }
    }
}

/// `[[camera.key]]`
#[derive(Clone, Debug, PartialEq, Default)]
pub struct CameraKeySection {
    /// When, in the units of the clock.
    pub time: f64,
    /// Degrees round `up` from the direction of the film (orbit).
    pub orbit: f64,
    /// Degrees up from it.
    pub rise: f64,
    /// Factor on the distance (perspective) or the height (orthographic) of the picture (dolly).
    pub dolly: f64,
    /// What is in the middle of the picture then.
    pub target: Option<[f64; 3]>,
}

/// `[[light]]`: a directional light in view space.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSection {
    /// Toward the light; x right, y up, z toward the eye.
    pub direction: [f64; 3],
    /// Linear colour times strength.
    pub color: [f64; 3],
    /// Whether it casts shadows.
    pub shadow: bool,
}

/// `[output]`
#[derive(Clone, Debug, PartialEq)]
pub struct OutputSection {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Samples per pixel: 1, 4, 8 or 16.
    pub samples: usize,
    /// PNG pictures.
    pub png: bool,
    /// EXR pictures.
    pub exr: bool,
    /// Bits per channel of PNG pictures: 8 or 16.
    pub depth: usize,
    /// The part of the picture that is made, in pixels from the upper left corner: x, y, width, height.
    pub crop: Option<[usize; 4]>,
    /// A moving picture of the whole film beside the frames.
    pub animation: Vec<AnimationFormat>,
    /// Frames a second of moving pictures.
    pub frame_rate: f64,
    /// A contact sheet of so many frames beside the frames; 0 is none.
    pub sheet: usize,
    /// Fields of which every EXR picture has a layer.
    pub fields: Vec<FieldName>,
    /// Formats in which the film is written for other programs.
    pub export: Vec<ExportFormat>,
    /// Whether a run ends with a page of the film.
    pub report: bool,
}

/// What a film can be exported as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExportFormat {
    /// Universal Scene Description: the film with its camera and lights, in one text file.
    Usd,
    /// For ParaView: a `.vtu` of each frame and the `.pvd` that lists them.
    Vtk,
    /// glTF 2.0, binary: one file with morph targets, for browsers.
    Gltf,
    /// A point cache and the OBJ file that it moves.
    Pc2,
    /// A PLY file of each frame, with colours and fields.
    Ply,
    /// An OBJ file of each frame.
    Obj,
    /// FOLD 1.2: edge lengths and fold angles, all frames in one file.
    Fold,
    /// Arrays of NumPy of each frame, with all fields.
    Npz,
}

impl ExportFormat {
    /// All of them by their names.
    pub const ALL: [(&'static str, ExportFormat); 8] = [
        ("usd", ExportFormat::Usd),
        ("vtk", ExportFormat::Vtk),
        ("gltf", ExportFormat::Gltf),
        ("pc2", ExportFormat::Pc2),
        ("ply", ExportFormat::Ply),
        ("obj", ExportFormat::Obj),
        ("fold", ExportFormat::Fold),
        ("npz", ExportFormat::Npz),
    ];

    /// Its name, as in `usd`.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, format)| *format == self).map_or("", |(name, _)| name)
    }
}

/// Files that show a whole film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationFormat {
    /// 256 colours a frame.
    Gif,
    /// Animated PNG.
    Apng,
    /// H.264; needs the feature `mp4`.
    Mp4,
}

impl OutputSection {
    /// The least width and height of H.264 video in pixels, and the most, whichever of the two is longer.
    pub const VIDEO_SIDES: [[usize; 2]; 2] = [[2, 2], [3840, 2160]];

    /// Whether there can be video of pictures of this width and height.
    pub fn is_of_video(width: usize, height: usize) -> bool {
        let [[least, _], [long, short]] = OutputSection::VIDEO_SIDES;
        width.min(height) >= least && width.max(height) <= long && width.min(height) <= short
    }
}

impl Default for OutputSection {
    fn default() -> Self {
        Self {
            size: [1280, 960],
            samples: 8,
            png: true,
            exr: false,
            depth: 8,
            crop: None,
            animation: Vec::new(),
            frame_rate: 24.0,
            sheet: 0,
            fields: Vec::new(),
            export: Vec::new(),
            report: true,
        }
    }
}
