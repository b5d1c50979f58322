//! How often do the intervals of sampled traces hold the truth? Measured on a whole trace, for many seeds.
//!
//! The trace is simulated once. For each search it is noted what it fetches and how far back one must begin, with an empty
//! cache, to know that; then a sample of windows is a matter of sums, and a thousand of them take a moment. The samples
//! are put together by what `pm-cachesim` and `scripts/until.sh` use: the same choice, ratio, interval and rule.

use clap::Parser;
use pm_formats::trace::{Access, Region, TraceReader, TraceSink};
use pm_tools::cli::{self, Typed, Voice, open_input, usage};
use pm_tools::report::{Column, Format, Table, Value};
use pm_tools::statistics::{CONFIDENCE, Ratio, Tuning, student_quantile};
use pm_tools::windows::Choice;
use std::io::Write as _;
use std::ops::Range;
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
    #[arg(long)]
    window: Option<usize>,
    /// Searches of warm-up before a window
    #[arg(long, default_value = "0")]
    warm_up: usize,
    /// Share of the searches that is simulated, warm-up included
    #[arg(long, default_value = "0.05")]
    share: f64,
    /// Number of samples
    #[arg(long, default_value = "1000")]
    seeds: u64,
    /// How to print the result
    #[arg(long, default_value = "table")]
    format: Format,
    #[command(flatten)]
    voice: Voice,
}

/// The cache: 128 KiB, fully associative LRU.
const LINE: u64 = 128;
const LINES: usize = 1024;

fn main() -> ExitCode {
    cli::main("coverage", run)
}

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let mut trace = TraceReader::from_blocks(open_input(&args.trace)?)?;
    let mut costs = Costs::new(&trace.header().regions);
    while trace.replay_block(&mut costs)?.is_some() {}
    let population = Population::new(&args, costs)?;
    let mut table = Table::new(
        std::iter::once(Column::text("order"))
            .chain(std::iter::once(Column::text("rule")))
            .chain(MEASURES.iter().map(|name| Column::number(*name)))
            .collect(),
    );
    let fixed = population.measure(&args, None);
    // An interval that takes somewhat less than the share, so that there is something to stop at.
    let until = fixed.half_width / population.truth() * 1.15;
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

/// What each search of a trace costs.
struct Costs {
    /// First addresses of the regions.
    bases: Vec<u64>,
    /// Fetches of each search.
    fetches: Vec<u64>,
    /// Searches that begin a batch.
    batches: Vec<usize>,
    batch: Option<u64>,
    /// For each search, the latest search from which on an empty cache is filled when it begins; nothing before there are
    /// lines enough.
    begin: Vec<Option<u32>>,
    /// By line, the search that last used it, and its neighbours in the list of lines by recency.
    used: Vec<u32>,
    links: Vec<[u32; 2]>,
    held: usize,
}

/// Ends of the list of lines, and no line.
const NEWER: usize = 0;
const OLDER: usize = 1;
const NONE: u32 = u32::MAX;

impl Costs {
    fn new(regions: &[Region]) -> Self {
        let bytes = regions.iter().map(|region| region.base + region.size).max().unwrap_or(0);
        // The last of them is the ring's beginning and end.
        let lines = (bytes / LINE + 2) as usize;
        let mut links = vec![[NONE; 2]; lines];
        links[lines - 1] = [lines as u32 - 1; 2];
        let bases = regions.iter().map(|region| region.base).collect();
        let used = vec![0; lines];
        Self { bases, fetches: vec![], batches: vec![], batch: None, begin: vec![], used, links, held: 0 }
    }

    fn ring(&self) -> usize {
        self.links.len() - 1
    }

    fn take_out(&mut self, line: usize) {
        let [newer, older] = self.links[line].map(|at| at as usize);
        self.links[newer][OLDER] = older as u32;
        self.links[older][NEWER] = newer as u32;
        self.links[line] = [NONE; 2];
    }

    fn touch(&mut self, line: usize) {
        let ring = self.ring();
        if self.links[line][NEWER] == NONE {
            *self.fetches.last_mut().expect("a search has begun") += 1;
            if self.held == LINES {
                self.take_out(self.links[ring][NEWER] as usize);
            } else {
                self.held += 1;
            }
        } else {
            self.take_out(line);
        }
        let newest = self.links[ring][OLDER] as usize;
        self.links[line] = [ring as u32, newest as u32];
        self.links[newest][NEWER] = line as u32;
        self.links[ring][OLDER] = line as u32;
        self.used[line] = self.fetches.len() as u32 - 1;
    }
}

impl TraceSink for Costs {
    fn block(&mut self, batch: u64, _: bool) {
        if self.batch.replace(batch) != Some(batch) {
            self.batches.push(self.fetches.len());
        }
    }

    fn search(&mut self, _: &[u32]) {
        // All that an LRU cache holds was used since the oldest of its lines was.
        let oldest = self.used[self.links[self.ring()][NEWER] as usize];
        self.begin.push((self.held == LINES).then_some(oldest));
        self.fetches.push(0);
    }

    fn access(&mut self, access: Access) {
        let first = self.bases[usize::from(access.region)] + access.offset;
        (first / LINE..=(first + u64::from(access.len.max(1)) - 1) / LINE).for_each(|line| self.touch(line as usize));
    }
}

/// The whole, cut into cells.
struct Population {
    /// Fetches of the searches before each.
    before: Vec<u64>,
    begin: Vec<Option<u32>>,
    cells: Vec<Range<usize>>,
    warm_up: usize,
}

