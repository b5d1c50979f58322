//! Is what does not fit the store charged for every time that it goes out and in?

use super::*;

const fn store(bytes: u64) -> Store {
    Store { bytes, record: StoredQuery::Full }
}

#[test]
fn what_fits_is_not_spilled_and_a_sort_beyond_goes_out_and_in_once() {
    let store = store(44 * 1000);
    assert_eq!([0, 1, 1000].map(|n| store.spilled_by_sort(n)), [0; 3]);
    // One record too many: it goes out, and six more for the buffer of its run.
    assert_eq!(store.spilled_by_sort(1001), 1 + 6);
    // 100 runs: every record but about a store's worth, less than once.
    let spilled = store.spilled_by_sort(101_000);
    assert!((100_000..=101_000).contains(&spilled), "{spilled}");
    // 171 runs can be merged at once: beyond, all goes once more.
    assert_eq!(store.fan(), 171);
    let spilled = store.spilled_by_sort(1_000_000);
    assert!((1_999_000..=2_000_000).contains(&spilled), "{spilled}");
}

#[test]
fn partitions_beyond_the_buffers_take_another_pass() {
    let store = store(256 * 10);
    assert_eq!([1, 10, 11, 100, 101].map(|parts| store.passes_to_part(parts)), [1, 1, 2, 2, 3]);
    // However little there is, it ends.
    assert!(Store { bytes: 0, record: StoredQuery::Full }.passes_to_part(u64::MAX) <= 64);
    assert!(Store { bytes: 0, record: StoredQuery::Full }.spilled_by_sort(1 << 40) > 0);
}
