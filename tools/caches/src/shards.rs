//! The miss curve from a sample of the lines.
//!
//! SHARDS (Waldspurger, Park, Garthwaite and Ahmad, *Efficient MRC construction with SHARDS*, FAST 2015), at a fixed rate R:
//! a line is sampled if the hash of its number is below R; a stack distance among sampled lines is R times the distance
//! among all, and each sampled access stands for 1 / R accesses. With the authors' correction for the number of accesses
//! sampled (SHARDS-adj, which moves the surplus to distance 0), the fetches of C lines are the sampled misses of R C lines,
//! divided by R.
//!
//! A cache of C lines is then modelled by R C lines, so a size below [`LEAST_MODEL`] / R has no estimate: a photon map of
//! some 70,000 lines, a few of which take most accesses, is small for a sample. How far an estimate may be off is told by
//! the sample itself: it is split into [`PARTS`] samples of their own, by other bits of the hash, and the spread of their
//! estimates gives Student's 95 % interval.

use super::curve::{Histogram, TraceCounts};
use super::{lines::LineChunk, stack_distance::StackDistances};
use pm_random::Random;

/// The fewest lines that may stand for a cache.
pub const LEAST_MODEL: f64 = 100.0;

/// Samples that the sample is split into for its error bar.
const PARTS: usize = 8;

/// 0.975 quantile of Student's t with `PARTS` - 1 degrees of freedom (any table of the distribution).
const STUDENT: f64 = 2.364_624;

/// Not a sampled line.
const NOT_SAMPLED: u32 = u32::MAX;

/// One sample, or one part of it.
struct Sample {
    distances: StackDistances,
    accesses: Histogram,
}

impl Sample {
    fn new(lines: u64) -> Self {
        Self { distances: StackDistances::new(lines), accesses: Histogram::default() }
    }

    #[inline]
    fn touch(&mut self, line: u32, counted: bool) {
        let distance = self.distances.touch(line);
        self.accesses.add(distance, &self.distances, counted);
    }

    /// By lines held, from none on: the misses.
    fn misses(self) -> Vec<u64> {
        self.accesses.at_least()
    }
}

/// Collects the sampled curve of one line size.
pub(super) struct Shards {
    rate: f64,
    /// By slot: a bit for each line sampled. Small, so that what is not sampled costs little.
    sampled: Vec<u64>,
    /// By slot: its number in the sample.
    numbers: Vec<u32>,
    /// By number in the sample: its part and its number there.
    parts: Vec<(u8, u32)>,
    sample: Sample,
    samples: Vec<Sample>,
    /// Scratch: sampled slots of the chunk.
    kept: Vec<u32>,
}

impl Shards {
    /// The curve of lines numbered below `slots`, from a share of `rate` of them, above 0 and at most 1.
    pub(super) fn new(slots: u64, rate: f64) -> Self {
        let limit = (rate * 2_f64.powi(32)) as u64;
        let mut sampled = vec![0_u64; slots.div_ceil(64) as usize];
        let mut numbers = vec![NOT_SAMPLED; slots as usize];
        let mut parts = vec![];
        let mut sizes = [0_u32; PARTS];
        // A line's hash is its number in this sequence, whatever the trace.
        let mut hashes = Random::new(&[]);
        for slot in 0..slots {
            let hash = hashes.next_u64();
            if hash >> 32 < limit {
                sampled[(slot / 64) as usize] |= 1 << (slot % 64);
                numbers[slot as usize] = parts.len() as u32;
                let part = (hash as u32 as usize) % PARTS;
                parts.push((part as u8, sizes[part]));
                sizes[part] += 1;
            }
        }
        let sample = Sample::new(parts.len() as u64);
        let samples = sizes.into_iter().map(|lines| Sample::new(lines.into())).collect();
        Self { rate, sampled, numbers, parts, sample, samples, kept: vec![] }
    }

    /// Runs the line accesses of `chunk`; `counted` is false during warm-up.
    pub(super) fn run(&mut self, chunk: &LineChunk, counted: bool) {
        let slots = chunk.slots();
        self.kept.resize(self.kept.len().max(slots.len()), 0);
        let mut kept = 0;
        for &slot in slots {
            self.kept[kept] = slot;
            kept += (self.sampled[(slot / 64) as usize] >> (slot % 64) & 1) as usize;
        }
        for &slot in &self.kept[..kept] {
            let number = self.numbers[slot as usize];
            self.sample.touch(number, counted);
            let (part, number) = self.parts[number as usize];
            self.samples[usize::from(part)].touch(number, counted);
        }
    }

    pub(super) fn finish(self, trace: TraceCounts) -> SampledCurve {
        SampledCurve {
            trace,
            rate: self.rate,
            misses: self.sample.misses(),
            parts: self.samples.into_iter().map(Sample::misses).collect(),
        }
    }
}

/// What fully associative LRU caches would fetch, as far as a sample of the lines tells.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledCurve {
    /// What is the same for all sizes; these counts are exact.
    pub trace: TraceCounts,
    /// Share of the lines that is sampled.
    pub rate: f64,
    /// By lines of the sample; those beyond the end are as the last.
    misses: Vec<u64>,
    parts: Vec<Vec<u64>>,
}

/// An estimate and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Lines fetched.
    pub fetches: f64,
    /// Half the width of the 95 % interval, from the spread of the parts of the sample.
    pub error: f64,
}

impl SampledCurve {
    /// The least cache, in lines, that there are estimates for.
    #[must_use]
    pub fn least(&self) -> u64 {
        (LEAST_MODEL / self.rate).ceil() as u64
    }

    /// Lines fetched by a cache of so many lines; `None` below [`least`](Self::least).
    #[must_use]
    pub fn fetches(&self, lines: u64) -> Option<Estimate> {
        (lines >= self.least()).then(|| self.unchecked(lines))
    }

    /// The same for any size, however wrong: for showing how wrong.
    pub(super) fn unchecked(&self, lines: u64) -> Estimate {
        let at = |misses: &[u64], rate: f64| {
            let held = (lines as f64 * rate).ceil() as usize;
            misses[held.min(misses.len() - 1)] as f64 / rate
        };
        let estimates: Vec<f64> = self.parts.iter().map(|part| at(part, self.rate / PARTS as f64)).collect();
        let mean = estimates.iter().sum::<f64>() / PARTS as f64;
        let variance = estimates.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (PARTS - 1) as f64;
        Estimate { fetches: at(&self.misses, self.rate), error: STUDENT * (variance / PARTS as f64).sqrt() }
    }

    /// Sizes in lines to print: the least that there is an estimate for, and each twice the one before, up to the map's.
    #[must_use]
    pub fn sizes(&self, lines_of_map: u64) -> Vec<u64> {
        std::iter::successors(Some(self.least()), |lines| lines.checked_mul(2))
            .take_while(|&lines| lines <= lines_of_map)
            .collect()
    }
}