/// What samples of it gave.
#[derive(Default)]
struct Measured {
    held: u64,
    half_width: f64,
    /// Sums of estimates and of their squares, less the truth.
    off: f64,
    squares: f64,
    freedom: f64,
    windows: f64,
    inexact: f64,
    simulated: f64,
}

impl Population {
    fn new(args: &Args, costs: Costs) -> anyhow::Result<Self> {
        let searches = costs.fetches.len();
        let cells: Vec<Range<usize>> = match args.window {
            Some(length) => (0..searches).step_by(length.max(1)).map(|at| at..(at + length).min(searches)).collect(),
            None => {
                let ends = costs.batches.iter().skip(1).copied().chain([searches]);
                costs.batches.iter().zip(ends).map(|(&start, end)| start..end).collect()
            }
        };
        let mut before = vec![0];
        costs.fetches.iter().for_each(|fetches| before.push(before[before.len() - 1] + fetches));
        let population = Self { before, begin: costs.begin, cells, warm_up: args.warm_up };
        if population.windows(args) < 4 {
            return Err(usage("--share: that is less than four windows; give a longer trace or shorter windows"));
        }
        Ok(population)
    }

    fn searches(&self) -> usize {
        self.before.len() - 1
    }

    /// Fetches for each search of all.
    fn truth(&self) -> f64 {
        self.before[self.searches()] as f64 / self.searches() as f64
    }

    /// Windows that the share allows.
    fn windows(&self, args: &Args) -> u64 {
        let a_cell = self.searches() as f64 / self.cells.len() as f64 + self.warm_up as f64;
        (self.searches() as f64 * args.share / a_cell) as u64
    }

    /// What is measured of a cell; nothing if that is inexact.
    fn measured(&self, cell: &Range<usize>) -> Option<Range<usize>> {
        let start = cell.start.saturating_sub(self.warm_up);
        let exact = |&at: &usize| self.begin[at].is_some_and(|begin| begin as usize >= start);
        match start == cell.start {
            true => cell.clone().find(exact).map(|from| from..cell.end),
            false => exact(&cell.start).then(|| cell.clone()),
        }
    }

    /// Adds a sample to `ratio`.
    fn sample(&self, windows: u64, seed: u64, ratio: Option<Ratio>, measured: &mut Measured) -> Ratio {
        let (mut above, mut below) = (vec![], vec![]);
        let choice = Choice::new(self.cells.len() as u64, windows.min(self.cells.len() as u64), seed);
        for cell in choice.into_iter().flat_map(Choice::cells).map(|cell| &self.cells[cell as usize]) {
            measured.simulated += (cell.end - cell.start.saturating_sub(self.warm_up)) as f64;
            measured.windows += 1.0;
            match self.measured(cell) {
                Some(Range { start, end }) => {
                    above.push((self.before[end] - self.before[start]) as f64);
                    below.push((end - start) as f64);
                }
                None => measured.inexact += 1.0,
            }
        }
        let sampled = Ratio::of(&above, &below);
        ratio.map_or(sampled, |ratio| ratio.with(sampled))
    }

    /// Measures as many samples as there are seeds: of a fixed number of windows, or until the interval is as narrow as
    /// this share of the value.
    fn measure(&self, args: &Args, until: Option<f64>) -> Measured {
        let mut measured = Measured::default();
        let truth = self.truth();
        for seed in 0..args.seeds {
            let most = self.windows(args);
            let ratio = match until {
                None => self.sample(most, seed, None, &mut measured),
                Some(until) => {
                    let tuning = Tuning { until, pilot: (most / 3).max(4) };
                    let (mut ratio, mut windows) = (None, 0);
                    for round in 0.. {
                        let more = tuning.missing(windows, &ratio.unwrap_or_default());
                        if more == 0 || round == ROUNDS {
                            break;
                        }
                        ratio = Some(self.sample(more, seed * ROUNDS + round, ratio, &mut measured));
                        windows += more;
                    }
                    ratio.unwrap_or_default()
                }
            };
            let half_width = ratio.spread.half_width();
            measured.held += u64::from((ratio.value - truth).abs() <= half_width);
            measured.half_width += half_width / args.seeds as f64;
            measured.off += ratio.value - truth;
            measured.squares += (ratio.value - truth) * (ratio.value - truth);
            measured.freedom += ratio.spread.freedom / args.seeds as f64;
        }
        measured
    }
}

/// The most rounds of a sample.
const ROUNDS: u64 = 16;

const MEASURES: [&str; 15] = [
    "seeds",
    "queries",
    "truth",
    "until",
    "coverage",
    "mean_half_width",
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
        let (seeds, truth) = (args.seeds as f64, population.truth());
        let bias = self.off / seeds;
        let spread = (self.squares / seeds - bias * bias).max(0.0).sqrt();
        let t = student_quantile(CONFIDENCE, self.freedom);
        let a_cell = population.searches() as f64 / population.cells.len() as f64;
        vec![
            Value::Int(args.seeds),
            Value::Int(population.searches() as u64),
            number(truth),
            number(until),
            number(self.held as f64 / seeds),
            number(self.half_width / truth),
            number(spread / truth),
            number(self.half_width / (t * spread)),
            number(bias / truth),
            number((self.squares / seeds).sqrt() / truth),
            number(self.windows / seeds),
            number(self.inexact / seeds),
            number(a_cell),
            number(population.warm_up as f64),
            number(self.simulated / seeds / population.searches() as f64),
        ]
    }
}
