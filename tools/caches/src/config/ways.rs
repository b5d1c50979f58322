//! Where a line may be placed.

use std::{fmt, num::NonZeroU32, str::FromStr};

use thiserror::Error;

/// Where a line may be placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ways {
    /// Anywhere: fully associative.
    Full,
    /// In any of this many places of its set.
    N(NonZeroU32),
}

/// Which set a line belongs to, where there are several: a number below a power of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SetIndex {
    /// The lowest bits of the line number.
    Plain,
    /// All bits of the line number, cut from below into pieces as long as a set number and combined by exclusive or, so
    /// that strides of a power of two do not meet in one set (after González, Valero, Topham and Parcerisa, *Eliminating
    /// Cache Conflict Misses Through XOR-Based Placement Functions*, ICS 1997).
    Hash,
}

/// Ways are neither a number nor `full`.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("ways are `full` or a number from 1 on, not `{0}`")]
pub struct UnknownWays(String);

impl FromStr for Ways {
    type Err = UnknownWays;

    fn from_str(text: &str) -> Result<Self, UnknownWays> {
        let number = match text {
            "full" => return Ok(Self::Full),
            // `+8` is a number to Rust; to us it is a typing mistake.
            _ if text.bytes().all(|b| b.is_ascii_digit()) => text.parse().ok(),
            _ => None,
        };
        number.map(Self::N).ok_or_else(|| UnknownWays(text.to_owned()))
    }
}

impl fmt::Display for Ways {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full => f.pad("full"),
            Self::N(n) => n.fmt(f),
        }
    }
}
