//! The stage around the samples.

use glam::{Mat3, Vec3};

use super::pieces::{APERTURE, Attribute, FIELDS};
use super::text::{identifier, integers, number, points, quoted};
use crate::film::export::colors::Colors;
use crate::film::export::layout::{Mark, Part};
use crate::film::export::subject::{Subject, unit_in_words};
use crate::immersion::FieldName;

/// Widths of curves and points as shares of the size of the surface.
const CURVE: f64 = 0.002;
const DOT: f64 = 0.012;

const RIM: Vec3 = Vec3::new(0.75, 0.05, 0.05);
const CROSSING: Vec3 = Vec3::new(0.02, 0.02, 0.02);
const EDGE: Vec3 = Vec3::new(0.08, 0.08, 0.08);
const PIN: Vec3 = Vec3::new(0.05, 0.25, 0.75);

/// The file, with samples where they stand.
pub(super) fn parts(subject: &Subject, frames: &[Mark]) -> Vec<Part> {
    let mut stage = Writer::default();
    let name = identifier(&subject.name);
    let ends = [frames.first(), frames.last()].map(|mark| mark.map_or(1, |mark| mark.number));
    let up = if subject.camera.up.z.abs() > subject.camera.up.y.abs() { "Z" } else { "Y" };
    stage.text(&format!(
        "#usda 1.0\n(\n    defaultPrim = \"{name}\"\n    doc = {}\n    endTimeCode = {}\n    framesPerSecond = {rate}\n    \
         metersPerUnit = 1\n    startTimeCode = {}\n    timeCodesPerSecond = {rate}\n    upAxis = \"{up}\"\n)\n\n\
         def Xform \"{name}\" (\n    kind = \"component\"\n)\n{{\n",
        quoted(&subject.made_by),
        ends[1],
        ends[0],
        rate = subject.frame_rate,
    ));
    surface(&mut stage, subject, &name);
    curves(&mut stage, subject);
    eye(&mut stage, subject);
    stage.text("}\n");
    stage.parts
}

fn surface(stage: &mut Writer, subject: &Subject, name: &str) {
    let triangles = &subject.triangles;
    stage.text(&format!(
        "    def Mesh \"surface\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{\n        \
         uniform bool doubleSided = 1\n        uniform token orientation = \"rightHanded\"\n        \
         uniform token subdivisionScheme = \"none\"\n        int[] faceVertexCounts = {}\n        \
         int[] faceVertexIndices = {}\n        rel material:binding = </{name}/material>\n",
        integers(vec![3; triangles.len()]),
        integers(triangles.iter().flatten().map(|&v| v as usize)),
    ));
    stage.samples("point3f[] points", Attribute::Points as usize, "");
    stage.samples("float3[] extent", Attribute::Extent as usize, "");
    stage.samples("normal3f[] normals", Attribute::Normals as usize, "interpolation = \"vertex\"");
    let Colors { sides: [front, back], .. } = subject.colors;
    match subject.color_interpolation() {
        Some(interpolation) => {
            let metadata = format!("interpolation = \"{interpolation}\"");
            stage.samples("color3f[] primvars:displayColor", Attribute::Color as usize, &metadata);
        }
        None => {
            stage.text(&format!("        color3f[] primvars:displayColor = {} (\n", points([front])));
            stage.text("            interpolation = \"constant\"\n        )\n");
            stage.text(&format!("        color3f[] primvars:backColor = {} (\n", points([back])));
            stage.text("            doc = \"Colour of the side that the normals point away from.\"\n");
            stage.text("            interpolation = \"constant\"\n        )\n");
        }
    }
    for (k, (name, field)) in FieldName::ALL.into_iter().enumerate() {
        let interpolation = subject.interpolation(field);
        let doc = quoted(unit_in_words(field));
        let metadata = format!("doc = {doc}\n            interpolation = \"{interpolation}\"");
        let attribute = format!("float[] primvars:{name}");
        if field == FieldName::Generators {
            stage.text(&format!("        {attribute} = "));
            stage.parts.push(Part::Pieces(FIELDS + k));
            stage.text(&format!(" (\n            {metadata}\n        )\n"));
        } else {
            stage.samples(&attribute, FIELDS + k, &metadata);
        }
    }
    if subject.components.len() > 1 {
        stage.text("        uniform token subsetFamily:component:familyType = \"partition\"\n");
        for (number, faces) in (1..).zip(&subject.components) {
            stage.text(&format!(
                "\n        def GeomSubset \"component_{number}\"\n        {{\n            \
                 uniform token elementType = \"face\"\n            uniform token familyName = \"component\"\n            \
                 int[] indices = {}\n        }}\n",
                integers(faces.iter().map(|&f| f as usize))
            ));
        }
    }
    stage.text("    }\n\n");
    material(stage, subject, name);
}

/// What previews show: the colours of the surface.
fn material(stage: &mut Writer, subject: &Subject, name: &str) {
    let color = match subject.color_interpolation() {
        None => format!("color3f inputs:diffuseColor = {}", points([subject.colors.sides[0]]).trim_matches(['[', ']'])),
        Some(_) => format!("color3f inputs:diffuseColor.connect = </{name}/material/colors.outputs:result>"),
    };
    stage.text(&format!(
        "    def Material \"material\"\n    {{\n        token outputs:surface.connect = </{name}/material/preview.outputs:surface>\n\n        \
         def Shader \"preview\"\n        {{\n            uniform token info:id = \"UsdPreviewSurface\"\n            {color}\n            \
         float inputs:roughness = 0.6\n            token outputs:surface\n        }}\n\n        \
         def Shader \"colors\"\n        {{\n            uniform token info:id = \"UsdPrimvarReader_float3\"\n            \
         string inputs:varname = \"displayColor\"\n            float3 outputs:result\n        }}\n    }}\n"
    ));
}

