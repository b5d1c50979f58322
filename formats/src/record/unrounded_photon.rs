//! A photon of a part: 32 bytes, its power as the path carried it.

use super::photon::Photon;
use super::rgbe::pack_rgbe;
use super::{Record, pack_direction};
use crate::container::{Header, StreamKind};
use bytemuck::{Pod, Zeroable};

/// A photon whose number in the whole is not known: the rounding of its power goes by that.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct UnroundedPhoton {
    /// Where it was stored, in scene units.
    pub position: [f32; 3],
    /// Flux in watts times the number of emitted paths.
    pub power: [f32; 3],
    /// As [`Photon::direction`].
    pub direction: [u8; 2],
    /// As [`Photon::flags`], without an axis.
    pub flags: u16,
    /// Which path of its batch stored it, from 0.
    pub path: u32,
}

impl UnroundedPhoton {
    /// Packs all of a photon but its power.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "14 and 2 x 8 bits")]
    pub fn new(position: [f32; 3], power: [f32; 3], towards_source: [f32; 3], normal: [f32; 3], path: u32) -> Self {
        let direction = pack_direction::<8>(towards_source);
        let direction = [direction as u8, (direction >> 8) as u8];
        Self { position, power, direction, flags: (pack_direction::<7>(normal) as u16) << 2, path }
    }

    /// The photon of the whole, its power rounded by `threshold` as [`Photon::new`] does.
    #[must_use]
    pub fn rounded(&self, threshold: [f32; 3]) -> Option<Photon> {
        let Self { position, power, direction, flags, .. } = *self;
        Some(Photon { position, power: pack_rgbe(power, threshold)?, direction, flags })
    }
}

impl Record for UnroundedPhoton {
    const KIND: StreamKind = StreamKind::UnroundedPhotons;

    fn problem(&self, _: &Header) -> Option<&'static str> {
        if !self.position.iter().all(|x| x.is_finite()) {
            return Some("a photon's position is not finite");
        }
        (!self.power.iter().all(|x| x.is_finite() && *x >= 0.0)).then_some("a photon's power is no power")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_it_is_the_photon() {
        for i in 0..1000u16 {
            let x = f32::from(i) / 999.0;
            let (position, power) = ([x, -x, 2.0], [x * 7.3, 0.1, x * x]);
            let (direction, normal, threshold) = ([0.6, x - 0.5, 0.7], [0.0, 1.0 - x, -x], [x, 1.0 - x, 0.5]);
            let photon = Photon::new(position, power, threshold, direction, normal);
            assert_eq!(UnroundedPhoton::new(position, power, direction, normal, 9).rounded(threshold), photon);
        }
        let dark = UnroundedPhoton::new([0.0; 3], [f32::NAN, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0], 0);
        assert!(dark.problem(&Header::empty()).is_some() && dark.rounded([0.5; 3]).is_none());
    }
}
