//! The queries of a batch in a tree of boxes, by which a photon finds those whose balls it lies in.

use crate::Nearest;
use crate::geometry::{Box3, distance_squared, extent, longest_axis};

/// Queries of a leaf, at most.
const LEAF: usize = 4;

/// A box of queries.
struct Node {
    bounds: Box3,
    /// The greatest squared radius of its queries' balls.
    bound: f32,
    /// Its queries, as places in the order of the tree; of a node that is no leaf, those of its children one after the other.
    queries: std::ops::Range<usize>,
    /// Number of the second child; the first comes right behind its parent. 0 of a leaf.
    second: usize,
}

/// The tree.
pub(super) struct QueryIndex {
    nodes: Vec<Node>,
    /// Number and point of each query, in the order of the tree.
    queries: Vec<(usize, [f32; 3])>,
}

impl QueryIndex {
    /// Of queries at these points, whose balls are those within the bounds of what was found so far.
    pub(super) fn new(points: &[[f32; 3]], found: &[&mut Nearest]) -> Self {
        let queries: Vec<_> = points.iter().copied().enumerate().collect();
        let mut index = Self { nodes: vec![], queries };
        if !points.is_empty() {
            index.split(0..points.len(), found);
        }
        index
    }

    /// Makes the node of these queries and those below it.
    fn split(&mut self, range: std::ops::Range<usize>, found: &[&mut Nearest]) {
        let own = &mut self.queries[range.clone()];
        let bounds = extent(own.iter().map(|&(_, point)| point));
        let bound = own.iter().map(|&(query, _)| found[query].bound()).fold(f32::NEG_INFINITY, f32::max);
        let at = self.nodes.len();
        self.nodes.push(Node { bounds, bound, queries: range.clone(), second: 0 });
        if range.len() > LEAF {
            let (axis, middle) = (longest_axis(&bounds), range.len() / 2);
            own.select_nth_unstable_by(middle, |a, b| a.1[axis].total_cmp(&b.1[axis]).then(a.0.cmp(&b.0)));
            self.split(range.start..range.start + middle, found);
            self.nodes[at].second = self.nodes.len();
            self.split(range.start + middle..range.end, found);
        }
    }

    /// Offers a photon to all queries in whose balls it lies: `take` is told the query and the squared distance, and says the
    /// query's bound from then on. Returns how many distances were computed.
    pub(super) fn offer(&mut self, photon: [f32; 3], mut take: impl FnMut(usize, f32) -> f32) -> usize {
        if self.nodes.is_empty() { 0 } else { self.offer_below(0, photon, &mut take) }
    }

    fn offer_below(&mut self, at: usize, photon: [f32; 3], take: &mut impl FnMut(usize, f32) -> f32) -> usize {
        let Node { ref bounds, bound, ref queries, second } = self.nodes[at];
        // Also true for NaN, of which there is none. Rounding keeps the order, so no point of the box is nearer than this.
        if outside(photon, bounds) > bound {
            return 0;
        }
        if second == 0 {
            let (mut largest, queries) = (f32::NEG_INFINITY, queries.clone());
            for &(query, point) in &self.queries[queries.clone()] {
                largest = largest.max(take(query, distance_squared(point, photon)));
            }
            self.nodes[at].bound = largest;
            return queries.len();
        }
        let examined = self.offer_below(at + 1, photon, take) + self.offer_below(second, photon, take);
        self.nodes[at].bound = self.nodes[at + 1].bound.max(self.nodes[second].bound);
        examined
    }
}

/// Squared distance of a point from a box, 0 within; computed as those of points are.
fn outside(point: [f32; 3], (low, high): &Box3) -> f32 {
    let nearest = [0, 1, 2].map(|axis| point[axis].clamp(low[axis], high[axis]));
    distance_squared(nearest, point)
}
