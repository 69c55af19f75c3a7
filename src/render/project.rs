//! From world space to the pixel grid: clipping, projection, and the depth plane of each triangle.

use glam::{DMat4, DVec3, DVec4};
use rayon::prelude::*;

use super::{Camera, Output, samples::SUBPIXELS};

/// A triangle on the subpixel grid, wound so that its inside is on the right of its edges (y down).
#[derive(Clone, Debug)]
pub struct ScreenTriangle {
    /// Which triangle of the scenery it is (a part of).
    pub id: u32,
    /// Corners in subpixels.
    pub corners: [[i64; 2]; 3],
    /// A point of its plane in pixels and depth.
    pub first: DVec3,
    /// Change of the depth per pixel in x and y.
    pub slope: [f64; 2],
    /// Least and greatest depth of the corners, so that slivers cannot overshoot.
    pub depth_range: [f64; 2],
}

impl ScreenTriangle {
    /// Lower and upper corner in pixels.
    pub fn bounds(&self) -> [[f32; 2]; 2] {
        let pixels = |bound: fn(i64, i64) -> i64, start: i64| {
            [0, 1].map(|axis| self.corners.iter().map(|c| c[axis]).fold(start, bound) as f32 / SUBPIXELS as f32)
        };
        [pixels(i64::min, i64::MAX), pixels(i64::max, i64::MIN)]
    }
}

/// Everything that maps a position to the picture.
#[derive(Clone, Debug)]
pub struct Projection {
    clip_from_world: DMat4,
    half_size: [f64; 2],
}

/// How far outside the picture, in pixels, geometry is kept before it is clipped: products of subpixel
/// coordinates within it fit 64 bits with room to spare.
const GUARD_PIXELS: f64 = 400_000.0;

impl Projection {
    pub fn new(camera: &Camera, output: &Output) -> Self {
        let view_from_world = DMat4::from(camera.view_from_world());
        Self {
            clip_from_world: camera.clip_from_view() * view_from_world,
            half_size: [output.width() as f64 / 2.0, output.height() as f64 / 2.0],
        }
    }

    /// Clip space of a position.
    pub fn clip(&self, position: DVec3) -> DVec4 {
        self.clip_from_world * position.extend(1.0)
    }

    /// Pixel coordinates (y down) and depth of a point in clip space with w > 0.
    pub fn pixel(&self, clip: DVec4) -> DVec3 {
        DVec3::new(
            (clip.x / clip.w + 1.0) * self.half_size[0],
            (1.0 - clip.y / clip.w) * self.half_size[1],
            clip.z / clip.w,
        )
    }

    /// Signed distances to the planes a point must be inside of: near, far, and the guard band.
    fn insides(&self, clip: DVec4) -> [f64; 6] {
        let guard = self.half_size.map(|half| GUARD_PIXELS / half);
        [
            clip.w - clip.z,
            clip.z,
            guard[0] * clip.w - clip.x,
            guard[0] * clip.w + clip.x,
            guard[1] * clip.w - clip.y,
            guard[1] * clip.w + clip.y,
        ]
    }

    /// The part of a segment in front of the near plane, as pixels and depths.
    pub fn segment(&self, ends: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let [mut a, mut b] = ends.map(|end| self.clip(end));
        for plane in 0..6 {
            let inside = [a, b].map(|end| self.insides(end)[plane]);
            match inside.map(|distance| distance >= 0.0) {
                [true, true] => {}
                [true, false] => b = crossing(a, b, inside[0], inside[1]),
                [false, true] => a = crossing(b, a, inside[1], inside[0]),
                [false, false] => return None,
            }
        }
        Some([self.pixel(a), self.pixel(b)])
    }

    /// Clips and projects all triangles. The result is in the order of the triangles.
    pub fn triangles(&self, triangles: &[[u32; 3]], positions: &[DVec3], output: &Output) -> Vec<ScreenTriangle> {
        let clip: Vec<DVec4> = positions.par_iter().map(|&position| self.clip(position)).collect();
        triangles
            .par_iter()
            .enumerate()
            .with_min_len(1024)
            .flat_map_iter(|(id, corners)| {
                let polygon = self.clipped(corners.map(|vertex| clip[vertex as usize]));
                let pixels: Vec<DVec3> = polygon.iter().map(|&corner| self.pixel(corner)).collect();
                (2..pixels.len()).filter_map(move |last| {
                    screen_triangle(id as u32, [pixels[0], pixels[last - 1], pixels[last]], output)
                })
            })
            .collect()
    }

    /// Sutherland and Hodgman. Crossings are computed from inside to outside whichever way an edge runs,
    /// so two triangles that share an edge get the same point.
    fn clipped(&self, corners: [DVec4; 3]) -> Vec<DVec4> {
        let mut polygon = corners.to_vec();
        if corners.iter().all(|&corner| self.insides(corner).iter().all(|&distance| distance >= 0.0)) {
            return polygon;
        }
        for plane in 0..6 {
            let mut kept = Vec::with_capacity(polygon.len() + 1);
            for (place, &current) in polygon.iter().enumerate() {
                let next = polygon[(place + 1) % polygon.len()];
                let inside = [current, next].map(|corner| self.insides(corner)[plane]);
                if inside[0] >= 0.0 {
                    kept.push(current);
                }
                match inside.map(|distance| distance >= 0.0) {
                    [true, false] => kept.push(crossing(current, next, inside[0], inside[1])),
                    [false, true] => kept.push(crossing(next, current, inside[1], inside[0])),
                    _ => {}
                }
            }
            polygon = kept;
        }
        polygon
    }
}

fn crossing(inside: DVec4, outside: DVec4, distance_inside: f64, distance_outside: f64) -> DVec4 {
    inside + (outside - inside) * (distance_inside / (distance_inside - distance_outside))
}

/// Snaps a triangle to the grid; none if nothing of it can be seen.
fn screen_triangle(id: u32, pixels: [DVec3; 3], output: &Output) -> Option<ScreenTriangle> {
    let snap = |value: f64| (value * SUBPIXELS as f64 + 0.5).floor() as i64;
    let mut corners = pixels.map(|pixel| [snap(pixel.x), snap(pixel.y)]);
    let area = doubled_area(corners);
    if area < 0 {
        corners.swap(1, 2);
    }
    // The filter looks one pixel beyond the picture.
    let limits = [output.width(), output.height()].map(|size| (size as i64 + 1) * SUBPIXELS);
    let outside = (0..2).any(|axis| {
        corners.iter().all(|corner| corner[axis] < -SUBPIXELS)
            || corners.iter().all(|corner| corner[axis] > limits[axis])
    });
    if area == 0 || outside {
        return None;
    }
    // The depth plane is that of the triangle before snapping, which moves the picture but not the surface.
    let (to_1, to_2) = (pixels[1] - pixels[0], pixels[2] - pixels[0]);
    let exact_area = to_1.x * to_2.y - to_1.y * to_2.x;
    let slope = [to_1.z * to_2.y - to_2.z * to_1.y, to_2.z * to_1.x - to_1.z * to_2.x]
        .map(|rise| if exact_area == 0.0 { 0.0 } else { rise / exact_area });
    let depths = pixels.map(|pixel| pixel.z);
    let depth_range =
        [depths.iter().copied().fold(f64::MAX, f64::min), depths.iter().copied().fold(f64::MIN, f64::max)];
    Some(ScreenTriangle { id, corners, first: pixels[0], slope, depth_range })
}

fn doubled_area([a, b, c]: [[i64; 2]; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
