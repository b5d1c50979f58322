//! Which part of a whole a stream is.

use super::UnknownText;
use std::fmt;
use std::str::FromStr;

/// A part of a stream that several machines make: the value of [`PART`](super::meaning::PART), such as `2/8`.
///
/// Batches are dealt out like cards: the first part has batches 0, N, 2 N and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    number: u64,
    of: u64,
}

impl Part {
    /// Most parts of a stream.
    pub const MOST: u64 = 1 << 16;

    /// Part `number` of `of`, counted from 1; `None` if there is no such.
    #[must_use]
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (1..=of.min(Self::MOST)).contains(&number).then_some(Self { number, of }).filter(|_| of <= Self::MOST)
    }

    /// Which it is, from 1.
    #[must_use]
    pub const fn number(self) -> u64 {
        self.number
    }

    /// Of how many.
    #[must_use]
    pub const fn of(self) -> u64 {
        self.of
    }

    /// Whether a batch is one of its own.
    #[must_use]
    pub const fn has(self, batch: u64) -> bool {
        batch % self.of == self.number - 1
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Part {
    type Err = UnknownText;

    fn from_str(text: &str) -> Result<Self, UnknownText> {
        let parsed = text.split_once('/').and_then(|(number, of)| Self::new(number.parse().ok()?, of.parse().ok()?));
        parsed.ok_or_else(|| UnknownText {
            what: "part of a stream, such as 2/8, of at most 65536",
            text: text.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_read_as_they_are_written_and_deal_out_all_batches() {
        for text in ["1/1", "2/8", "8/8", "65536/65536"] {
            assert_eq!(text.parse::<Part>().map(|part| part.to_string()), Ok(text.to_owned()));
        }
        for odd in ["", "2", "0/8", "9/8", "1/0", "1/65537", "-1/8", "1/8/8", "a/8", " 1/8"] {
            assert!(odd.parse::<Part>().is_err(), "{odd}");
        }
        for of in [1, 3, 8] {
            for batch in 0..20 {
                let owners = (1..=of).filter(|&number| Part::new(number, of).unwrap().has(batch)).count();
                assert_eq!(owners, 1, "batch {batch} of {of} parts");
            }
        }
    }
}
