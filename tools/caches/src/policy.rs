//! The names of the replacement policies: which line makes room for a new one.

use std::{fmt, str::FromStr};

use thiserror::Error;

/// Which line makes room for a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Policy {
    /// No cache at all: every record goes to memory by itself, byte for byte.
    None,
    /// The least recently used.
    Lru,
    /// The one that came first.
    Fifo,
    /// The first one in a round, from where the last round ended, that was not used since the hand passed it (Corbató
    /// 1969; also known as second chance). A line that comes in counts as used.
    Clock,
    /// Any, by a sequence of random numbers that belongs to the seed.
    Random {
        /// Names the sequence.
        seed: u64,
    },
    /// The one that the bits of a binary tree over the ways point away from: an approximation of LRU in ways - 1 bits,
    /// common in hardware.
    TreePlru,
    /// The one whose next use is farthest (Belady 1966): no policy that fetches on every miss fetches less.
    Min,
    /// The same where a fetched line may also pass by the cache; consecutive accesses to it then count as one use.
    MinBypass,
}

/// Seed of `random`.
const DEFAULT_SEED: u64 = 0;

/// There is no policy of that name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "there is no policy `{0}`; there are lru, fifo, clock, random, random:SEED, plru, min, min-bypass, and none for no cache"
)]
pub struct UnknownPolicy(pub String);

impl FromStr for Policy {
    type Err = UnknownPolicy;

    /// Reads the policy of a cache, so not `none`.
    fn from_str(text: &str) -> Result<Self, UnknownPolicy> {
        let unknown = || UnknownPolicy(text.to_owned());
        Ok(match text {
            "lru" => Self::Lru,
            "fifo" => Self::Fifo,
            "clock" => Self::Clock,
            "random" => Self::Random { seed: DEFAULT_SEED },
            "plru" => Self::TreePlru,
            "min" => Self::Min,
            "min-bypass" => Self::MinBypass,
            _ => match text.strip_prefix("random:") {
                // `+8` is a number to Rust; to us it is a typing mistake.
                Some(seed) if seed.bytes().all(|b| b.is_ascii_digit()) => {
                    Self::Random { seed: seed.parse().map_err(|_| unknown())? }
                }
                _ => return Err(unknown()),
            },
        })
    }
}

impl fmt::Display for Policy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::None => "none",
            Self::Lru => "lru",
            Self::Fifo => "fifo",
            Self::Clock => "clock",
            Self::Random { seed: DEFAULT_SEED } => "random",
            Self::Random { seed } => return f.pad(&format!("random:{seed}")),
            Self::TreePlru => "plru",
            Self::Min => "min",
            Self::MinBypass => "min-bypass",
        })
    }
}
