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
use crate::lines::{LineChunk, LineSpace};
use pm_random::Random;

/// Not a sampled line.
const NOT_SAMPLED: u32 = u32::MAX;

/// One sample, or one part of it.
struct Sample {
    distances: StackDistances,
    accesses: Histogram,
}

impl Sample {
    fn new() -> Self {
        Self { distances: StackDistances::new(0), accesses: Histogram::default() }
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
    hashes: Random,
    /// Slots of which it is decided whether they are in the sample.
    lines: u64,
    /// By slot: a bit for each line sampled. Small, so that what is not sampled costs little.
    sampled: Vec<u64>,
    /// By slot: its number in the sample.
    numbers: Vec<u32>,
    /// By number in the sample: its part and its number there.
    parts: Vec<(u8, u32)>,
    /// Lines of each part.
    sizes: [u32; PARTS],
    sample: Sample,
    samples: Vec<Sample>,
    /// Scratch: sampled slots of the chunk.
    kept: Vec<u32>,
}

impl Shards {
    /// The curve of the lines of `space`, from a share of `rate` of them, above 0 and at most 1.
    pub(crate) fn new(space: &LineSpace, rate: f64) -> Self {
        let mut shards = Self {
            rate,
            hashes: Random::new(&[]),
            lines: 0,
            sampled: vec![],
            numbers: vec![],
            parts: vec![],
            sizes: [0; PARTS],
            sample: Sample::new(),
            samples: (0..PARTS).map(|_| Sample::new()).collect(),
            kept: vec![],
        };
        shards.grow(space);
        shards
    }

    /// Decides of the lines that are new whether they are in the sample.
    fn grow(&mut self, space: &LineSpace) {
        let limit = (self.rate * 2_f64.powi(32)) as u64;
        self.sampled.resize(space.slots().div_ceil(64) as usize, 0);
        self.numbers.resize(space.slots() as usize, NOT_SAMPLED);
        for slot in self.lines..space.slots() {
            // Where slots are in order of addresses a line's hash is its number in this sequence, whatever the trace; where
            // they are in order of first touches it is that of its address.
            let hash = match space.grows() {
                false => self.hashes.next_u64(),
                true => Random::new(&[space.line(0, slot as u32)]).next_u64(),
            };
            if hash >> 32 < limit {
                self.sampled[(slot / 64) as usize] |= 1 << (slot % 64);
                self.numbers[slot as usize] = self.parts.len() as u32;
                let part = (hash as u32 as usize) % PARTS;
                self.parts.push((part as u8, self.sizes[part]));
                self.sizes[part] += 1;
            }
        }
        self.lines = space.slots();
        self.sample.distances.grow(self.parts.len() as u64);
        for (sample, &lines) in self.samples.iter_mut().zip(&self.sizes) {
            sample.distances.grow(lines.into());
        }
    }

    /// Runs the line accesses of `chunk`; `counted` is false during warm-up.
    pub(crate) fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool) {
        if self.lines < space.slots() {
            self.grow(space);
        }
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
