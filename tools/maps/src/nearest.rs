//! The k nearest so far.

use crate::candidates::Room;
use std::sync::Arc;

/// Keeps the k nearest of the photons it is shown, within a bound that shrinks once there are k.
///
/// Candidates are single integers, their [`rank`]s, so one comparison orders by distance and then by id.
pub struct Nearest {
    k: usize,
    /// Unordered until there are k; then a max-heap.
    keys: Vec<u64>,
    bound: f32,
    /// Photons at most so far, squared, are sure to be among the k nearest; negative if nothing is known.
    floor: f32,
    /// Distance and place of the farthest, where the nearest were selected at the end.
    settled: Option<(f32, u32)>,
    /// Ids of the photons in their places, where the nearest were selected at the end.
    ids: Arc<[u32]>,
    /// Room for those who select at the end.
    pub(crate) room: Room,
}

impl Nearest {
    /// Room for `k` photons, none of them farther than the square root of `bound`.
    ///
    /// # Panics
    /// If k is 0.
    #[must_use]
    pub fn new(k: usize, bound: f32) -> Self {
        assert!(k > 0, "the nearest 0 photons are no question");
        Self {
            k,
            keys: Vec::with_capacity(k.min(1 << 16)),
            bound,
            floor: -1.0,
            settled: None,
            ids: Arc::default(),
            room: Room::default(),
        }
    }

    /// Forgets all photons and starts again with this bound on the squared distance.
    #[inline]
    pub fn restart(&mut self, bound: f32) {
        self.restart_between(-1.0, bound);
    }

    /// The same, where photons whose squared distance is at most `floor` are sure to be among the k nearest.
    #[inline]
    pub fn restart_between(&mut self, floor: f32, bound: f32) {
        self.keys.clear();
        self.room.forget();
        self.bound = bound;
        self.floor = floor;
        self.settled = None;
    }

    /// Squared distance up to which photons are sure to be among the nearest; negative if nothing is known.
    #[inline(always)]
    #[must_use]
    pub const fn floor(&self) -> f32 {
        self.floor
    }

    /// The nearest have been selected, and are what is chosen: distance and place of the farthest, and the ids of the map's
    /// photons in their places. No photon may be shown before the next start.
    #[inline(always)]
    pub(crate) fn settle(&mut self, farthest: (f32, u32), ids: &Arc<[u32]>) {
        debug_assert!(self.keys.is_empty() && self.room.chosen.len <= self.k);
        // One map after the other is searched thousands of times: to count it each time would be the dearest of all.
        if !Arc::ptr_eq(&self.ids, ids) {
            self.ids = Arc::clone(ids);
        }
        self.settled = Some(farthest);
        if self.is_full() {
            self.bound = farthest.0;
        }
    }

    /// Largest squared distance that a photon may still have.
    #[inline(always)]
    #[must_use]
    pub const fn bound(&self) -> f32 {
        self.bound
    }

    /// Shows a photon at this squared distance.
    #[inline]
    pub fn show(&mut self, distance_squared: f32, id: u32) {
        // Also false for NaN.
        if distance_squared <= self.bound {
            let key = rank(distance_squared, id);
            if self.keys.len() < self.k {
                self.keys.push(key);
                if self.keys.len() == self.k {
                    self.make_heap(|_| ());
                }
            } else if key < self.keys[0] {
                self.replace_farthest(key);
            }
        }
    }

    /// Puts a nearer key in the place of the farthest. The hole at the top goes down to a leaf of the heap, since it seldom stays
    /// above, and the key up from there: no way down is guessed wrong, and the new bound is known before it ends (Floyd's
    /// bottom-up sifting; Wegener, *Bottom-up heapsort*, Theoretical Computer Science 118, 1993).
    #[inline]
    fn replace_farthest(&mut self, key: u64) {
        let keys = &mut self.keys[..];
        let mut at = 0;
        while 2 * at + 2 < keys.len() {
            let [left, right] = [keys[2 * at + 1], keys[2 * at + 2]];
            keys[at] = left.max(right);
            at = 2 * at + 1 + usize::from(right > left);
        }
        if 2 * at + 1 < keys.len() {
            keys[at] = keys[2 * at + 1];
            at = 2 * at + 1;
        }
        while at > 0 && keys[(at - 1) / 2] < key {
            keys[at] = keys[(at - 1) / 2];
            at = (at - 1) / 2;
        }
        keys[at] = key;
        self.tighten();
    }

    /// The same, where `touch` is told of each candidate that is read or written, by its slot.
    #[inline]
    pub fn show_touching(&mut self, distance_squared: f32, id: u32, mut touch: impl FnMut(usize)) {
        // Also false for NaN.
        if distance_squared <= self.bound {
            let key = rank(distance_squared, id);
            if self.keys.len() < self.k {
                touch(self.keys.len());
                self.keys.push(key);
                if self.keys.len() == self.k {
                    self.make_heap(touch);
                }
            } else if key < self.keys[0] {
                self.sift_down(0, key, &mut touch);
                self.tighten();
            }
        }
    }

    /// May so many more be shown before the bound changes?
    #[inline(always)]
    pub(crate) fn bound_stays_with(&self, more: usize) -> bool {
        self.keys.len() + more < self.k
    }

    /// Keeps a photon if `kept`, which says whether it lies within the bound; the bound must [stay](Self::bound_stays_with).
    #[inline(always)]
    pub(crate) fn keep_if(&mut self, kept: bool, distance_squared: f32, id: u32) {
        debug_assert!(self.bound_stays_with(1) && kept == (distance_squared <= self.bound));
        let before = self.keys.len();
        // No branch to be guessed.
        self.keys.push(rank(distance_squared, id));
        self.keys.truncate(before + usize::from(kept));
    }

