//! Misses in the order they happen, for whoever wants to follow them, and what becomes of DRAM pages.

/// The misses of the chunk in hand.
#[derive(Debug, Default)]
pub(super) struct Misses {
    wanted: bool,
    list: Vec<Miss>,
}

/// One line access that missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Miss {
    /// Index of the line access in the chunk.
    pub(super) index: u32,
    /// It missed in the first so many caches of the model.
    pub(super) caches: u32,
}

impl Misses {
    /// A list that is kept only if `wanted`.
    pub(super) fn new(wanted: bool) -> Self {
        Self { wanted, list: vec![] }
    }

    /// The line access at `index` missed in the first `caches` caches of the model. Called in the order of the accesses,
    /// during warm-up too.
    #[inline]
    pub(super) fn push(&mut self, index: usize, caches: usize) {
        if self.wanted {
            self.list.push(Miss { index: index as u32, caches: caches as u32 });
        }
    }

    pub(super) fn list(&self) -> &[Miss] {
        &self.list
    }

    pub(super) fn clear(&mut self) {
        self.list.clear();
    }
}

/// Counts how often the page (DRAM row) changes from one fetch to the next: whenever a fetch begins in another page than
/// the one before ended in, and within a fetch that reaches over several. The first fetch of all changes from nothing and
/// is not counted.
#[derive(Clone, Debug)]
pub(super) struct PageSwitches {
    /// log2 of the page in bytes.
    shift: u32,
    last: Option<u64>,
    pub(super) switches: u64,
}

impl PageSwitches {
    /// Pages of `bytes` bytes, a power of two.
    pub(super) fn new(bytes: u64) -> Self {
        assert!(bytes.is_power_of_two());
        Self { shift: bytes.ilog2(), last: None, switches: 0 }
    }

    /// The bytes from address `first` to `last` are fetched.
    #[inline]
    pub(super) fn fetch(&mut self, first: u64, last: u64, counted: bool) {
        let (first, last) = (first >> self.shift, last >> self.shift);
        let switches = u64::from(self.last.is_some_and(|page| page != first)) + (last - first);
        self.last = Some(last);
        self.switches += if counted { switches } else { 0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn page_switches_are_pairs_of_fetches_in_two_pages() {
        let mut pages = PageSwitches::new(100_u64.next_power_of_two());
        for (first, last, switches) in
            [(0, 127, 0), (64, 127, 0), (128, 191, 1), (0, 63, 2), (192, 511, 5), (500, 500, 5)]
        {
            pages.fetch(first, last, true);
            assert_eq!(pages.switches, switches, "{first}..={last}");
        }
        pages.fetch(0, 0, false);
        pages.fetch(0, 0, true);
        assert_eq!(pages.switches, 5, "warm-up moves the page and is not counted");
    }
}
