//! A photon with its radius, as memory holds it: 32 bytes.

use super::LINE;
use glam::{DVec3, Vec3};
use pm_formats::{Photon, pack_direction, unpack_direction, unpack_rgbe};
use pm_maps::geometry::distance_squared;

/// Discs of a leaf.
pub(super) const LEAF: usize = LINE as usize / size_of::<PhotonDisc>();
/// A room has three walls in a corner, so two cuts.
pub(super) const MOST_CUTS: usize = 2;
/// Steps of a radius in which the heights of cuts are said.
const STEPS: f64 = 65_535.0;
/// No normal has this code.
const NO_CUT: u16 = u16::MAX;

/// A plane beyond which a photon lights nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Cut {
    /// Unit normal towards the photon, octahedral, 7 bits a coordinate; [`NO_CUT`] where there is none.
    normal: u16,
    /// Distance of the photon from the plane, in steps of the radius.
    height: u16,
}

/// A photon, its flux per area and its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(super) struct PhotonDisc {
    /// Its power is said per area: irradiance in the middle, in watts per square scene unit.
    photon: Photon,
    /// In scene units.
    pub(super) radius: f32,
    cuts: [Cut; MOST_CUTS],
}

const _: () = assert!(size_of::<PhotonDisc>() == 32);

impl PhotonDisc {
    /// That of a photon, with the flux per area as RGBE, and with the planes that cut it.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "single precision; 0 to STEPS; 14 bits"
    )]
    pub(super) fn new(photon: &Photon, radius: f64, density: [u8; 4], planes: &[(DVec3, f64)]) -> Self {
        let mut cuts = [Cut { normal: NO_CUT, height: 0 }; MOST_CUTS];
        for (cut, (normal, height)) in cuts.iter_mut().zip(planes) {
            let normal = pack_direction::<7>(normal.as_vec3().into()) as u16;
            *cut = Cut { normal, height: (height * STEPS).round() as u16 };
        }
        Self { photon: Photon { power: density, ..*photon }, radius: radius as f32, cuts }
    }

    pub(super) const fn position(&self) -> [f32; 3] {
        self.photon.position
    }

    /// From the photon.
    #[inline]
    pub(super) fn distance_squared(&self, point: [f32; 3]) -> f32 {
        distance_squared(point, self.photon.position)
    }

    /// Code of the normal of its surface.
    #[inline]
    pub(super) fn code(&self) -> usize {
        usize::from(self.photon.flags >> 2)
    }

    /// Irradiance in the middle, in watts per square scene unit.
    #[inline]
    pub(super) fn density(&self) -> [f64; 3] {
        unpack_rgbe(self.photon.power)
    }

    /// Unit vector to where the photon came from.
    pub(super) fn towards_source(&self) -> [f32; 3] {
        self.photon.towards_source()
    }

    /// Is a point on the photon's side of every plane that cuts the disc?
    #[inline]
    pub(super) fn holds(&self, point: [f32; 3]) -> bool {
        self.cuts.iter().all(|cut| {
            cut.normal == NO_CUT || {
                let normal = Vec3::from(unpack_direction::<7>(u32::from(cut.normal))).as_dvec3();
                let offset = Vec3::from(point).as_dvec3() - Vec3::from(self.photon.position).as_dvec3();
                normal.dot(offset) + f64::from(cut.height) / STEPS * f64::from(self.radius) >= 0.0
            }
        })
    }
}