    #[cold]
    fn make_heap(&mut self, mut touch: impl FnMut(usize)) {
        for at in (0..self.k / 2).rev() {
            self.sift_down(at, self.keys[at], &mut touch);
        }
        self.tighten();
    }

    /// Puts `key` at `at` or below it, wherever the heap wants it.
    #[inline(always)]
    fn sift_down(&mut self, mut at: usize, key: u64, touch: &mut impl FnMut(usize)) {
        let keys = &mut self.keys[..];
        loop {
            let left = 2 * at + 1;
            if left >= keys.len() {
                break;
            }
            let right = left + 1;
            touch(left);
            if right < keys.len() {
                touch(right);
            }
            let larger = if right < keys.len() && keys[right] > keys[left] { right } else { left };
            if keys[larger] <= key {
                break;
            }
            keys[at] = keys[larger];
            touch(at);
            at = larger;
        }
        keys[at] = key;
        touch(at);
    }

    fn tighten(&mut self) {
        self.bound = distance_of(self.keys[0]);
    }

    /// Number of photons asked for.
    #[must_use]
    pub const fn k(&self) -> usize {
        self.k
    }

    /// Number of photons found.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.keys.len() + self.room.chosen.len
    }

    /// True if none was found.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True if k were found.
    #[inline]
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.len() == self.k
    }

    /// Squared distance and id of the farthest photon found.
    #[must_use]
    pub fn farthest(&self) -> Option<(f32, u32)> {
        let key = match self.settled {
            Some((distance, place)) => return (!self.is_empty()).then(|| (distance, self.ids[place as usize])),
            None if self.is_full() => self.keys.first().copied(),
            None => self.keys.iter().max().copied(),
        };
        key.map(|key| (distance_of(key), id_of(key)))
    }

    /// The photons found, in no particular order, as squared distance and id.
    pub fn iter(&self) -> impl Iterator<Item = (f32, u32)> {
        let chosen = self.room.chosen.iter().map(|(distance, place)| (distance, self.ids[place as usize]));
        self.keys.iter().map(|&key| (distance_of(key), id_of(key))).chain(chosen)
    }

    /// The photons found, in no particular order, as squared distance and place: the number by which the map knows a photon,
    /// which is its id unless there is an [`order`](Self::order).
    #[inline]
    pub fn places(&self) -> impl Iterator<Item = (f32, u32)> {
        self.keys.iter().map(|&key| (distance_of(key), id_of(key))).chain(self.room.chosen.iter())
    }

    /// Calls `visit` with the places of the photons found, many at once.
    #[inline(always)]
    pub fn for_places(&self, mut visit: impl FnMut(&[u32])) {
        for keys in self.keys.chunks(64) {
            let mut places = [0; 64];
            places.iter_mut().zip(keys).for_each(|(place, &key)| *place = id_of(key));
            visit(&places[..keys.len()]);
        }
        visit(&self.room.chosen.places[..self.room.chosen.len]);
    }

    /// Calls `visit` with places and squared distances of the photons found, many at once.
    #[inline(always)]
    pub fn for_photons(&self, mut visit: impl FnMut(&[u32], &[f32])) {
        for keys in self.keys.chunks(64) {
            let (mut places, mut distances) = ([0; 64], [0.0; 64]);
            for ((place, distance), &key) in places.iter_mut().zip(&mut distances).zip(keys) {
                (*place, *distance) = (id_of(key), distance_of(key));
            }
            visit(&places[..keys.len()], &distances[..keys.len()]);
        }
        let chosen = &self.room.chosen;
        visit(&chosen.places[..chosen.len], &chosen.distances[..chosen.len]);
    }

    /// Ids of the photons by their places, if a map found them that has an order of its own.
    #[inline]
    #[must_use]
    pub fn order(&self) -> Option<&Arc<[u32]>> {
        self.settled.map(|_| &self.ids)
    }

    /// The id of the photon in a place of the map that found these.
    #[inline]
    #[must_use]
    pub fn id(&self, place: u32) -> u32 {
        self.order().map_or(place, |order| order[place as usize])
    }

    /// Squared distance and place of the farthest photon found.
    #[inline]
    #[must_use]
    pub fn farthest_place(&self) -> Option<(f32, u32)> {
        match self.settled {
            Some(farthest) => (!self.is_empty()).then_some(farthest),
            None => self.farthest(),
        }
    }

    /// The photons found, nearest first, ties by id.
    #[must_use]
    pub fn sorted(&self) -> Vec<(f32, u32)> {
        let mut keys: Vec<u64> = self.iter().map(|(distance, id)| rank(distance, id)).collect();
        keys.sort_unstable();
        keys.into_iter().map(|key| (distance_of(key), id_of(key))).collect()
    }
}

/// One integer that orders photons by squared distance, then id: for non-negative floats the bits order as the numbers do.
#[inline(always)]
#[must_use]
pub const fn rank(distance_squared: f32, id: u32) -> u64 {
    (distance_squared.to_bits() as u64) << 32 | id as u64
}

/// The squared distance in a [`rank`].
#[inline(always)]
pub(crate) const fn distance_of(key: u64) -> f32 {
    f32::from_bits((key >> 32) as u32)
}

/// The id in a [`rank`].
#[inline(always)]
pub(crate) const fn id_of(key: u64) -> u32 {
    key as u32
}

#[cfg(test)]
mod tests;
