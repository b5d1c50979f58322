//! What was found, trace by trace.

use super::cache_result::CacheResult;
use super::columns;
use super::curve_point::CurvePoint;
use super::found::Found;
use super::questions::asked_wrongly;
use super::sizes::Size;
use super::{Args, traffic};
use crate::cli::usage;
use pm_caches::{CacheConfig, Findings, LEAST_MODEL, TraceCounts, Ways, WindowedCounts};
use pm_formats::trace::Region;
use pm_formats::vocabulary::meaning;
use pm_formats::{End, Header, as_commands};
use pm_report::{Format, Table};
use std::path::Path;
use std::rc::Rc;

/// What is printed at the end.
#[derive(Default)]
pub(super) struct Results {
    rows: Vec<CacheResult>,
    points: Vec<CurvePoint>,
}

/// The trace that something was found of.
pub(super) struct Source {
    /// The name of the file, as it was typed.
    trace: Rc<str>,
    /// The photon map, if it is a trace of one.
    map: Rc<str>,
    /// The order of the queries, or the format of a foreign trace.
    order: String,
    /// Which part of the stream it is, in words; empty if it is all.
    sample: String,
    /// The commands that it came by, on one line as a shell reads them; of a foreign trace nothing is known.
    history: Rc<str>,
    /// Names of the regions.
    regions: Rc<Vec<String>>,
    query_bytes: u64,
    order_bytes: u64,
}

impl Source {
    /// One of our traces, read to its end.
    pub(super) fn ours(path: &Path, header: &Header, end: &End) -> Self {
        let (query_bytes, order_bytes) = (traffic::query_bytes(end), traffic::order_bytes(end));
        let sample = header.meaning(meaning::SAMPLE).unwrap_or_default().to_owned();
        let history = as_commands(&header.history).trim_end().replace('\n', "; ").into();
        let order = order_of(header);
        let map = header.meaning(meaning::MAP).unwrap_or_default().into();
        let source = Self::foreign(path, order, &header.regions);
        Self { map, sample, history, query_bytes, order_bytes, ..source }
    }

    /// A trace in another format.
    pub(super) fn foreign(path: &Path, format: String, regions: &[Region]) -> Self {
        let regions = Rc::new(regions.iter().map(|region| region.name.clone()).collect());
        let (sample, history) = (String::new(), "".into());
        let trace = path.display().to_string().into();
        Self { trace, map: "".into(), order: format, sample, history, regions, query_bytes: 0, order_bytes: 0 }
    }

    /// What was found of a cache with so many searches in flight.
    fn result(&self, lanes: u16, found: Found, result_bytes: Option<u64>) -> CacheResult {
        CacheResult {
            trace: Rc::clone(&self.trace),
            map: Rc::clone(&self.map),
            order: self.order.clone(),
            sample: self.sample.clone(),
            lanes,
            found,
            history: Rc::clone(&self.history),
            regions: Rc::clone(&self.regions),
            query_bytes: self.query_bytes,
            order_bytes: self.order_bytes,
            result_bytes,
        }
    }
}

impl Results {
    /// The table of all.
    pub(super) fn table(&self, args: &Args) -> Table {
        match args.is_curve() {
            true => columns::of_curves(args.format, &self.points),
            false => columns::of_caches(args.format, &self.rows),
        }
    }

    /// Adds what the windows of a trace tell.
    pub(super) fn add_windows(&mut self, source: &Source, caches: Vec<WindowedCounts>) {
        self.rows.extend(caches.into_iter().map(|counts| source.result(1, Found::Windows(counts), None)));
    }

    /// Adds what was found of a trace with so many searches in flight.
    pub(super) fn add(&mut self, args: &Args, source: &Source, lanes: u16, findings: Findings) -> anyhow::Result<()> {
        let result = |counts| source.result(lanes, Found::Exact(Box::new(counts)), findings.result_bytes);
        self.rows.extend(findings.caches.into_iter().map(result));
        let mut exact = findings.curves.into_iter().map(Rc::new);
        let mut sampled = findings.sampled.into_iter().map(Rc::new);
        loop {
            let (exact, sampled) = (exact.next(), sampled.next());
            let trace = exact.as_ref().map(|curve| curve.trace).or(sampled.as_ref().map(|curve| curve.trace));
            let Some(trace) = trace else { return Ok(()) };
            let (file, map) = (Rc::clone(&source.trace), Rc::clone(&source.map));
            let (order, history) = (source.order.clone(), Rc::clone(&source.history));
            let cliff = exact.as_ref().and_then(|curve| curve.cliff());
            let mut point = CurvePoint { file, map, order, lanes, history, exact, cliff, sampled, trace, lines: 0 };
            for lines in curve_sizes(args, &point)? {
                point.lines = lines;
                self.points.push(point.clone());
            }
        }
    }
}

/// Sizes of a curve to print, in lines.
fn curve_sizes(args: &Args, curve: &CurvePoint) -> anyhow::Result<Vec<u64>> {
    let TraceCounts { line_bytes, blocks, .. } = curve.trace;
    let sizes = args.all_sizes();
    let lines = |size: Size| {
        let bytes = size.bytes(line_bytes.into(), 1, blocks);
        Ok(CacheConfig::lru(bytes, Ways::Full, line_bytes).map_err(asked_wrongly)?.lines())
    };
    let asked: Vec<u64> = sizes.into_iter().map(lines).collect::<anyhow::Result<_>>()?;
    if let Some(sampled) = &curve.sampled {
        let least = sampled.least();
        let too_small = asked.iter().find(|&&lines| lines < least);
        let sizes = if asked.is_empty() { sampled.sizes(blocks) } else { asked.clone() };
        if let Some(&lines) = too_small.or(sizes.is_empty().then_some(&blocks)) {
            return Err(usage(format!(
                "--shards {}: nothing can be said of {lines} lines, only of {least} and more, for which {LEAST_MODEL} \
                 stand; a rate of {:.2} would do, or --curve for exact numbers",
                sampled.rate,
                ((LEAST_MODEL / lines.max(1) as f64) * 100.0).ceil().clamp(1.0, 100.0) / 100.0
            )));
        }
        return Ok(sizes);
    }
    match (&curve.exact, args.format) {
        _ if !asked.is_empty() => Ok(asked),
        (Some(exact), Format::Table) => Ok(exact.readable()),
        (Some(exact), _) => Ok(exact.changes().collect()),
        (None, _) => Ok(vec![]),
    }
}

/// The order of the queries, as the stream tells it: `tiled 16x16, hilbert per batch`.
fn order_of(header: &Header) -> String {
    let parts = [meaning::ORDER, meaning::DEFERRED_ORDER]
        .into_iter()
        .filter_map(|name| header.meaning(name).map(str::to_owned));
    parts
        .chain(header.meaning(meaning::MISSES_OF).map(|caches| format!("{} {caches}", meaning::MISSES_OF)))
        .collect::<Vec<_>>()
        .join(", ")
}
