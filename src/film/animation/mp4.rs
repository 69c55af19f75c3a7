//! H.264 video in an MP4 file.

use std::{
    fs::File,
    io::{BufWriter, Write},
};

use muxide::api::{Muxer, MuxerBuilder, VideoCodec};
use openh264::{
    OpenH264API,
    encoder::{
        Complexity, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod, QpRange, RateControlMode, VuiConfig,
    },
    formats::YUVSlices,
};
use rayon::prelude::*;

use super::draft::Draft;
use super::reeling::{Animation, Reeling};
use crate::film::error::FilmError;
use crate::render::Metadata;
use crate::scene::OutputSection;

pub(super) struct Mp4 {
    encoder: Encoder,
    muxer: Muxer<BufWriter<File>>,
    reeling: Reeling,
    pushed: usize,
    draft: Draft,
}

/// Fine enough that smooth shading shows no steps.
const QUANTIZATION: [u8; 2] = [16, 18];

impl Mp4 {
    /// Video has an even number of columns and rows: of odd pictures the last ones are left out.
    pub fn begin(draft: Draft, reeling: Reeling) -> Result<Mp4, FilmError> {
        let Reeling { width, height, rate, .. } = reeling;
        let (even_width, even_height) = (width & !1, height & !1);
        if !OutputSection::is_of_video(width, height) {
            let reason = "H.264 takes pictures from 2 x 2 to 3840 x 2160 pixels; choose another size";
            return Err(draft.error(format!("{width} x {height} pixels: {reason}")));
        }
        // The same quality throughout, however many bits it takes. Background detection would leave specks behind
        // what moves.
        let config = EncoderConfig::new()
            .max_frame_rate(FrameRate::from_hz(rate as f32))
            .rate_control_mode(RateControlMode::Bufferbased)
            .qp(QpRange::new(QUANTIZATION[0], QUANTIZATION[1]))
            .adaptive_quantization(false)
            .background_detection(false)
            .complexity(Complexity::High)
            .intra_frame_period(IntraFramePeriod::from_num_frames((rate.ceil() as u32).max(1)))
            .skip_frames(false)
            .scene_change_detect(false)
            .num_threads(1)
            .vui(VuiConfig::bt709());
        let encoder =
            Encoder::with_api_config(OpenH264API::from_source(), config).map_err(|error| draft.error(error))?;
        let muxer = MuxerBuilder::new(draft.writer()?)
            .video(VideoCodec::H264, even_width as u32, even_height as u32, rate)
            .build()
            .map_err(|error| draft.error(error))?;
        Ok(Mp4 { encoder, muxer, reeling, pushed: 0, draft })
    }
}

impl Animation for Mp4 {
    fn push(&mut self, pixels: &[u8]) -> Result<(), FilmError> {
        let Reeling { width, height, rate, .. } = self.reeling;
        let planes = Planes::of(pixels, width, height);
        let source = YUVSlices::new(
            (&planes.luma, &planes.blueness, &planes.redness),
            (planes.width, planes.height),
            (planes.width, planes.width / 2, planes.width / 2),
        );
        let stream = self.encoder.encode(&source).map_err(|error| self.draft.error(error))?;
        let whole = matches!(stream.frame_type(), FrameType::IDR | FrameType::I);
        let time = self.pushed as f64 / rate;
        self.pushed += 1;
        self.muxer.write_video(time, &stream.to_vec(), whole).map_err(|error| self.draft.error(error))
    }

    fn finish(self: Box<Self>) -> Result<(), FilmError> {
        let Mp4 { mut muxer, draft, .. } = *self;
        muxer.finish_in_place().map_err(|error| draft.error(error))?;
        let mut writer = muxer.into_writer();
        // Who made it, in a box that players skip.
        let comment = Metadata::SOFTWARE;
        let length = (8 + comment.len() as u32).to_be_bytes();
        let free_box = [&length[..], b"free", comment.as_bytes()].concat();
        writer.write_all(&free_box).and_then(|()| writer.flush()).map_err(|error| draft.error(error))?;
        draft.publish()
    }
}

/// A picture as video has it (Rec. 709, limited range): colour at every second pixel of every second row.
struct Planes {
    width: usize,
    height: usize,
    luma: Vec<u8>,
    blueness: Vec<u8>,
    redness: Vec<u8>,
}

impl Planes {
    fn of(pixels: &[u8], columns: usize, rows: usize) -> Planes {
        let (width, height) = (columns & !1, rows & !1);
        let color = |x: usize, y: usize| {
            let at = 3 * (y * columns + x);
            [pixels[at], pixels[at + 1], pixels[at + 2]].map(|value| f32::from(value) / 255.0)
        };
        let luma = |[red, green, blue]: [f32; 3]| 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        let byte = |value: f32| (value + 0.5) as u8;
        // Mean colour of each square of four pixels, as differences from its luma.
        let colors: Vec<[u8; 2]> = (0..width * height / 4)
            .into_par_iter()
            .map(|index| {
                let (x, y) = (2 * (index % (width / 2)), 2 * (index / (width / 2)));
                let four = [color(x, y), color(x + 1, y), color(x, y + 1), color(x + 1, y + 1)];
                let mean = [0, 1, 2].map(|axis| four.iter().map(|color| color[axis]).sum::<f32>() / 4.0);
                let gray = luma(mean);
                [byte(128.0 + 224.0 * (mean[2] - gray) / 1.8556), byte(128.0 + 224.0 * (mean[0] - gray) / 1.5748)]
            })
            .collect();
        Planes {
            width,
            height,
            luma: (0..width * height)
                .into_par_iter()
                .map(|index| byte(16.0 + 219.0 * luma(color(index % width, index / width))))
                .collect(),
            blueness: colors.iter().map(|color| color[0]).collect(),
            redness: colors.iter().map(|color| color[1]).collect(),
        }
    }
}
