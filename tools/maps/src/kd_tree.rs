//! The left-balanced kd-tree of Jensen's photon map: one photon a node, no pointers, children of node i at 2i and 2i + 1.
//!
//! Bentley, *Multidimensional binary search trees used for associative searching*, CACM 18(9), 1975; Jensen, *Realistic
//! Image Synthesis Using Photon Mapping*, 2001, appendix B.

use super::layout::{Layout, left_size, place};
use super::{AccessObserver, Box3, BuildError, Nearest, PhotonMap, check, distance_squared, extent, longest_axis};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};

/// Deepest tree of at most 2^30 nodes, and one more.
const MAX_DEPTH: usize = 32;

/// The tree. In the memory that is traced a node is the 20-byte photon with its split axis; here it holds what a search
/// needs, in 16 bytes.
pub struct KdTree {
    /// Node i at index i - 1.
    nodes: Vec<Node>,
    /// Which record of the traced memory each node is; empty if node i is record i - 1.
    places: Vec<u32>,
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
        let places = layout.places(nodes.len());
        Ok(Self { nodes, places, line: None })
    }

    /// The same tree with its records padded, so that none crosses from one line of this many bytes into the next.
    ///
    /// # Panics
    /// If a line is smaller than a record.
    #[must_use]
    pub fn padded(self, line: u32) -> Self {
        assert!(line as usize >= size_of::<Photon>(), "a record must fit a line");
        Self { line: Some(line), ..self }
    }

    /// Which record of the traced memory a node is.
    #[inline(always)]
    fn record(&self, node: usize) -> u32 {
        place(&self.places, node)
    }

    /// Split axis and photon id of each node, in the order of the traced memory.
    pub fn nodes(&self) -> impl Iterator<Item = (usize, u32)> {
        self.nodes.iter().map(|node| (node.axis(), node.id()))
    }
}

fn balance(nodes: &mut [Node], at: usize, rest: &mut [Node], cell: Box3) {
    if rest.is_empty() {
        return;
    }
    let axis = longest_axis(&cell);
    let middle = left_size(rest.len());
    let (left, &mut median, right) = rest.select_nth_unstable_by(middle, |a, b| {
        // No NaN gets here; -0 and 0 are one coordinate.
        a.position[axis].partial_cmp(&b.position[axis]).unwrap_or(std::cmp::Ordering::Equal).then(a.id().cmp(&b.id()))
    });
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
        let heap = self.places.is_empty() && self.line.is_none();
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

    /// Jensen's search: the child on the query's side first, then the other if the splitting plane lies within the
    /// bound, then the node's own photon. A node is read when it is reached, and the inner ones are looked at again for
    /// their own photon.
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        let nodes = &self.nodes[..];
        let count = nodes.len();
        if count == 0 {
            return;
        }
        // Nodes above whose second child and own photon are still to be looked at: node, second child (0: done with),
        // squared distance to the splitting plane.
        let mut above = [(0u32, 0u32, 0f32); MAX_DEPTH];
        let mut depth = 0;
        let mut at = 1;
        loop {
            let node = &nodes[at - 1];
            eyes.read(0, self.record(at));
            eyes.examined(1);
            let left = 2 * at;
            if left <= count {
                let axis = node.axis();
                let delta = point[axis] - node.position[axis];
                let (near, far) = if delta > 0.0 { (left + 1, left) } else { (left, left + 1) };
                if near <= count {
                    above[depth] = (at as u32, if far <= count { far as u32 } else { 0 }, delta * delta);
                    depth += 1;
                    at = near;
                    continue;
                }
                // The only child lies on the other side.
                if delta * delta <= found.bound() {
                    above[depth] = (at as u32, 0, 0.0);
                    depth += 1;
                    at = far;
                    continue;
                }
                eyes.reread(0, self.record(at));
            }
            found.show(distance_squared(point, node.position), node.id());
            loop {
                if depth == 0 {
                    return;
                }
                let (parent, far, plane) = above[depth - 1];
                // Not `<`: a photon as far as the farthest found may have the smaller id.
                if far != 0 && plane <= found.bound() {
                    above[depth - 1].1 = 0;
                    at = far as usize;
                    break;
                }
                depth -= 1;
                eyes.reread(0, self.record(parent as usize));
                let node = &nodes[parent as usize - 1];
                found.show(distance_squared(point, node.position), node.id());
            }
        }
    }
}
