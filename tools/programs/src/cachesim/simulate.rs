//! Traces through the simulation: ours and foreign ones, whole and in windows, with one search in flight or several.

use super::questions::Questions;
use super::replay::{Replay, Waiting};
use super::results::{Results, Source};
use super::{Args, windowed};
use crate::cli::{Progress, named, open_bytes, room_for, usage};
use anyhow::Context as _;
use pm_caches::{LaneSink, Lanes, Measures, PrefetchError, Prefetching, PrivateCaches, Simulation};
use pm_exchange::traces::{self, Opened, Trace, TraceImport};
use pm_formats::trace::{Access, Coding, Region, TraceReader, TraceSink};
use pm_registry::Registry;
use std::io::Read;
use std::path::Path;

/// Simulates all caches on every trace. Parts of one trace, given one after the other, are that trace.
pub(super) fn simulate_all(
    args: &Args,
    imports: &Registry<dyn TraceImport>,
    questions: &Questions,
    results: &mut Results,
) -> anyhow::Result<()> {
    let mut waiting = Waiting::new();
    let together = |parts: Option<(String, Replay<_>)>, results: &mut Results| {
        parts.map_or(Ok(()), |(names, trace)| simulate_ours(args, Path::new(&names), trace, questions, results))
    };
    for path in &args.traces {
        match open(args, path, imports)? {
            Opened::Ours(blocks) if Waiting::takes(&blocks) => {
                together(waiting.add(named(path), blocks)?, results)?;
            }
            opened => {
                together(waiting.rest()?, results)?;
                simulate(args, path, opened, questions, results)?;
            }
        }
    }
    together(waiting.rest()?, results)
}

/// Simulates all caches on one trace.
fn simulate(
    args: &Args,
    path: &Path,
    opened: Opened,
    questions: &Questions,
    results: &mut Results,
) -> anyhow::Result<()> {
    let name = named(path);
    match opened {
        Opened::Ours(blocks) => {
            let trace = TraceReader::from_blocks(blocks).context(name.clone())?;
            simulate_ours(args, path, Replay::One(Box::new(trace)), questions, results).context(name)
        }
        Opened::Foreign(mut trace) => {
            if args.lanes.iter().any(|&lanes| lanes > 1) || !args.private.is_empty() {
                return Err(usage(format!("{name}: {NO_SEARCHES}")));
            }
            if args.prefetch.is_some() {
                return Err(usage(format!("{name}: --prefetch: {}", PrefetchError::NoRegions)));
            }
            check_waits(args, trace.regions()).context(name.clone())?;
            let caches = questions.caches_of(args, trace.regions()).context(name.clone())?;
            let measures = questions.measures_of_addresses();
            let simulation = Simulation::measuring(trace.regions(), &caches, &measures);
            let mut simulation = simulation.context(name.clone())?;
            trace.replay(&mut simulation).and_then(|()| Ok(simulation.check()?)).context(name.clone())?;
            remark_left_out(args, &name, &trace);
            let source = Source::foreign(path, trace.format().word().to_owned(), trace.regions());
            results.add(args, &source, 1, simulation.findings())
        }
    }
}

/// What is said where searches are to fly together and there are none.
const NO_SEARCHES: &str = "a foreign trace has no searches for --lanes or --private to share out";

/// Refuses to look for chains where no read says what it waits for.
fn check_waits(args: &Args, regions: &[Region]) -> anyhow::Result<()> {
    match args.miss_chain && !regions.iter().any(|region| region.coding == Coding::Waiting) {
        true => {
            Err(usage("--miss-chain: no read of this trace says what it waits for; write it with `pm-gather --waits`"))
        }
        false => Ok(()),
    }
}

/// Opens a trace of ours or of another program.
pub(super) fn open(args: &Args, path: &Path, imports: &Registry<dyn TraceImport>) -> anyhow::Result<Opened> {
    let reading = args.foreign.reading(args.columns.as_deref());
    let input = open_bytes(path)?;
    let opened = traces::open(input, &reading, imports).with_context(|| named(path))?;
    if matches!(opened, Opened::Ours(_)) {
        args.foreign.refuse_of_ours().with_context(|| named(path))?;
    }
    Ok(opened)
}

/// Says what was left out of a foreign trace that was replayed.
pub(super) fn remark_left_out(args: &Args, name: &str, trace: &Trace) {
    if let Some(remark) = args.foreign.left_out(trace.left_out()) {
        args.voice.remark(format!("{name}: {remark}"));
    }
}

