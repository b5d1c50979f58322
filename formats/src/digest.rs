//! A checksum that ignores order: the sum of a 128-bit hash of each record.
//!
//! Reordering keeps it, and losing, changing or doubling a record changes it.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::AddAssign;
use xxhash_rust::xxh3::xxh3_128;

/// Sum modulo 2^128 of the XXH3-128 hashes of records.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Digest(pub u128);

impl Digest {
    /// The digest of one record.
    #[inline]
    #[must_use]
    pub fn of(record: &[u8]) -> Self {
        Self(xxh3_128(record))
    }
}

impl AddAssign for Digest {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.0 = self.0.wrapping_add(other.0);
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// How many records went by, and their digest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Number of records.
    pub records: u64,
    /// Their order-free digest.
    pub digest: Digest,
}

impl Tally {
    /// Counts one record.
    #[inline]
    pub fn count(&mut self, record: &[u8]) {
        self.records += 1;
        self.digest += Digest::of(record);
    }
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.records += other.records;
        self.digest += other.digest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally(records: &[&[u8]]) -> Tally {
        let mut tally = Tally::default();
        records.iter().for_each(|r| tally.count(r));
        tally
    }

    #[test]
    fn order_does_not_matter_but_content_and_number_do() {
        let abc = tally(&[b"a", b"b", b"c"]);
        assert_eq!(abc, tally(&[b"c", b"a", b"b"]));
        assert_ne!(abc, tally(&[b"a", b"b", b"d"]));
        assert_ne!(abc, tally(&[b"a", b"b", b"c", b"c"]));
        // A sum, unlike an exclusive or, notices a pair of equal records.
        assert_ne!(tally(&[b"a", b"a"]).digest, tally(&[b"b", b"b"]).digest);
    }

    #[test]
    fn the_hash_is_xxh3() {
        // Published test vector of XXH3-128 (xxHash sanity checks): empty input, seed 0.
        assert_eq!(Digest::of(b"").to_string(), "99aa06d3014798d86001c324468d497f");
    }
}
