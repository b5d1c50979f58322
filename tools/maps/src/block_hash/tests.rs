//! Does a search keep to its budget, and is what no bucket refers to counted?

use super::build::follow_density;
use super::*;
use crate::SearchReads;
use pm_formats::Photon;
use pm_random::Random;

const OPTIONS: BlockHashOptions = BlockHashOptions {
    line: 128,
    tables: None,
    thresholds: None,
    slots: None,
    budget: 20,
    orphans: Orphans::Keep,
    seed: 0,
};

/// Photons on a wall, evenly.
fn wall(n: u16) -> Vec<Photon> {
    let mut random = Random::new(&[7]);
    let positions = (0..n).map(|_| [random.unit(), 0.0, random.unit()]);
    positions.map(|p| Photon::new(p, [1.0; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap()).collect()
}

#[test]
fn the_budget_is_kept_to_a_block() {
    let photons = wall(20_000);
    for budget in [1, 5, 20] {
        let map = BlockHash::build(&photons, BlockHashOptions { budget, ..OPTIONS }).unwrap();
        let mut found = Nearest::new(10, f32::INFINITY);
        for photon in photons.iter().step_by(997) {
            let mut reads = SearchReads::default();
            found.restart(f32::INFINITY);
            map.nearest(photon.position, &mut found, &mut reads);
            assert!(reads.photons_examined() < 10 * u64::from(budget) + 6);
            let buckets = reads.runs().filter(|run| run.0 == BUCKETS).map(|run| run.1.len()).sum::<usize>();
            assert_eq!(buckets, map.sizes().0, "one bucket a table");
        }
    }
}

#[test]
fn orphans_are_kept_or_repaired() {
    // One reference a bucket and few cells: most blocks find no room.
    let photons = wall(5000);
    let narrow = BlockHashOptions { slots: Some(1), tables: Some(4), thresholds: Some(4), ..OPTIONS };
    let kept = BlockHash::build(&photons, narrow).unwrap();
    assert!(
        kept.unreferenced() > kept.number_of_blocks() / 2,
        "{} of {}",
        kept.unreferenced(),
        kept.number_of_blocks()
    );
    let repaired = BlockHash::build(&photons, BlockHashOptions { orphans: Orphans::Repair, ..narrow }).unwrap();
    assert!(repaired.unreferenced() <= kept.unreferenced());
    // Where there is room, all are referred to, and more so when repaired.
    let tight = BlockHashOptions { slots: Some(4), tables: Some(6), thresholds: Some(10), ..OPTIONS };
    let kept = BlockHash::build(&photons, tight).unwrap();
    let repaired = BlockHash::build(&photons, BlockHashOptions { orphans: Orphans::Repair, ..tight }).unwrap();
    assert!(
        kept.unreferenced() > 0 && repaired.unreferenced() == 0,
        "{} {}",
        kept.unreferenced(),
        repaired.unreferenced()
    );
}

#[test]
fn what_no_bucket_refers_to_is_counted_by_looking() {
    let photons = wall(3000);
    for orphans in [Orphans::Keep, Orphans::Repair] {
        for (slots, tables, thresholds) in [(3, 8, 8), (1, 4, 4), (2, 6, 10)] {
            let sizes = BlockHashOptions { tables: Some(tables), thresholds: Some(thresholds), ..OPTIONS };
            let map = BlockHash::build(&photons, BlockHashOptions { slots: Some(slots), orphans, ..sizes }).unwrap();
            let buckets = || map.tables.iter().flat_map(|table| &table.buckets);
            let referenced: std::collections::BTreeSet<u32> =
                buckets().flatten().map(|reference| reference.block).collect();
            assert_eq!(map.number_of_blocks() - referenced.len(), map.unreferenced(), "{orphans:?} {slots}");
            assert!(buckets().all(|bucket| bucket.len() <= slots as usize));
        }
    }
}

#[test]
fn thresholds_follow_the_photons() {
    // Nine tenths of the coordinates lie below 0.1.
    let sorted: Vec<f32> =
        (0..1000u16).map(|i| if i < 900 { f32::from(i) / 9000.0 } else { 0.1 + f32::from(i - 900) * 0.009 }).collect();
    let thresholds = follow_density(&sorted, 20, &mut Random::new(&[1]));
    assert!(thresholds.is_sorted());
    let below = thresholds.iter().filter(|&&threshold| threshold < 0.1).count();
    assert_eq!(below, 18);
}
