//! How often do the intervals of sampled traces hold the truth? Measured on a whole trace, for many seeds.
//!
//! The trace is simulated once as a whole, and once with each cell as a window that begins with an empty cache and its
//! warm-up. Then a sample is a choice of windows that are simulated already, and a thousand of them take a moment. All else
//! is what `pm-queries --only-tiles`, `pm-cachesim` and `pm-sweep until` do: the same choice, estimate, interval and rule.

use clap::Parser;
use pm_caches::{CacheConfig, Measures, Simulation, WindowedCounts, Windows};
use pm_formats::trace::{Access, Region, TraceReader, TraceSink};
use pm_programs::cli::{self, Typed, Voice, open_input, usage};
use pm_report::{Column, Format, Table, Value};
use pm_sampling::windows::StratifiedCells;
use pm_sampling::{CONFIDENCE, Ratio, Tuning, student_quantile};
use std::collections::VecDeque;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Measure how often intervals of samples of a trace hold what the whole trace gives.
#[derive(Parser)]
struct Args {
    /// A whole trace; `-` is standard input
    #[arg(default_value = "-")]
    trace: PathBuf,
    /// Name of the order, for the first column
    #[arg(long)]
    order: String,
    /// Searches of a window; without it, windows are whole batches
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    window: Option<u64>,
    /// Searches of warm-up before a window
    #[arg(long, default_value = "0")]
    warm_up: usize,
    /// Share of the searches that is simulated, warm-up included
    #[arg(long, default_value = "0.05")]
    share: f64,
    /// The cache
    #[arg(long, default_value = "128K,full,128,lru")]
    cache: CacheConfig,
    /// Number of samples
    #[arg(long, default_value = "1000")]
    seeds: u64,
    /// How to print the result
    #[arg(long, default_value = "table", value_parser = cli::choice::<Format>())]
    format: Format,
    #[command(flatten)]
    voice: Voice,
}

fn main() -> ExitCode {
    cli::main("coverage", run)
}

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let mut trace = TraceReader::from_blocks(open_input(&args.trace)?)?;
    let mut cells = Cells::new(&args, &trace.header().regions)?;
    while trace.replay_block(&mut cells)?.is_some() {}
    let population = cells.finish(&args)?;
    let mut table =
        Table::new(["order", "rule"].map(Column::text).into_iter().chain(MEASURES.map(Column::number)).collect());
    let fixed = population.measure(&args, None);
    // An interval that takes about half of the share, so that the rule stops before it is used up.
    let until = fixed.half_width / population.truth * 1.3;
    for (rule, measured) in [("fixed", &fixed), ("until", &population.measure(&args, Some(until)))] {
        let words = [args.order.as_str(), rule].map(|word| Value::Text(word.to_owned()));
        let numbers = measured.values(&args, &population, if rule == "until" { until } else { f64::NAN });
        table.push(words.into_iter().chain(numbers).collect());
    }
    let mut text = vec![];
    table.write(args.format, &mut text)?;
    let mut output = cli::create_output(Path::new("-"))?;
    output.write_all(&text)?;
    output.commit()
}

/// Simulates a trace as a whole, and each cell of it as a window with its warm-up.
struct Cells {
    whole: Simulation,
    windows: Windows,
    /// Searches of a cell; without it, cells are batches.
    window: Option<u64>,
    warm_up: usize,
    searches: u64,
    /// The batch of the trace and the cell in hand, counted from 1.
    batch: Option<u64>,
    cell: u64,
    /// The searches before the one in hand, as many as warm-up takes.
    before: VecDeque<Vec<Access>>,
    search: Vec<Access>,
}

impl Cells {
    fn new(args: &Args, regions: &[Region]) -> anyhow::Result<Self> {
        Ok(Self {
            whole: Simulation::new(regions, &[args.cache])?,
            windows: Windows::new(regions, &[args.cache], &Measures::default())?,
            window: args.window,
            warm_up: args.warm_up,
            searches: 0,
            batch: None,
            cell: 0,
            before: VecDeque::new(),
            search: vec![],
        })
    }

    fn begin_cell(&mut self) {
        self.cell += 1;
        if !self.before.is_empty() {
            self.windows.block(self.cell, true);
        }
        for search in &self.before {
            self.windows.search(&[0]);
            search.iter().for_each(|&access| self.windows.access(access));
        }
        self.windows.block(self.cell, false);
    }

    fn finish(self, args: &Args) -> anyhow::Result<Population> {
        let whole = self.whole.finish().swap_remove(0);
        let row = self.windows.finish(None, None).swap_remove(0);
        let truth = whole.fetches as f64 / whole.searches as f64;
        let population = Population { row, truth, searches: whole.searches, warm_up: args.warm_up };
        if population.windows(args) < 8 {
            return Err(usage("--share: that is less than eight windows; give a longer trace or shorter windows"));
        }
        Ok(population)
    }
}

impl TraceSink for Cells {
    fn block(&mut self, batch: u64, _: bool) {
        if self.batch.replace(batch) != Some(batch) && self.window.is_none() {
            self.begin_cell();
        }
    }

    fn search(&mut self, _: &[u32]) {
        if self.window.is_some_and(|length| self.searches.is_multiple_of(length)) {
            self.begin_cell();
        }
        self.searches += 1;
        self.whole.search(&[0]);
        self.windows.search(&[0]);
    }

