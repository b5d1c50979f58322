//! How often each symbol comes in each context: counted, written, read.

use super::memory::{BESIDE, DECISION_CONTEXTS, WAY_CONTEXTS};
use super::rans::{Share, WHOLE};
use super::units::WAYS;
use crate::trace::varint::{push, take};

/// Bits that a table of ways takes, apart from those of each way in it; and for each of these.
const TABLE_BITS: f64 = 12.0;
const WAY_BITS: f64 = 7.0;
/// Contexts of ways where nothing is known of the tree beside: the tables of those that have none of their own.
const COMMON: usize = (WAYS + 1) * 2;
/// Most bytes of tables that are written.
pub(super) const MOST_BYTES: usize = DECISION_CONTEXTS + WAY_CONTEXTS + COMMON + (WAY_CONTEXTS + COMMON) * WAYS * 2;

/// Starts of the shares of all ways, where the last ends, and so many more that they fill registers.
type Starts = [i16; 48];

/// The context in which nothing is known of the tree beside.
const fn common(context: usize) -> usize {
    context / (2 * BESIDE) * 2 + context % 2
}

/// Frequencies by context.
pub(super) struct Tables {
    /// Of a decision of each context the share of ones.
    ones: Box<[u16; DECISION_CONTEXTS]>,
    /// Which of `ways` is that of each context.
    of_context: Vec<u16>,
    ways: Vec<Starts>,
}

/// How often there was which symbol.
pub(super) struct Counts {
    pub(super) decisions: Vec<[u32; 2]>,
    pub(super) ways: Vec<[u32; WAYS]>,
}

impl Counts {
    pub(super) fn new() -> Self {
        Self { decisions: vec![[0; 2]; DECISION_CONTEXTS], ways: vec![[0; WAYS]; WAY_CONTEXTS] }
    }

    /// The tables that suit them, as they are written.
    pub(super) fn tables(&self) -> Vec<u8> {
        let share = |&[zeros, ones]: &[u32; 2]| match u64::from(zeros) + u64::from(ones) {
            0 => 0,
            all => u8::try_from((u64::from(ones) * 256 / all).min(255)).expect("at most 255"),
        };
        let mut bytes: Vec<u8> = self.decisions.iter().map(share).collect();
        let mut commons = vec![[0; WAYS]; COMMON];
        let add = |sum: &mut [u32; WAYS], more: &[u32; WAYS]| sum.iter_mut().zip(more).for_each(|(s, m)| *s += m);
        self.ways.iter().enumerate().for_each(|(context, counts)| add(&mut commons[common(context)], counts));
        // A context has a table of its own if that saves more than it takes.
        let pays = |(context, counts): (usize, &[u32; WAYS])| {
            let ways = counts.iter().filter(|&&count| count > 0).count() as f64;
            ways > 0.0
                && bits_with(counts, &commons[common(context)]) - bits_with(counts, counts)
                    > TABLE_BITS + WAY_BITS * ways
        };
        let own: Vec<bool> = self.ways.iter().enumerate().map(pays).collect();
        let mut rest = vec![[0; WAYS]; COMMON];
        let without = self.ways.iter().enumerate().filter(|(context, _)| !own[*context]);
        without.for_each(|(context, counts)| add(&mut rest[common(context)], counts));
        let is_any = |counts: &[u32; WAYS]| counts.iter().any(|&count| count > 0);
        bytes.extend(rest.iter().map(|counts| u8::from(is_any(counts))));
        bytes.extend(own.iter().map(|&own| u8::from(own)));
        let own = self.ways.iter().zip(&own).filter(|(_, own)| **own).map(|(counts, _)| counts);
        for counts in rest.iter().filter(|counts| is_any(counts)).chain(own) {
            frequencies(counts).iter().for_each(|&frequency| push(&mut bytes, frequency.into()));
        }
        bytes
    }
}

/// Bits that ways that came so often take, by frequencies in proportion to `by`.
fn bits_with(counts: &[u32; WAYS], by: &[u32; WAYS]) -> f64 {
    let all = log2(by.iter().sum::<u32>());
    let bits = |(&count, &by): (&u32, &u32)| match count {
        0 => 0.0,
        _ => f64::from(count) * (all - log2(by)),
    };
    counts.iter().zip(by).map(bits).sum()
}

/// The logarithm to base 2, to twelve bits behind the point: the same everywhere.
fn log2(number: u32) -> f64 {
    let whole = number.ilog2();
    let (mut rest, mut sum, mut bit) = (f64::from(number) / f64::from(1u32 << whole), f64::from(whole), 0.5);
    for _ in 0..12 {
        rest *= rest;
        if rest >= 2.0 {
            rest /= 2.0;
            sum += bit;
        }
        bit /= 2.0;
    }
    sum
}

