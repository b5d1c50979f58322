//! Are those that are kept the nearest, ties by id?

use super::*;
use proptest::prelude::*;

proptest! {
    #[test]
    fn keeps_the_k_smallest_by_distance_then_id(
        // Few distinct distances, so that ties at the k-th are common.
        distances in prop::collection::vec(0u8..12, 0..80), k in 1usize..20, bound in 0u8..14
    ) {
        let bound = f32::from(bound);
        let mut found = Nearest::new(k, bound);
        // Shown in a scrambled order: which of two equals comes first must not matter.
        let n = distances.len();
        for step in 0..n {
            let id = (step * 7 + 3) % n.max(1);
            if n % 7 == 0 { break; }
            found.show(f32::from(distances[id]), id as u32);
        }
        prop_assume!(n % 7 != 0);
        let mut expected: Vec<_> = distances.iter().enumerate().map(|(id, &d)| (f32::from(d), id as u32))
            .filter(|&(d, _)| d <= bound).collect();
        expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        expected.truncate(k);
        prop_assert_eq!(found.sorted(), expected.clone());
        prop_assert_eq!(found.farthest(), expected.last().copied());
        let mut together = vec![];
        found.for_photons(|ids, distances| together.extend(distances.iter().copied().zip(ids.iter().copied())));
        prop_assert_eq!(together, found.places().collect::<Vec<_>>());
    }
}

#[test]
fn nan_is_never_near() {
    let mut found = Nearest::new(1, f32::INFINITY);
    found.show(f32::NAN, 0);
    assert!(found.is_empty());
}
