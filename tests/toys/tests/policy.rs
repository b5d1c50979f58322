//! A cache policy added from outside: `policy/lfu.rs`, and the one line below. It is in every test that says "for every
//! policy", it can be chosen, and the program knows it.

#[path = "policy/lfu.rs"]
mod lfu;
#[path = "policy/liar.rs"]
mod liar;
#[path = "policy/naive.rs"]
mod naive;

use naive::{Naive, Trace};
use pm_caches::{CacheConfig, CacheCounts, Measures, Policy, Simulation, trial};
use pm_formats::trace::{BlockEncoder, TraceSink, TraceWriter};
use pm_formats::{BlockMeta, Header};
use pm_programs::cachesim;
use pm_registry::Registry;
use std::panic;

/// The line.
fn policies() -> Registry<dyn Policy> {
    pm_caches::policies().with(&lfu::Lfu)
}

fn simulate(trace: &Trace, caches: &[CacheConfig], chunk: usize) -> Vec<CacheCounts> {
    let measures = Measures::default();
    let mut simulation = Simulation::in_chunks(&trace.regions, caches, &measures, chunk).expect("small regions");
    trace.accesses.iter().for_each(|&access| simulation.access(access));
    simulation.finish()
}

fn cache(text: &str) -> CacheConfig {
    CacheConfig::parse(text, &policies()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn it_passes_the_trials_of_every_policy() {
    trial::all(&policies());
}

#[test]
fn the_trials_find_it() {
    // One that counts, and says that it need not.
    let fails = |trial: fn(&Registry<dyn Policy>)| {
        let tried = panic::catch_unwind(|| trial(&policies().with(&liar::Liar)));
        let told = tried.err().and_then(|told| told.downcast::<String>().ok());
        told.is_some_and(|told| told.contains("lfu-liar"))
    };
    assert!(fails(trial::counts_are_those_of_the_definition));
    assert!(fails(trial::repeats_are_left_out_only_where_they_do_not_matter));
    assert!(fails(trial::chunks_one_after_another_are_the_whole));
    assert!(fails(trial::a_cache_does_not_depend_on_those_beside_it));
}

#[test]
fn it_sees_every_access() {
    // 500 traces, most accesses of which are to the line of the one before, and some to two lines.
    let (mut repeats, mut spanning, mut differ) = (0, 0, 0);
    for seed in 0..500 {
        let trace = Trace::random(seed);
        let lines = trace.line_accesses(64);
        repeats += lines.windows(2).filter(|two| two[0] == two[1]).count();
        spanning += lines.len() - trace.accesses.len();
        for (lines_held, sets) in [(4, 1), (16, 1), (16, 4)] {
            let ways = if sets == 1 { "full".to_owned() } else { (lines_held / sets).to_string() };
            let config = cache(&format!("{},{ways},64,rarest", lines_held * 64));
            let expected = Naive::new(sets, lines_held / sets).misses(&lines);
            for chunk in [1, 2, 7, 60, 2048] {
                let alone = simulate(&trace, &[config], chunk).remove(0);
                assert_eq!(alone.fetches, expected, "seed {seed}, {config}, chunk {chunk}");
                assert_eq!(alone.accesses, lines.len() as u64);
            }
            // Beside one that need not see repeats, and counts the same with them.
            let lru = cache(&format!("{},{ways},64,lru", lines_held * 64));
            let both = simulate(&trace, &[lru, config], 2048);
            assert_eq!((&both[0], both[1].fetches), (&simulate(&trace, &[lru], 2048)[0], expected), "seed {seed}");
            differ += u64::from(both[0].fetches != expected);
        }
    }
    assert!(repeats > 100_000 && spanning > 10_000 && differ > 500, "{repeats} repeats, {spanning}, {differ}: no test");
}

#[test]
fn its_word_is_read_printed_and_told() {
    let (full, sets) = (cache("128K,full,128,rarest"), cache("64K,8,64,rarest,hash"));
    assert_eq!((full.to_string(), sets.to_string()), ("128K,full,128,rarest".into(), "64K,8,64,rarest,hash".into()));
    assert!("128K,full,128,rarest".parse::<CacheConfig>().is_err(), "it is none of the library's own");
    let error = CacheConfig::parse("128K,full,128,mru", &policies()).err().map(|error| error.to_string());
    assert!(
        error.as_ref().is_some_and(|error| error.contains("min-bypass, rarest, and none for no cache")),
        "{error:?}"
    );
    assert!(policies().table().contains("| `rarest` | The line used least often"), "{}", policies().table());
}

/// A trace of one search, as a stream.
fn stream(trace: &Trace) -> Vec<u8> {
    let header = Header { regions: trace.regions.clone(), ..Header::empty() };
    let mut writer = TraceWriter::new(vec![], &header).expect("memory");
    let mut encoder = BlockEncoder::new(&header.regions);
    encoder.begin(&[0]);
    trace.accesses.iter().for_each(|&access| encoder.access(access));
    encoder.end();
    let (block, tally) = encoder.finish(BlockMeta::default()).expect("a block");
    writer.write(&block, tally).expect("memory");
    writer.finish(vec![]).expect("memory")
}

#[test]
fn pm_cachesim_knows_it() {
    let run = |arguments: &[&str]| {
        let mut table = vec![];
        let registries = cachesim::Registries { policies: policies(), ..Default::default() };
        let outcome = cachesim::program(&registries).run(arguments, |args, typed| {
            table = cachesim::run(&args, typed, &registries)?.unwrap_or_default();
            Ok(())
        });
        (outcome, String::from_utf8(table).expect("text"))
    };
    let (help, _) = run(&["--help"]);
    let help = help.help().expect("help");
    assert!(help.contains("- rarest:") && help.contains("The line used least often"), "{help}");
    let (refused, _) = run(&["--policies", "mru", "x.pmt"]);
    assert_eq!(refused.code(), 2);
    assert!(refused.said().contains("min-bypass, rarest, and none for no cache"), "{}", refused.said());

    let folder = tempfile::tempdir().expect("a folder");
    let (trace, path) = (Trace::random(7), folder.path().join("t.pmt"));
    std::fs::write(&path, stream(&trace)).expect("a file");
    let path = path.display().to_string();
    let (done, csv) = run(&["--sizes", "1K", "--lines", "64", "--policies", "lru,rarest", "--format", "csv", &path]);
    assert_eq!(done.code(), 0, "{}", done.said());
    let cell = |row: usize, name: &str| {
        let column = csv.lines().next().and_then(|head| head.split(',').position(|known| known == name));
        // The cache has commas, and stands between quotes before all numbers.
        let fields: Vec<&str> = csv.lines().nth(row).into_iter().flat_map(|row| row.split(',')).collect();
        let shift = fields.len() - csv.lines().next().map_or(0, |head| head.split(',').count());
        fields[column.expect("such a column") + shift].to_owned()
    };
    assert_eq!((cell(1, "policy"), cell(2, "policy")), ("lru".into(), "rarest".into()));
    let counts = simulate(&trace, &[cache("1K,full,64,lru"), cache("1K,full,64,rarest")], 2048);
    assert_eq!([cell(1, "fetches"), cell(2, "fetches")], [&counts[0], &counts[1]].map(|of| of.fetches.to_string()));
}
