//! Which of many comes when they are sorted by key.

/// A part that is sorted by itself holds about so many, 8 bytes each: it fits a core's own cache.
const PART: usize = 1 << 12;
/// Most bits of the key that tell a part from another: so many places are written to in turns.
const MOST_BITS: u32 = 11;

/// Key in the upper half, index in the lower, sorted: equal keys keep the order in which they came. `None` if the system
/// has no memory for so many.
///
/// They are put into parts by their highest bits, and each part is sorted by itself, so that sorting does not go through
/// memory once for each level of a quicksort.
///
/// # Panics
/// If there are more than 2^32 keys.
pub(super) fn sorted_by_key(keys: &[u32]) -> Option<Vec<u64>> {
    assert!(keys.len() <= 1 << 32, "more than 2^32 queries cannot be sorted at once");
    let mut sorted = bytemuck::allocation::try_zeroed_vec::<u64>(keys.len()).ok()?;
    let bits = (keys.len() / PART).checked_ilog2().map_or(0, |bits| (bits + 1).min(MOST_BITS));
    let used = u32::BITS - keys.iter().fold(0, |used, key| used | key).leading_zeros();
    let part_of = |key: u32| (u64::from(key) >> used.saturating_sub(bits)) as usize;
    // Where each part begins; then, while it is filled, where its next one goes.
    let mut places = vec![0; (1 << bits) + 1];
    keys.iter().for_each(|&key| places[part_of(key) + 1] += 1);
    for part in 1..places.len() {
        places[part] += places[part - 1];
    }
    for (index, &key) in (0u64..).zip(keys) {
        let place = &mut places[part_of(key)];
        sorted[*place] = u64::from(key) << 32 | index;
        *place += 1;
    }
    let mut rest = &mut sorted[..];
    let mut begun = 0;
    for &end in &places[..1 << bits] {
        let (part, later) = rest.split_at_mut(end - begun);
        part.sort_unstable();
        (rest, begun) = (later, end);
    }
    Some(sorted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    #[test]
    fn they_are_sorted_as_the_standard_librarys_stable_sort_has_them() {
        let mut random = Random::new(&[7]);
        for n in [0, 1, 2, 1000, 3 * PART, 100_000] {
            for mask in [0, 1, 7, 0xff00, 0x3fff_ffff, u32::MAX] {
                let keys: Vec<u32> = (0..n).map(|_| random.next_u64() as u32 & mask).collect();
                let mut expected: Vec<u64> = (0..n as u64).collect();
                expected.sort_by_key(|&index| keys[index as usize]);
                let found = sorted_by_key(&keys).unwrap();
                assert!(found.iter().map(|at| at & 0xffff_ffff).eq(expected), "{n} with {mask:x}");
                assert!(found.iter().all(|&at| (at >> 32) as u32 == keys[(at & 0xffff_ffff) as usize]));
            }
        }
    }
}
