//! What a sample is chosen of.

use super::UnknownText;
use std::fmt;
use std::str::FromStr;

/// What a part of a stream was chosen of: the value of [`SAMPLE_OF`](super::meaning::SAMPLE_OF).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleUnit {
    /// Whole batches, such as tiles.
    Batches,
    /// Gather rays, in the order in which they are cast.
    Rays,
    /// Queries, in the order of the stream.
    Queries,
}

impl SampleUnit {
    const ALL: [Self; 3] = [Self::Batches, Self::Rays, Self::Queries];

    const fn word(self) -> &'static str {
        match self {
            Self::Batches => "batches",
            Self::Rays => "rays",
            Self::Queries => "queries",
        }
    }
}

impl fmt::Display for SampleUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for SampleUnit {
    type Err = UnknownText;

    fn from_str(text: &str) -> Result<Self, UnknownText> {
        let found = Self::ALL.into_iter().find(|unit| unit.word() == text);
        found.ok_or_else(|| UnknownText { what: "unit of a sample, such as `batches`", text: text.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_read_as_it_is_written() {
        for unit in SampleUnit::ALL {
            assert_eq!(unit.to_string().parse(), Ok(unit));
        }
        assert!("batch".parse::<SampleUnit>().is_err());
    }
}
