//! Are runs as long as the theorem says?

use super::*;
use crate::{Per, Reordering, StoredQuery};
use bytemuck::Zeroable as _;
use pm_formats::vocabulary::measure;
use pm_formats::{BlockMeta, Number};
use pm_random::Random;

#[test]
fn runs_are_twice_as_long_as_the_store() {
    // Knuth's theorem for keys in random order.
    let room = 500;
    let store = Store { bytes: room * 44, record: StoredQuery::Full };
    let keys = |queries: &[Query]| queries.iter().map(|query| query.sample).collect();
    let mut order = Reordering::new(Per::Image, Box::new(ReplacementSelection::new(keys, store)));
    let mut random = Random::new(&[5]);
    let queries: Vec<Query> =
        (0..100_000).map(|_| Query { sample: random.next_u64() as u32, ..Query::zeroed() }).collect();
    let mut out = vec![];
    let mut emit = |_: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|query| query.sample));
        Ok(())
    };
    order.push(BlockMeta::default(), &queries, &mut emit).unwrap();
    order.drain(&mut emit).unwrap();
    assert_eq!(out.len(), queries.len());
    let runs = 1 + out.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let length = queries.len() as f64 / runs as f64 / room as f64;
    assert!((1.9..2.1).contains(&length), "{length}");
    assert_eq!(order.measures()[0], (measure::PEAK_QUERIES_HELD.to_owned(), Number::Count(room)));
}
