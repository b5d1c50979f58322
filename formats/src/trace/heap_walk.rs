//! Depth-first walks of an implicit binary tree, as decision bits.
//!
//! Node `i` has the children `2i` and `2i + 1`; a child exists if its number is at most the node count. On the way down
//! a node with two children costs one bit (which child comes first), and one more on the way back up (is the other child
//! visited too?); a node with one child costs one bit (is it visited?); leaves cost nothing. The reader needs to know
//! nothing else of the tree: not what is stored in it, not why a search went where it went.

use super::bits::{BitReader, BitWriter};
use crate::region::MAX_NODES;

/// Depth of the deepest tree that can be walked: node numbers stay below 2^31.
const MAX_DEPTH: usize = 32;

/// Codes the walk that `visited` (node numbers minus one, in the order of the visits) begins with. Returns how many
/// visits it has, or `None`, and no bits, if they are no depth-first walk from the root.
pub(super) fn encode(visited: &[u32], nodes: u32, bits: &mut BitWriter) -> Option<usize> {
    let mark = bits.mark();
    let walk = encode_walk(visited, nodes, bits);
    if walk.is_none() {
        bits.rewind(mark);
    }
    walk
}

/// As [`decode`], the loop is over the lowest three levels of the tree, whose bits are arithmetic on seven visits. The way back up
/// from there ends at the level of the visit that comes next: what is undecided below that level is zeros.
fn encode_walk(visited: &[u32], nodes: u32, bits: &mut BitWriter) -> Option<usize> {
    let walk = Visited(visited);
    if walk.number(0) != 1 || nodes == 0 || nodes > MAX_NODES {
        return None;
    }
    // Whether the sibling of the node above or at this one at each level is not yet decided upon, a bit each; and if it is not, of how
    // many levels above it that is so.
    let (mut undecided, mut above) = (0u32, [0u32; MAX_DEPTH]);
    let (mut node, mut level, mut at, mut depth) = (1u32, 0, 0, 0);
    bits.make_room(2 * visited.len() + MAX_DEPTH);
    loop {
        // Down to the lowest three levels: one of two children comes next, whatever the search is after.
        let (mut firsts, from) = (0u64, depth);
        while node <= nodes / 8 {
            let next = walk.number(at + 1);
            if next >> 1 != node {
                return None;
            }
            firsts |= u64::from(next & 1) << (depth - from);
            level += 1;
            undecided |= 1 << level;
            above[level % MAX_DEPTH] = depth;
            depth += 1;
            (node, at) = (next, at + 1);
        }
        match visited.get(at..).and_then(<[u32]>::first_chunk) {
            Some(visits) if 4 * node + 3 <= nodes => {
                let lowest = encode_lowest(visits)?;
                bits.push_all(firsts | lowest.bits << (depth - from), depth - from + lowest.count);
                at += lowest.visits;
            }
            _ => {
                bits.push_all(firsts, depth - from);
                at = walk.encode_below(node, nodes, at, bits)?;
            }
        }
        // Back up, until a second child is visited too.
        let next = walk.number(at);
        let to = (next | 1).ilog2();
        let is_second = undecided >> to & 1 == 1 && node >> (level as u32).saturating_sub(to) ^ 1 == next;
        if !is_second {
            bits.push_all(0, depth);
            return Some(at);
        }
        level = to as usize;
        let left = above[level % MAX_DEPTH];
        let below = depth - left - 1;
        bits.push_all(1 << below, below + 1);
        undecided &= (1 << to) - 1;
        (node, depth) = (next, left);
    }
}

/// The visits of and below a node that has four grandchildren and no more.
struct OfLowest {
    visits: usize,
    bits: u64,
    count: u32,
}

/// Codes those that come first of these; `None` if they are no walk.
#[inline]
fn encode_lowest(visits: &[u32; Lowest::MOST]) -> Option<OfLowest> {
    // How many there are depends on the data, so it is arithmetic and not a branch.
    let number = |at: usize| visits[at % Lowest::MOST].wrapping_add(1);
    let (child, grandchild) = (number(1), number(2));
    let both = u32::from(number(3) == grandchild ^ 1);
    let at = 3 + both as usize;
    let (other, below_other) = (number(at), number(at + 1));
    let second = u32::from(other == child ^ 1);
    let both_of_other = second & u32::from(number(at + 2) == below_other ^ 1);
    if (child >> 1 ^ number(0)) | (grandchild >> 1 ^ child) | (second * (below_other >> 1 ^ other)) != 0 {
        return None;
    }
    let of_first = child & 1 | (grandchild & 1) << 1 | both << 2;
    let of_other = second << 3 | (second & below_other) << 4 | both_of_other << 5;
    let visits = at + (2 * second + both_of_other) as usize;
    Some(OfLowest { visits, bits: u64::from(of_first | of_other), count: 4 + 2 * second })
}

