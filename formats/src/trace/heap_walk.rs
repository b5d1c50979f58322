//! Depth-first walks of an implicit binary tree, as decision bits.
//!
//! Node `i` has the children `2i` and `2i + 1`; a child exists if its number is at most the node count. On the way down
//! a node with two children costs one bit (which child comes first), and one more on the way back up (is the other child
//! visited too?); a node with one child costs one bit (is it visited?); leaves cost nothing. The reader needs to know
//! nothing else of the tree: not what is stored in it, not why a search went where it went.

/// Depth of the deepest tree that can be walked: node numbers stay below 2^31.
const MAX_DEPTH: usize = 32;
/// Most nodes of a tree.
pub(crate) const MAX_NODES: u32 = (1 << 31) - 1;

/// Bits, least significant first within each byte.
#[derive(Default)]
pub(super) struct BitWriter {
    pub(super) bytes: Vec<u8>,
    pending: u64,
    count: u32,
}

impl BitWriter {
    #[inline]
    fn push(&mut self, bit: bool) {
        self.pending |= u64::from(bit) << self.count;
        self.count += 1;
        if self.count == 64 {
            self.bytes.extend_from_slice(&self.pending.to_le_bytes());
            (self.pending, self.count) = (0, 0);
        }
    }

    /// Fills the last byte with zeros.
    pub(super) fn align(&mut self) {
        let whole = self.count.div_ceil(8) as usize;
        self.bytes.extend_from_slice(&self.pending.to_le_bytes()[..whole]);
        (self.pending, self.count) = (0, 0);
    }

    /// Forgets all bits since the writer was aligned at `len` bytes.
    fn rewind(&mut self, (len, pending, count): (usize, u64, u32)) {
        self.bytes.truncate(len);
        (self.pending, self.count) = (pending, count);
    }

    fn mark(&self) -> (usize, u64, u32) {
        (self.bytes.len(), self.pending, self.count)
    }
}

/// Reads what [`BitWriter`] wrote.
pub(super) struct BitReader<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> BitReader<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0 }
    }

    #[inline(always)]
    fn bit(&mut self) -> Option<u32> {
        let byte = *self.bytes.get(self.position >> 3)?;
        let bit = u32::from(byte >> (self.position & 7)) & 1;
        self.position += 1;
        Some(bit)
    }

    pub(super) const fn align(&mut self) {
        self.position = self.position.next_multiple_of(8);
    }

    /// Number of whole bytes read.
    pub(super) const fn bytes_read(&self) -> usize {
        self.position / 8
    }
}

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
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A depth-first walk that goes where `choices` say: the definition, by recursion. Also with second touches.
    fn walk(node: u32, nodes: u32, choices: &mut impl FnMut() -> bool, visited: &mut Vec<u32>, touched: &mut Vec<u32>) {
        visited.push(node - 1);
        touched.push(node - 1);
        let children: Vec<u32> = [2 * node, 2 * node + 1].into_iter().filter(|&c| c <= nodes).collect();
        match children[..] {
            [left, right] => {
                let (first, other) = if choices() { (right, left) } else { (left, right) };
                walk(first, nodes, choices, visited, touched);
                if choices() {
                    walk(other, nodes, choices, visited, touched);
                }
            }
            [only] if choices() => walk(only, nodes, choices, visited, touched),
            _ => {}
        }
        if !children.is_empty() {
            touched.push(node - 1);
        }
    }

    fn decoded(bytes: &[u8], nodes: u32) -> Option<Vec<u32>> {
        let mut visited = vec![];
        decode::<false>(&mut BitReader::new(bytes), nodes, |node| visited.push(node - 1)).map(|()| visited)
    }

    fn decoded_with_rereads(bytes: &[u8], nodes: u32) -> Option<Vec<u32>> {
        let mut touched = vec![];
        decode::<true>(&mut BitReader::new(bytes), nodes, |node| touched.push(node - 1)).map(|()| touched)
    }

    proptest! {
        #[test]
        fn any_walk_comes_back(nodes in 1u32..200, choices in prop::collection::vec(any::<bool>(), 0..512)) {
            let mut choices = choices.into_iter().cycle();
            let (mut visited, mut touched) = (vec![], vec![]);
            walk(1, nodes, &mut || choices.next().unwrap_or(true), &mut visited, &mut touched);
            let mut bits = BitWriter::default();
            prop_assert_eq!(encode(&visited, nodes, &mut bits), Some(visited.len()));
            bits.align();
            prop_assert_eq!(decoded(&bits.bytes, nodes), Some(visited.clone()));
            prop_assert_eq!(decoded_with_rereads(&bits.bytes, nodes), Some(touched));
            // A second walk right behind it is told apart.
            let twice = [visited.clone(), visited.clone()].concat();
            prop_assert_eq!(encode(&twice, nodes, &mut BitWriter::default()), Some(visited.len()));
        }

        #[test]
        fn what_is_no_walk_leaves_no_bits(visited in prop::collection::vec(0u32..40, 0..30), nodes in 0u32..40) {
            let mut bits = BitWriter::default();
            bits.push(true);
            match encode(&visited, nodes, &mut bits) {
                None => prop_assert_eq!(bits.mark(), (0, 1, 1)),
                Some(len) => {
                    // Then it is one: decoding gives the same visits.
                    let mut bits = BitWriter::default();
                    encode(&visited, nodes, &mut bits);
                    bits.align();
                    prop_assert_eq!(decoded(&bits.bytes, nodes), Some(visited[..len].to_vec()));
                }
            }
        }

        #[test]
        fn random_bits_never_run_away(bytes in prop::collection::vec(any::<u8>(), 0..64), nodes in 0u32..MAX_NODES) {
            if let Some(visited) = decoded(&bytes, nodes) {
                prop_assert!(visited.len() <= bytes.len() * 8 + 1);
                prop_assert!(visited.iter().all(|&index| index < nodes));
            }
        }
    }

    #[test]
    fn costs_what_the_module_says() {
        // Seven nodes, all visited: three inner nodes at two bits each.
        let mut bits = BitWriter::default();
        assert_eq!(encode(&[0, 1, 3, 4, 2, 5, 6], 7, &mut bits), Some(7));
        assert_eq!(bits.count, 6);
    }
}
