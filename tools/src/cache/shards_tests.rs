//! How far is the sampled curve from the exact one, and does it say so?

use pm_formats::trace::{Access, Coding, TraceSink, lay_out};

use super::tests::Random;
use super::{Curve, Measures, SampledCurve, Simulation};

/// The exact and the sampled curve of reads of 64-byte lines.
fn both(lines_of_map: u64, rate: f64, lines: impl Iterator<Item = u64>) -> (Curve, SampledCurve) {
    let regions = lay_out([("a".to_owned(), lines_of_map * 64, 64, Coding::Records)]);
    let measures = Measures { curves: vec![64], sampled: Some(rate), exact_too: true, ..Measures::default() };
    let mut simulation = Simulation::measuring(&regions, &[], &measures).unwrap();
    lines.for_each(|line| simulation.access(Access::read(0, line * 64, 4)));
    let mut findings = simulation.findings();
    (findings.curves.remove(0), findings.sampled.remove(0))
}

/// Reads of a tree by a walk from the root to a leaf, near the leaf of the walk before or anywhere: the few lines of the
/// upper levels take most of them.
fn walks(seed: u64, levels: u32, number: usize) -> impl Iterator<Item = u64> {
    let mut random = Random(seed);
    let leaves = 1_u64 << (levels - 1);
    let mut leaf = 0;
    (0..number).flat_map(move |_| {
        leaf = match random.below(4) {
            0 => random.below(leaves),
            _ => (leaf + random.below(200)) % leaves,
        };
        let leaf = leaf;
        // Line 2^level - 1 + position within the level.
        (0..levels).map(move |level| (1 << level) - 1 + (leaf >> (levels - 1 - level)))
    })
}

#[test]
fn a_sample_of_all_is_exact() {
    let (exact, sampled) = both((1 << 12) - 1, 1.0, walks(1, 12, 20_000));
    assert_eq!(sampled.sampled_lines, (1 << 12) - 1);
    assert_eq!((sampled.least(), sampled.fetches(99)), (100, None));
    for lines in 100..5000 {
        assert_eq!(sampled.fetches(lines).unwrap().fetches, exact.fetches(lines) as f64, "{lines} lines");
    }
}

#[test]
fn a_sample_of_many_lines_is_near_and_its_interval_holds() {
    // Lines used alike: what sampling is made for.
    let (mut held, mut tried) = (0, 0);
    for seed in 0..20 {
        let mut random = Random(100 + seed);
        // Each seed has its own region of interest, so that other lines are sampled.
        let from = seed * 20_000;
        let uses = (0..400_000).map(move |i| from + if i % 3 == 0 { random.below(20_000) } else { random.below(4000) });
        let (exact, sampled) = both(500_000, 0.1, uses);
        for lines in [1000, 2000, 4000, 8000, 16_000] {
            let estimate = sampled.fetches(lines).unwrap();
            let off = estimate.fetches - exact.fetches(lines) as f64;
            assert!(off.abs() < 0.12 * exact.fetches(1) as f64, "{lines} lines: off by {off}");
            held += u32::from(off.abs() <= estimate.error);
            tried += 1;
        }
    }
    assert!(held * 100 >= tried * 80, "the interval held in {held} of {tried}");
}

#[test]
fn a_small_map_has_no_sampled_curve_and_the_resolution_says_so() {
    // Some 32,000 lines of a tree, as a photon map has; a cache of 256 lines is good for nearly all of a walk.
    let (exact, sampled) = both((1 << 15) - 1, 0.01, walks(3, 15, 40_000));
    assert_eq!(sampled.least(), 10_000);
    for lines in [64, 256, 1024, 9_999] {
        assert_eq!(sampled.fetches(lines), None, "{lines} lines are modelled by less than 100");
    }
    // What would have been said of 256 lines is wrong by far: this is why it is not said.
    let wrong = sampled.unchecked(256).fetches / exact.fetches(256) as f64;
    assert!(!(0.5..2.0).contains(&wrong), "{wrong} times the exact number");
    assert!(sampled.readable((1 << 15) - 1).iter().eq(&[10_000, 20_000]));
    assert!(sampled.readable(9_999).is_empty());
}
