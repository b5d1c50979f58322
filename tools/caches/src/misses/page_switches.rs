//! How often the DRAM page changes from one fetch to the next.

/// Counts how often the page (DRAM row) changes from one fetch to the next: whenever a fetch begins in another page than
/// the one before ended in, and within a fetch that reaches over several. The first fetch of all changes from nothing and
/// is not counted.
#[derive(Clone, Debug)]
pub(crate) struct PageSwitches {
    /// log2 of the page in bytes.
    shift: u32,
    last: Option<u64>,
    pub(crate) switches: u64,
}

impl PageSwitches {
    /// Pages of `bytes` bytes, a power of two.
    pub(crate) fn new(bytes: u64) -> Self {
        assert!(bytes.is_power_of_two());
        Self { shift: bytes.ilog2(), last: None, switches: 0 }
    }

    /// The bytes from address `first` to `last` are fetched.
    #[inline]
    pub(crate) fn fetch(&mut self, first: u64, last: u64, counted: bool) {
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
