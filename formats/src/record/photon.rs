//! The photon: 20 bytes, in the spirit of Jensen's packed form (*Realistic Image Synthesis Using Photon Mapping*, 2001).

use super::Record;
use super::direction::{pack_direction, unpack_direction};
use super::rgbe::{pack_rgbe, unpack_rgbe};
use crate::container::{Header, StreamKind};
use bytemuck::{Pod, Zeroable};

/// A photon where it was stored.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Photon {
    /// Where it was stored, in scene units.
    pub position: [f32; 3],
    /// Flux as RGBE, in watts *times the number of emitted paths*: divide by the end block's `emitted_paths`.
    pub power: [u8; 4],
    /// Direction it came from (points away from the surface), octahedral, 8 bits a coordinate.
    pub direction: [u8; 2],
    /// Bits 0-1: split axis in a kd-tree; bits 2-15: coarse normal of the surface, octahedral, 7 bits a coordinate.
    pub flags: u16,
}

impl Photon {
    /// Packs a photon. `threshold` decides the rounding of the power, see [`pack_rgbe`]; `None` if the power cannot be
    /// said in RGBE.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "14 and 2 x 8 bits")]
    pub fn new(
        position: [f32; 3],
        power: [f32; 3],
        threshold: [f32; 3],
        towards_source: [f32; 3],
        normal: [f32; 3],
    ) -> Option<Self> {
        let direction = pack_direction::<8>(towards_source);
        Some(Self {
            position,
            power: pack_rgbe(power, threshold)?,
            direction: [direction as u8, (direction >> 8) as u8],
            flags: (pack_direction::<7>(normal) as u16) << 2,
        })
    }

    /// Flux, linear RGB.
    #[inline]
    #[must_use]
    pub fn power(&self) -> [f64; 3] {
        unpack_rgbe(self.power)
    }

    /// Unit vector towards where the photon came from.
    #[must_use]
    pub fn towards_source(&self) -> [f32; 3] {
        unpack_direction::<8>(u32::from(self.direction[0]) | u32::from(self.direction[1]) << 8)
    }

    /// Coarse unit normal of the surface it lies on, on the side it came from.
    #[must_use]
    pub fn normal(&self) -> [f32; 3] {
        unpack_direction::<7>(u32::from(self.flags >> 2))
    }

    /// Split axis of the kd-tree node that this photon is (0, 1, 2).
    #[inline]
    #[must_use]
    pub const fn axis(&self) -> usize {
        (self.flags & 3) as usize
    }

    /// The same photon as a kd-tree node that splits at its own position along `axis`.
    #[inline]
    #[must_use]
    pub const fn with_axis(mut self, axis: usize) -> Self {
        self.flags = self.flags & !3 | axis as u16 & 3;
        self
    }
}

impl Record for Photon {
    const KIND: StreamKind = StreamKind::Photons;

    fn problem(&self, _: &Header) -> Option<&'static str> {
        (!self.position.iter().all(|x| x.is_finite())).then_some("a photon's position is not finite")
    }
}
