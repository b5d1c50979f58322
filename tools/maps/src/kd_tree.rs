//! The left-balanced kd-tree of Jensen's photon map: one photon a node, no pointers, children of node i at 2i and 2i + 1.
//!
//! Bentley, *Multidimensional binary search trees used for associative searching*, CACM 18(9), 1975; Jensen, *Realistic
//! Image Synthesis Using Photon Mapping*, 2001, appendix B.

mod search;

use super::error::check;
use super::geometry::{Box3, extent, longest_axis};
use super::layout::{Layout, left_size, record_of};
use super::select_nth::{Placed, select_nth};
use super::{AccessObserver, BuildError, Nearest, PhotonMap};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};

/// The tree. In the memory that is traced a node is the 20-byte photon with its split axis; here it holds what a search
/// needs, in 16 bytes.
pub struct KdTree {
    /// Node i at index i - 1.
    nodes: Vec<Node>,
    /// Which record of the traced memory each node is; empty if node i is record i - 1.
    records: Vec<u32>,
    /// Bytes of the lines that no record crosses, if the records are padded.
    line: Option<u32>,
}

#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
struct Node {
    position: [f32; 3],
    /// Photon id in the low 30 bits, split axis in the high two.
    id_and_axis: u32,
}

impl Node {
    #[inline(always)]
    const fn id(self) -> u32 {
        self.id_and_axis & 0x3fff_ffff
    }

    #[inline(always)]
    const fn axis(self) -> usize {
        (self.id_and_axis >> 30) as usize
    }
}

impl Placed for Node {
    #[inline(always)]
    fn coordinate(&self, axis: usize) -> f32 {
        self.position[axis]
    }

    #[inline(always)]
    fn id(&self) -> u32 {
        Self::id(*self)
    }
}

impl KdTree {
    /// Builds the tree in O(n log n). Each node splits along the longest side of its cell (the cell is cut by every split
    /// above, not shrunk to its photons); photons are ordered by (coordinate, id), so equal coordinates do no harm.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], layout: Layout) -> Result<Self, BuildError> {
        check(photons)?;
        let mut rest: Vec<Node> =
            (0..).zip(photons).map(|(id, photon)| Node { position: photon.position, id_and_axis: id }).collect();
        let cell = extent(rest.iter().map(|node| node.position));
        let mut nodes = vec![Node::default(); rest.len()];
        balance(&mut nodes, 1, &mut rest, cell);
        let records = layout.records(nodes.len());
        Ok(Self { nodes, records, line: None })
    }

    /// The same tree with its records padded, so that none crosses from one line of this many bytes into the next.
    ///
    /// # Errors
    /// If a line is smaller than a record.
    pub fn padded(self, line: u32) -> Result<Self, BuildError> {
        BuildError::unless_fits(line, size_of::<Photon>() as u32)?;
        Ok(Self { line: Some(line), ..self })
    }

    /// Which record of the traced memory a node is.
    #[inline(always)]
    fn record(&self, node: usize) -> u32 {
        record_of(&self.records, node)
    }

    /// Split axis and photon id of each node, in the order of the traced memory.
    pub fn nodes(&self) -> impl Iterator<Item = (usize, u32)> {
        self.nodes.iter().map(|node| (node.axis(), node.id()))
    }
}

fn balance(nodes: &mut [Node], at: usize, rest: &mut [Node], cell: Box3) {
    let axis = longest_axis(&cell);
    match rest {
        [] => return,
        [node] => {
            nodes[at - 1] = Node { id_and_axis: node.id() | (axis as u32) << 30, ..*node };
            return;
        }
        _ => {}
    }
    let middle = left_size(rest.len());
    select_nth(rest, middle, axis);
    let (left, others) = rest.split_at_mut(middle);
    let Some((&mut median, right)) = others.split_first_mut() else { return };
    let split = median.position[axis];
    nodes[at - 1] = Node { id_and_axis: median.id() | (axis as u32) << 30, ..median };
    let (mut left_cell, mut right_cell) = (cell, cell);
    left_cell.1[axis] = split;
    right_cell.0[axis] = split;
    balance(nodes, 2 * at, left, left_cell);
    balance(nodes, 2 * at + 1, right, right_cell);
}

impl PhotonMap for KdTree {
    fn regions(&self, reread: bool) -> Vec<Region> {
        let record = size_of::<Photon>() as u32;
        let nodes = u32::try_from(self.nodes.len()).expect("checked when built");
        let heap = self.records.is_empty() && self.line.is_none();
        let coding = if heap { Coding::HeapWalk { nodes, reread } } else { Coding::Records };
        let bytes = match self.line {
            Some(line) => u64::from(nodes.div_ceil(line / record)) * u64::from(line),
            None => u64::from(nodes) * u64::from(record),
        };
        lay_out([("kd nodes".into(), bytes, record, coding)])
    }

    fn len(&self) -> usize {
        self.nodes.len()
    }

    fn padding(&self) -> Option<u32> {
        self.line
    }

    fn tells_waits(&self) -> bool {
        true
    }

    #[inline]
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        search::nearest(self, point, found, eyes);
    }
}

#[cfg(test)]
mod tests;
