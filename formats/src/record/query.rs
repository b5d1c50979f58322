//! The gather query: 44 bytes, the size of the paper's deferred search (section 3.2).

use super::Record;
use super::direction::{pack_direction, unpack_direction};
use crate::container::{Header, StreamKind};
use bytemuck::{Pod, Zeroable};

/// Where a radiance estimate is wanted, and what becomes of it.
///
/// (`pixel`, `sample`) identifies a query for ever, in whatever order it is met.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Query {
    /// Where, in scene units.
    pub position: [f32; 3],
    /// Surface normal on the viewer's side, octahedral, 16 bits a coordinate.
    pub normal: u32,
    /// Direction towards the viewer, octahedral, 16 bits a coordinate.
    pub view: u32,
    /// Material, an index into the header's table.
    pub material: u16,
    /// Bit 0: `pixel` is the id of an irradiance record; the other bits are reserved, 0.
    pub flags: u16,
    /// Destination pixel, counted row by row from the upper left corner; or irradiance record.
    pub pixel: u32,
    /// Sample number within the pixel.
    pub sample: u32,
    /// What the radiance is multiplied by before it is added to the pixel, linear RGB.
    pub weight: [f32; 3],
}

impl Query {
    /// Flag of a query that belongs to an irradiance record.
    pub const FOR_RECORD: u16 = 1;

    /// Does the query belong to an irradiance record, and not to a pixel by itself?
    #[inline]
    #[must_use]
    pub const fn is_for_record(&self) -> bool {
        self.flags & Self::FOR_RECORD != 0
    }

    /// Packs the two unit vectors of a query.
    #[must_use]
    pub fn pack_vectors(normal: [f32; 3], view: [f32; 3]) -> (u32, u32) {
        (Self::pack_vector(normal), Self::pack_vector(view))
    }

    /// Packs one of the two unit vectors of a query.
    #[must_use]
    #[inline]
    pub fn pack_vector(unit: [f32; 3]) -> u32 {
        pack_direction::<16>(unit)
    }

    /// Unit normal of the surface, on the viewer's side.
    #[must_use]
    pub fn normal(&self) -> [f32; 3] {
        unpack_direction::<16>(self.normal)
    }

    /// Unit vector towards the viewer.
    #[must_use]
    pub fn view(&self) -> [f32; 3] {
        unpack_direction::<16>(self.view)
    }
}

impl Record for Query {
    const KIND: StreamKind = StreamKind::Queries;

    fn problem(&self, header: &Header) -> Option<&'static str> {
        if !self.position.iter().chain(&self.weight).all(|x| x.is_finite()) {
            Some("a query's position or weight is not finite")
        } else if usize::from(self.material) >= header.materials.len() {
            Some("a query's material is not in the table")
        } else if !self.is_for_record() && u64::from(self.pixel) >= header.pixels() {
            Some("a query's pixel lies outside the image")
        } else {
            None
        }
    }
}
