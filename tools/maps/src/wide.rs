//! A tree of sixteen children a node over leaves of sixteen photons, all of them side by side: the fast one.
//!
//! Median splits, as of a kd-tree, are cut into nodes of sixteen boxes; nodes and leaves lie level by level without
//! pointers. A search knows its radius before it begins (from the fitted radius, from the search before, or from a box that
//! holds enough photons), collects what lies within it, and selects the k nearest at the end: there is no heap. What a node
//! or a leaf asks of its sixteen children is the same arithmetic on sixteen lanes, for which there are three paths (AVX-512,
//! AVX2, plain loops) that find the same to the last bit.

mod build;
mod group;
mod instructions;
mod kernels;
mod search;
mod select;

pub use instructions::Instructions;

use crate::candidates::WIDTH;
use crate::error::check;
use crate::vicinity::{Ball, Vicinity};
use crate::{AccessObserver, BuildError, Nearest, PhotonMap};
use group::{Collect, LookThrough};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};
use search::Find;
use std::sync::Arc;

/// Number of the region that holds the nodes.
const NODES: u16 = 0;
/// Number of the region that holds the photons.
const LEAVES: u16 = 1;

/// The boxes of a node's children, tight; of a child that is not there, not numbers.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Boxes {
    pub(crate) low: [[f32; WIDTH]; 3],
    pub(crate) high: [[f32; WIDTH]; 3],
}

/// Photons side by side; where there is none, not numbers.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Leaf {
    pub(crate) position: [[f32; WIDTH]; 3],
}

/// Nodes of one level: children of node i are 16 i to 16 i + 15 of the level below, or leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level {
    /// Index of the level's first node among all.
    pub(crate) first: u32,
    /// Photons below a node, all of them full but the last.
    pub(crate) photons: u64,
}

/// The tree.
pub struct WideTree {
    /// From the root on, level by level.
    pub(crate) levels: Vec<Level>,
    pub(crate) nodes: Vec<Boxes>,
    pub(crate) leaves: Vec<Leaf>,
    /// Ids of the photons: those of the first leaf, lane by lane, and so on. Asked for at the end of a search only.
    pub(crate) ids: Arc<[u32]>,
    pub(crate) photons: usize,
    instructions: Instructions,
    /// Queries of a group at most.
    group: usize,
}

impl WideTree {
    /// Builds the tree in O(n log n), for the best instructions that this machine has.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon]) -> Result<Self, BuildError> {
        check(photons)?;
        Ok(build::build(photons, Instructions::best()))
    }

    /// The same tree, one search of which serves so many neighbouring queries at most: see [`Groups`](crate::Groups).
    #[must_use]
    pub fn in_groups_of(self, group: usize) -> Self {
        Self { group, ..self }
    }

    /// The same tree, searched by other instructions; the answers are the same.
    ///
    /// # Panics
    /// If this machine has no such instructions.
    #[must_use]
    pub fn with(self, instructions: Instructions) -> Self {
        assert!(instructions.are_there(), "no {instructions:?} on this machine");
        Self { instructions, ..self }
    }
}

impl PhotonMap for WideTree {
    fn regions(&self, _: bool) -> Vec<Region> {
        let node = size_of::<Boxes>() as u32;
        // A photon is as long here as in any map.
        let leaf = (WIDTH * size_of::<Photon>()) as u32;
        let bytes = |count: usize, record: u32| count as u64 * u64::from(record);
        lay_out([
            ("nodes".into(), bytes(self.nodes.len(), node), node, Coding::InTurns),
            ("photon leaves".into(), bytes(self.leaves.len(), leaf), leaf, Coding::InTurns),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn order(&self) -> Option<&Arc<[u32]>> {
        Some(&self.ids)
    }

    fn narrows(&self) -> bool {
        false
    }

    fn group(&self) -> usize {
        self.group
    }

    fn surround(&self, ball: &Ball, into: &mut Vicinity, room: &mut Nearest, eyes: &mut impl AccessObserver) -> bool {
        self.photons >= ball.k && self.instructions.run(Collect { tree: self, ball, into, room: &mut room.room, eyes })
    }

    fn nearest_of_surrounding(&self, vicinity: &Vicinity, point: [f32; 3], max_dist: f32, found: &mut Nearest) {
        self.instructions.run(LookThrough { tree: self, vicinity, point, max_dist, found });
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if self.photons > 0 {
            self.instructions.run(Find { tree: self, point, found, eyes });
        }
    }
}

#[cfg(test)]
mod tests;
