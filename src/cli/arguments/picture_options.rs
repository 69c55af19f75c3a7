//! What the command line says of pictures in place of the scene.

use std::str::FromStr;

use clap::{Args, ValueEnum};

use super::frame_range::{FrameRange, FrameRangeError, number};
use super::names::one_of;
use crate::render::LookName;
use crate::scene::{AnimationFormat, LookSection, Scene};

/// Flags of `run` and `render`; what is left out is as the scene says.
#[derive(Args, Clone, Debug, Default)]
pub(in crate::cli) struct PictureOptions {
    /// Which frames become pictures, as in 1-20,30-240:4 [default: all]
    #[arg(long, value_name = "RANGE", help_heading = HEADING)]
    frames: Option<FrameRange>,
    /// A named look in place of the scene's [look]
    #[arg(long, value_name = "NAME", value_parser = one_of(&LookName::ALL), help_heading = HEADING)]
    look: Option<LookName>,
    /// Size of pictures in pixels, as in 1920x1080; makes whole pictures unless --crop is given
    #[arg(long, value_name = "WxH", help_heading = HEADING)]
    size: Option<Size>,
    /// Samples per pixel: 1, 4, 8 or 16
    #[arg(long, value_name = "N", value_parser = samples, help_heading = HEADING)]
    samples: Option<usize>,
    /// What is written in place of the scene's formats, several separated by commas
    #[arg(long, value_name = "FORMAT", value_delimiter = ',', help_heading = HEADING)]
    format: Vec<Format>,
    /// The part of the pictures that is made, as in 100,50,640x480: x and y of its upper left corner, and its size
    #[arg(long, value_name = "X,Y,WxH", help_heading = HEADING)]
    crop: Option<Crop>,
    /// Frames on a contact sheet of the film, sheet.png; 0 makes none
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=400), help_heading = HEADING)]
    sheet: Option<u16>,
}

const HEADING: &str = "Pictures";

impl PictureOptions {
    /// Writes what was typed into the scene, and gives the frames that are wanted.
    pub fn apply(&self, scene: &mut Scene) -> Result<Vec<usize>, FrameRangeError> {
        if let Some(preset) = self.look {
            // Colours and patterns of the scene would spoil another look, so nothing of its own stays.
            scene.look = LookSection { preset, ..LookSection::default() };
        }
        let output = &mut scene.output;
        if let Some(Size(size)) = self.size {
            output.size = size;
            output.crop = None;
        }
        if let Some(Crop(window)) = self.crop {
            output.crop = Some(window);
        }
        output.samples = self.samples.unwrap_or(output.samples);
        output.sheet = self.sheet.map_or(output.sheet, usize::from);
        if !self.format.is_empty() {
            output.png = self.format.contains(&Format::Png);
            output.exr = self.format.contains(&Format::Exr);
            output.animation = self.format.iter().filter_map(|format| format.animation()).collect();
            output.animation.dedup();
        }
        match &self.frames {
            Some(range) => range.frames(scene.clock.frames),
            None => Ok((1..=scene.clock.frames).collect()),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A picture of every frame
    Png,
    /// A picture of every frame in linear light, with layers
    Exr,
    /// The film with 256 colours
    Gif,
    /// The film as an animated PNG
    Apng,
    /// The film as H.264 video
    Mp4,
}

impl Format {
    fn animation(self) -> Option<AnimationFormat> {
        match self {
            Format::Png | Format::Exr => None,
            Format::Gif => Some(AnimationFormat::Gif),
            Format::Apng => Some(AnimationFormat::Apng),
            Format::Mp4 => Some(AnimationFormat::Mp4),
        }
    }
}

fn samples(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(samples) if [1, 4, 8, 16].contains(&samples) => Ok(samples),
        _ => Err("there is no such number of samples; write 1, 4, 8 or 16".into()),
    }
}

/// Width and height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Size([usize; 2]);

impl FromStr for Size {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let sides =
            text.split_once('x').and_then(|(width, height)| Some([number(width.trim())?, number(height.trim())?]));
        sides.map(Size).ok_or("this is no size; write width and height like 1920x1080")
    }
}

/// x, y, width and height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Crop([usize; 4]);

impl FromStr for Crop {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers: Option<Vec<usize>> =
            text.replace('x', ",").split(',').map(|digits| number(digits.trim())).collect();
        let window = numbers.and_then(|numbers| <[usize; 4]>::try_from(numbers).ok());
        window.map(Crop).ok_or("this is no part of a picture; write x, y, width and height like 100,50,640x480")
    }
}
