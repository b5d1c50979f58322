//! Simulates caches over a trace and prints what each would fetch.

use anyhow::Context as _;
use clap::Parser;
use pm_formats::trace::{Access, TraceReader, TraceSink};
use pm_tools::cache::{CacheConfig, LaneSource, Lanes, Row, Simulation};
use pm_tools::cli::{self, Progress, Typed, Voice, create_output, named, open_bytes, usage};
use pm_tools::foreign::{self, Form, Opened, Reading, References};
use pm_tools::report::{Column, Format, Table, Value};
use pm_tools::size::Bytes;
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Simulate caches over an access trace: how much memory traffic is left?
///
/// All caches asked for are simulated in one reading of the trace. An access is one whole record, read when a search
/// reaches it; a record that spans two lines is two line accesses. A `fetch` is a line that was not in the cache; `per
/// block` divides by the number of lines that the map occupies. The table shows the columns that people compare, csv and
/// json have all. Traces of other simulators are read too, plain or compressed: text formats (din, xdin, lackey, dramsim3,
/// ramulator2, csv) tell themselves, binary ones (raw32, raw64, dinb, oracleGeneral) have to be named with --input. They
/// have no queries, and their blocks are those of the 4 KiB pages they touch.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Traces to read, a table row for each trace and cache; `-` is standard input
    #[arg(default_value = "-")]
    traces: Vec<PathBuf>,
    /// A cache: size, ways (`full` or a number), line size, policy (lru, none); may be repeated
    #[arg(long, value_name = "SIZE,WAYS,LINE,POLICY", conflicts_with_all = ["sizes", "lines", "ways"])]
    cache: Vec<CacheConfig>,
    /// Cache sizes, combined with each of --lines and --ways
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128K")]
    sizes: Vec<Bytes>,
    /// Line sizes
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128")]
    lines: Vec<Bytes>,
    /// Ways: `full` or numbers
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "full")]
    ways: Vec<String>,
    /// Searches in flight at a time, accesses one of each in turn; a list: a row for each number
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..))]
    lanes: Vec<u16>,
    /// Which searches fly together: the next of the stream, or one of each of as many parts of a batch
    #[arg(long, value_name = "HOW", default_value = "stream", requires = "lanes", hide_short_help = true)]
    lanes_from: LaneSource,
    /// Format of the traces; without it, as the content tells (ours, or a text), gzip or zstd around it
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    input: Option<Form>,
    #[command(flatten)]
    foreign: ForeignArgs,
    /// How to print the result
    #[arg(long, default_value = "table")]
    format: Format,
    #[command(flatten)]
    voice: Voice,
}

/// How traces of other programs are read.
#[derive(clap::Args)]
struct ForeignArgs {
    /// Bytes of every foreign access [default: as the trace says; where it does not, din 4 and the address that of a
    /// word, dramsim3 and ramulator2 64, others 1]
    #[arg(long, value_name = "BYTES", hide_short_help = true)]
    access_size: Option<u32>,
    /// Bytes that 1 stands for in foreign addresses, such as the line where they are numbers of lines or objects
    #[arg(long, value_name = "BYTES", default_value = "1", hide_short_help = true, value_parser = clap::value_parser!(u64).range(1..))]
    address_unit: u64,
    /// What to simulate of a foreign trace that has instructions too
    #[arg(long, value_name = "WHICH", default_value = "data", hide_short_help = true)]
    references: References,
    /// Columns of a csv file without names: address, size, kind, and _ for one to skip
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_short_help = true)]
    columns: Option<Vec<String>>,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-cachesim --sizes 32K,128K,512K --lines 64,128 scanline.pmt hilbert.pmt
  pm-cachesim --cache 128K,full,128,lru --cache 128K,8,128,lru --format csv trace.pmt
  pm-cachesim --cache 32K,8,64,lru lackey.log.gz dinero.din";

fn main() -> ExitCode {
    cli::main("pm-cachesim", run)
}

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let configs = configurations(&args)?;
    if args.traces.iter().filter(|trace| *trace == Path::new("-")).count() > 1 {
        return Err(usage("standard input (`-`) can be read only once"));
    }
    let mut table = Table::new(columns(&args));
    for trace in &args.traces {
        simulate(&args, trace, &configs, &mut table)?;
    }
    // The table is written when every trace was read to its end: a broken pipe yields none.
    let mut text = Vec::new();
    table.write(args.format, &mut text)?;
    let mut output = create_output(Path::new("-"))?;
    output.write_all(&text)?;
    output.commit()
}

fn configurations(args: &Args) -> anyhow::Result<Vec<CacheConfig>> {
    if !args.cache.is_empty() {
        return Ok(args.cache.clone());
    }
    let mut configs = vec![];
    for line in &args.lines {
        for size in &args.sizes {
            for ways in &args.ways {
                let text = format!("{size},{ways},{line},lru");
                configs.push(text.parse().map_err(|error| usage(format!("{text}: {error}")))?);
            }
        }
    }
    Ok(configs)
}

