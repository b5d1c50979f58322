//! Evicts the least recently used line of a set of few ways.

use crate::models::Replacement;

/// The ways of each set in order of use: a word of sixteen digits of four bits, the way last used lowest.
///
/// So a set is one word, whatever its ways, and a victim is one digit of it: [`LruTimes`](super::times::LruTimes) would search
/// as many times as there are ways on every miss.
pub(super) struct LruOrder {
    orders: Vec<u64>,
    /// Where the digit of the way least recently used begins, in bits.
    last: u32,
}

impl LruOrder {
    /// The most ways.
    pub(super) const WAYS: usize = 16;

    /// `ways` is from 1 to [`WAYS`](LruOrder::WAYS).
    pub(super) fn new(sets: usize, ways: usize) -> Self {
        assert!((1..=Self::WAYS).contains(&ways));
        // Digits of ways that there are not stay above all others.
        Self { orders: vec![0xfedc_ba98_7654_3210; sets], last: 4 * (ways as u32 - 1) }
    }
}

/// A one in each digit.
const ONES: u64 = 0x1111_1111_1111_1111;

impl Replacement for LruOrder {
    const REPEATS_MATTER: bool = false;

    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        let order = self.orders[set];
        let way = way as u64;
        // The lowest digit that is zero is that of the way: subtracting one from each digit borrows from the highest bit of
        // zeros, and of digits above one (Knuth, *The Art of Computer Programming* 4A, 7.1.3, (90)).
        let differs = order ^ (way * ONES);
        let zeros = differs.wrapping_sub(ONES) & !differs & (8 * ONES);
        // Below the digit: what was used since. All of that goes up by one digit, into its place.
        let digit = zeros & zeros.wrapping_neg();
        let below = (digit >> 3) - 1;
        let up_to = below << 4 | 15;
        self.orders[set] = (order & !up_to) | ((order & below) << 4) | way;
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.hit(set, way);
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        (self.orders[set] >> self.last & 15) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digit_moves_to_the_front_from_anywhere() {
        for at in 0..16 {
            let mut lru = LruOrder::new(1, 16);
            lru.hit(0, at);
            let order: Vec<usize> = (0..16).map(|i| (lru.orders[0] >> (4 * i) & 15) as usize).collect();
            let expected: Vec<usize> = [at].into_iter().chain((0..16).filter(|&way| way != at)).collect();
            assert_eq!(order, expected);
        }
    }
}
