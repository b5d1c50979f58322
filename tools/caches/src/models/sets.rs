//! Sets that lines are spread over.

use crate::SetIndex;

/// How many sets there are, and which of them a line belongs to.
#[derive(Clone, Copy)]
pub(crate) struct Sets {
    number: u64,
    index: SetIndex,
}

impl Sets {
    /// `sets` is not none, and a power of two if it is chosen by a hash.
    pub(crate) fn new(sets: u64, index: SetIndex) -> Self {
        assert!(sets > 0 && (index == SetIndex::Plain || sets.is_power_of_two()));
        Self { number: sets, index }
    }

    /// How many there are.
    pub(crate) fn number(self) -> usize {
        self.number as usize
    }

    /// The set that a line number belongs to.
    #[inline]
    pub(crate) fn of(self, line: u64) -> usize {
        if !self.number.is_power_of_two() {
            return (line % self.number) as usize;
        }
        let mut folded = line;
        if self.index == SetIndex::Hash && self.number > 1 {
            let bits = self.number.ilog2();
            let mut rest = line >> bits;
            while rest > 0 {
                folded ^= rest;
                rest >>= bits;
            }
        }
        (folded & (self.number - 1)) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hashed_index_folds_all_bits_of_the_line() {
        let sets = Sets::new(8, SetIndex::Hash);
        assert_eq!(sets.of(0b101_110_011), 0b101 ^ 0b110 ^ 0b011);
        assert_eq!(sets.of(1 << 63), 1 << (63 % 3));
        // Where it differs from the plain index, and where there is nothing to choose.
        assert_eq!((Sets::new(8, SetIndex::Plain).of(8), sets.of(8)), (0, 1));
        assert_eq!((Sets::new(1, SetIndex::Plain).of(u64::MAX), Sets::new(1, SetIndex::Hash).of(u64::MAX)), (0, 0));
    }

    #[test]
    fn of_sets_that_are_no_power_of_two_the_remainder_tells() {
        let sets = Sets::new(12, SetIndex::Plain);
        assert_eq!([0, 11, 12, 25, u64::MAX].map(|line| sets.of(line)), [0, 11, 0, 1, (u64::MAX % 12) as usize]);
    }

    #[test]
    fn the_hashed_index_spreads_strides_evenly() {
        // As many lines as sets, a power of two apart: each set gets one where the plain index puts all in one.
        for stride in [1, 2, 64, 128, 4096, 1 << 40_u64] {
            let sets = Sets::new(128, SetIndex::Hash);
            let mut met = [0; 128];
            (0..128).for_each(|i| met[sets.of(i * stride)] += 1);
            assert_eq!(met, [1; 128], "stride {stride}");
        }
    }
}
