//! Surfaces: the query's own, and which photons lie on it.

use glam::{DVec3, Vec3};

/// Photons whose surface is turned farther than this from the query's are left out of the sum: they lie round a corner
/// or on the other side. The cosine of 26 degrees: well beyond the 2 degrees that the packed normal may be off.
const MIN_NORMAL_COSINE: f32 = 0.9;

/// A unit normal in steps of 1/127.
#[expect(clippy::cast_possible_truncation, reason = "|components| <= 1")]
pub(super) fn coarse(normal: [f32; 3]) -> [i8; 3] {
    normal.map(|x| (x * 127.0).round() as i8)
}

/// Is a photon's surface, by its coarse normal, the one whose unit normal is `normal`?
#[inline]
pub(super) fn on_same_surface(photon: [i8; 3], normal: [f32; 3]) -> bool {
    let [x, y, z] = photon.map(f32::from);
    x * normal[0] + y * normal[1] + z * normal[2] > MIN_NORMAL_COSINE * 127.0
}

/// Where light is asked for.
pub(super) struct Surface {
    pub(super) position: DVec3,
    /// Unit normal.
    pub(super) normal: [f32; 3],
    /// Of the photons' disc.
    pub(super) radius: f64,
}

impl Surface {
    /// Where a photon is, from there, in radii.
    pub(super) fn offset(&self, photon: [f32; 3]) -> DVec3 {
        (Vec3::from(photon).as_dvec3() - self.position) / self.radius
    }
}
