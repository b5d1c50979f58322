//! Walks come back, cost what is said, and nothing else is taken for one.

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

/// A walk that visits both children of the nodes on so many levels and one of those below; `choices` say which, and
/// whether both on the lowest levels.
fn walk_wide_above(node: u32, nodes: u32, levels: u32, choices: &mut impl FnMut() -> bool, visited: &mut Vec<u32>) {
    visited.push(node - 1);
    if 2 * node < nodes {
        let first = 2 * node + u32::from(choices());
        walk_wide_above(first, nodes, levels.saturating_sub(1), choices, visited);
        if levels > 0 || (node > nodes / 8 && choices()) {
            walk_wide_above(first ^ 1, nodes, levels.saturating_sub(1), choices, visited);
        }
    }
}

fn decoded(bytes: &[u8], nodes: u32) -> Option<Vec<u32>> {
    let mut visited = vec![];
    decode(&mut BitReader::new(bytes), nodes, &mut Visits::new(), &mut |visits| visited.extend_from_slice(visits))
        .map(|()| visited)
}

fn decoded_with_rereads(bytes: &[u8], nodes: u32) -> Option<Vec<u32>> {
    let mut touched = vec![];
    decode_rereading(&mut BitReader::new(bytes), nodes, |node| touched.push(node - 1)).map(|()| touched)
}

proptest! {
    #[test]
    fn any_walk_comes_back(nodes in prop_oneof![1u32..200, 200u32..9000], choices in prop::collection::vec(any::<bool>(), 0..512)) {
        let mut choices = choices.into_iter().cycle();
        let (mut visited, mut touched, mut made) = (vec![], vec![], BitWriter::default());
        let mut choose = || {
            let choice = choices.next().unwrap_or(true);
            made.make_room(1);
            made.push_all(choice.into(), 1);
            choice
        };
        walk(1, nodes, &mut choose, &mut visited, &mut touched);
        let mut bits = BitWriter::default();
        prop_assert_eq!(encode(&visited, nodes, &mut bits), Some(visited.len()));
        // The bits are the choices, one by one, and no more.
        prop_assert_eq!(bits.mark(), made.mark());
        bits.align();
        made.align();
        prop_assert_eq!(bits.bytes(), made.bytes());
        prop_assert_eq!(decoded(bits.bytes(), nodes), Some(visited.clone()));
        prop_assert_eq!(decoded_with_rereads(bits.bytes(), nodes), Some(touched));
        // A second walk right behind it is told apart.
        let twice = [visited.clone(), visited.clone()].concat();
        prop_assert_eq!(encode(&twice, nodes, &mut BitWriter::default()), Some(visited.len()));
    }

    #[test]
    fn walks_of_the_deepest_trees_come_back(
        nodes in prop_oneof![1u32 << 26..1 << 29, 1 << 29..=MAX_NODES, Just(MAX_NODES), Just((1 << 28) + 1)],
        levels in 0u32..7,
        choices in prop::collection::vec(any::<bool>(), 1..400),
    ) {
        // The way back up is longer than what is left of the bits that are looked at together.
        let mut choices = choices.into_iter().cycle();
        let mut visited = vec![];
        walk_wide_above(1, nodes, levels, &mut || choices.next().unwrap_or(true), &mut visited);
        let mut bits = BitWriter::default();
        prop_assert_eq!(encode(&visited, nodes, &mut bits), Some(visited.len()));
        bits.align();
        prop_assert_eq!(decoded(bits.bytes(), nodes), Some(visited));
    }

    #[test]
    fn what_is_no_walk_leaves_no_bits(visited in prop::collection::vec(0u32..40, 0..30), nodes in 0u32..40) {
        let mut bits = BitWriter::default();
        bits.make_room(1);
        bits.push_all(1, 1);
        match encode(&visited, nodes, &mut bits) {
            None => prop_assert_eq!(bits.mark(), (0, 1, 1)),
            Some(len) => {
                // Then it is one: decoding gives the same visits.
                let mut bits = BitWriter::default();
                encode(&visited, nodes, &mut bits);
                bits.align();
                prop_assert_eq!(decoded(bits.bytes(), nodes), Some(visited[..len].to_vec()));
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
    assert_eq!(bits.mark().2, 6);
}
