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

fn encode_walk(visited: &[u32], nodes: u32, bits: &mut BitWriter) -> Option<usize> {
    // Second children, not yet decided upon, of the nodes above.
    let mut others = [0u32; MAX_DEPTH];
    let mut depth = 0;
    let number = |at: usize| visited.get(at).map_or(0, |index| index.wrapping_add(1));
    let mut node = number(0);
    if node != 1 || nodes == 0 || nodes > MAX_NODES {
        return None;
    }
    let mut at = 0;
    loop {
        let (left, next) = (2 * node, number(at + 1));
        if left < nodes {
            // Two children: one of them comes next, whatever the search is after.
            if next & !1 != left {
                return None;
            }
            bits.push(next != left);
            others[depth] = next ^ 1;
            depth += 1;
        } else if left == nodes {
            bits.push(next == left);
        }
        at += 1;
        if left < nodes || (left == nodes && next == left) {
            node = next;
            continue;
        }
        loop {
            if depth == 0 {
                return Some(at);
            }
            depth -= 1;
            let taken = others[depth] == next;
            bits.push(taken);
            if taken {
                node = next;
                break;
            }
        }
    }
}

/// Calls `visit` with the number of each node of a walk; `None` if the bits end before the walk does.
///
/// With `REREAD` it is called again for each inner node when all that is visited below it has been: the second touch of
/// a search that looks at a node's own record last. That costs no bits.
#[inline]
pub(super) fn decode<const REREAD: bool>(
    bits: &mut BitReader<'_>,
    nodes: u32,
    mut visit: impl FnMut(u32),
) -> Option<()> {
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
            let taken = bits.bit()? == 1;
            if taken && REREAD {
                above[depth] = (node, 0);
                depth += 1;
            }
            if taken {
                node = left;
                continue;
            }
            if REREAD {
                visit(node);
            }
        }
        loop {
            if depth == 0 {
                return Some(());
            }
            let (parent, other) = above[depth - 1];
            if other != 0 && bits.bit()? == 1 {
                if REREAD {
                    above[depth - 1].1 = 0;
                } else {
                    depth -= 1;
                }
                node = other;
                break;
            }
            depth -= 1;
            if REREAD {
                visit(parent);
            }
        }
    }
}

#[cfg(test)]
mod tests;
