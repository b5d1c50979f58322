//! Blocks of a few photons each, whose distances are computed side by side.

use super::Nearest;
use super::geometry::distance_squared;
use super::point::Point;

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
pub(super) struct PhotonBlocks {
    lanes: Vec<Lanes>,
    lanes_per_block: usize,
    counts: Vec<u32>,
}

impl PhotonBlocks {
    /// `count` empty blocks with room for `capacity` photons each.
    pub(super) fn new(count: usize, capacity: usize) -> Self {
        let lanes_per_block = capacity.div_ceil(LANES);
        Self { lanes: vec![EMPTY; count * lanes_per_block], lanes_per_block, counts: vec![0; count] }
    }

    /// Number of blocks.
    pub(super) const fn len(&self) -> usize {
        self.counts.len()
    }

    /// Puts photons into a block that is empty.
    pub(super) fn fill(&mut self, block: usize, points: &[Point]) {
        self.counts[block] = u32::try_from(points.len()).expect("a block's worth of photons");
        for (lanes, points) in self.lanes[block * self.lanes_per_block..].iter_mut().zip(points.chunks(LANES)) {
            for (lane, point) in points.iter().enumerate() {
                [lanes.x[lane], lanes.y[lane], lanes.z[lane]] = point.position;
                lanes.id[lane] = point.id;
            }
        }
    }

    /// Number of photons in a block.
    #[inline]
    pub(super) fn count(&self, block: usize) -> usize {
        self.counts[block] as usize
    }

    /// Ids of the photons in a block.
    pub(super) fn ids(&self, block: usize) -> impl Iterator<Item = u32> {
        let lanes = &self.lanes[block * self.lanes_per_block..(block + 1) * self.lanes_per_block];
        lanes.iter().flat_map(|lanes| lanes.id).take(self.count(block))
    }

    /// Shows all photons of a block to `found`.
    #[inline]
    pub(super) fn show(&self, block: usize, point: [f32; 3], found: &mut Nearest) {
        let from = block * self.lanes_per_block;
        for lanes in &self.lanes[from..from + self.lanes_per_block] {
            let distances: [f32; LANES] =
                std::array::from_fn(|lane| distance_squared(point, [lanes.x[lane], lanes.y[lane], lanes.z[lane]]));
            // One bit for each photon within the bound; most blocks at the rim of a search have none.
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
