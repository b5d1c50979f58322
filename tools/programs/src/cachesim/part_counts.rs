//! What was counted of the windows of one part of a trace, as a file: one machine writes it, another adds up those of all parts.
//!
//! It is JSON. The part's header and end stand in it as a stream without blocks, since that is what tells whether parts belong
//! together; counts are rows of whole numbers, one for each window.

use super::questions::Questions;
use super::replay::Replay;
use super::results::{Results, Source};
use super::simulate::{open, replay, room_for_lines};
use super::{Args, windowed};
use crate::cli::{named, open_bytes, refuse_parts, usage};
use anyhow::Context as _;
use pm_caches::{
    AskedCounts, CacheConfig, CacheCounts, CountedWindows, Measures, RecordCounts, SpanRule, WindowCounts,
};
use pm_exchange::bad_input;
use pm_exchange::traces::{Opened, TraceImport};
use pm_formats::trace::{Access, TraceReader, TraceSink};
use pm_formats::vocabulary::meaning;
use pm_formats::{BlockReader, BlockWriter, End, Header, Parts, StreamKind};
use pm_registry::{Choice as _, Registry};
use serde_json::{Value, json};
use std::io::{Cursor, Read as _};
use std::path::Path;

/// What the file is, and its version.
const SCHEMA: (&str, u64) = ("pm-cachesim counts of a part", 1);
/// Longest file, in bytes.
const MOST_BYTES: u64 = 1 << 30;
/// Numbers of a window besides two for each region.
const COLUMNS: [&str; 17] = [
    "batch",
    "exact",
    "queries",
    "searches",
    "reads",
    "writes",
    "read_modify_writes",
    "bytes_read",
    "bytes_written",
    "accesses",
    "fetches",
    "bytes_fetched",
    "bytes_written_back",
    "compulsory",
    "blocks",
    "page_switches",
    "search_lines",
];

/// Counts the windows of the one part that is given, and tells it as a file.
pub(super) fn count(
    args: &Args,
    imports: &Registry<dyn TraceImport>,
    questions: &Questions,
) -> anyhow::Result<Vec<u8>> {
    let [path] = &args.traces[..] else { return Err(usage("--counts counts one part at a time")) };
    let name = named(path);
    let Opened::Ours(blocks) = open(args, path, imports)? else {
        return Err(usage(format!(
            "{name}: --counts is for parts (--part i/N), and a trace of another program has none"
        )));
    };
    let trace = TraceReader::from_blocks(blocks).with_context(|| name.clone())?;
    refuse_whole(&name, trace.header())?;
    windowed::refuse(args)?;
    windowed::sample(trace.header()).with_context(|| name.clone())?;
    let caches = questions.caches_of(args, &trace.header().regions)?;
    room_for_lines(&trace.header().regions, questions)?;
    let measures = questions.measures_of(trace.header());
    let mut windows = windowed::windows(&trace.header().regions, &caches, &measures)?;
    let mut trace = Replay::One(Box::new(trace));
    replay(args, &mut trace, &mut windows).with_context(|| name.clone())?;
    written(args, trace.header(), &trace.end()?, &caches, &windows.counted())
}

