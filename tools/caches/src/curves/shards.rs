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

use super::sampled_curve::PARTS;
use super::{Histogram, SampledCurve, StackDistances, TraceCounts};
use crate::lines::LineChunk;
use pm_random::Random;

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

    /// By lines held, from one on: the misses. What holds none is no model, and whether it has missed repeats depends on
    /// how the trace was cut into chunks.
    fn misses(self) -> Vec<u64> {
        let mut misses = self.accesses.at_least();
        if misses.len() > 1 {
            misses.remove(0);
        }
        misses
    }
}

/// Collects the sampled curve of one line size.
pub(crate) struct Shards {
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
    pub(crate) fn new(slots: u64, rate: f64) -> Self {
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
    pub(crate) fn run(&mut self, chunk: &LineChunk, counted: bool) {
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

    pub(crate) fn finish(self, trace: TraceCounts) -> SampledCurve {
        SampledCurve {
            trace,
            rate: self.rate,
            misses: self.sample.misses(),
            parts: self.samples.into_iter().map(Sample::misses).collect(),
        }
    }
}
