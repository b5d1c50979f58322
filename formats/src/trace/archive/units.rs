//! Whole trees of seven nodes, at the bottom of the tree that is walked: what a walk does in one is one symbol.

/// Ways through a tree of seven nodes.
pub(super) const WAYS: usize = 40;

/// Is the node the root of such a tree?
#[inline(always)]
pub(super) const fn is_unit(node: u32, nodes: u32) -> bool {
    8 * node as u64 > nodes as u64 && 4 * node as u64 + 3 <= nodes as u64
}

/// The decisions of a way, the first one lowest, and how many they are.
///
/// A way has number `4 r + i` if the second child is not visited, else `8 + 16 r + 4 i + j`: `r` says which child comes first, `i` what is
/// done there and `j` what is done at the other one, each twice whether the second child is visited, plus which comes first.
pub(super) const fn decisions(way: usize) -> (u32, u32) {
    // Which child comes first, then what is done there, is the second visited, and what is done there.
    let way = way as u32;
    if way < 8 {
        return (way >> 2 | (way & 3) << 1, 4);
    }
    let way = way - 8;
    (way >> 4 | (way >> 2 & 3) << 1 | 1 << 3 | (way & 3) << 4, 6)
}

/// All of them.
pub(super) const DECISIONS: [(u32, u32); WAYS] = {
    let mut all = [(0, 0); WAYS];
    let mut way = 0;
    while way < WAYS {
        all[way] = decisions(way);
        way += 1;
    }
    all
};

/// The way whose decisions come next, and how many bits they are.
pub(super) fn way(mut bit: impl FnMut() -> Option<u32>) -> Option<usize> {
    let first = bit()?;
    let there = bit()? | bit()? << 1;
    let way = match bit()? {
        0 => 4 * first + there,
        _ => 8 + 16 * first + 4 * there + (bit()? | bit()? << 1),
    };
    Some(way as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_is_told_by_its_decisions() {
        for (number, (bits, count)) in DECISIONS.into_iter().enumerate() {
            let mut at = 0;
            let read = way(|| {
                at += 1;
                Some(bits >> (at - 1) & 1)
            });
            assert_eq!((read, at), (Some(number), count));
        }
    }

    #[test]
    fn units_are_whole_and_at_the_bottom() {
        // Fifteen nodes: two trees of seven below the root. One less: the right one is not whole.
        assert_eq!((1..=15).filter(|&node| is_unit(node, 15)).collect::<Vec<_>>(), [2, 3]);
        assert_eq!((1..=14).filter(|&node| is_unit(node, 14)).collect::<Vec<_>>(), [2]);
        assert_eq!((1..=7).filter(|&node| is_unit(node, 7)).collect::<Vec<_>>(), [1]);
        assert!((1..=6).all(|node| !is_unit(node, 6)));
        assert!(!is_unit(u32::MAX, u32::MAX));
    }
}
