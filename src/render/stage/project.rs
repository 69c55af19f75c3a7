//! From world space to the pixel grid: clipping, projection, and the depth plane of each triangle.

use glam::{DMat4, DVec3, DVec4};

use crate::render::{Camera, Look, Output};

/// Subpixels per pixel: vertices and samples lie on this grid.
pub const SUBPIXELS: i32 = 256;

/// A triangle on the subpixel grid, wound so that its inside is on the right of its edges (y down).
#[derive(Clone, Debug)]
pub struct ScreenTriangle {
    /// The depth, `depth[0] + depth[1] x + depth[2] y` at x, y in pixels.
    pub depth: [f64; 3],
    /// Corners in subpixels.
    pub corners: [[i32; 2]; 3],
    /// Least and greatest depth of the corners, so that slivers cannot overshoot.
    pub depth_range: [f32; 2],
    /// Which face of the stage it is (a part of).
    pub id: u32,
}

impl ScreenTriangle {
    /// First and last pixel that it may touch, in x and y.
    pub fn bounds(&self) -> [[i32; 2]; 2] {
        let [a, b, c] = self.corners;
        let span =
            |a: i32, b: i32, c: i32| [a.min(b).min(c).div_euclid(SUBPIXELS), a.max(b).max(c).div_euclid(SUBPIXELS)];
        [span(a[0], b[0], c[0]), span(a[1], b[1], c[1])]
    }
}

/// Everything that maps a position to the picture.
#[derive(Clone, Debug)]
pub struct Projection {
    clip_from_world: DMat4,
    half_size: [f64; 2],
    /// Pixels that are drawn or that the filter of those looks at: first and last in x and y.
    limits: [[i32; 2]; 2],
    /// What has a negative product with this in clip space is cut away.
    cut: Option<DVec4>,
}

/// How far from the middle of the picture, in pixels, geometry is kept before it is clipped. Differences
/// of subpixel coordinates then have 23 bits, which is what edge functions in 32 bits allow for
/// (`Outline` in raster.rs).
const GUARD_PIXELS: f64 = 16_000.0;
/// Slopes beyond this belong to slivers, whose depths are clamped anyway.
const STEEPEST: f64 = 1e9;
const PLANES: usize = 7;