/// Frequencies that add up to [`WHOLE`], none of them 0 where there is a count.
fn frequencies(counts: &[u32; WAYS]) -> [u32; WAYS] {
    let all: u64 = counts.iter().map(|&count| u64::from(count)).sum();
    let mut found = counts.map(|count| match count {
        0 => 0,
        _ => u32::try_from((u64::from(count) * u64::from(WHOLE) / all).max(1)).expect("at most the whole"),
    });
    // What is over or missing is the greatest one's, which is many times as much.
    let greatest = (0..WAYS).max_by_key(|&way| found[way]).expect("there are ways");
    found[greatest] = found[greatest] + WHOLE - found.iter().sum::<u32>();
    found
}

impl Tables {
    /// Reads them; `None` if they are none.
    pub(super) fn read(bytes: &[u8]) -> Option<Self> {
        let (decisions, bytes) = bytes.split_at_checked(DECISION_CONTEXTS)?;
        let (rest, bytes) = bytes.split_at_checked(COMMON)?;
        let (own, mut bytes) = bytes.split_at_checked(WAY_CONTEXTS)?;
        if rest.iter().chain(own).any(|&flag| flag > 1) {
            return None;
        }
        // A context without any table has one in which the first way is all there is.
        let mut ways = vec![starts(&{
            let mut only = [0; WAYS];
            only[0] = WHOLE;
            only
        })?];
        let mut next = |flag: u8| {
            if flag == 0 {
                return Some(0);
            }
            let mut frequencies = [0; WAYS];
            for frequency in &mut frequencies {
                *frequency = u32::try_from(take(&mut bytes)?).ok()?;
            }
            ways.push(starts(&frequencies)?);
            u16::try_from(ways.len() - 1).ok()
        };
        let rest: Vec<u16> = rest.iter().map(|&flag| next(flag)).collect::<Option<_>>()?;
        let own: Vec<u16> = own.iter().map(|&flag| next(flag)).collect::<Option<_>>()?;
        let of_context =
            own.iter().enumerate().map(|(context, &own)| if own == 0 { rest[common(context)] } else { own }).collect();
        let mut ones = Box::new([0; DECISION_CONTEXTS]);
        ones.iter_mut().zip(decisions).for_each(|(ones, &of_256)| *ones = 16 * u16::from(of_256) + 8);
        bytes.is_empty().then_some(Self { ones, of_context, ways })
    }

    /// The size of the share of ones among the decisions of each context; it begins at 0, and the zeros follow.
    pub(super) const fn ones(&self) -> &[u16; DECISION_CONTEXTS] {
        &self.ones
    }

    /// The share of a way.
    #[inline(always)]
    pub(super) fn way(&self, context: usize, way: usize) -> Share {
        let starts = &self.ways[usize::from(self.of_context[context])];
        let start = starts[way];
        Share { start: start as u32, size: (starts[way + 1] - start) as u32 }
    }

    /// The way in whose share a number lies, and the share.
    #[inline(always)]
    pub(super) fn way_of(&self, context: usize, number: u32) -> (usize, Share) {
        let starts = &self.ways[usize::from(self.of_context[context])];
        let number = number as i16;
        // How many begin at the number or before it, less one: counted by signs, eight at a time, without a branch.
        let mut before = [0i16; 8];
        for eight in starts[..WAYS].chunks_exact(8) {
            before.iter_mut().zip(eight).for_each(|(before, &start)| *before += (start - number - 1) >> 15);
        }
        let way = -1 - before.iter().sum::<i16>();
        let way = way as usize;
        let start = starts[way];
        (way, Share { start: start as u32, size: (starts[way + 1] - start) as u32 })
    }
}

/// The share of a decision, where those that are ones have so much.
#[inline(always)]
pub(super) const fn decision(ones: u32, bit: u32) -> Share {
    match bit {
        0 => Share { start: ones, size: WHOLE - ones },
        _ => Share { start: 0, size: ones },
    }
}

/// Where the shares of ways begin; `None` if they do not add up to the whole.
fn starts(frequencies: &[u32; WAYS]) -> Option<Starts> {
    let mut starts = [i16::MAX; 48];
    let mut sum = 0u32;
    for (start, &frequency) in starts.iter_mut().zip(frequencies) {
        *start = i16::try_from(sum).ok()?;
        sum = sum.checked_add(frequency).filter(|&sum| sum <= WHOLE)?;
    }
    starts[WAYS] = WHOLE as i16;
    (sum == WHOLE).then_some(starts)
}
