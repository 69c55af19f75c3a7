//! Camera, lights, look and output.

/// `[camera]`: everything left out frames the surface by itself.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct CameraSection {
    /// Direction from the surface to the eye; left out, the best view along the principal axes.
    pub direction: Option<[f64; 3]>,
    /// Up in the picture.
    pub up: Option<[f64; 3]>,
    /// Vertical field of view in degrees; 0 is orthographic.
    pub field_of_view: Option<f64>,
    /// Share of the picture the surface fills, 0 to 1.
    pub fill: Option<f64>,
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

/// `[look]`
#[derive(Clone, Debug, PartialEq)]
pub struct LookSection {
    /// sRGB of the side the normal points from.
    pub front: [u8; 3],
    /// sRGB of the other side.
    pub back: [u8; 3],
    /// sRGB behind the surface.
    pub background: [u8; 3],
    /// Strength of the mesh edges, 0 to 1.
    pub wireframe: f64,
    /// Whether silhouettes, boundary and rims are drawn.
    pub lines: bool,
}

impl Default for LookSection {
    fn default() -> Self {
        Self {
            front: [0xE0, 0x82, 0x3D],
            back: [0x3E, 0x7C, 0xB8],
            background: [0xF4, 0xF3, 0xF0],
            wireframe: 0.0,
            lines: true,
        }
    }
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
}

impl Default for OutputSection {
    fn default() -> Self {
        Self { size: [1280, 960], samples: 8, png: true, exr: false }
    }
}
