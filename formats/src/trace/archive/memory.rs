//! What is known of a tree from the walks before, and how the next walk is told by it.

use super::units::{WAYS, is_unit};

/// Most nodes of a tree whose walks are coded so: memory is in proportion.
pub(super) const MOST_NODES: u32 = 1 << 24;
/// Contexts of a decision.
pub(super) const DECISION_CONTEXTS: usize = 4 * 4 * 8 * 8 * 4;
/// What may be known of the tree of seven nodes beside one: a way through it, that there was none, or that it comes later and how
/// the two nodes above were entered.
pub(super) const BESIDE: usize = WAYS + 1 + 4;
/// Contexts of a way through seven nodes.
pub(super) const WAY_CONTEXTS: usize = (WAYS + 1) * BESIDE * 2;

/// There was no way yet.
const NONE: u8 = WAYS as u8;
/// Deepest node of the largest tree, and one more.
const DEPTHS: usize = 32;

/// Whence the next symbol comes, or whither it goes.
pub(super) trait Coder {
    /// A decision of this context.
    fn decision(&mut self, context: usize) -> Option<u32>;
    /// A way through seven nodes of this context.
    fn way(&mut self, context: usize) -> Option<usize>;
}

/// Decisions of the walks so far.
pub(super) struct Memory {
    nodes: u32,
    /// Of each node the last two decisions which child comes first, and the last two whether the second is visited.
    decisions: [Vec<u8>; 2],
    /// Of each node that is the root of a tree of seven, the last way through it.
    ways: Vec<u8>,
}

/// A node above whose second child is not yet decided upon.
#[derive(Clone, Copy, Default)]
struct Above {
    node: u32,
    first: u32,
    entered: u32,
}

impl Memory {
    /// Of a tree that was not yet walked.
    pub(super) fn new(nodes: u32) -> Self {
        Self {
            nodes,
            decisions: [vec![0; nodes as usize / 2 + 2], vec![0; nodes as usize / 2 + 2]],
            ways: vec![NONE; nodes as usize / 4 + 2],
        }
    }

    /// One walk; `None` if the coder ends before it does.
    #[inline]
    pub(super) fn walk(&mut self, coder: &mut impl Coder) -> Option<()> {
        let nodes = self.nodes;
        let mut above = [Above::default(); DEPTHS];
        let mut waiting = 0;
        // Of each depth the last two decisions of each sort in this walk.
        let mut beside = [[0u32; DEPTHS]; 2];
        // How the node and the two above it were entered: 1 as the second child, the node's own lowest.
        let (mut node, mut entered) = (1u32, 0u32);
        if nodes == 0 {
            return None;
        }
        loop {
            let left = 2 * node;
            if is_unit(node, nodes) {
                self.unit(node, entered, coder)?;
            } else if left < nodes {
                let first = self.decision(coder, &mut beside[0], node, entered, 0)?;
                above[waiting & (DEPTHS - 1)] = Above { node, first, entered };
                waiting += 1;
                (node, entered) = (left + first, entered << 1 & 7);
                continue;
            } else if left == nodes && self.decision(coder, &mut beside[0], node, entered, 1)? == 1 {
                (node, entered) = (left, entered << 1 & 7);
                continue;
            }
            loop {
                if waiting == 0 {
                    return Some(());
                }
                waiting -= 1;
                let Above { node: parent, first, entered: above } = above[waiting & (DEPTHS - 1)];
                if self.decision(coder, &mut beside[1], parent, above, 2 + first)? == 1 {
                    (node, entered) = (2 * parent + (first ^ 1), above << 1 & 7 | 1);
                    break;
                }
            }
        }
    }

    /// A decision at a node: which child comes first (0), whether the only one is visited (1), or the second one (2, 3).
    #[inline(always)]
    fn decision(
        &mut self,
        coder: &mut impl Coder,
        beside: &mut [u32; DEPTHS],
        node: u32,
        entered: u32,
        sort: u32,
    ) -> Option<u32> {
        let known = &mut self.decisions[usize::from(sort >= 2)][node as usize];
        let beside = &mut beside[(31 - node.leading_zeros()) as usize & (DEPTHS - 1)];
        let before = u32::from(*known);
        let context = before << 10 | *beside << 8 | entered << 5 | (node & 7) << 2 | sort;
        let bit = coder.decision(context as usize)?;
        *known = ((before << 1 | bit) & 3) as u8;
        *beside = (*beside << 1 | bit) & 3;
        Some(bit)
    }

    /// All that is done in a tree of seven nodes.
    #[inline(always)]
    fn unit(&mut self, node: u32, entered: u32, coder: &mut impl Coder) -> Option<()> {
        let at = node as usize;
        let beside = match entered & 1 {
            1 => usize::from(self.ways[at ^ 1]),
            _ => WAYS + 1 + (entered >> 1) as usize,
        };
        let way = coder.way((usize::from(self.ways[at]) * BESIDE + beside) * 2 + at % 2)?;
        self.ways[at] = way as u8;
        Some(())
    }
}
