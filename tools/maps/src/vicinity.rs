//! The photons about a group of queries, side by side: read once, and looked through by each query of the group.

use super::candidates::{Candidates, WIDTH};

/// A ball about a group of queries, in which the nearest photons of all of them lie.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Middle of the group.
    pub centre: [f32; 3],
    /// Photons of each query.
    pub k: usize,
    /// From the middle to the farthest query, in scene units.
    pub spread: f32,
    /// Radius about the middle within which k photons are looked for, in scene units.
    pub enough: f32,
}

/// What was collected about a group of queries.
#[derive(Clone, Default)]
pub struct Vicinity {
    /// Squared distances from the middle, and places. Behind the last there is room for a leaf's photons.
    pub(crate) near: Candidates,
    /// Where they are: of those behind the last, up to whole lanes, not numbers.
    pub(crate) position: [Vec<f32>; 3],
    pub(crate) centre: [f32; 3],
    /// Squared distances from the middle: fewer than k photons lie within the first, or as many at most; at least k within the second.
    pub(crate) kth: [f32; 2],
}

impl Vicinity {
    /// Empties it. What it has room for is bounded: as many as a search has room for that needs no heap.
    #[inline]
    pub(crate) fn clear(&mut self, most: usize) {
        self.near.clear(most);
        for coordinates in &mut self.position {
            if coordinates.len() < self.near.distances.len() {
                coordinates.resize(self.near.distances.len(), 0.0);
            }
        }
    }

    /// Fills the lanes behind the last photon: they are near to nothing.
    #[inline(always)]
    pub(crate) fn pad(&mut self) {
        self.near.pad();
        self.position.iter_mut().for_each(|coordinates| coordinates[self.near.len..][..WIDTH].fill(f32::NAN));
    }

    /// How many photons it holds.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.near.len
    }

    /// Does it hold none?
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.near.len == 0
    }
}