    fn access(&mut self, access: Access) {
        self.whole.access(access);
        self.windows.access(access);
        if self.warm_up > 0 {
            self.search.push(access);
        }
    }

    fn search_end(&mut self) {
        if self.warm_up > 0 {
            let oldest = if self.before.len() == self.warm_up { self.before.pop_front() } else { None };
            let search = std::mem::replace(&mut self.search, oldest.unwrap_or_default());
            self.before.push_back(search);
            self.search.clear();
        }
    }
}

/// The whole, cut into cells.
struct Population {
    /// What each cell costs as a window.
    row: WindowedCounts,
    /// Fetches for each search of the whole.
    truth: f64,
    searches: u64,
    warm_up: usize,
}

/// What samples of it gave.
#[derive(Default)]
struct Measured {
    held: u64,
    half_width: f64,
    doubt: f64,
    /// Sums of estimates and of their squares, less the truth.
    off: f64,
    squares: f64,
    freedom: f64,
    windows: f64,
    inexact: f64,
    simulated: f64,
}

impl Population {
    /// Searches of a cell, on average.
    fn a_cell(&self) -> f64 {
        self.searches as f64 / self.row.windows.len() as f64
    }

    /// Windows that the share allows.
    fn windows(&self, args: &Args) -> u64 {
        (self.searches as f64 * args.share / (self.a_cell() + self.warm_up as f64)) as u64
    }

    /// What a sample tells.
    fn sample(&self, windows: u64, seed: u64, measured: &mut Measured) -> Ratio {
        let cells = self.row.windows.len() as u64;
        let choice = StratifiedCells::new(cells, windows.min(cells), seed);
        let row = self.row.of_windows(choice.into_iter().flat_map(StratifiedCells::cells).map(|cell| cell as usize));
        let windows = row.windows.len() as u64;
        measured.windows += windows as f64;
        measured.inexact += row.windows_inexact() as f64;
        measured.simulated += (row.queries_measured() + windows * self.warm_up as u64) as f64;
        row.fetches_per_query()
    }

    /// Measures as many samples as there are seeds: of a fixed number of windows, or until the interval is as narrow as
    /// this share of the value.
    fn measure(&self, args: &Args, until: Option<f64>) -> Measured {
        let mut measured = Measured::default();
        let most = self.windows(args);
        for seed in 0..args.seeds {
            let ratio = match until {
                None => self.sample(most, seed, &mut measured),
                Some(until) => {
                    let tuning = Tuning { until: Some(until), pilot: (most / 2).max(4), most: Some(most) };
                    self.tuned(tuning, [seed, args.seeds], &mut measured)
                }
            };
            let off = ratio.value - self.truth;
            measured.held += u64::from(off.abs() <= ratio.half_width());
            measured.half_width += ratio.half_width() / args.seeds as f64;
            measured.doubt += ratio.doubt / args.seeds as f64;
            measured.off += off;
            measured.squares += off * off;
            measured.freedom += ratio.spread.freedom / args.seeds as f64;
        }
        measured
    }

    /// What a sample tells that windows are added to until its interval is narrow enough, or there are as many as may be.
    fn tuned(&self, tuning: Tuning, [seed, seeds]: [u64; 2], measured: &mut Measured) -> Ratio {
        let mut sample = tuning.begin();
        while let Some(round) = sample.next_round() {
            // No two rounds of all samples have the same.
            let seed = (round.number / ROUNDS * seeds + seed) * ROUNDS + round.number % ROUNDS;
            sample.add(round, self.sample(round.windows, seed, measured));
        }
        sample.ratio().expect("a pilot")
    }
}

/// Rounds whose seeds follow one another.
const ROUNDS: u64 = 16;

const MEASURES: [&str; 16] = [
    "seeds",
    "queries",
    "truth",
    "until",
    "coverage",
    "mean_half_width",
    "mean_doubt",
    "spread",
    "ratio",
    "bias",
    "root_mean_square_error",
    "windows",
    "windows_inexact",
    "window",
    "warm_up",
    "sampled_share",
];

impl Measured {
    /// The values of [`MEASURES`]. Widths and errors are shares of the truth.
    fn values(&self, args: &Args, population: &Population, until: f64) -> Vec<Value> {
        let number = |x: f64| Value::Float(x, 5);
        let (seeds, truth) = (args.seeds as f64, population.truth);
        let bias = self.off / seeds;
        let spread = (self.squares / seeds - bias * bias).max(0.0).sqrt();
        let t = student_quantile(CONFIDENCE, self.freedom);
        vec![
            Value::Int(args.seeds),
            Value::Int(population.searches),
            number(truth),
            number(until),
            number(self.held as f64 / seeds),
            number(self.half_width / truth),
            number(self.doubt / truth),
            number(spread / truth),
            number(self.half_width / (t * spread)),
            number(bias / truth),
            number((self.squares / seeds).sqrt() / truth),
            number(self.windows / seeds),
            number(self.inexact / seeds),
            number(population.a_cell()),
            number(population.warm_up as f64),
            number(self.simulated / seeds / population.searches as f64),
        ]
    }
}
