//! Traces of windows: what their header says, and what cannot be asked of them.

use super::Args;
use super::questions::asked_wrongly;
use crate::cli::usage;
use pm_caches::{CacheConfig, Measures, SpanRule, WindowError, Windows};
use pm_exchange::bad_input;
use pm_formats::Header;
use pm_formats::trace::Region;
use pm_formats::vocabulary::meaning;

/// The most windows a trace may say it has.
const MOST_WINDOWS: u64 = 1 << 20;

/// What a header says of the windows.
pub(super) struct Sample {
    /// How many were chosen.
    pub(super) windows: u64,
    /// The part of the stream that they measure, if it says so.
    pub(super) share: Option<f64>,
}

/// What the header says of windows; nothing if the trace has none.
///
/// # Errors
/// If it makes no sense.
pub(super) fn sample(header: &Header) -> anyhow::Result<Option<Sample>> {
    let Some(windows) = header.meaning(meaning::SAMPLE_WINDOWS) else { return Ok(None) };
    let windows = windows.parse().ok().filter(|&windows| windows <= MOST_WINDOWS).ok_or_else(|| {
        bad_input(format!(
            "the header says `{name}` is `{windows}`: at most {MOST_WINDOWS} are expected",
            name = meaning::SAMPLE_WINDOWS
        ))
    })?;
    let share = header.meaning(meaning::SAMPLE_SHARE).map(|share| match share.parse() {
        Ok(part) if part > 0.0 && part <= 1.0 => Ok(part),
        _ => {
            Err(bad_input(format!("the header says `{}` is `{share}`: a part of 1 is expected", meaning::SAMPLE_SHARE)))
        }
    });
    Ok(Some(Sample { windows, share: share.transpose()? }))
}

/// Refuses what cannot be estimated from windows that begin with empty caches.
///
/// # Errors
/// If something of that was asked for.
pub(super) fn refuse(args: &Args) -> anyhow::Result<()> {
    let what = match () {
        () if args.misses.is_some() => "--misses: what a cache fetches in windows is not the stream of its misses",
        () if args.span == SpanRule::Once => "--span once: what a window does not know is told in lines",
        () if args.dram.is_some() => "--dram: which rows were open before a window is not known",
        () if args.dinero => "--dinero: an unbounded past is not known in a window",
        () if args.miss_chain => "--miss-chain: what a window does not know is told in lines, not in chains",
        () if args.curve => "--curve: the state of an unbounded cache is never exact in a window",
        () if args.shards.is_some() => "--shards: the state of an unbounded cache is never exact in a window",
        () if args.prefetch.is_some() => "--prefetch: what was prefetched before a window is not known",
        () if !args.private.is_empty() => "--private: searches of a window are a stretch of one element's, not of all",
        () if !args.lanes.is_empty() => "--lanes: searches of other windows would be in flight with those of this one",
        () => return Ok(()),
    };
    Err(usage(format!("{what}; leave it out, or give a trace that is not sampled in windows")))
}

/// Caches that wait for the windows of a trace.
///
/// # Errors
/// As [`Windows::new`].
pub(super) fn windows(regions: &[Region], caches: &[CacheConfig], measures: &Measures) -> anyhow::Result<Windows> {
    Windows::new(regions, caches, measures).map_err(|error| match error {
        WindowError::Policy(_) => asked_wrongly(error),
        error => error.into(),
    })
}
