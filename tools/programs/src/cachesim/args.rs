//! What pm-cachesim may be asked.

use super::sizes::{Size, Sizes};
use crate::cli::{OutputArgs, Voice, choice};
use crate::foreign_args::ForeignArgs;
use clap::Parser;
use pm_caches::{CacheConfig, ChosenPolicy, Dram, LaneSource, Prefetcher, SpanRule, Ways};
use pm_report::Format;
use pm_size::Bytes;
use std::path::{Path, PathBuf};

/// Simulate caches over an access trace: how much memory traffic is left?
///
/// All caches asked for are simulated in one reading of the trace. An access is one whole record, read when a search
/// reaches it; a record that spans two lines is two line accesses. A `fetch` is a line that was not in the cache; `per
/// block` divides by the number of lines that the map occupies. The table shows the columns that people compare, csv and
/// json have all. Traces of other simulators are read too, plain or compressed: texts tell their format by their first line,
/// binary ones have to be named with --input. They have no queries, and their blocks are those of the 4 KiB pages they
/// touch. Of a trace of windows (pm-queries --only-tiles, pm-sample --every) each window is simulated from an empty cache,
/// and the numbers are estimates with 95 % intervals.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Traces to read, a table row for each trace and cache; `-` is standard input
    #[arg(default_value = "-")]
    pub(super) traces: Vec<PathBuf>,
    /// A cache: size, ways (`full` or a number), line size, policy, and `,hash` to hash the set index; or `none`; may be
    /// repeated
    ///
    /// Without `,hash` the set of a line is the remainder of its number by the number of sets, which may be any.
    #[arg(long, value_name = "SIZE,WAYS,LINE,POLICY", conflicts_with_all = ["sizes", "lines", "ways", "policies"])]
    pub(super) cache: Vec<CacheConfig>,
    /// Sizes, combined with each of --lines, --ways and --policies; 4K..4M is each power of two, 10% of the map [default: 128K]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub(super) sizes: Vec<Sizes>,
    /// Line sizes
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128")]
    pub(super) lines: Vec<Bytes>,
    /// Ways: `full` or numbers
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "full")]
    pub(super) ways: Vec<Ways>,
    /// Policies: which line makes room for a new one
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "lru")]
    pub(super) policies: Vec<ChosenPolicy>,
    /// Fully associative LRU of every size instead, in one pass: csv and json have all sizes at which a count changes,
    /// the table has powers of two, the cliff and the size that holds all; or the --sizes given
    #[arg(long, conflicts_with_all = ["cache", "ways", "policies"])]
    pub(super) curve: bool,
    /// The curve from this share of the lines (SHARDS), with its error; beside the exact one with --curve
    #[arg(long, value_name = "R", conflicts_with_all = ["cache", "ways"], value_parser = rate, hide_short_help = true)]
    pub(super) shards: Option<f64>,
    /// Write what the one --cache fetches as a trace, for a further cache; `-` is standard output, then no table
    #[arg(long, value_name = "FILE", requires = "cache", conflicts_with_all = ["curve", "shards", "lanes"])]
    pub(super) misses: Option<PathBuf>,
    /// With --misses: dirty lines that leave the cache are writes in the stream, before the read that they make room for.
    /// Those that are still there at the end have not left
    #[arg(long, requires = "misses", hide_short_help = true)]
    pub(super) write_backs: bool,
    /// Which lines a record touches that does not lie in one
    #[arg(long, default_value = "both", hide_short_help = true, value_parser = choice::<SpanRule>())]
    pub(super) span: SpanRule,
    /// A DRAM that fetches go to in their order: banks, bytes of a row, `open` or `closed` after a fetch; columns for rows
    /// found open, conflicts and activations
    ///
    /// The bank of a row is its number modulo the banks; with `,xor` behind it, that xor-ed with the bits above.
    #[arg(long, value_name = "BANKS,ROW,POLICY", hide_short_help = true, conflicts_with_all = ["curve", "shards"])]
    pub(super) dram: Option<Dram>,
    /// Columns for capacity and conflict misses as Dinero's -ccc counts them: a miss is one of capacity if the fully
    /// associative LRU cache of that size misses too
    #[arg(long, hide_short_help = true, conflicts_with_all = ["curve", "shards"])]
    pub(super) dinero: bool,
    /// Columns for the longest chain of misses of each search, each of which waits for the one before: the mean and the longest
    ///
    /// What latency costs a search at the least, however much of it is in flight at a time; where nothing is, each of its
    /// fetches waits for the one before. Needs a trace whose reads say what they wait for; pm-gather has an option for that.
    #[arg(long, hide_short_help = true, conflicts_with_all = ["curve", "shards", "misses", "lanes"])]
    pub(super) miss_chain: bool,
    /// DRAM page (row) to count page switches by, a power of two; as if one were open in all, --dram knows banks
    #[arg(long, value_name = "SIZE", default_value = "8K", hide_short_help = true)]
    pub(super) page: Bytes,
    /// Write-back cache of 32-byte sectors that results go through; where a batch is a tile whose pixels fit in it, they
    /// stay on chip until the batch is over
    #[arg(long, value_name = "SIZE", default_value = "16K", hide_short_help = true)]
    pub(super) result_cache: Bytes,
    /// Bytes of a pixel in memory
    #[arg(long, value_name = "BYTES", default_value = "12", hide_short_help = true,
        value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(super) pixel: u32,
    /// Searches in flight at a time over one cache, accesses one of each in turn; a list: a row for each number
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) lanes: Vec<u16>,
    /// Which searches fly together: the next of the stream, one of each of as many parts of a batch, or of as many batches
    #[arg(long, value_name = "HOW", default_value = "stream", requires = "lanes", hide_short_help = true, value_parser = choice::<LaneSource>())]
    pub(super) lanes_from: LaneSource,
    /// So many processing elements, each with caches of its own; a list: a row for each number
    ///
    /// Fetches are those of all private caches together. With --lanes as many searches share one cache; here none of them sees what
    /// another's cache holds, and a line that several want is fetched by each.
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..=4096), hide_short_help = true,
        conflicts_with_all = ["curve", "shards", "misses", "lanes", "dram", "dinero", "miss_chain"])]
    pub(super) private: Vec<u16>,
    /// How searches are shared out: the next one of the stream to whoever is free, a stretch of each batch to each, or a batch to each
    #[arg(long, value_name = "HOW", default_value = "stream", requires = "private", hide_short_help = true, value_parser = choice::<LaneSource>())]
    pub(super) private_from: LaneSource,
    /// A cache that all share behind their own, which is then the one --cache; columns for what it fetches
    #[arg(long, value_name = "SIZE,WAYS,LINE,POLICY", requires = "private", hide_short_help = true)]
    pub(super) shared: Option<CacheConfig>,
    /// A miss brings in more: the N lines behind it (`next-line:N`), or its block of so many bytes (`treelet:512`), into fully
    /// associative LRU caches; columns for how much of that was used
    ///
    /// Blocks are counted from the beginning of a region. Fetches are the misses that are left; bytes fetched are those of what was
    /// prefetched as well.
    #[arg(long, value_name = "HOW", hide_short_help = true,
        conflicts_with_all = ["curve", "shards", "misses", "lanes", "dram", "dinero", "miss_chain", "private", "counts", "add"])]
    pub(super) prefetch: Option<Prefetcher>,
    /// Count the windows of one part of a trace of windows, and write what --add adds to that of the others, instead of a table
    ///
    /// A window begins with empty caches, so what is counted of it is the same wherever that is. Without windows caches go on from
    /// part to part: then all parts have to be given.
    #[arg(long, conflicts_with_all = ["format", "misses", "curve", "shards", "lanes", "dram", "dinero", "miss_chain", "private", "add"], hide_short_help = true)]
    pub(super) counts: bool,
    /// The inputs are what --counts wrote of all parts: the table of the whole
    #[arg(long, conflicts_with_all = ["cache", "sizes", "lines", "ways", "policies", "misses", "curve", "shards", "lanes", "dram",
        "dinero", "miss_chain", "private", "span", "page", "result_cache", "pixel", "columns"], hide_short_help = true)]
    pub(super) add: bool,
    #[command(flatten)]
    pub(super) foreign: ForeignArgs,
    /// Columns of a CSV file: address (or key, any text), size, kind, and _ for one to skip, or names of its own, such as address=lbn,size=len
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_short_help = true)]
    pub(super) columns: Option<Vec<String>>,
    /// How to print the result
    #[arg(long, default_value = "table", value_parser = choice::<Format>())]
    pub(super) format: Format,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    #[command(flatten)]
    pub(super) voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-cachesim --sizes 4K..4M --lines 64,128 scanline.pmt hilbert.pmt
  pm-cachesim --ways full,8 --policies lru,plru,min --format csv trace.pmt
  pm-cachesim --cache 16K,4,64,lru,hash --misses - trace.pmt | pm-cachesim --curve";

fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1.0 => Ok(x),
        _ => Err("a share of the lines above 0 and at most 1 is expected, such as 0.1".into()),
    }
}

impl Args {
    /// Whether sizes of a curve are printed, and no caches one by one.
    pub(super) const fn is_curve(&self) -> bool {
        self.curve || self.shards.is_some()
    }

    /// The sizes asked for.
    pub(super) fn all_sizes(&self) -> Vec<Size> {
        self.sizes.iter().flat_map(|sizes| sizes.0.clone()).collect()
    }

    /// Where the table goes.
    #[must_use]
    pub fn output(&self) -> &Path {
        self.output.output.as_deref().unwrap_or(Path::new("-"))
    }
}
