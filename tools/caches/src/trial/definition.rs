//! What a policy does, in the plainest way there is: sets as lists, all of them searched, the whole trace at hand.

use pm_formats::trace::{AccessKind, Region};

use super::Event;
use crate::SetIndex;

/// What a policy does, told by the history of a full set. A closure from a [`FullSet`] to a way is one.
pub trait Definition {
    /// The line in `way` of `set` is used: it comes in, or it was there.
    fn used(&mut self, set: u64, way: usize) {
        let _ = (set, way);
    }

    /// Which way gives up its line to the one accessed; none if that one passes by.
    fn victim(&mut self, full: &FullSet) -> Option<usize>;
}

impl<F: FnMut(&FullSet) -> Option<usize>> Definition for F {
    fn victim(&mut self, full: &FullSet) -> Option<usize> {
        self(full)
    }
}

/// A full set of which a line is accessed that it does not hold.
pub struct FullSet<'a> {
    pub(super) set: u64,
    pub(super) held: &'a [HeldLine],
    pub(super) accesses: &'a [LineAccess],
    pub(super) now: usize,
}

/// A line in its way, and when it was used.
#[derive(Clone, Debug)]
pub struct HeldLine {
    pub(super) line: u64,
    pub(super) dirty: bool,
    pub(super) uses: Vec<usize>,
}

impl FullSet<'_> {
    /// Which set it is.
    #[must_use]
    pub fn set(&self) -> u64 {
        self.set
    }

    /// The lines it holds, way by way.
    #[must_use]
    pub fn held(&self) -> &[HeldLine] {
        self.held
    }

    /// When this is: the number of the access, which is greater than those of all uses.
    #[must_use]
    pub fn now(&self) -> usize {
        self.now
    }

    /// The line accessed.
    #[must_use]
    pub fn line(&self) -> u64 {
        self.accesses[self.now].line
    }

    /// When a line is used next, after the accesses to the line at hand that follow one another; a time after all if never.
    #[must_use]
    pub fn next_use(&self, line: u64) -> usize {
        let others = self.accesses[self.now..].iter().position(|access| access.line != self.line());
        let from = others.map_or(self.accesses.len(), |steps| self.now + steps);
        self.accesses[from..].iter().position(|access| access.line == line).map_or(usize::MAX, |steps| from + steps)
    }

    /// The way of the line with the least key, the first of equals.
    pub fn least<K: Ord>(&self, key: impl Fn(&HeldLine) -> K) -> Option<usize> {
        (0..self.held.len()).min_by_key(|&way| key(&self.held[way]))
    }
}

impl HeldLine {
    /// Its number.
    #[must_use]
    pub fn line(&self) -> u64 {
        self.line
    }

    /// When it was used since it came in, which is the first of these times.
    #[must_use]
    pub fn uses(&self) -> &[usize] {
        &self.uses
    }

    /// When it came in.
    #[must_use]
    pub fn came(&self) -> usize {
        self.uses[0]
    }

    /// When it was last used.
    #[must_use]
    pub fn last_use(&self) -> usize {
        self.uses[self.uses.len() - 1]
    }
}

/// An access to one line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineAccess {
    pub(crate) line: u64,
    pub(super) writes: bool,
    pub(super) counted: bool,
    pub(super) region: usize,
}

/// The line accesses of a trace.
pub(crate) fn line_accesses(regions: &[Region], line_bytes: u32, events: &[Event]) -> Vec<LineAccess> {
    let (mut accesses, mut counted, line_bytes) = (Vec::new(), true, u64::from(line_bytes));
    for event in events {
        match event {
            Event::Block { warm_up } => counted = !warm_up,
            Event::Search(_) => {}
            Event::Access(access) => {
                let first = regions[access.region as usize].base + access.offset;
                let last = first + u64::from(access.len.max(1)) - 1;
                let (writes, region) = (access.kind != AccessKind::Read, access.region as usize);
                let lines = first / line_bytes..=last / line_bytes;
                accesses.extend(lines.map(|line| LineAccess { line, writes, counted, region }));
            }
        }
    }
    accesses
}

/// The set of a line: bit i of its number is the parity of the bits i, i + b, i + 2b, ... of the line.
pub(crate) fn set_of(line: u64, sets: u64, index: SetIndex) -> u64 {
    let bits = sets.trailing_zeros() as usize;
    match index {
        SetIndex::Plain => line % sets,
        SetIndex::Hash => {
            (0..bits).map(|i| (i..64).step_by(bits).fold(0, |parity, bit| parity ^ line >> bit & 1) << i).sum()
        }
    }
}