/// What was counted of a part, as a file.
fn written(
    args: &Args,
    header: &Header,
    end: &End,
    caches: &[CacheConfig],
    counted: &CountedWindows,
) -> anyhow::Result<Vec<u8>> {
    let stream = BlockWriter::new(vec![], StreamKind::Trace, header)?
        .finish(&End { stages: end.stages.clone(), ..End::default() })?;
    let stream: String = stream.iter().map(|byte| format!("{byte:02x}")).collect();
    let rows = |windows: &[WindowCounts]| -> Vec<Value> {
        counted.batches.iter().zip(windows).map(|(&batch, window)| row(batch, window)).collect()
    };
    let caches: Vec<Value> = caches
        .iter()
        .zip(&counted.caches)
        .map(|(config, windows)| json!({ "cache": config.to_string(), "windows": rows(windows) }))
        .collect();
    let file = json!({
        "schema": SCHEMA.0,
        "version": SCHEMA.1,
        "part": stream,
        "page": args.page.0,
        "span": args.span.word(),
        "queries_simulated": counted.queries_simulated,
        "columns": COLUMNS,
        "caches": caches,
    });
    let mut bytes = serde_json::to_vec_pretty(&file)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// A window as numbers: those of [`COLUMNS`], then fetches of each region, then what is not known of each.
fn row(batch: u64, window: &WindowCounts) -> Value {
    let (cache, records) = (&window.cache, &window.cache.records);
    let known: [Option<u64>; COLUMNS.len()] = [
        Some(batch),
        Some(window.exact.into()),
        Some(cache.queries),
        Some(cache.searches),
        Some(records.reads),
        Some(records.writes),
        Some(records.read_modify_writes),
        Some(records.bytes_read),
        Some(records.bytes_written),
        Some(cache.accesses),
        Some(cache.fetches),
        Some(cache.bytes_fetched),
        Some(cache.bytes_written_back),
        Some(cache.compulsory),
        Some(cache.blocks),
        cache.more.page_switches,
        window.search_lines,
    ];
    let regions = cache.region_fetches.iter().chain(&window.unknown).map(|&number| Some(number));
    json!(known.into_iter().chain(regions).collect::<Vec<_>>())
}

/// The batch and the window of a row; `None` if it is none.
fn window_of(config: CacheConfig, row: &Value) -> Option<(u64, WindowCounts)> {
    let row = row.as_array()?;
    let (known, regions) = row.split_at_checked(COLUMNS.len())?;
    let whole = |at: usize| known[at].as_u64();
    let perhaps = |at: usize| if known[at].is_null() { Some(None) } else { whole(at).map(Some) };
    let regions: Vec<u64> = regions.iter().map(Value::as_u64).collect::<Option<_>>()?;
    let (region_fetches, unknown) = regions.split_at(regions.len() / 2);
    let records = RecordCounts {
        reads: whole(4)?,
        writes: whole(5)?,
        read_modify_writes: whole(6)?,
        bytes_read: whole(7)?,
        bytes_written: whole(8)?,
    };
    let cache = CacheCounts {
        config,
        queries: whole(2)?,
        searches: whole(3)?,
        records,
        accesses: whole(9)?,
        fetches: whole(10)?,
        bytes_fetched: whole(11)?,
        bytes_written_back: whole(12)?,
        compulsory: whole(13)?,
        blocks: whole(14)?,
        region_fetches: region_fetches.to_vec(),
        more: AskedCounts { page_switches: perhaps(15)?, ..AskedCounts::default() },
    };
    let exact = [false, true].get(usize::try_from(whole(1)?).ok()?).copied()?;
    Some((whole(0)?, WindowCounts { cache, unknown: unknown.to_vec(), exact, search_lines: perhaps(16)? }))
}

/// What a file says.
struct PartCounts {
    name: String,
    stream: Vec<u8>,
    /// What else was asked: the page and which lines are touched.
    page: u64,
    span: SpanRule,
    caches: Vec<CacheConfig>,
    counted: CountedWindows,
}

impl PartCounts {
    fn read(path: &Path) -> anyhow::Result<Self> {
        let name = named(path);
        let mut bytes = vec![];
        open_bytes(path)?.take(MOST_BYTES).read_to_end(&mut bytes).with_context(|| name.clone())?;
        let file: Value = serde_json::from_slice(&bytes)
            .map_err(|_| bad_input(format!("{name}: not what pm-cachesim --counts writes, or not all of it")))?;
        if (file["schema"].as_str(), file["version"].as_u64()) != (Some(SCHEMA.0), Some(SCHEMA.1)) {
            return Err(bad_input(format!("{name}: not what pm-cachesim --counts of this version writes")));
        }
        Self::of(name.clone(), &file).ok_or_else(|| bad_input(format!("{name}: its counts make no sense")))
    }

    fn of(name: String, file: &Value) -> Option<Self> {
        let digits = file["part"].as_str()?.as_bytes();
        let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok();
        let stream = digits.chunks(2).map(byte).collect::<Option<Vec<u8>>>()?;
        let (mut caches, mut counts, mut batches) = (vec![], vec![], None);
        for cache in file["caches"].as_array()? {
            let config: CacheConfig = cache["cache"].as_str()?.parse().ok()?;
            let rows = cache["windows"].as_array()?.iter().map(|row| window_of(config, row));
            let (of_these, windows): (Vec<u64>, Vec<_>) = rows.collect::<Option<Vec<_>>>()?.into_iter().unzip();
            if *batches.get_or_insert_with(|| of_these.clone()) != of_these {
                return None;
            }
            caches.push(config);
            counts.push(windows);
        }
        let counted = CountedWindows {
            batches: batches?,
            queries_simulated: file["queries_simulated"].as_u64()?,
            caches: counts,
        };
        let span = SpanRule::of_word(file["span"].as_str()?)?;
        Some(Self { name, stream, page: file["page"].as_u64()?, span, caches, counted })
    }
}

/// Adds up what was counted of all parts of one trace.
pub(super) fn add_up(args: &Args, questions: &Questions, results: &mut Results) -> anyhow::Result<()> {
    args.foreign.refuse_of_ours()?;
    let parts = args.traces.iter().map(|path| PartCounts::read(path)).collect::<anyhow::Result<Vec<_>>>()?;
    let open = |part: &PartCounts| -> anyhow::Result<_> {
        let blocks = BlockReader::new(Cursor::new(part.stream.clone())).with_context(|| part.name.clone())?;
        Ok((part.name.clone(), blocks))
    };
    let streams = parts.iter().map(open).collect::<anyhow::Result<Vec<_>>>()?;
    let mut whole = Replay::Parts(Parts::new(streams).map_err(refuse_parts)?);
    while whole.replay_block(&mut Nobody)?.is_some() {}
    let (header, end) = (whole.header().clone(), whole.end()?);
    let first = &parts[0];
    if let Some(other) = parts.iter().find(|part| part.caches != first.caches) {
        return Err(usage(format!("{} and {} were counted for other caches", first.name, other.name)));
    }
    if let Some(other) = parts.iter().find(|part| (part.page, part.span) != (first.page, first.span)) {
        return Err(usage(format!("{} and {} were counted with another --page or --span", first.name, other.name)));
    }
    let sample = windowed::sample(&header)?.ok_or_else(|| bad_input(format!("{}: no windows", first.name)))?;
    let measures = Measures { page_bytes: Some(first.page), span: first.span, ..questions.measures.clone() };
    let mut windows = windowed::windows(&header.regions, &first.caches, &measures)?;
    let names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
    let names = names.join(" ");
    for part in &parts {
        if !windows.add(part.counted.clone()) {
            return Err(bad_input(format!("{}: its counts are not those of its trace", part.name)));
        }
    }
    let rows = windows.finish(Some(sample.windows), sample.share);
    results.add_windows(&Source::ours(Path::new(&names), &header, &end), rows);
    Ok(())
}

/// Refuses counts of what can be counted only as a whole.
fn refuse_whole(name: &str, header: &Header) -> anyhow::Result<()> {
    match (header.meaning(meaning::PART), header.meaning(meaning::SAMPLE_WINDOWS)) {
        (Some(_), Some(_)) => Ok(()),
        (None, _) => Err(usage(format!("{name}: --counts is for parts (--part i/N), and this is a whole trace"))),
        (Some(part), None) => Err(usage(format!(
            "{name} is part {part} of a trace without windows: its caches go on from batch to batch, so that counts of parts \
             are not those of the whole; give pm-cachesim all parts"
        ))),
    }
}

/// Whom a stream without searches is told.
struct Nobody;

impl TraceSink for Nobody {
    fn access(&mut self, _: Access) {}
}
