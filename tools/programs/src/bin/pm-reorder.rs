//! Puts a stream of gather queries into another order, changing nothing else.

use anyhow::Context as _;
use clap::Parser;
use indicatif::BinaryBytes;
use pm_curves::{Grid, hilbert_keys, morton_keys};
use pm_formats::vocabulary::{DeferredLabel, SampleUnit, meaning};
use pm_formats::{Block, BlockMeta, Header, Photon, Query, RecordReader, RecordWriter, StageReport, Step, Tally};
use pm_orders::{
    Buffered, Charge, Hashed, Limits, MedianSplit, Partition, Per, Record, Reorder, Reordering, Snowplow, Sorted, Store,
};
use pm_programs::cli::choice;
use pm_programs::cli::{self, Output, OutputArgs, Progress, Typed, Voice, named, open_input, usage};
use pm_random::Random;
use pm_size::Bytes;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Reorder gather queries so that neighbours in space become neighbours in time.
///
/// The same queries come out, which the digest at the end of the stream proves; only their order, and with it the memory
/// traffic of their searches, is another. What the order itself costs stands in the end block (`pm-view`): queries held,
/// bytes on chip, and bytes written to memory and read back because the store on chip is too small.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// How to order the queries
    order: Order,
    /// Queries to read; `-` is standard input
    #[arg(default_value = "-")]
    queries: PathBuf,
    /// Reorder each batch (tile, scanline) by itself, or the whole image
    #[arg(long, default_value = "image", value_parser = choice::<Per>())]
    per: Per,
    /// Bytes of the store on chip; queries beyond are written to memory and read back, which is counted
    #[arg(long, value_name = "SIZE", default_value = "1M")]
    storage: Bytes,
    /// What is stored of a query while it waits, as far as is counted
    #[arg(long, default_value = "full", value_parser = choice::<Record>())]
    record: Record,
    /// Photon map, whose leaves are the cells of leaf, cells and (optional) buffered
    #[arg(long, value_name = "FILE")]
    photons: Option<PathBuf>,
    /// Most photons of such a cell; default: 64 for leaf, 2048 for cells, 1024 for buffered
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    leaf_photons: Option<u32>,
    /// Buckets of hashed
    #[arg(long, value_name = "N", default_value = "37", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    buckets: u32,
    /// Queries that a bucket of hashed holds
    #[arg(long, value_name = "N", default_value = "128", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    capacity: u32,
    /// Side of the cells of hashed and buffered, in scene units; default: 1/32 and 1/8 of the scene's longest side (after
    /// direction binning 1/8 serves hashed best)
    #[arg(long, value_name = "X", value_parser = side)]
    cell: Option<f32>,
    /// Seed of the random order
    #[arg(long, default_value = "0")]
    seed: u64,
    /// Memory of this machine to sort in; beyond it, temporary files (TMPDIR) are used. The output is the same
    #[arg(long, value_name = "SIZE", default_value = "2G", value_parser = memory)]
    memory: Bytes,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    voice: Voice,
}

#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum Order {
    /// Along a Hilbert curve through the scene (30-bit keys)
    Hilbert,
    /// Along Morton's curve (30-bit keys)
    Morton,
    /// By leaf of a median split of the photons, depth first
    Leaf,
    /// By a hash of pixel, sample and seed: the control, without any coherence
    Random,
    /// Through hash buckets of cells: when one is full, the current one is emptied, then the fullest; streaming
    Hashed,
    /// Along a Hilbert curve: spilled in partitions that fit the store, and sorted when they are read back
    Partition,
    /// By cells that each hold so many photons that they fit the cache, and as they came within a cell
    Cells,
    /// Along a Hilbert curve, round after round: the next on the curve leaves when the store is full; streaming
    Snowplow,
    /// Through buffers of cells that share the store: when it is full, the best by benefit over cost leaves; streaming
    Buffered,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-queries --order tiled | pm-reorder hilbert --per batch -o tiled-hilbert.pmq
  pm-reorder snowplow --storage 256K --record compact q.pmq | pm-gather map.pmp | pm-cachesim
  pm-queries --order tiled --tile 128 | pm-reorder cells --photons map.pmp --per batch | pm-gather";

/// Streams that need more than this while they are held are announced.
const WORTH_SAYING: u64 = 256 << 20;
/// Least memory to sort in.
const LEAST_MEMORY: u64 = 64 << 10;
/// Cells along the longest side for hashed, and for buffered.
const HASH_CELLS: u32 = 32;
const BUFFER_CELLS: u32 = 8;
/// Most cells of buffered: all of them are looked at when one is chosen.
const MOST_BUFFERS: u32 = 16384;

fn side(text: &str) -> Result<f32, String> {
    let parsed = text.parse().ok().filter(|&side: &f32| side > 0.0 && side.is_finite());
    parsed.ok_or_else(|| "a length above 0 is expected, in scene units".into())
}

