//! Does a prefetcher do what a list of lines does with it, and what can be said without simulating?

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};

use super::{PrefetchError, Prefetcher, Prefetching};
use crate::trial::{Draw, Event, random_events, random_regions, replay};
use crate::{CacheConfig, CacheCounts, Measures, Ways, plain_lru};

fn prefetching(regions: &[Region], config: CacheConfig, prefetcher: Prefetcher) -> Prefetching {
    Prefetching::new(regions, &[config], &Measures::default(), prefetcher).unwrap()
}

/// Misses of each region, lines prefetched, those used, and lines that turned dirty: a list, the most recent first, of line, what it was
/// prefetched for (2 if that counts and nobody asked, 1 in warm-up, 0 else) and whether it is dirty.
fn by_list(regions: &[Region], config: CacheConfig, how: Prefetcher, events: &[Event]) -> (Vec<u64>, [u64; 3]) {
    let bytes = u64::from(config.line_bytes());
    let mut list: Vec<(u64, u8, bool)> = vec![];
    let (mut counted, mut misses, mut sums) = (true, vec![0; regions.len()], [0; 3]);
    for event in events {
        let access = match event {
            Event::Block { warm_up } => {
                counted = !warm_up;
                continue;
            }
            Event::Search(_) => continue,
            Event::Access(access) => *access,
        };
        let region = &regions[usize::from(access.region)];
        let (begin, end) = (region.base / bytes, (region.base + region.size - 1) / bytes);
        for line in plain_lru::lines(regions, access, bytes) {
            let found = list.iter().position(|held| held.0 == line);
            let mut dirty = false;
            if let Some(at) = found {
                let held = list.remove(at);
                dirty = held.2;
                sums[1] += u64::from(held.1 == 2 && counted);
            } else {
                misses[usize::from(access.region)] += u64::from(counted);
                let others: Vec<u64> = match how {
                    Prefetcher::NextLine(n) => (1..=u64::from(n)).map(|step| line + step).collect(),
                    Prefetcher::Treelet(block) => {
                        let lines = u64::from(block) / bytes;
                        (begin..=end).filter(|other| (other - begin) / lines == (line - begin) / lines).collect()
                    }
                };
                for other in others.into_iter().filter(|&other| other != line && other <= end) {
                    if list.iter().all(|held| held.0 != other) {
                        list.truncate(config.lines() as usize - 1);
                        list.insert(0, (other, if counted { 2 } else { 1 }, false));
                        sums[0] += u64::from(counted);
                    }
                }
            }
            let writes = counted && access.kind != AccessKind::Read;
            sums[2] += u64::from(writes && !dirty);
            list.truncate(config.lines() as usize - usize::from(found.is_none()));
            list.insert(0, (line, 0, dirty || writes));
        }
    }
    (misses, sums)
}

#[test]
fn a_prefetcher_does_what_a_list_does() {
    let mut draw = Draw::new(71);
    let (mut all, mut useful) = (0, 0);
    for case in 0..600 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let line = draw.pick(&[16_u32, 64]);
        let lines = draw.pick(&[8_u64, 9, 40]);
        let config = CacheConfig::lru(lines * u64::from(line), Ways::Full, line).unwrap();
        let how = draw.pick(&[
            Prefetcher::NextLine(1),
            Prefetcher::NextLine(3),
            Prefetcher::Treelet(2 * line),
            Prefetcher::Treelet(3 * line),
            Prefetcher::Treelet(8 * line),
        ]);
        let mut sink = prefetching(&regions, config, how);
        replay(&events, &mut sink);
        let found = sink.findings().caches.remove(0);
        let (misses, [prefetched, used, dirty]) = by_list(&regions, config, how, &events);
        let told = found.more.prefetch.unwrap();
        assert_eq!(found.region_fetches, misses, "case {case}: {how}, {config}");
        assert_eq!((told.prefetched, told.used), (prefetched, used), "case {case}: {how}, {config}");
        assert_eq!(found.bytes_fetched, (found.fetches + prefetched) * u64::from(line));
        assert_eq!(found.bytes_written_back, dirty * u64::from(line), "case {case}: {how}, {config}");
        // All else is as without.
        let plain = plain_lru::oracle(&regions, config, &events);
        assert_eq!(told.fetches_without, plain.fetches);
        let of_trace = |it: &CacheCounts| (it.queries, it.searches, it.records, it.accesses, it.compulsory, it.blocks);
        assert_eq!(of_trace(&found), of_trace(&plain));
        (all, useful) = (all + prefetched, useful + used);
    }
    assert!(useful > 1000 && all > 2 * useful, "{useful} of {all}");
}

