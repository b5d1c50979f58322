//! Photons within a radius, of which some will be the nearest: room for those who select at the end.

use crate::nearest::rank;

/// Photons that lie side by side, as many as the widest instructions take at once.
pub(crate) const WIDTH: usize = 16;

/// Numbers of nodes of a level that are set aside before what lies below them is visited.
pub(crate) const MOST_OPEN: usize = 112;
/// Levels of the largest tree, leaves among them: 2^30 photons in leaves of 16, and 16 children a node.
pub(crate) const MOST_LEVELS: usize = 9;

/// Candidates for the nearest k that there is room for, before some of them have to go.
#[inline(always)]
pub(crate) fn most_candidates(k: usize) -> usize {
    (4 * k).clamp(k + 1024, k + 8192)
}

/// Squared distances and places in the map, side by side, in bounded room.
#[derive(Clone, Default)]
pub(crate) struct Candidates {
    /// Beyond `len` there is room for a leaf's photons.
    pub(crate) distances: Vec<f32>,
    pub(crate) places: Vec<u32>,
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
        self.places.resize(room, 0);
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
        (distances, self.places[from..][..WIDTH].try_into().expect("sixteen lanes"))
    }

    /// Those that it holds.
    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = (f32, u32)> {
        self.distances[..self.len].iter().copied().zip(self.places[..self.len].iter().copied())
    }

    /// Keeps the k nearest, ties by id, whatever they are; `ids` are those of the places. Returns the distance of the last.
    #[cold]
    pub(crate) fn shrink(&mut self, k: usize, ids: &[u32]) -> f32 {
        let mut keys: Vec<(u64, u32)> =
            self.iter().map(|(distance, place)| (rank(distance, ids[place as usize]), place)).collect();
        keys.select_nth_unstable(k - 1);
        for (at, &(key, place)) in keys[..k].iter().enumerate() {
            self.distances[at] = f32::from_bits((key >> 32) as u32);
            self.places[at] = place;
        }
        self.len = k;
        f32::from_bits((keys[k - 1].0 >> 32) as u32)
    }
}

/// Nodes of a level that are yet to be visited.
#[derive(Clone)]
pub(crate) struct Open {
    /// Beyond `len` there is room for the children of a node.
    pub(crate) numbers: [u32; MOST_OPEN + WIDTH],
    pub(crate) len: usize,
    /// How many of them have been.
    pub(crate) visited: usize,
}

/// Room for a search.
#[derive(Clone, Default)]
pub(crate) struct Room {
    /// Sure to be among the nearest; in the end, the nearest.
    pub(crate) chosen: Candidates,
    /// Of which some may be.
    pub(crate) shell: Candidates,
    /// Level by level.
    pub(crate) open: Vec<Open>,
}

impl Room {
    /// Empties it, with room for k that are chosen and for more that may be.
    #[inline(always)]
    pub(crate) fn clear(&mut self, k: usize) {
        self.chosen.clear(k + WIDTH);
        self.shell.clear(most_candidates(k));
        self.open();
    }

    /// Room for nodes that are open.
    #[inline(always)]
    pub(crate) fn open(&mut self) {
        if self.open.is_empty() {
            self.open = vec![Open { numbers: [0; MOST_OPEN + WIDTH], len: 0, visited: 0 }; MOST_LEVELS];
        }
    }

    /// Nothing is chosen, and nothing may be.
    pub(crate) fn forget(&mut self) {
        (self.chosen.len, self.shell.len) = (0, 0);
    }
}
