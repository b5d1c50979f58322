//! A photon that is being sorted into a structure.

use super::select_nth::Placed;

/// A photon that is being sorted into a structure: where it is, and which it is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Point {
    pub(super) position: [f32; 3],
    pub(super) id: u32,
}

impl Point {
    /// The photons as points.
    pub(super) fn all(photons: &[pm_formats::Photon]) -> Vec<Self> {
        (0..).zip(photons).map(|(id, photon)| Self { position: photon.position, id }).collect()
    }
}

impl Placed for Point {
    #[inline(always)]
    fn coordinate(&self, axis: usize) -> f32 {
        self.position[axis]
    }

    #[inline(always)]
    fn id(&self) -> u32 {
        self.id
    }
}
