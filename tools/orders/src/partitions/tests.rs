//! Do partitions fit the store, and is all written and read once?

use super::*;
use crate::StoredQuery;
use bytemuck::Zeroable as _;
use pm_formats::vocabulary::measure;
use pm_random::Random;

fn run(keys: &[u32], bytes: u64) -> Costs {
    let mut costs = Costs::new(Store { bytes, record: StoredQuery::Full });
    let mut partition = Partitions::new();
    for (pixel, &key) in (0..).zip(keys) {
        partition.sample(&Query { pixel, ..Query::zeroed() }, key);
    }
    partition.decide(keys.len() as u64, costs.store());
    let mut sorted = keys.to_vec();
    sorted.sort_unstable();
    sorted.into_iter().for_each(|key| partition.count(key));
    partition.charge(keys.len() as u64, &mut costs);
    costs
}

fn measure(costs: &Costs, name: &str) -> f64 {
    costs.measures().into_iter().find(|(known, _)| known == name).map(|(_, number)| number.as_f64()).unwrap()
}

#[test]
fn partitions_fit_and_all_is_written_once() {
    let mut random = Random::new(&[3]);
    // Crowded at one end, as queries are in corners.
    let keys: Vec<u32> = (0..300_000).map(|_| (random.unit() * random.unit() * 1e9) as u32).collect();
    let bytes = 128 << 10;
    let costs = run(&keys, bytes);
    assert!(measure(&costs, measure::ON_CHIP) <= bytes as f64);
    assert!(measure(&costs, "partitions") >= 300_000.0 * 44.0 / bytes as f64);
    assert!(measure(&costs, "partitions_overflowing") <= 2.0);
    let once = 300_000.0 * 44.0;
    assert!((once..1.05 * once).contains(&measure(&costs, measure::SPILLED_WRITTEN)));
    assert_eq!(measure(&costs, measure::SPILLED_WRITTEN), measure(&costs, measure::SPILLED_READ));
    assert_eq!(measure(&costs, "prepass_rays"), 2.0 * f64::from(300_000 / 64));
}

#[test]
fn queries_of_one_key_need_no_sorting() {
    let costs = run(&[7; 50_000], 64 << 10);
    assert_eq!(measure(&costs, "partitions_overflowing"), 0.0);
    assert_eq!(measure(&costs, measure::SPILLED_WRITTEN), 50_000.0 * 44.0);
    // And in a crowd, the others are sorted as ever.
    let crowded: Vec<u32> = (0..50_000).map(|i| if i % 2 == 0 { 1 << 20 } else { i * 40 }).collect();
    assert!(measure(&run(&crowded, 64 << 10), "spilled_written") < 1.3 * 50_000.0 * 44.0);
}

#[test]
fn a_partition_that_overflows_pays_for_its_own_sort() {
    let mut costs = Costs::new(Store { bytes: 4400, record: StoredQuery::Full });
    let mut partition = Partitions::new();
    // The sample foretells nothing of what comes.
    (0..8).for_each(|key| partition.sample(&Query { pixel: key, ..Query::zeroed() }, 1 << 29));
    partition.decide(1000, costs.store());
    (0..1000).for_each(|key| partition.count(key));
    partition.charge(1000, &mut costs);
    assert!(measure(&costs, measure::SPILLED_WRITTEN) >= 1.8 * 44_000.0);
    assert_eq!(measure(&costs, "partitions_overflowing"), 1.0);
    assert!(measure(&costs, measure::ON_CHIP) <= 4400.0);
}