/// A region of 1,024 lines of 128 bytes, read line by line.
fn read(lines: impl IntoIterator<Item = u64>, how: &str) -> CacheCounts {
    let regions = lay_out([("photons".to_owned(), 1024 * 128, 128, Coding::Records)]);
    let mut sink = prefetching(&regions, "8K,full,128,lru".parse().unwrap(), how.parse().unwrap());
    sink.block(0, false);
    sink.search(&[0]);
    lines.into_iter().for_each(|line| sink.access(Access::read(0, line * 128, 128)));
    sink.search_end();
    sink.findings().caches.remove(0)
}

#[test]
fn of_a_sweep_one_line_of_a_treelet_is_missed_and_of_a_stride_all_is_for_nothing() {
    // 1,024 lines one by one: of 8 of a treelet the first is missed, 7 are used. One line of each treelet: 7 are not.
    let sweep = read(0..1024, "treelet:1K");
    let told = sweep.more.prefetch.unwrap();
    assert_eq!((sweep.fetches, told.prefetched, told.used), (128, 896, 896));
    assert_eq!((told.accuracy(), told.coverage(), told.traffic()), (1.0, 0.875, 1.0));
    let stride = read((0..128).map(|it| it * 8 + 3), "treelet:1K");
    let told = stride.more.prefetch.unwrap();
    assert_eq!((told.accuracy(), told.coverage(), told.traffic()), (0.0, 0.0, 8.0));
    // The next line on a miss: every other one. Backwards, none is there to come.
    let told = read(0..1024, "next-line:1").more.prefetch.unwrap();
    assert_eq!((told.accuracy(), told.coverage(), told.traffic()), (1.0, 0.5, 1.0));
    let told = read((0..1024).rev(), "next-line:1").more.prefetch.unwrap();
    assert_eq!((told.prefetched, told.used, told.coverage()), (0, 0, 0.0));
    // 64 lines fit, and are asked for over and over; prefetched ones drive them out.
    let cycle = || (0..16).flat_map(|_| (0..64).map(|it| it * 16));
    let told = read(cycle(), "treelet:256").more.prefetch.unwrap();
    assert_eq!((told.fetches_without, told.fetches, told.used), (64, 1024, 0));
    assert_eq!((told.coverage(), told.traffic()), (-15.0, 32.0));
}

#[test]
fn what_does_nothing_or_cannot_be_done_is_refused() {
    for text in ["treelet", "treelet:", "treelet:x", "next-line:0", "next-line:-1", "stream:4", "treelet:8G"] {
        assert_eq!(text.parse::<Prefetcher>(), Err(PrefetchError::Unknown(text.into())));
    }
    for text in ["treelet:512", "treelet:4K", "next-line:2"] {
        assert_eq!(text.parse::<Prefetcher>().unwrap().to_string(), text);
    }
    let regions = lay_out([("photons".to_owned(), 1024, 128, Coding::Records)]);
    for (config, how, said) in [
        ("8K,8,128,lru", "treelet:512", "fully associative LRU"),
        ("8K,full,128,fifo", "treelet:512", "fully associative LRU"),
        ("none", "treelet:512", "fully associative LRU"),
        ("8K,full,128,lru", "treelet:128", "two or more whole lines"),
        ("8K,full,128,lru", "treelet:300", "two or more whole lines"),
        ("8K,full,128,lru", "treelet:16K", "does not fit"),
        ("1K,full,128,lru", "next-line:8", "does not fit"),
    ] {
        let new = Prefetching::new(&regions, &[config.parse().unwrap()], &Measures::default(), how.parse().unwrap());
        let error = new.err().expect("it is refused").to_string();
        assert!(error.contains(said), "{config}, {how}: {error}");
    }
}
