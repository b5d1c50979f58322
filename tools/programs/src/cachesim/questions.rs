//! What is to be found out: the caches, and what else of a trace.

use super::sizes::Size;
use super::{Args, traffic};
use crate::cli::usage;
use pm_caches::{CacheConfig, Measures, ResultMemory, SpanRule, Ways};
use pm_formats::Header;
use pm_formats::trace::Region;
use pm_report::Format;
use pm_size::Bytes;

/// What is to be found out of every trace.
pub(super) struct Questions {
    pub(super) caches: Vec<CacheConfig>,
    pub(super) measures: Measures,
}

/// The paper's cache.
const DEFAULT_SIZE: Bytes = Bytes(128 << 10);

impl Questions {
    /// What the arguments ask.
    pub(super) fn new(args: &Args) -> anyhow::Result<Self> {
        // A share of a map that is not known yet: any map shows what is wrong.
        Ok(Self { caches: caches(args, &[])?, measures: measures(args)? })
    }

    /// The caches of a trace whose map lies in these regions.
    pub(super) fn caches_of(&self, args: &Args, regions: &[Region]) -> anyhow::Result<Vec<CacheConfig>> {
        if !args.all_sizes().iter().any(|size| matches!(size, Size::Share(_))) {
            return Ok(self.caches.clone());
        }
        if regions.iter().any(Region::is_addresses) {
            return Err(usage("--sizes: a share is one of the map, and a trace of all addresses has none"));
        }
        caches(args, regions)
    }

    /// The measures, given what the trace says.
    pub(super) fn measures_of(&self, header: &Header) -> Measures {
        let tile_pixels = traffic::tile_pixels(header);
        let results = self.measures.results.map(|memory| ResultMemory { tile_pixels, ..memory });
        Measures { results, ..self.measures.clone() }
    }
}

impl Questions {
    /// The measures of a trace of all addresses: it has no queries whose results would go anywhere.
    pub(super) fn measures_of_addresses(&self) -> Measures {
        Measures { results: None, ..self.measures.clone() }
    }
}

/// Says that something was asked wrongly.
pub(super) fn asked_wrongly(error: impl std::fmt::Display) -> anyhow::Error {
    usage(error.to_string())
}

fn caches(args: &Args, regions: &[Region]) -> anyhow::Result<Vec<CacheConfig>> {
    if !args.cache.is_empty() || args.is_curve() {
        return Ok(args.cache.clone());
    }
    let mut sizes = args.all_sizes();
    if sizes.is_empty() {
        sizes.push(Size::Fixed(DEFAULT_SIZE));
    }
    let mut caches = vec![];
    for line in &args.lines {
        for size in &sizes {
            for &ways in &args.ways {
                for &policy in &args.policies {
                    let size = Bytes(size.bytes(
                        line.0,
                        match ways {
                            Ways::Full => 1,
                            Ways::N(ways) => ways.get().into(),
                        },
                        lines_of(regions, line.0),
                    ));
                    let cache = CacheConfig::line(line.0).and_then(|line| CacheConfig::new(size.0, ways, line, policy));
                    let cache = cache.map_err(|error| usage(format!("{size},{ways},{line},{policy}: {error}")));
                    caches.push(cache?);
                }
            }
        }
    }
    Ok(caches)
}

/// The lines that a map in these regions occupies.
fn lines_of(regions: &[Region], line: u64) -> u64 {
    regions.iter().map(|region| region.size.div_ceil(line.max(1))).sum()
}

/// What to find out besides the caches' own counts: what the format shows.
fn measures(args: &Args) -> anyhow::Result<Measures> {
    if args.shared.is_some() && caches(args, &[])?.len() != 1 {
        return Err(usage(
            "--shared lies behind one cache of each element: name one, such as --cache 16K,full,128,lru",
        ));
    }
    if !args.page.0.is_power_of_two() {
        return Err(usage(format!("--page {}: a power of two is expected, such as 8K", args.page)));
    }
    if args.dinero && args.span == SpanRule::Once {
        return Err(usage("--dinero tells misses of lines apart: leave out --span once"));
    }
    if args.span == SpanRule::Once && args.is_curve() {
        return Err(usage(
            "--span once counts records of single caches; a curve counts lines: leave out --curve and --shards",
        ));
    }
    let (dram, miss_by_miss) = (args.dram, args.dinero);
    let (write_backs, miss_chains) = (args.write_backs, args.miss_chain);
    let mut measures =
        Measures { span: args.span, dram, miss_by_miss, miss_chains, write_backs, ..Measures::default() };
    if args.is_curve() {
        // Whatever the size, the line must do.
        let lines = args.lines.iter().map(|line| CacheConfig::line(line.0).map_err(asked_wrongly));
        measures.curves = lines.collect::<anyhow::Result<_>>()?;
        measures.sampled = args.shards;
        measures.exact_too = args.curve;
    } else if args.format != Format::Table || args.counts || args.add {
        measures.split = true;
        measures.page_bytes = Some(args.page.0);
        measures.working_sets = true;
        // The tile, if there is one, is the trace's.
        measures.results =
            Some(ResultMemory { cache_bytes: args.result_cache.0, pixel_bytes: args.pixel, tile_pixels: None });
    }
    Ok(measures)
}