fn curves(stage: &mut Writer, subject: &Subject) {
    let width = |share: f64| {
        let mut text = String::new();
        number(&mut text, (share * subject.size) as f32);
        text
    };
    let changing = [
        ("rims", RIM, Attribute::RimPoints, Attribute::RimCounts),
        ("self_intersections", CROSSING, Attribute::CrossingPoints, Attribute::CrossingCounts),
    ];
    for (name, color, points, counts) in changing {
        stage.curve(name, color, &width(CURVE), "nonperiodic");
        stage.samples("int[] curveVertexCounts", counts as usize, "");
        stage.samples("point3f[] points", points as usize, "");
        stage.text("    }\n");
    }
    if !subject.boundary.is_empty() {
        stage.curve("boundary", EDGE, &width(CURVE), "periodic");
        let counts = integers(subject.boundary.iter().map(Vec::len));
        stage.text(&format!("        int[] curveVertexCounts = {counts}\n"));
        stage.samples("point3f[] points", Attribute::Boundary as usize, "");
        stage.text("    }\n");
    }
    if !subject.pins.is_empty() {
        stage.text(&format!(
            "\n    def Points \"pins\"\n    {{\n        color3f[] primvars:displayColor = {}\n        float[] widths = [{}] (\n            \
             interpolation = \"constant\"\n        )\n",
            points([PIN]),
            width(DOT)
        ));
        stage.samples("point3f[] points", Attribute::Pins as usize, "");
        stage.text("    }\n");
    }
}

/// The camera, and the lights, which go with it.
fn eye(stage: &mut Writer, subject: &Subject) {
    let Some(first) = subject.camera.poses.first() else { return };
    let clipping = subject
        .camera
        .poses
        .iter()
        .fold(first.clipping, |[near, far], pose| [near.min(pose.clipping[0]), far.max(pose.clipping[1])]);
    let (projection, focal_length) = match first.is_perspective {
        true => ("perspective", APERTURE / (2.0 * first.half_height)),
        false => ("orthographic", 50.0),
    };
    stage.text(&format!(
        "\n    def Camera \"camera\"\n    {{\n        float2 clippingRange = ({:?}, {:?})\n        float focalLength = {:?}\n        \
         token projection = \"{projection}\"\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n",
        clipping[0] as f32, clipping[1] as f32, focal_length as f32
    ));
    stage.samples("float horizontalAperture", Attribute::ApertureAcross as usize, "");
    stage.samples("float verticalAperture", Attribute::ApertureUp as usize, "");
    stage.samples("matrix4d xformOp:transform", Attribute::Camera as usize, "");
    for (number, (direction, color)) in (1..).zip(&subject.camera.lights) {
        // It shines against its own z axis.
        let side = direction.any_orthonormal_vector();
        let turned = Mat3::from_cols(side, direction.cross(side), *direction).as_dmat3();
        let transform = super::text::matrix(glam::DAffine3::from_mat3(turned));
        let color = points([*color]);
        let color = color.trim_matches(['[', ']']);
        stage.text(&format!(
            "\n        def DistantLight \"light_{number}\"\n        {{\n            float inputs:angle = 4\n            \
             color3f inputs:color = {color}\n            float inputs:intensity = 3.1415927\n            \
             bool inputs:normalize = 1\n            matrix4d xformOp:transform = {transform}\n            \
             uniform token[] xformOpOrder = [\"xformOp:transform\"]\n        }}\n"
        ));
    }
    let sky = points([subject.camera.sky]);
    stage.text(&format!(
        "    }}\n\n    def DomeLight \"sky\"\n    {{\n        color3f inputs:color = {}\n        float inputs:intensity = 1\n    }}\n",
        sky.trim_matches(['[', ']'])
    ));
}

#[derive(Default)]
struct Writer {
    parts: Vec<Part>,
}

impl Writer {
    fn text(&mut self, text: &str) {
        match self.parts.last_mut() {
            Some(Part::Bytes(bytes)) => bytes.extend(text.as_bytes()),
            _ => self.parts.push(Part::Bytes(text.as_bytes().to_vec())),
        }
    }

    /// An attribute with a sample for each frame.
    fn samples(&mut self, attribute: &str, pieces: usize, metadata: &str) {
        if !metadata.is_empty() {
            self.text(&format!("        {attribute} (\n            {metadata}\n        )\n"));
        }
        self.text(&format!("        {attribute}.timeSamples = {{\n"));
        self.parts.push(Part::Pieces(pieces));
        self.text("        }\n");
    }

    /// The beginning of curves.
    fn curve(&mut self, name: &str, color: Vec3, width: &str, wrap: &str) {
        self.text(&format!(
            "\n    def BasisCurves \"{name}\"\n    {{\n        uniform token type = \"linear\"\n        uniform token wrap = \"{wrap}\"\n        \
             color3f[] primvars:displayColor = {}\n        float[] widths = [{width}] (\n            interpolation = \"constant\"\n        )\n",
            points([color])
        ));
    }
}
