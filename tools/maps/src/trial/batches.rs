//! For tests of maps that answer a batch at a time.

use super::{photons, query_points};
use crate::{AnyMap, Blind, BruteForce, Nearest, Search, SearchReads};

/// Panics if the queries of a batch, ten photons sought, do not find what looking at all photons finds for each of them by itself.
pub(crate) fn batch_finds_what_each_query_finds(what: &str, map: &dyn AnyMap, positions: &[[f32; 3]], search: &Search) {
    let oracle = BruteForce::build(&photons(positions.iter().copied())).unwrap();
    let points = query_points(positions);
    let mut found: Vec<_> = points.iter().map(|_| Nearest::new(10, 0.0)).collect();
    search.run_all(map, &points, &mut found, &mut SearchReads::default());
    for (point, found) in points.iter().zip(&found) {
        let mut expected = Nearest::new(10, 0.0);
        search.run(&oracle, *point, &mut expected, &mut Blind);
        assert_eq!(found.sorted(), expected.sorted(), "{what}, {search:?}, {point:?}");
    }
}
