//! How far is the sampled curve from the exact one, and does it say so?

use pm_formats::trace::{Access, Coding, TraceSink, lay_out};

use crate::trial::Draw;
use crate::{Curve, Measures, SampledCurve, Simulation};

/// The exact and the sampled curve of reads of 64-byte lines.
fn both(lines_of_map: u64, rate: f64, lines: impl Iterator<Item = u64>) -> (Curve, SampledCurve) {
    let regions = lay_out([("a".to_owned(), lines_of_map * 64, 64, Coding::Records)]);
    let measures = Measures { curves: vec![64], sampled: Some(rate), exact_too: true, ..Measures::default() };
    let mut simulation = Simulation::measuring(&regions, &[], &measures).unwrap();
    lines.for_each(|line| simulation.access(Access::read(0, line * 64, 4)));
    let mut findings = simulation.findings();
    (findings.curves.remove(0), findings.sampled.remove(0))
}

/// Reads as of nearest-neighbour searches in a good order: again and again the same hundred lines or so, which wander
/// over the map a line at a time.
fn searches(lines_of_map: u64, rounds: u64) -> impl Iterator<Item = u64> {
    (0..lines_of_map - 110).flat_map(move |from| (0..rounds * 110).map(move |i| from + i % 110))
}

#[test]
fn a_sample_of_all_is_exact() {
    let mut draw = Draw::new(31);
    let uses = (0..200_000).map(move |_| draw.below(4095) >> draw.below(6));
    let (exact, sampled) = both(4095, 1.0, uses);
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
        let mut draw = Draw::new(100 + seed);
        // Each seed has its own region of interest, so that other lines are sampled.
        let from = seed * 20_000;
        let uses = (0..400_000).map(move |i| from + if i % 3 == 0 { draw.below(20_000) } else { draw.below(4000) });
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
    // A cache of 256 lines holds a search's lines with ease, and fetches each line of the map once.
    let (exact, sampled) = both(12_000, 0.01, searches(12_000, 4));
    assert_eq!(exact.fetches(256), 12_000 - 1);
    assert_eq!(sampled.least(), 10_000);
    for lines in [64, 256, 1024, 9_999] {
        assert_eq!(sampled.fetches(lines), None, "{lines} lines are modelled by less than 100");
    }
    // What would have been said is wrong by far, since the model holds three lines: this is why it is not said.
    let wrong = sampled.unchecked(256).fetches / exact.fetches(256) as f64;
    assert!(wrong > 4.0, "{wrong} times the exact number");
    assert_eq!(sampled.sizes(12_000), [10_000]);
    assert!(sampled.sizes(9_999).is_empty());
}