fn memory(text: &str) -> Result<Bytes, String> {
    let bytes: Bytes = text.parse().map_err(|error: pm_size::SizeError| error.to_string())?;
    if bytes.0 < LEAST_MEMORY { Err(format!("at least {} is needed", Bytes(LEAST_MEMORY))) } else { Ok(bytes) }
}

fn main() -> ExitCode {
    cli::main("pm-reorder", run)
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let photons = photons(&args)?;
    let name = named(&args.queries);
    let mut queries = RecordReader::<Query, _>::from_blocks(open_input(&args.queries)?).context(name.clone())?;
    let mut header = queries.header().clone();
    check_sample(&args, &name, &header)?;
    header.set_meaning(meaning::DEFERRED_ORDER, label(&args));
    let seed = (args.order == Order::Random).then_some(args.seed);
    let inputs = photons.iter().map(|photons| (photons.name.clone(), photons.history.clone())).collect();
    header.history.push(Step { inputs, ..typed.step_from(&args.queries, seed) });

    let mut order = Reordering::new(args.per, build(&args, &header, photons)?);
    let mut output = RecordWriter::new(args.output.create()?, &header)?;
    let progress = Progress::new(header.expected_records, "queries", args.voice.quiet);
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

/// Windows of a stream stay apart.
fn check_sample(args: &Args, name: &str, header: &Header) -> anyhow::Result<()> {
    let Some(sample) = header.meaning(meaning::SAMPLE).filter(|_| header.meaning(meaning::SAMPLE_WINDOWS).is_some())
    else {
        return Ok(());
    };
    if args.per == Per::Image {
        return Err(usage(format!(
            "{name} holds {sample}, which stay apart: give --per batch, or take the sample after reordering"
        )));
    }
    if header.meaning(meaning::SAMPLE_OF).and_then(|of| of.parse().ok()) != Some(SampleUnit::Batches) {
        args.voice.remark(format!(
            "{name} holds {sample}: the queries of each are ordered by themselves, which is not the order of all"
        ));
    }
    Ok(())
}

/// Writes blocks that stand beside the queries as they are.
fn pass_on(blocks: Vec<(Block, Tally)>, output: &mut RecordWriter<Query, Output>) -> anyhow::Result<()> {
    for (block, tally) in blocks {
        output.write_beside(&block, tally)?;
    }
    Ok(())
}

/// The order with what its result depends on, for the table of the caches.
fn label(args: &Args) -> DeferredLabel {
    let order = match args.order {
        Order::Hilbert => "hilbert".to_owned(),
        Order::Morton => "morton".to_owned(),
        Order::Leaf => "leaf".to_owned(),
        Order::Random => "random".to_owned(),
        Order::Hashed => format!("hashed {}x{}", args.buckets, args.capacity),
        Order::Partition => format!("partition {}", args.storage),
        Order::Cells => format!("cells of {}", leaf_photons(args)),
        Order::Snowplow => format!("snowplow {}", args.storage),
        Order::Buffered => format!("buffered {}", args.storage),
    };
    DeferredLabel { order, per_batch: args.per == Per::Batch, compact: args.record == Record::Compact }
}

/// Most photons of a cell.
fn leaf_photons(args: &Args) -> u32 {
    args.leaf_photons.unwrap_or(match args.order {
        Order::Cells => 2048,
        Order::Buffered => 1024,
        _ => 64,
    })
}

/// A photon map, as far as cells need it.
struct Photons {
    name: String,
    history: Vec<Step>,
    cells: MedianSplit,
}

/// The cells of the photons asked for.
fn photons(args: &Args) -> anyhow::Result<Option<Photons>> {
    let wanted = match args.order {
        Order::Leaf | Order::Cells => true,
        Order::Buffered => args.photons.is_some(),
        _ => false,
    };
    let path = match &args.photons {
        Some(path) if wanted => path,
        None if wanted => return Err(usage("this order goes by cells of the photon map: give --photons FILE")),
        Some(_) => return Err(usage("this order goes by no photons: leave --photons out")),
        None => return Ok(None),
    };
    if path == Path::new("-") && args.queries == Path::new("-") {
        return Err(usage("standard input (`-`) can be read only once: name the photons or the queries by file"));
    }
    let name = named(path);
    let mut reader = RecordReader::<Photon, _>::from_blocks(open_input(path)?).context(name.clone())?;
    let mut positions = vec![];
    while let Some((_, photons)) = reader.next_block().with_context(|| name.clone())? {
        positions.extend(photons.iter().map(|photon| photon.position));
    }
    let cells = MedianSplit::new(positions, leaf_photons(args) as usize);
    Ok(Some(Photons { name: path.display().to_string(), history: reader.header().history.clone(), cells }))
}

/// Keys of many queries at once.
type Keys = Box<dyn Fn(&[Query]) -> Vec<u32>>;

fn build(args: &Args, header: &Header, photons: Option<Photons>) -> anyhow::Result<Box<dyn Reorder>> {
    let seed = args.seed;
    let store = Store { bytes: args.storage.0, record: args.record };
    let bounds = header.bounds;
    let hilbert = move |queries: &[Query]| hilbert_keys(&bounds, queries, |query| query.position);
    let sorted = |keys: Keys, charge: Charge, tables: u64| -> Box<dyn Reorder> {
        Box::new(Sorted::new(keys, charge, store, tables, limits(args, header)))
    };
    let by_cell = |photons: Option<Photons>, charge: fn(u64) -> Charge| {
        let cells = photons.expect("this order has asked for photons").cells;
        let (number, bytes) = (cells.cells(), cells.bytes());
        let keys = move |queries: &[Query]| queries.iter().map(|query| cells.cell(query.position)).collect();
        sorted(Box::new(keys), charge(number.into()), bytes)
    };
    Ok(match args.order {
        Order::Hilbert => sorted(Box::new(hilbert), Charge::MergeSort, 0),
        Order::Partition => sorted(Box::new(hilbert), Charge::Partition(Partition::new()), 0),
        Order::Morton => {
            let morton = move |queries: &[Query]| morton_keys(&bounds, queries, |query| query.position);
            sorted(Box::new(morton), Charge::MergeSort, 0)
        }
        Order::Random => {
            let key = move |query: &Query| {
                Random::new(&[seed, u64::from(query.pixel), u64::from(query.sample)]).next_u64() >> 32
            };
            let keys = move |queries: &[Query]| queries.iter().map(|query| key(query) as u32).collect();
            sorted(Box::new(keys), Charge::MergeSort, 0)
        }
        Order::Leaf => by_cell(photons, |_| Charge::MergeSort),
        Order::Cells => by_cell(photons, Charge::Cells),
        Order::Snowplow => Box::new(Snowplow::new(hilbert, store)),
        Order::Hashed => {
            // Cells beyond that number along a side are smaller than what coordinates tell apart.
            let grid = args.cell.map(|side| Grid::of_side(&bounds, side, 1 << 24));
            let grid = grid.unwrap_or_else(|| Grid::across(&bounds, HASH_CELLS));
            Box::new(Hashed::new(grid, args.buckets, args.capacity, store))
        }
        Order::Buffered => {
            if let Some(Photons { cells, .. }) = photons {
                let number = few_enough(cells.cells().into(), "--leaf-photons")?;
                let tables = cells.bytes();
                Box::new(Buffered::new(move |query: &Query| cells.cell(query.position), number, store, tables))
            } else {
                let grid = args.cell.map(|side| Grid::of_side(&bounds, side, 1 << 20));
                let grid = grid.unwrap_or_else(|| Grid::across(&bounds, BUFFER_CELLS));
                let [across, down, _] = grid.cells();
                let number = few_enough(grid.cells().map(u64::from).iter().product(), "--cell")?;
                let cell = move |query: &Query| {
                    let [x, y, z] = grid.cell(query.position);
                    (z * down + y) * across + x
                };
                Box::new(Buffered::new(cell, number, store, 0))
            }
        }
    })
}

/// Few enough cells for buffers.
fn few_enough(cells: u64, option: &str) -> anyhow::Result<u32> {
    match u32::try_from(cells) {
        Ok(cells) if cells <= MOST_BUFFERS => Ok(cells),
        _ => Err(usage(format!("buffered has at most {MOST_BUFFERS} cells, not {cells}: give a larger {option}"))),
    }
}

/// What this machine may spend on sorting, and what is said of it.
fn limits(args: &Args, header: &Header) -> Limits {
    let (voice, memory, folder) = (args.voice, args.memory.0, std::env::temp_dir());
    // A record and its sorting key each.
    let bytes = |records: u64| records.saturating_mul((size_of::<Query>() + size_of::<u64>()) as u64);
    let expected = header.expected_records.filter(|_| args.per == Per::Image);
    if let Some(records) = expected.filter(|&records| (WORTH_SAYING..=memory).contains(&bytes(records))) {
        let size = BinaryBytes(bytes(records));
        voice.remark(format!("up to {records} queries will be held in {size} of memory to order the whole image"));
    }
    let size = expected.map_or(String::new(), |records| format!(", up to {}", BinaryBytes(bytes(records))));
    let place = folder.display().to_string();
    let announce = move || {
        let memory = Bytes(memory);
        voice.remark(format!("more than --memory {memory} holds: sorting in temporary files in {place}{size}"));
    };
    Limits { memory, folder, announce: Box::new(announce) }
}