/// Simulates all caches on one of our traces, once for each number of lanes.
fn simulate_ours<R: Read>(
    args: &Args,
    path: &Path,
    mut trace: Replay<R>,
    questions: &Questions,
    results: &mut Results,
) -> anyhow::Result<()> {
    let measures = questions.measures_of(trace.header());
    let regions = trace.header().regions.clone();
    let configs = &questions.caches_of(args, &regions)?;
    let of_addresses = regions.iter().any(Region::is_addresses);
    room_for_lines(&regions, questions)?;
    check_waits(args, &regions)?;
    if of_addresses && (args.lanes.iter().any(|&lanes| lanes > 1) || !args.private.is_empty()) {
        return Err(usage(NO_SEARCHES));
    }
    let measures = if of_addresses { questions.measures_of_addresses() } else { measures };
    if let Some(sample) = windowed::sample(trace.header())? {
        windowed::refuse(args)?;
        let mut windows = windowed::windows(&regions, configs, &measures)?;
        replay(args, &mut trace, &mut windows)?;
        let rows = windows.finish(Some(sample.windows), sample.share);
        results.add_windows(&Source::ours(path, trace.header(), &trace.end()?), rows);
        return Ok(());
    }
    if let Some(prefetcher) = args.prefetch {
        let prefetching = Prefetching::new(&regions, configs, &measures, prefetcher);
        let mut prefetching = prefetching.map_err(|error| usage(format!("--prefetch: {error}")))?;
        replay(args, &mut trace, &mut prefetching)?;
        let source = Source::ours(path, trace.header(), &trace.end()?);
        return results.add(args, &source, 1, prefetching.findings());
    }
    if !args.private.is_empty() {
        let private = |&elements: &u16| -> anyhow::Result<_> {
            let caches = PrivateCaches::new(&regions, configs, &measures, elements, args.shared)?;
            Lanes::new(caches, elements, args.private_from).context("temporary file")
        };
        let mut together = Together(args.private.iter().map(private).collect::<anyhow::Result<_>>()?);
        replay(args, &mut trace, &mut together)?;
        let source = Source::ours(path, trace.header(), &trace.end()?);
        for caches in together.0 {
            results.add(args, &source, 1, caches.finish().context("temporary file")?.findings())?;
        }
        return Ok(());
    }
    if args.lanes.is_empty() || of_addresses {
        let mut simulation = Simulation::measuring(&regions, configs, &measures)?;
        replay(args, &mut trace, &mut simulation)?;
        simulation.check()?;
        return results.add(args, &Source::ours(path, trace.header(), &trace.end()?), 1, simulation.findings());
    }
    let lanes = |&lanes: &u16| -> anyhow::Result<_> {
        // Where searches are mixed, an access belongs to none of them.
        let measures = Measures { working_sets: measures.working_sets && lanes == 1, ..measures.clone() };
        let simulation = Simulation::measuring(&regions, configs, &measures)?;
        Lanes::new(simulation, lanes, args.lanes_from).context("temporary file")
    };
    let mut together = Together(args.lanes.iter().map(lanes).collect::<anyhow::Result<_>>()?);
    replay(args, &mut trace, &mut together)?;
    let source = Source::ours(path, trace.header(), &trace.end()?);
    for (&lanes, simulation) in args.lanes.iter().zip(together.0) {
        results.add(args, &source, lanes, simulation.finish().context("temporary file")?.findings())?;
    }
    Ok(())
}

/// Lines of a small size, of all regions, that tables are made for: some bytes each for every cache, and for what is asked besides.
pub(super) fn room_for_lines(regions: &[Region], questions: &Questions) -> anyhow::Result<()> {
    let bytes =
        regions.iter().filter(|region| !region.is_addresses()).map(|region| region.size).fold(0, u64::saturating_add);
    // More lines than there are numbers are refused by whoever numbers them.
    let line = |line: u32| (bytes / u64::from(line.max(1))).min(1 << 31) * 8;
    let caches = questions.caches.iter().map(|cache| line(cache.line_bytes()));
    let curves = questions.measures.curves.iter().map(|&bytes| line(bytes) * 2);
    room_for(caches.chain(curves).fold(0, u64::saturating_add), "what is known of each line of the trace's memory")
}

/// Replays a trace to its end.
pub(super) fn replay<R: Read>(args: &Args, trace: &mut Replay<R>, sink: &mut impl TraceSink) -> anyhow::Result<()> {
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(sink)? {
        progress.add(u64::from(block.records));
    }
    Ok(())
}

/// The same trace through several numbers of lanes, or of elements.
struct Together<S>(Vec<Lanes<S>>);

impl<S: LaneSink> TraceSink for Together<S> {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.0.iter_mut().for_each(|sink| sink.block(batch, warm_up));
    }
    fn search(&mut self, destinations: &[u32]) {
        self.0.iter_mut().for_each(|sink| sink.search(destinations));
    }
    fn access(&mut self, access: Access) {
        self.0.iter_mut().for_each(|sink| sink.access(access));
    }
    fn search_end(&mut self) {
        self.0.iter_mut().for_each(TraceSink::search_end);
    }
}
