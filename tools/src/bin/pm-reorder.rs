//! Puts a stream of gather queries into another order, changing nothing else.

use anyhow::Context as _;
use clap::Parser;
use indicatif::BinaryBytes;
use pm_formats::{Block, BlockMeta, Bounds, Query, RecordReader, RecordWriter, StageReport, Tally};
use pm_tools::cli::{self, Output, OutputArgs, Progress, Typed, Voice, named, open_input};
use pm_tools::order::{Per, Reorder, Sorted, hilbert_keys};
use pm_tools::random::Random;
use std::path::PathBuf;
use std::process::ExitCode;

/// Reorder gather queries so that neighbours in space become neighbours in time.
///
/// The same queries come out, which the digest at the end of the stream proves; only their order, and with it the memory
/// traffic of their searches, is another.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// How to order the queries
    order: Order,
    /// Queries to read; `-` is standard input
    #[arg(default_value = "-")]
    queries: PathBuf,
    /// Reorder each batch (tile, scanline) by itself, or the whole image
    #[arg(long, default_value = "image")]
    per: Per,
    /// Seed of the random order
    #[arg(long, default_value = "0")]
    seed: u64,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    voice: Voice,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Order {
    /// Along a Hilbert curve through the scene (30-bit keys)
    Hilbert,
    /// By a hash of pixel, sample and seed: the control, without any coherence
    Random,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-queries --order tiled | pm-reorder hilbert --per batch -o tiled-hilbert.pmq
  pm-reorder random scanline.pmq | pm-gather map.pmp | pm-cachesim --format csv";

/// Streams that need more than this while they are held are announced.
const WORTH_SAYING: u64 = 256 << 20;

fn main() -> ExitCode {
    cli::main("pm-reorder", run)
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let name = named(&args.queries);
    let mut queries = RecordReader::<Query, _>::from_blocks(open_input(&args.queries)?).context(name.clone())?;
    let mut header = queries.header().clone();
    let (label, seed) = match args.order {
        Order::Hilbert => ("hilbert", None),
        Order::Random => ("random", Some(args.seed)),
    };
    let per = if args.per == Per::Batch { " per batch" } else { "" };
    header.set_meaning("deferred order", format!("{label}{per}"));
    header.history.push(typed.step_from(&args.queries, seed));

    if let (Per::Image, Some(records)) = (args.per, header.expected_records) {
        // A record and its sorting key each.
        let bytes = records * (size_of::<Query>() + size_of::<u64>()) as u64;
        if bytes > WORTH_SAYING {
            let size = BinaryBytes(bytes);
            args.voice
                .remark(format!("up to {records} queries will be held in {size} of memory to order the whole image"));
        }
    }

    let mut output = RecordWriter::new(args.output.create()?, &header)?;
    let progress = Progress::new(header.expected_records, "queries", args.voice.quiet);
    let mut order = build(args.order, args.per, header.bounds, args.seed);
    while let Some((meta, records)) = queries.next_block().with_context(|| name.clone())? {
        pass_on(queries.take_beside(), &mut output)?;
        order.push(meta, &records, &mut |meta: BlockMeta, queries: &[Query]| output.write(meta, queries))?;
        progress.add(records.len() as u64);
    }
    pass_on(queries.take_beside(), &mut output)?;
    order.drain(&mut |meta: BlockMeta, queries: &[Query]| output.write(meta, queries))?;
    let mut report = StageReport::new(typed.program());
    report.measures = order.measures();
    output.finish_with_same_records(queries.end()?, report)?.commit()
}

/// Writes blocks that stand beside the queries as they are.
fn pass_on(blocks: Vec<(Block, Tally)>, output: &mut RecordWriter<Query, Output>) -> anyhow::Result<()> {
    for (block, tally) in blocks {
        output.write_beside(&block, tally)?;
    }
    Ok(())
}

fn build(order: Order, per: Per, bounds: Bounds, seed: u64) -> Box<dyn Reorder> {
    match order {
        Order::Hilbert => {
            Box::new(Sorted::new(per, move |queries: &[Query]| hilbert_keys(&bounds, queries, |query| query.position)))
        }
        Order::Random => Box::new(Sorted::new(per, move |queries: &[Query]| {
            let key = |query: &Query| Random::new(&[seed, u64::from(query.pixel), u64::from(query.sample)]).next_u64();
            queries.iter().map(|query| (key(query) >> 32) as u32).collect()
        })),
    }
}
