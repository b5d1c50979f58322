//! Numbers that differ from the one before: line accesses without repeats, packed together.

mod instructions;

use instructions::Instructions;

/// How many more numbers than it is given [`pack_changes`] needs room for.
pub(super) const SLACK: usize = 8;

/// Writes those of `numbers` to the front of `to` that differ from the one before, the first from `before`, and tells how many
/// there are.
///
/// # Panics
/// If there is not room for all, and [`SLACK`] more.
pub(super) fn pack_changes(numbers: &[u32], before: u32, to: &mut [u32]) -> usize {
    Instructions::best().pack_changes(numbers, before, to)
}

/// The same in the instructions that every machine has.
fn pack_changes_one_by_one(numbers: &[u32], mut before: u32, to: &mut [u32]) -> usize {
    // Which of them differ depends on the data, so it is arithmetic and not a branch: each is written where the next one goes,
    // and the place is taken or not.
    let to = &mut to[..numbers.len() + SLACK];
    let mut len = 0;
    for &number in numbers {
        to[len] = number;
        len += usize::from(number != before);
        before = number;
    }
    len
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    #[test]
    fn all_instructions_pack_what_the_definition_says() {
        let mut random = Random::new(&[3]);
        for round in 0..2000_usize {
            let len = round % 67;
            // Few different ones, so that there are runs of all lengths, and now and then the one before.
            let most = 1 + round as u32 % 5;
            let numbers: Vec<u32> = (0..len).map(|_| u32::MAX - (random.next_u64() % u64::from(most)) as u32).collect();
            let before = u32::MAX - (random.next_u64() % u64::from(most)) as u32;
            let mut expected: Vec<u32> = std::iter::once(before).chain(numbers.iter().copied()).collect();
            expected.dedup();
            expected.remove(0);
            for instructions in Instructions::ALL.into_iter().filter(|instructions| instructions.are_there()) {
                let mut to = vec![7; len + SLACK];
                let packed = instructions.pack_changes(&numbers, before, &mut to);
                assert_eq!(to[..packed], expected, "{instructions:?} {numbers:?} after {before}");
            }
        }
    }

    #[test]
    #[should_panic(expected = "out of range")]
    fn room_that_is_too_small_is_not_written_past() {
        pack_changes(&[1; 32], 0, &mut [0; 32]);
    }
}