fn simulate(args: &Args, path: &Path, configs: &[CacheConfig], table: &mut Table) -> anyhow::Result<()> {
    let name = named(path);
    let reading = Reading {
        form: args.input,
        access_size: args.foreign.access_size,
        address_unit: args.foreign.address_unit,
        columns: args.foreign.columns.clone(),
        references: args.foreign.references,
    };
    let opened = open_bytes(path).and_then(|input| foreign::open(input, &reading).context(name.clone()))?;
    let (order, results) = match opened {
        Opened::Ours(blocks) => {
            let mut trace = TraceReader::from_blocks(blocks).context(name.clone())?;
            let order = order_of(trace.header());
            let simulation = || Simulation::new(&trace.header().regions, configs).context(name.clone());
            if args.lanes.is_empty() {
                let mut simulation = simulation()?;
                replay(args, &mut trace, &mut simulation).context(name.clone())?;
                (order, vec![(1, simulation.finish())])
            } else {
                let lanes = |&lanes: &u16| -> anyhow::Result<_> {
                    Lanes::new(simulation()?, lanes, args.lanes_from).context("temporary file")
                };
                let mut together = Together(args.lanes.iter().map(lanes).collect::<anyhow::Result<_>>()?);
                replay(args, &mut trace, &mut together).context(name.clone())?;
                let finish = |(&lanes, simulation): (&u16, Lanes<Simulation>)| -> anyhow::Result<_> {
                    Ok((lanes, simulation.finish().context("temporary file")?.finish()))
                };
                (order, args.lanes.iter().zip(together.0).map(finish).collect::<anyhow::Result<_>>()?)
            }
        }
        Opened::Foreign(mut trace) => {
            if args.lanes.iter().any(|&lanes| lanes > 1) {
                return Err(usage(format!(
                    "{name}: a foreign trace has no searches that --lanes could let fly together"
                )));
            }
            if trace.left_out() > 0 {
                let what = if args.foreign.references == References::Data { "instructions" } else { "data accesses" };
                args.voice.remark(format!("{name}: {} {what} left out (--references all)", trace.left_out()));
            }
            let mut simulation = Simulation::new(trace.regions(), configs).context(name.clone())?;
            trace.replay(&mut simulation).context(name.clone())?;
            (trace.form().name().to_owned(), vec![(1, simulation.finish())])
        }
    };
    for (lanes, rows) in results {
        for row in rows {
            table.push(values(args, &order, lanes, &row));
        }
    }
    Ok(())
}
/// Replays a trace to its end.
fn replay<R: Read>(args: &Args, trace: &mut TraceReader<R>, sink: &mut impl TraceSink) -> anyhow::Result<()> {
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(sink)? {
        progress.add(u64::from(block.records));
    }
    Ok(())
}

/// The same trace through several numbers of lanes.
struct Together(Vec<Lanes<Simulation>>);

impl TraceSink for Together {
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

/// The order of the queries, as the stream tells it: `tiled 16x16, hilbert per batch`.
fn order_of(header: &pm_formats::Header) -> String {
    let parts = ["order", "deferred order"].into_iter().filter_map(|name| header.meaning(name));
    parts.collect::<Vec<_>>().join(", ")
}

/// Columns of the result: name, and is it one that the table shows?
const COLUMNS: [(&str, bool); 16] = [
    ("order", true),
    ("cache", true),
    // And that only where it is asked for.
    (LANES, true),
    ("queries", true),
    ("reads", false),
    ("raw_bytes", false),
    ("accesses", false),
    ("fetches", true),
    ("bytes_fetched", true),
    ("bytes_written_back", false),
    ("compulsory", false),
    ("blocks", false),
    ("reads_per_query", true),
    ("fetches_per_query", true),
    ("fetches_per_block", true),
    ("bytes_per_query", false),
];

/// Significant digits of ratios in the table.
const DIGITS: u8 = 5;

/// The column of the searches in flight.
const LANES: &str = "lanes";

/// Which columns a format has.
fn shown(args: &Args) -> impl Fn(&(usize, &(&str, bool))) -> bool {
    move |&(_, &(name, in_table))| {
        args.format != Format::Table || (in_table && (name != LANES || !args.lanes.is_empty()))
    }
}

fn columns(args: &Args) -> Vec<Column> {
    let column = |(index, &(name, _)): (usize, &(&str, bool))| match index {
        0 | 1 => Column::text(name),
        _ => Column::number(name),
    };
    COLUMNS.iter().enumerate().filter(shown(args)).map(column).collect()
}

fn values(args: &Args, order: &str, lanes: u16, row: &Row) -> Vec<Value> {
    let ratio = |x: f64| Value::Float(x, DIGITS);
    let all = [
        Value::Text(order.to_owned()),
        Value::Text(row.config.to_string()),
        Value::Int(lanes.into()),
        Value::Int(row.queries),
        Value::Int(row.records.reads),
        Value::Int(row.raw_bytes()),
        Value::Int(row.accesses),
        Value::Int(row.fetches),
        Value::Int(row.bytes_fetched),
        Value::Int(row.bytes_written_back),
        Value::Int(row.compulsory),
        Value::Int(row.blocks),
        ratio(row.reads_per_query()),
        ratio(row.fetches_per_query()),
        ratio(row.fetches_per_block()),
        ratio(row.bytes_per_query()),
    ];
    let shown = shown(args);
    all.into_iter()
        .zip(COLUMNS.iter().enumerate())
        .filter(|(_, column)| shown(column))
        .map(|(value, _)| value)
        .collect()
}
