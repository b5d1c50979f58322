//! Are the distances those of the definition?

use super::*;

/// The definition: the distinct slots between a use and the one before.
fn brute_force(uses: &[u32], at: usize) -> Option<u32> {
    let before = uses[..at].iter().rposition(|&slot| slot == uses[at])?;
    let mut between = uses[before + 1..at].to_vec();
    between.sort_unstable();
    between.dedup();
    Some(between.len() as u32)
}

fn random_uses(seed: u64, slots: u64, length: usize) -> Vec<u32> {
    let mut state = seed;
    let mut next = move |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    let mut around = 0;
    let uses = (0..length).map(|i| {
        // Now anywhere, now in a neighbourhood that wanders, now the next one.
        around = match (i / 100) % 3 {
            0 => next(slots),
            1 => (around + next(9)) % slots,
            _ => (around + 1) % slots,
        };
        around as u32
    });
    uses.collect()
}

#[test]
fn distances_are_those_of_the_definition() {
    for seed in 0..60 {
        let slots = [1, 2, 15, 16, 17, 18, 40, 200, 900][seed as usize % 9];
        let uses = random_uses(seed, slots, 1500);
        let mut stack = StackDistances::new(slots);
        for (i, &slot) in uses.iter().enumerate() {
            assert_eq!(stack.touch(slot), brute_force(&uses, i), "seed {seed}, use {i}");
        }
    }
}

#[test]
fn a_row_that_is_full_loses_nothing() {
    // Rows so short that bits are moved together often, against one that never fills.
    for (slots, bits) in [(3000, 4096), (200_000, 1 << 18)] {
        let uses = random_uses(slots, slots, 400_000);
        let (mut short, mut long) =
            (StackDistances::with_bits(slots, bits), { StackDistances::with_bits(slots, 1 << 20) });
        for (i, &slot) in uses.iter().enumerate() {
            assert_eq!(short.touch(slot), long.touch(slot), "use {i} of {slots} slots in {bits} bits");
        }
        assert!(short.now < long.now, "the row was full at least once");
    }
}

#[test]
fn a_loop_has_one_distance_at_every_level() {
    // Distances from the top array to beyond one super-group of bits.
    for slots in [1_u64, 15, 16, 17, 64, 65, 4096, 4111, 70_000, 300_000] {
        let mut stack = StackDistances::new(slots);
        for round in 0..3 {
            for slot in 0..slots as u32 {
                let expected = (round > 0).then_some(slots as u32 - 1);
                assert_eq!(stack.touch(slot), expected, "{slots} slots");
            }
        }
        assert_eq!(stack.touched(), slots);
    }
}
