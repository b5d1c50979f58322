//! The photons about a query, side by side: which of them lie on its surface, and which no cut takes away.

use super::{Cut, ON_THE_PLANE};
use crate::surface::{Spot, Surface};
use glam::DVec3;

/// Where depths in radii differ from a limit by more than this, rounding does not decide on which side of it they are: in single
/// precision some ten roundings of numbers below 2 are a tenth of it.
const ROUNDED: f32 = 1e-5;

/// The photons found for a query. Room that is used again for the next.
#[derive(Default)]
pub(crate) struct Around {
    pub(crate) places: Vec<u32>,
    /// Squared.
    pub(crate) distances: Vec<f32>,
    /// Where they are. Of this and what follows nothing is meant beyond as many as there are places.
    at: [Vec<f32>; 3],
    /// All bits, if it lies on the query's surface; else none.
    own: Vec<u32>,
    /// All bits, unless a cut has taken it away; then none.
    kept: Vec<u32>,
    /// Which of them do not lie on the query's surface, and no cut has taken away; beyond `strange` nothing is meant.
    strangers: Vec<u32>,
    strange: usize,
}

impl Around {
    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.places.clear();
        self.distances.clear();
        self.kept.clear();
        self.strange = 0;
    }

    /// Adds photons in these places, at these squared distances; `is_own` is asked for the code of a normal.
    #[inline(always)]
    pub(crate) fn add(
        &mut self,
        places: &[u32],
        distances: &[f32],
        spot: impl Fn(u32) -> Spot,
        mut is_own: impl FnMut(u32) -> bool,
    ) {
        let first = self.places.len();
        let len = first + places.len();
        self.places.extend_from_slice(places);
        self.distances.extend_from_slice(distances);
        self.kept.resize(len, u32::MAX);
        if self.own.len() < len {
            self.at.iter_mut().for_each(|at| at.resize(len, 0.0));
            self.own.resize(len, 0);
            self.strangers.resize(len, 0);
        }
        let [x, y, z] = self.at.each_mut().map(|at| &mut at[first..len]);
        let (own, strangers, mut strange) = (&mut self.own[first..len], &mut self.strangers[..len], self.strange);
        // In slices of one length, so that nothing is checked.
        let (x, y, z, own) =
            (&mut x[..places.len()], &mut y[..places.len()], &mut z[..places.len()], &mut own[..places.len()]);
        for (number, &place) in places.iter().enumerate() {
            let spot = spot(place);
            [x[number], y[number], z[number]] = spot.position;
            let same = is_own(spot.code);
            own[number] = u32::from(same).wrapping_neg();
            // The next one over it if it is no stranger: nobody foresees who is.
            strangers[strange] = (first + number) as u32;
            strange += usize::from(!same);
        }
        self.strange = strange;
    }

    /// Who does not lie on the query's surface, and no cut has taken away.
    pub(crate) fn strangers(&self) -> &[u32] {
        &self.strangers[..self.strange]
    }

    /// Where a photon is, from the query, in radii.
    pub(crate) fn offset(&self, surface: &Surface, number: u32) -> DVec3 {
        surface.offset([0, 1, 2].map(|axis| self.at[axis][number as usize]))
    }

    /// Takes away what lies beyond a cut: on the query's surface what is not on the query's side, and of the strangers those next to
    /// the plane as well.
    pub(super) fn take_away(&mut self, surface: &Surface, cut: &Cut) {
        let len = self.places.len();
        let [x, y, z] = self.at.each_ref().map(|at| &at[..len]);
        let (own, kept) = (&self.own[..len], &mut self.kept[..len]);
        let radius = surface.radius as f32;
        let [px, py, pz] = surface.place();
        let [nx, ny, nz] = cut.normal.as_vec3().to_array();
        let (height, margin, least) = (cut.height as f32 * radius, ROUNDED * radius, ON_THE_PLANE as f32 * radius);
        // In single precision first, which says of nearly all of them what doubles would.
        let depth = |number: usize| {
            let along = nx * (x[number] - px) + ny * (y[number] - py) + nz * (z[number] - pz);
            along + height - f32::from_bits(least.to_bits() & !own[number])
        };
        // What is not a number is neither.
        let all = |is: bool| u32::from(is).wrapping_neg();
        let (is_inside, is_outside) = (|depth: f32| all(depth > margin), |depth: f32| all(depth < -margin));
        let mut unsure = 0;
        for (number, kept) in kept.iter_mut().enumerate() {
            let depth = depth(number);
            *kept &= !is_outside(depth);
            unsure |= *kept & !is_inside(depth);
        }
        if unsure != 0 {
            for number in (0..len).filter(|&number| is_inside(depth(number)) == 0) {
                let depth = cut.depth(surface.offset([x[number], y[number], z[number]]));
                let is_kept = if own[number] == 0 { depth > ON_THE_PLANE } else { depth >= 0.0 };
                kept[number] &= all(is_kept);
            }
        }
        let mut strange = 0;
        for at in 0..self.strange {
            let number = self.strangers[at];
            self.strangers[strange] = number;
            strange += usize::from(kept[number as usize] != 0);
        }
        self.strange = strange;
    }

    /// Leaves in `own` place and squared distance of those on the query's surface but the one in the place `rim`, with those that cuts
    /// have taken away or without.
    pub(crate) fn own(&self, with_cut_off: bool, rim: Option<u32>, own: &mut Vec<(u32, f32)>) {
        let with = u32::from(with_cut_off).wrapping_neg();
        let rim = rim.unwrap_or(u32::MAX);
        own.resize(self.places.len(), (0, 0.0));
        let mut len = 0;
        let masks = self.own.iter().zip(&self.kept);
        for ((&place, &distance), (&is_own, &kept)) in self.places.iter().zip(&self.distances).zip(masks) {
            own[len] = (place, distance);
            len += usize::from((is_own & (kept | with) != 0) & (place != rim));
        }
        own.truncate(len);
    }
}
