//! Is the curve that of a cache of every size by itself?

use pm_formats::trace::{Access, Coding, Region, lay_out};

use crate::trial::{Draw, Event, random_events, random_regions, replay};
use crate::{CacheConfig, Curve, Findings, Measures, Simulation, Ways};

fn findings(regions: &[Region], configs: &[CacheConfig], lines: &[u32], events: &[Event], chunk: usize) -> Findings {
    let measures = Measures { curves: lines.to_vec(), ..Measures::default() };
    let mut simulation = Simulation::in_chunks(regions, configs, &measures, chunk).unwrap();
    replay(events, &mut simulation);
    simulation.findings()
}

/// A cache of so many lines of the curve's.
fn full(curve: &Curve, lines: u64) -> CacheConfig {
    let line = curve.trace.line_bytes;
    CacheConfig::lru(lines * u64::from(line), Ways::Full, line).unwrap()
}

#[test]
fn a_curve_is_a_run_for_each_size() {
    let mut draw = Draw::new(11);
    let mut written = 0;
    for case in 0..2000 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let lines = draw.pick(&[&[128_u32][..], &[16], &[16, 64, 4096], &[8192, 4], &[64, 64]]);
        let chunk = draw.pick(&[1, 3, 60, 2048]);
        let curves = findings(&regions, &[], lines, &events, chunk).curves;
        assert_eq!(curves.iter().map(|c| c.trace.line_bytes).collect::<Vec<_>>(), lines);
        for curve in &curves {
            // Every size up to one beyond the last at which anything changes, all by another algorithm.
            let sizes: Vec<u64> = (1..=curve.last() + 1).chain([1 << 20]).collect();
            let configs: Vec<CacheConfig> = sizes.iter().map(|&lines| full(curve, lines)).collect();
            let mut rows = Simulation::new(&regions, &configs).unwrap();
            replay(&events, &mut rows);
            for (row, &size) in rows.finish().iter().zip(&sizes) {
                let place = format!("case {case}, {}, chunk {chunk}", row.config);
                assert_eq!((curve.fetches(size), curve.compulsory), (row.fetches, row.compulsory), "{place}");
                let trace = curve.trace;
                let line_bytes = u64::from(trace.line_bytes);
                assert_eq!(curve.write_backs(size) * line_bytes, row.bytes_written_back, "{place}");
                assert_eq!((trace.queries, trace.records, trace.accesses, trace.blocks), {
                    (row.queries, row.records, row.accesses, row.blocks)
                });
            }
            // No line held is no hit: all distances together are all accesses.
            assert_eq!(curve.fetches(0), curve.trace.accesses);
            // The sizes printed tell all the others.
            let changes: Vec<u64> = curve.changes().collect();
            for size in 1..=curve.last() {
                let below = changes[changes.partition_point(|&change| change <= size) - 1];
                let at = |lines| (curve.fetches(lines), curve.write_backs(lines));
                assert_eq!(at(size), at(below));
            }
            assert_eq!(changes.windows(2).filter(|w| w[0] >= w[1]).count(), 0);
            assert!(curve.readable().contains(&curve.last()));
            written += u64::from(curve.write_backs(1) > 0);
        }
    }
    assert!(written > 300, "{written} traces with writes are no test");
}

#[test]
fn chunks_one_after_another_are_the_whole() {
    let mut draw = Draw::new(12);
    for _ in 0..200 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let whole = findings(&regions, &[], &[32], &events, 2048);
        for chunk in [1, 2, 7, 100] {
            assert_eq!(findings(&regions, &[], &[32], &events, chunk), whole);
        }
    }
}

#[test]
fn caches_and_curves_share_a_reading() {
    let mut draw = Draw::new(13);
    for _ in 0..100 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let configs = ["1K,full,16,lru", "1K,2,64,lru", "none"].map(|text| text.parse().unwrap());
        let both = findings(&regions, &configs, &[64, 16], &events, 2048);
        assert_eq!(both.caches, findings(&regions, &configs, &[], &events, 2048).caches);
        assert_eq!(both.curves, findings(&regions, &[], &[64, 16], &events, 2048).curves);
    }
}

#[test]
fn the_first_access_may_be_to_address_zero() {
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    let read = |offset| Event::Access(Access::read(0, offset, 4));
    for (offsets, fetches) in
        [(&[0, 0, 0][..], &[3, 1, 1][..]), (&[0, 4, 0], &[3, 3, 2, 2]), (&[4, 0, 4, 0], &[4, 4, 2]), (&[], &[0, 0])]
    {
        let events: Vec<Event> = offsets.iter().map(|&offset| read(offset)).collect();
        let curve = &findings(&regions, &[], &[4], &events, 2048).curves[0];
        let counted: Vec<u64> = (0..fetches.len() as u64).map(|lines| curve.fetches(lines)).collect();
        assert_eq!(counted, fetches, "{offsets:?}");
    }
}

#[test]
fn lines_that_will_not_do_are_refused() {
    let regions = lay_out([("a".to_owned(), 4096, 4, Coding::Records)]);
    let measures = Measures { curves: vec![100], ..Measures::default() };
    let refused = Simulation::measuring(&regions, &[], &measures).err().unwrap();
    assert!(refused.to_string().contains("128 would do"), "{refused}");
}
