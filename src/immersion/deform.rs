//! stub
use glam::DVec3;
/// stub
pub fn noise_displacement(p: &[DVec3], _a: f64, _w: f64, _o: usize, _s: u64) -> Vec<DVec3> {
    p.to_vec()
}
