//! Are lines counted once a lookup, and quantiles right?

use super::*;
use bytemuck::Zeroable as _;
use pm_formats::trace::{Coding, lay_out};

use pm_maps::AccessObserver as _;

#[test]
fn lines_are_counted_once_a_lookup_and_quantiles_are_right() {
    let regions = lay_out([("a".to_owned(), 4000, 20, Coding::Records), ("b".to_owned(), 80, 8, Coding::Records)]);
    let mut parts = [Lookups::new(128, &regions, None), Lookups::new(128, &regions, None)];
    for i in 0..100u16 {
        let mut reads = SearchReads::default();
        // Record 6 of the first region spans its lines 0 and 1.
        for (region, record) in [(0, 0), (0, 5), (0, 6), (1, 0), (1, 1), (0, 0)] {
            reads.read(region, record);
        }
        reads.examined(4);
        let mut found = Nearest::new(1, f32::INFINITY);
        let distance = f32::from(i + 1);
        found.show(distance * distance, 0);
        let query = Query { pixel: u32::from(i), position: [distance; 3], ..Query::zeroed() };
        parts[usize::from(i % 2)].add(&query, &found, &reads);
    }
    let [mut all, odd] = parts;
    all += odd;
    assert_eq!((all.queries, all.reads, all.photons_examined, all.lines, all.full), (100, 600, 400, 300, 100));
    assert!((all.mean_distance() - 50.5).abs() < 1e-9);
    for (share, expected) in [(0.0, 1.0), (0.5, 51.0), (0.99, 100.0), (1.0, 100.0)] {
        let quantile = all.distance_quantile(share);
        assert!((quantile - expected).abs() <= 0.001 * expected, "{share}: {quantile}");
    }
    assert_eq!(all.sample().len(), 100);
    assert!(Lookups::new(128, &regions, None).distance_quantile(0.5).is_nan());
}
