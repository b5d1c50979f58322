//! Are reads remembered in their order?

use super::*;

#[test]
fn runs_are_cut_where_the_region_changes() {
    let mut reads = SearchReads::default();
    for (region, record) in [(0, 5), (0, 6), (1, 5), (0, 7)] {
        reads.read(region, record);
    }
    let runs: Vec<_> = reads.runs().map(|(region, records)| (region, records.to_vec())).collect();
    assert_eq!(runs, [(0, vec![5, 6]), (1, vec![5]), (0, vec![7])]);
    reads.clear();
    assert!(reads.is_empty() && reads.runs().next().is_none());
}