/// Visits that may be a walk.
struct Visited<'a>(&'a [u32]);

impl Visited<'_> {
    /// The node of a visit; behind the last, 0.
    #[inline]
    fn number(&self, at: usize) -> u32 {
        self.0.get(at).map_or(0, |index| index.wrapping_add(1))
    }

    /// Codes the visits from this one on, of and below a node, and tells where they end; `None`, and perhaps bits, if they are no walk.
    fn encode_below(&self, node: u32, nodes: u32, at: usize, bits: &mut BitWriter) -> Option<usize> {
        let (left, next) = (2 * node, self.number(at + 1));
        if left < nodes {
            if next >> 1 != node {
                return None;
            }
            bits.push_all(u64::from(next & 1), 1);
            let at = self.encode_below(next, nodes, at + 1, bits)?;
            let both = self.number(at) == next ^ 1;
            bits.push_all(u64::from(both), 1);
            return if both { self.encode_below(next ^ 1, nodes, at, bits) } else { Some(at) };
        }
        let only = left == nodes;
        if only {
            bits.push_all(u64::from(next == left), 1);
        }
        Some(at + 1 + usize::from(only && next == left))
    }
}

/// Tells `tell` the visits of a walk, in order and in pieces, as node numbers minus one; `None` if the bits end before the walk
/// does.
///
/// The loop is over the lowest three levels of the tree, which most visits are in: what a walk does there is arithmetic on six
/// bits and no branch, the way back up from there is as long as there are zeros, and the way down again is bits side by side.
pub(super) fn decode(
    bits: &mut BitReader<'_>,
    nodes: u32,
    visits: &mut Visits,
    tell: &mut dyn FnMut(&[u32]),
) -> Option<()> {
    if nodes == 0 || nodes > MAX_NODES {
        return None;
    }
    visits.len = 0;
    // Second children, not yet decided upon, of the nodes above.
    let mut others = [0u32; MAX_DEPTH];
    let mut depth = 0;
    let mut node = 1u32;
    loop {
        visits.make_room(tell);
        // Down to the lowest three levels, by the first child of each node.
        let mut ahead = bits.ahead();
        let above = depth;
        while node <= nodes / 8 {
            visits.push(node);
            let first = 2 * node + (ahead & 1) as u32;
            ahead >>= 1;
            others[depth % MAX_DEPTH] = first ^ 1;
            depth += 1;
            node = first;
        }
        let mut looked_at = depth - above;
        if 4 * node + 3 <= nodes {
            let taken = visits.push_lowest(node, ahead);
            ahead >>= taken;
            looked_at += taken;
            bits.skip(looked_at as u32);
        } else {
            bits.skip(looked_at as u32);
            visits.push_below(node, nodes, bits);
            (ahead, looked_at) = (bits.ahead(), 0);
        }
        // Most often all bits that the way back up may have are there.
        if looked_at + depth > BitReader::AHEAD {
            ahead = bits.ahead();
        }
        // Back up, until a second child is visited too.
        let undecided = ahead.trailing_zeros() as usize;
        if undecided >= depth {
            bits.skip(depth as u32);
            tell(&visits.told[..visits.len]);
            return bits.is_within().then_some(());
        }
        bits.skip(undecided as u32 + 1);
        depth -= undecided + 1;
        node = others[depth % MAX_DEPTH];
    }
}

/// A walk through three levels of a tree, from a node with four grandchildren and no further descendants.
#[derive(Clone, Copy)]
struct Lowest {
    /// By visit: all bits set if it is of a child, whose number is twice the node's and more.
    children: [u32; Self::MOST],
    /// The same of grandchildren, four times the node's and more.
    grandchildren: [u32; Self::MOST],
    /// What is more, less one.
    more: [u32; Self::MOST],
    visits: u32,
    bits: u32,
}

impl Lowest {
    /// Visits, and one for room: as many as two vectors hold.
    const MOST: usize = 8;
    /// The bits that decide: which child comes first; which grandchild by it, and whether the other too; whether the other child too;
    /// and of that the same two.
    const BITS: usize = 6;

    /// The walk that these bits decide, and those above them that are none of its own.
    const fn new(ahead: usize) -> Self {
        let empty = [0; Self::MOST];
        let mut walk = Self { children: empty, grandchildren: empty, more: [u32::MAX; Self::MOST], visits: 1, bits: 4 };
        let first = bit_of(ahead, 0);
        walk.visit_child(first, bit_of(ahead, 1), bit_of(ahead, 2));
        if bit_of(ahead, 3) == 1 {
            walk.bits += 2;
            walk.visit_child(first ^ 1, bit_of(ahead, 4), bit_of(ahead, 5));
        }
        walk
    }