impl Projection {
    pub fn new(camera: &Camera, look: &Look, output: &Output) -> Self {
        let clip_from_world = camera.clip_from_view() * DMat4::from(camera.view_from_world());
        let [x, y, width, height] = output.window().map(|value| value as i32);
        let cut = look.cut.map(|plane| clip_from_world.inverse().transpose() * (-plane.normal).extend(plane.offset));
        Self {
            clip_from_world,
            half_size: [output.width() as f64 / 2.0, output.height() as f64 / 2.0],
            limits: [[x - 1, x + width], [y - 1, y + height]],
            cut,
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

    /// Pixel coordinates and depth of a position; not a number if it is nearer than the near plane.
    pub fn projected(&self, position: DVec3) -> DVec3 {
        let clip = self.clip(position);
        if clip.w > 0.0 && clip.z <= clip.w { self.pixel(clip) } else { DVec3::NAN }
    }

    /// Signed distances to the planes a point must be inside of: near, far, the guard band, the cut.
    fn insides(&self, clip: DVec4) -> [f64; PLANES] {
        let guard = self.half_size.map(|half| GUARD_PIXELS / half);
        [
            clip.w - clip.z,
            clip.z,
            guard[0] * clip.w - clip.x,
            guard[0] * clip.w + clip.x,
            guard[1] * clip.w - clip.y,
            guard[1] * clip.w + clip.y,
            self.cut.map_or(0.0, |cut| cut.dot(clip)),
        ]
    }

    /// The part of a segment in front of the near plane and on this side of the cut, as pixels and depths.
    pub fn segment(&self, ends: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let [mut a, mut b] = ends.map(|end| self.clip(end));
        for plane in 0..PLANES {
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

    /// Hands on what of a triangle is in the picture, in one or more parts. `projected` are its corners as
    /// [`Projection::projected`] gives them.
    pub fn triangle(
        &self,
        id: u32,
        positions: [DVec3; 3],
        projected: [DVec3; 3],
        mut part: impl FnMut(ScreenTriangle),
    ) {
        let whole = self.cut.is_none()
            && projected.iter().all(|corner| {
                corner.z >= 0.0
                    && (corner.x - self.half_size[0]).abs() <= GUARD_PIXELS
                    && (corner.y - self.half_size[1]).abs() <= GUARD_PIXELS
            });
        if whole {
            self.screen_triangle(id, projected).into_iter().for_each(part);
            return;
        }
        let polygon = self.clipped(positions.map(|position| self.clip(position)));
        let pixels: Vec<DVec3> = polygon.iter().map(|&corner| self.pixel(corner)).collect();
        for last in 2..pixels.len() {
            self.screen_triangle(id, [pixels[0], pixels[last - 1], pixels[last]]).into_iter().for_each(&mut part);
        }
    }

    /// Sutherland and Hodgman. Crossings are computed from inside to outside whichever way an edge runs,
    /// so two triangles that share an edge get the same point.
    fn clipped(&self, corners: [DVec4; 3]) -> Vec<DVec4> {
        let mut polygon = corners.to_vec();
        for plane in 0..PLANES {
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

    /// Snaps a triangle to the grid; none if nothing of it can be seen.
    fn screen_triangle(&self, id: u32, pixels: [DVec3; 3]) -> Option<ScreenTriangle> {
        let snap = |value: f64| (value * f64::from(SUBPIXELS) + 0.5).floor() as i32;
        let mut corners = pixels.map(|pixel| [snap(pixel.x), snap(pixel.y)]);
        let area = doubled_area(corners);
        if area < 0 {
            corners.swap(1, 2);
        }
        // The depth plane is that of the triangle before snapping, which moves the picture but not the surface.
        let (to_1, to_2) = (pixels[1] - pixels[0], pixels[2] - pixels[0]);
        let exact_area = to_1.x * to_2.y - to_1.y * to_2.x;
        let [right, down] = [to_1.z * to_2.y - to_2.z * to_1.y, to_2.z * to_1.x - to_1.z * to_2.x]
            .map(|rise| if exact_area == 0.0 { 0.0 } else { (rise / exact_area).clamp(-STEEPEST, STEEPEST) });
        let depths = pixels.map(|pixel| pixel.z as f32);
        let triangle = ScreenTriangle {
            depth: [pixels[0].z - right * pixels[0].x - down * pixels[0].y, right, down],
            corners,
            depth_range: [depths[0].min(depths[1]).min(depths[2]), depths[0].max(depths[1]).max(depths[2])],
            id,
        };
        let near = |[first, last]: [i32; 2], limits: [i32; 2]| first <= limits[1] && last >= limits[0];
        let [across, down] = triangle.bounds();
        (area != 0 && near(across, self.limits[0]) && near(down, self.limits[1])).then_some(triangle)
    }

    /// Planes in pixels of value / w and 1 / w on a triangle, from the values at its corners: their quotient
    /// is the value that is seen. They hold for every part of the triangle.
    pub fn seen_values(&self, positions: [DVec3; 3], values: [f32; 3]) -> [[f64; 3]; 2] {
        // A combination a x + b y + c w of clip coordinates is a plane a x/w + b y/w + c after division by w.
        let [p, q, r] = positions.map(|position| {
            let clip = self.clip(position);
            DVec3::new((clip.x + clip.w) * self.half_size[0], (clip.w - clip.y) * self.half_size[1], clip.w)
        });
        let determinant = p.dot(q.cross(r));
        let combined = |[at_p, at_q, at_r]: [f64; 3]| {
            let plane = (q.cross(r) * at_p + r.cross(p) * at_q + p.cross(q) * at_r) / determinant;
            [plane.z, plane.x, plane.y]
        };
        [combined(values.map(f64::from)), combined([1.0; 3])]
    }
}

fn crossing(inside: DVec4, outside: DVec4, distance_inside: f64, distance_outside: f64) -> DVec4 {
    inside + (outside - inside) * (distance_inside / (distance_inside - distance_outside))
}

fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [to_b, to_c] = [b, c].map(|end| [0, 1].map(|axis| i64::from(end[axis] - a[axis])));
    to_b[0] * to_c[1] - to_b[1] * to_c[0]
}
