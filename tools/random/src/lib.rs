//! Random numbers that are a function of what they are for, never of the order of work.

/// The finaliser of SplitMix64: a bijection of 64-bit integers whose every output bit depends on every input bit
/// (Steele, Lea, Flood: *Fast Splittable Pseudorandom Number Generators*, OOPSLA 2014; Stafford's variant 13).
#[inline]
#[must_use]
pub const fn mix(x: u64) -> u64 {
    let mut z = x.wrapping_add(GOLDEN);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// 2^64 divided by the golden ratio: the step of SplitMix64.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// A SplitMix64 sequence that belongs to a key, such as (seed, pixel, sample).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of this key. Keys that differ anywhere give unrelated sequences.
    #[inline]
    #[must_use]
    pub fn new(key: &[u64]) -> Self {
        Self(key.iter().fold(0, |state, &part| mix(state ^ mix(part))))
    }

    /// The sequence of a key that is one part longer than this one's, from which nothing has been taken.
    #[inline]
    #[must_use]
    pub const fn with(&self, part: u64) -> Self {
        Self(mix(self.0 ^ mix(part)))
    }

    /// The next 64 bits.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        let value = mix(self.0);
        self.skip();
        value
    }

    /// Takes a number that nobody looks at.
    #[inline]
    pub const fn skip(&mut self) {
        self.0 = self.0.wrapping_add(GOLDEN);
    }

    /// The next number in [0, 1), a multiple of 2^-24.
    #[inline]
    #[expect(clippy::cast_precision_loss, reason = "24 bits fit an f32")]
    pub fn unit(&mut self) -> f32 {
        (self.next_u64() >> 40) as f32 * (1.0 / 16_777_216.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_splitmix64() {
        // Published outputs for seed 1234567 (Rosetta Code, Pseudo-random numbers/Splitmix64).
        let mut random = Random(1_234_567);
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
        ];
        assert_eq!([(); 4].map(|()| random.next_u64()), expected);
    }

    #[test]
    fn what_is_skipped_is_taken() {
        let (mut skipped, mut taken) = (Random::new(&[5]), Random::new(&[5]));
        skipped.skip();
        let _ = taken.next_u64();
        assert_eq!(skipped.next_u64(), taken.next_u64());
    }

    #[test]
    fn units_are_below_one_and_even() {
        let mut random = Random::new(&[1, 2, 3]);
        let n = 100_000;
        let units: Vec<f32> = (0..n).map(|_| random.unit()).collect();
        assert!(units.iter().all(|u| (0.0..1.0).contains(u)));
        let mean = units.iter().map(|&u| f64::from(u)).sum::<f64>() / f64::from(n);
        // Standard error 1 / sqrt(12 n) = 0.0009.
        assert!((mean - 0.5).abs() < 0.004, "{mean}");
    }

    #[test]
    fn every_part_of_a_key_counts() {
        let first = |key: &[u64]| Random::new(key).next_u64();
        let values = [first(&[1, 2]), first(&[2, 1]), first(&[1, 3]), first(&[1, 2, 0]), first(&[1])];
        let distinct: std::collections::BTreeSet<_> = values.into_iter().collect();
        assert_eq!(distinct.len(), values.len());
    }

    #[test]
    fn parts_can_be_added_one_by_one() {
        assert_eq!(Random::new(&[7]).with(0).with(9).next_u64(), Random::new(&[7, 0, 9]).next_u64());
    }
}
