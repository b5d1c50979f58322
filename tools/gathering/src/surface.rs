//! Surfaces: the query's own, and which photons lie on it.

use glam::{DVec3, Vec3};
use pm_formats::Photon;

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
    /// Where it is.
    #[inline]
    pub(super) fn place(&self) -> [f32; 3] {
        self.position.as_vec3().to_array()
    }

    /// Where a photon is, from there, in radii.
    pub(super) fn offset(&self, photon: [f32; 3]) -> DVec3 {
        (Vec3::from(photon).as_dvec3() - self.position) / self.radius
    }
}

/// Where a photon is, and the code of its surface's normal.
#[derive(Clone, Copy)]
#[repr(align(16))]
pub(super) struct Spot {
    pub(super) position: [f32; 3],
    pub(super) code: u32,
}

impl Spot {
    /// That of a photon.
    pub(super) fn of(photon: &Photon) -> Self {
        Self { position: photon.position, code: u32::from(photon.flags >> 2) }
    }
}

/// Which normals of photons are those of the query's surface, remembered from one photon to the next: few lie about a query.
pub(super) struct Kin {
    normal: [f32; 3],
    /// Twice the code of a normal and 1 more if it is the surface's, each in the slot of its last bits.
    slots: [u32; SLOTS],
}

/// A power of two.
const SLOTS: usize = 64;
/// A slot that knows of no code: there are none so large.
const NOTHING: u32 = u32::MAX;

impl Default for Kin {
    fn default() -> Self {
        Self { normal: [0.0; 3], slots: [NOTHING; SLOTS] }
    }
}

impl Kin {
    /// From here on it is about the surface with this unit normal.
    #[inline]
    pub(super) fn seen_from(&mut self, normal: [f32; 3]) {
        if normal != self.normal {
            *self = Self { normal, ..Self::default() };
        }
    }

    /// Is a photon's surface, by the code of its normal, the query's? `coarse` says what a code means.
    #[inline(always)]
    pub(super) fn is_same(&mut self, code: u32, coarse: impl FnOnce(u32) -> [i8; 3]) -> bool {
        let slot = &mut self.slots[code as usize % SLOTS];
        if *slot >> 1 != code {
            *slot = code << 1 | u32::from(on_same_surface(coarse(code), self.normal));
        }
        *slot & 1 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_formats::unpack_direction;
    use pm_random::Random;

    #[test]
    fn what_is_remembered_of_normals_is_what_they_are() {
        let mut random = Random::new(&[14]);
        let mut kin = Kin::default();
        let coarse = |code: u32| super::coarse(unpack_direction::<7>(code));
        let mut same = 0;
        for _ in 0..300 {
            // Some of them alike, and not a normal at all at first.
            let normal = unpack_direction::<7>((random.unit() * 16.0) as u32 * 1000);
            kin.seen_from(normal);
            for _ in 0..200 {
                let code = (random.unit() * 16_384.0) as u32 & [!0, 63 << 8][(random.unit() * 2.0) as usize];
                let expected = on_same_surface(coarse(code), normal);
                assert_eq!(kin.is_same(code, coarse), expected, "{code}");
                same += u32::from(expected);
            }
        }
        assert!(same > 500, "{same}");
    }
}
