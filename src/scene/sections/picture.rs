//! `[camera]`, `[[light]]` and `[output]`.

use crate::scene::data::{
    AnimationFormat, CameraKeySection, CameraSection, ExportFormat, Framed, LightSection, OutputSection,
};
use crate::scene::keys::Table;
use crate::scene::keys::ease;
use crate::{
    immersion::FieldName,
    render::{Output, Png, View},
};

pub(super) fn camera(table: &mut Table) -> CameraSection {
    let camera = CameraSection {
        direction: table
            .key("direction", "From the surface to the eye; left out, the best view along the principal axes.")
            .optional([1.0, 0.5, 2.0]),
        up: table
            .key("up", "What points up in the picture; left out, what suits the view, z for what is round.")
            .optional([0.0, 1.0, 0.0]),
        field_of_view: table
            .key("field_of_view", "Angle of view from bottom to top, in degrees; 0 is orthographic.")
            .at_least(0.0)
            .at_most(View::WIDEST_DEGREES)
            .optional(30.0),
        fill: table
            .key("fill", "Share of the picture the surface fills.")
            .at_least(View::FILLS[0])
            .at_most(View::FILLS[1])
            .optional(0.8),
        target: table
            .key("target", "What is in the middle of the picture; left out, the middle of the surface.")
            .optional([0.0, 0.0, 0.0]),
        turntable: table
            .key("turntable", "Degrees that the eye goes round `up` from the first frame to one past the last.")
            .or(0.0),
        keys: table.tables("key", "A place of the eye at a time.", camera_key),
        ease: ease(table),
        shutter: table
            .key("shutter", "Share of the time between frames for which the shutter is open; 0 is no motion blur.")
            .at_least(0.0)
            .at_most(1.0)
            .or(0.0),
        shutter_samples: table
            .key("shutter_samples", "Pictures averaged into one while the shutter is open.")
            .at_least(1.0)
            .at_most(64.0)
            .or(8),
        framed: table.choice_or(
            "framed",
            "What the picture has room for: all of the \"film\", or its \"first\" frame, so that pictures \
                 are made while the simulation goes on, unless colours wait for their range.",
            &[("film", Framed::Film), ("first", Framed::First)],
            Framed::default(),
        ),
    };
    not_zero(table, "direction", camera.direction);
    not_zero(table, "up", camera.up);
    if camera.keys.windows(2).any(|pair| pair[0].time >= pair[1].time) {
        table.complain("key", "the times of the keys do not grow", "write keys in the order of their times");
    }
    camera
}

fn camera_key(table: &mut Table) -> CameraKeySection {
    CameraKeySection {
        time: table.key("time", "The time at which the eye is there.").required(0.0),
        orbit: table.key("orbit", "Degrees round `up` from the direction of the film.").or(0.0),
        rise: table
            .key("rise", "Degrees that it is lifted from there toward `up`.")
            .at_least(-180.0)
            .at_most(180.0)
            .or(0.0),
        dolly: table.key("dolly", "Factor on the distance of the eye: less than 1 is nearer.").above(0.0).or(1.0),
        target: table.key("target", "What is in the middle of the picture.").optional([0.0, 0.0, 0.0]),
    }
}

pub(super) fn not_zero(table: &Table, name: &str, vector: Option<[f64; 3]>) {
    if vector == Some([0.0; 3]) {
        let reason = format!("`{name}` is the zero vector, which points nowhere");
        table.complain(name, reason, format!("write for example {name} = [0, 1, 0]"));
    }
}

pub(super) fn light(table: &mut Table) -> LightSection {
    let light = LightSection {
        direction: table
            .key("direction", "Toward the light, in the picture: x right, y up, z toward the eye.")
            .required([-0.5, 1.0, 1.0]),
        color: table
            .key("color", "Red, green and blue of the light, linear, times its strength; [1, 1, 1] is white.")
            .at_least(0.0)
            .or([1.0; 3]),
        shadow: table.key("shadow", "Whether it casts shadows.").or(true),
    };
    not_zero(table, "direction", Some(light.direction));
    light
}

pub(super) fn output(table: &mut Table) -> OutputSection {
    let default = OutputSection::default();
    let size = table
        .key("size", "Width and height in pixels.")
        .at_least(1.0)
        .at_most(Output::LONGEST_SIDE as f64)
        .or(default.size);
    let samples = table.key("samples", "Samples per pixel: 1, 4, 8 or 16.").or(default.samples);
    if !Output::SAMPLES.contains(&samples) {
        table.complain("samples", format!("`samples` is {samples}, it must be 1, 4, 8 or 16"), "write samples = 8");
    }
    let formats = table.choices("format", "Formats of the pictures.", &[("png", false), ("exr", true)], &[false]);
    let depth = table.key("depth", "Bits per channel of PNG pictures: 8 or 16.").or(default.depth);
    if !Png::DEPTHS.contains(&depth) {
        table.complain("depth", format!("`depth` is {depth}, it must be 8 or 16"), "write depth = 8");
    }
    let crop: Option<[usize; 4]> = table
        .key("crop", "The part of the picture that is made: x, y, width, height in pixels from the upper left.")
        .optional([0, 0, 640, 480]);
    if crop.is_some_and(|window| !Output::holds(size, window)) {
        let reason = format!("`crop` does not lie in the picture of {} x {} pixels", size[0], size[1]);
        table.complain("crop", reason, "write x, y, width and height of a part of it");
    }
    let animations = [("gif", AnimationFormat::Gif), ("apng", AnimationFormat::Apng), ("mp4", AnimationFormat::Mp4)];
    let animation = table.choices("animation", "Moving pictures of the whole film.", &animations, &[]);
    let [width, height] = crop.map_or(size, |[_, _, width, height]| [width, height]);
    if animation.contains(&AnimationFormat::Mp4) && !OutputSection::is_of_video(width, height) {
        let [[least, _], [long, short]] = OutputSection::VIDEO_SIDES;
        let reason = format!(
            "`animation` has \"mp4\", which takes pictures from {least} x {least} to {long} x {short} pixels, and these have \
             {width} x {height}"
        );
        table.complain("animation", reason, "choose another `size`, or another format");
    }
    OutputSection {
        size,
        samples,
        png: formats.contains(&false),
        exr: formats.contains(&true),
        depth,
        crop,
        animation,
        frame_rate: table
            .key("frame_rate", "Frames a second of moving pictures.")
            .above(0.0)
            .at_most(1000.0)
            .or(default.frame_rate),
        sheet: table.key("sheet", "Frames on a contact sheet of the film; 0 makes none.").at_most(400.0).or(0),
        fields: table.choices("fields", "Fields of which EXR pictures have a layer.", &FieldName::ALL, &[]),
        export: table.choices(
            "export",
            "Formats in which the film is written for other programs.",
            &ExportFormat::ALL,
            &[],
        ),
        report: table.key("report", "Whether `run` ends with a page of the film, `report.html`.").or(default.report),
    }
}
