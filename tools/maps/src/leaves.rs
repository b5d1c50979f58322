//! Leaves of a few photons each, whose distances are computed side by side.

use super::{Nearest, distance_squared};

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

    /// Order along an axis, ties by id. There are no NaNs among photons that were checked; -0 and 0 are one coordinate.
    pub(super) fn along(axis: usize) -> impl FnMut(&Self, &Self) -> std::cmp::Ordering {
        move |a, b| {
            let coordinates = a.position[axis].partial_cmp(&b.position[axis]);
            coordinates.unwrap_or(std::cmp::Ordering::Equal).then(a.id.cmp(&b.id))
        }
    }
}

/// Photons side by side: plain loops over this many are what compilers turn into vector code.
const LANES: usize = 8;

/// Coordinates apart, so that a vector register holds the same coordinate of several photons.
#[derive(Clone)]
#[repr(C, align(128))]
struct Lanes {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    id: [u32; LANES],
}

/// Lanes that hold no photon: no distance to a NaN is within any bound.
const EMPTY: Lanes = Lanes { x: [f32::NAN; LANES], y: [f32::NAN; LANES], z: [f32::NAN; LANES], id: [0; LANES] };

/// Leaves of at most `capacity` photons.
pub(super) struct Leaves {
    lanes: Vec<Lanes>,
    lanes_per_leaf: usize,
    counts: Vec<u32>,
}

impl Leaves {
    /// `count` empty leaves with room for `capacity` photons each.
    pub(super) fn new(count: usize, capacity: usize) -> Self {
        let lanes_per_leaf = capacity.div_ceil(LANES);
        Self { lanes: vec![EMPTY; count * lanes_per_leaf], lanes_per_leaf, counts: vec![0; count] }
    }

    /// Number of leaves.
    pub(super) const fn len(&self) -> usize {
        self.counts.len()
    }

    /// Puts photons into a leaf that is empty.
    pub(super) fn fill(&mut self, leaf: usize, points: &[Point]) {
        self.counts[leaf] = u32::try_from(points.len()).expect("a leaf's worth of photons");
        for (lanes, points) in self.lanes[leaf * self.lanes_per_leaf..].iter_mut().zip(points.chunks(LANES)) {
            for (lane, point) in points.iter().enumerate() {
                [lanes.x[lane], lanes.y[lane], lanes.z[lane]] = point.position;
                lanes.id[lane] = point.id;
            }
        }
    }

    /// Number of photons in a leaf.
    #[inline]
    pub(super) fn count(&self, leaf: usize) -> usize {
        self.counts[leaf] as usize
    }

    /// Ids of the photons in a leaf.
    pub(super) fn ids(&self, leaf: usize) -> impl Iterator<Item = u32> {
        let lanes = &self.lanes[leaf * self.lanes_per_leaf..(leaf + 1) * self.lanes_per_leaf];
        lanes.iter().flat_map(|lanes| lanes.id).take(self.count(leaf))
    }

    /// Shows all photons of a leaf to `found`.
    #[inline]
    pub(super) fn show(&self, leaf: usize, point: [f32; 3], found: &mut Nearest) {
        let from = leaf * self.lanes_per_leaf;
        for lanes in &self.lanes[from..from + self.lanes_per_leaf] {
            let distances: [f32; LANES] =
                std::array::from_fn(|lane| distance_squared(point, [lanes.x[lane], lanes.y[lane], lanes.z[lane]]));
            // One bit for each photon within the bound; most leaves at the rim of a search have none.
            let bound = found.bound();
            let mut near = 0u32;
            for (lane, &distance) in distances.iter().enumerate() {
                near |= u32::from(distance <= bound) << lane;
            }
            while near != 0 {
                let lane = near.trailing_zeros() as usize % LANES;
                near &= near - 1;
                found.show(distances[lane], lanes.id[lane]);
            }
        }
    }
}
