//! The longest chain of misses of a search in which each waits for the one before: what memory's latency costs a search at the
//! least, however much of it is in flight at a time.
//!
//! Which reads wait for which the trace says, read by read ([`Waits`]). A chain ends with a read and goes back through what
//! that waited for; it is as long as there are misses in it. A record that spans lines is one miss, since its lines are asked for
//! together.

#[cfg(test)]
mod tests;

use pm_formats::trace::Waits;

use crate::Distribution;

/// What accesses that are not yet simulated wait for, and where searches begin among them.
#[derive(Debug, Default)]
pub(crate) struct Waiting {
    /// Of the first accesses; all others wait for nothing.
    waits: Vec<Waits>,
    starts: Vec<usize>,
}

impl Waiting {
    /// A search begins with the access at this index.
    pub(crate) fn search(&mut self, at: usize) {
        self.starts.push(at);
    }

    /// The access at this index, which is behind those before, waits for this.
    pub(crate) fn say(&mut self, at: usize, waits: Waits) {
        self.waits.resize(at, Waits::NOTHING);
        self.waits.push(waits);
    }

    pub(crate) fn clear(&mut self) {
        self.waits.clear();
        self.starts.clear();
    }
}

/// The chains of one cache.
#[derive(Debug)]
pub(crate) struct Chains {
    /// Whether everything misses, since there is no cache.
    uncached: bool,
    /// Numbers of the records that missed and were not looked at yet, in order.
    missed: Vec<u64>,
    /// The search in hand.
    search: Option<Search>,
    /// Searches that count, by the longest chain of each.
    longest: Distribution,
}

/// The chains of a search, as far as it is read.
#[derive(Debug)]
struct Search {
    counted: bool,
    longest: u32,
    /// The chain that reads of level 0 come after.
    before: u32,
    /// Of each level, the chain that its last read ends, and the longest that one of its reads ends.
    levels: Vec<(u32, u32)>,
}

impl Search {
    /// A read, and whether it missed.
    fn read(&mut self, waits: Waits, missed: bool) {
        let level = usize::from(waits.level());
        if waits == Waits::ALL_BEFORE {
            self.before = self.longest;
            self.levels.clear();
        }
        let above = level.checked_sub(1).and_then(|above| self.levels.get(above));
        let before = match above {
            Some(&(_, longest)) if waits.is_for_all() => longest,
            Some(&(last, _)) => last,
            None => self.before,
        };
        let chain = before + u32::from(missed);
        if self.levels.len() <= level {
            self.levels.resize(level + 1, (self.before, self.before));
        }
        let (last, longest) = &mut self.levels[level];
        (*last, *longest) = (chain, chain.max(*longest));
        self.longest = self.longest.max(chain);
    }
}

impl Chains {
    /// Of a cache, or of none.
    pub(crate) fn new(keeps_lines: bool) -> Self {
        Self { uncached: !keeps_lines, missed: vec![], search: None, longest: Distribution::default() }
    }

    /// A line of the record of this number was fetched.
    pub(crate) fn miss(&mut self, record: u64) {
        if self.missed.last() != Some(&record) {
            self.missed.push(record);
        }
    }

    /// Follows so many records, from number `first` on, whose misses were told.
    pub(crate) fn run(&mut self, waiting: &Waiting, first: u64, records: usize, counted: bool) {
        let mut missed = self.missed.drain(..).peekable();
        let mut starts = waiting.starts.iter().peekable();
        for (at, number) in (first..).take(records).enumerate() {
            while starts.next_if(|&&start| start <= at).is_some() {
                begin(&mut self.search, &mut self.longest, counted);
            }
            let missed = missed.next_if_eq(&number).is_some() || self.uncached;
            if let Some(search) = &mut self.search {
                search.read(waiting.waits.get(at).copied().unwrap_or_default(), missed);
            }
        }
        starts.for_each(|_| begin(&mut self.search, &mut self.longest, counted));
    }

    /// How the longest chains of the searches that count are distributed.
    pub(crate) fn finish(mut self) -> Distribution {
        end(self.search.take(), &mut self.longest);
        self.longest
    }
}

/// A search begins, and the one before is over.
fn begin(search: &mut Option<Search>, longest: &mut Distribution, counted: bool) {
    end(search.replace(Search { counted, longest: 0, before: 0, levels: vec![] }), longest);
}

/// A search is over.
fn end(search: Option<Search>, longest: &mut Distribution) {
    if let Some(search) = search.filter(|search| search.counted) {
        longest.add(search.longest);
    }
}
