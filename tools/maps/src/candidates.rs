//! Photons within a radius, of which some will be the nearest.

/// Photons that lie side by side, as many as the widest instructions take at once.
pub(crate) const WIDTH: usize = 16;

/// Squared distances and ids, side by side, in bounded room.
#[derive(Clone, Default)]
pub(crate) struct Candidates {
    /// Beyond `len` there is room for a leaf's photons.
    pub(crate) distances: Vec<f32>,
    pub(crate) ids: Vec<u32>,
    pub(crate) len: usize,
}

impl Candidates {
    /// Empties it, with room for at least `most` and another leaf.
    #[inline(always)]
    pub(crate) fn clear(&mut self, most: usize) {
        self.len = 0;
        if self.distances.len() < most + WIDTH {
            self.grow(most);
        }
    }

    #[cold]
    fn grow(&mut self, most: usize) {
        // Whole leaves, so that the padding of the last has room.
        let room = most.next_multiple_of(WIDTH) + 2 * WIDTH;
        self.distances.resize(room, 0.0);
        self.ids.resize(room, 0);
    }

    /// How many it holds while there is still room for a leaf and its padding.
    #[inline(always)]
    pub(crate) fn most(&self) -> usize {
        self.distances.len() - 2 * WIDTH
    }

    /// Fills the lanes behind the last candidate: they are within no bound.
    #[inline(always)]
    pub(crate) fn pad(&mut self) {
        self.distances[self.len..][..WIDTH].fill(f32::NAN);
    }

    /// The distances, in whole lanes.
    #[inline(always)]
    pub(crate) fn padded(&self) -> &[[f32; WIDTH]] {
        self.distances[..self.len.next_multiple_of(WIDTH)].as_chunks().0
    }

    /// Lanes from a place on.
    #[inline(always)]
    pub(crate) fn lanes(&self, from: usize) -> ([f32; WIDTH], [u32; WIDTH]) {
        let distances = self.distances[from..][..WIDTH].try_into().expect("sixteen lanes");
        (distances, self.ids[from..][..WIDTH].try_into().expect("sixteen lanes"))
    }
}