    const fn visit_child(&mut self, child: u32, first: u32, both: u32) {
        let at = self.visits as usize;
        self.children[at] = u32::MAX;
        self.more[at] = child.wrapping_sub(1);
        self.visits += 2 + both;
        let mut grandchild = 0;
        while grandchild <= both {
            let at = at + 1 + grandchild as usize;
            self.grandchildren[at] = u32::MAX;
            self.more[at] = (2 * child + (first ^ grandchild)).wrapping_sub(1);
            grandchild += 1;
        }
    }
}

/// A bit of a number.
const fn bit_of(number: usize, at: usize) -> u32 {
    (number >> at & 1) as u32
}

/// By the bits that come next.
static LOWEST: [Lowest; 1 << Lowest::BITS] = {
    let mut walks = [Lowest::new(0); 1 << Lowest::BITS];
    let mut ahead = 0;
    while ahead < walks.len() {
        walks[ahead] = Lowest::new(ahead);
        ahead += 1;
    }
    walks
};

/// Visits that are not yet told of: room for them, which serves one walk after the other.
pub(super) struct Visits {
    told: Box<[u32; Self::ROOM]>,
    len: usize,
}

impl Visits {
    pub(super) fn new() -> Self {
        Self { told: Box::new([0; Self::ROOM]), len: 0 }
    }

    const ROOM: usize = 1024;
    /// The most that are added between two looks at how much room there is: a way down and three levels.
    const STEP: usize = MAX_DEPTH + 8;

    #[inline]
    fn make_room(&mut self, tell: &mut dyn FnMut(&[u32])) {
        if self.len > Self::ROOM - Self::STEP {
            tell(&self.told[..self.len]);
            self.len = 0;
        }
    }

    #[inline]
    fn push(&mut self, node: u32) {
        self.told[self.len % Self::ROOM] = node - 1;
        self.len += 1;
    }

    /// Adds the visits below and of a node that has four grandchildren and no more, and says how many bits they were. Eight are
    /// written always, and those that are made count.
    #[inline]
    fn push_lowest(&mut self, node: u32, ahead: u64) -> usize {
        let walk = &LOWEST[ahead as usize % LOWEST.len()];
        let told: &mut [u32; Lowest::MOST] =
            self.told[self.len..].first_chunk_mut().expect("make_room was asked for a step's room");
        for (i, visit) in told.iter_mut().enumerate() {
            let number = node + (node & walk.children[i]) + ((3 * node) & walk.grandchildren[i]);
            *visit = number.wrapping_add(walk.more[i]);
        }
        self.len += walk.visits as usize;
        walk.bits as usize
    }

    /// The same of any node that has no further descendants.
    fn push_below(&mut self, node: u32, nodes: u32, bits: &mut BitReader<'_>) {
        self.push(node);
        let left = 2 * node;
        if left < nodes {
            let first = left + bits.take();
            self.push_below(first, nodes, bits);
            if bits.take() == 1 {
                self.push_below(first ^ 1, nodes, bits);
            }
        } else if left == nodes && bits.take() == 1 {
            self.push_below(left, nodes, bits);
        }
    }
}

/// Calls `visit` with the number of each node of a walk, and again with that of each inner node when all that is visited below
/// it has been: the second touch of a search that looks at a node's own record last. That costs no bits. `None` if the bits
/// end before the walk does.
pub(super) fn decode_rereading(bits: &mut BitReader<'_>, nodes: u32, mut visit: impl FnMut(u32)) -> Option<()> {
    // Nodes above, and their second children as long as these are not decided upon (else 0).
    let mut above = [(0u32, 0u32); MAX_DEPTH];
    let mut depth = 0;
    if nodes == 0 {
        return None;
    }
    let mut node = 1u32;
    loop {
        visit(node);
        let left = 2 * node;
        if left < nodes {
            let first = left + bits.bit()?;
            above[depth] = (node, first ^ 1);
            depth += 1;
            node = first;
            continue;
        }
        if left == nodes {
            if bits.bit()? == 1 {
                above[depth] = (node, 0);
                depth += 1;
                node = left;
                continue;
            }
            visit(node);
        }
        loop {
            if depth == 0 {
                return Some(());
            }
            let (parent, other) = &mut above[depth - 1];
            if *other != 0 && bits.bit()? == 1 {
                node = std::mem::take(other);
                break;
            }
            depth -= 1;
            visit(*parent);
        }
    }
}

#[cfg(test)]
mod tests;
