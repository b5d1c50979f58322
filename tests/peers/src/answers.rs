//! What was found, and whether others found the same.

use crate::aim::Aim;
use crate::contestants::Contestant;
use crate::streams::Queries;
use anyhow::{Context as _, ensure};
use std::fmt;
use std::str::FromStr;

/// What was found for all queries.
pub(crate) struct Answers {
    /// Squared distance of the farthest, and number, query by query.
    farthest: Vec<(f32, usize)>,
    /// Of squared distances and ids, free of their order.
    pub(crate) digest: u64,
}

impl Answers {
    /// Those of one of them.
    pub(crate) fn of(contestant: &mut dyn Contestant, queries: &Queries, aim: Aim) -> Self {
        let (mut farthest, mut digest) = (vec![], 0_u64);
        contestant.run(
            queries,
            aim,
            Some(&mut |found: &[(f32, u32)]| {
                farthest.push((found.iter().map(|one| one.0).fold(0.0, f32::max), found.len()));
                let mixed = |&(distance, id): &(f32, u32)| {
                    let bits =
                        (u64::from(distance.to_bits()) << 32 | u64::from(id)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                    bits ^ bits >> 29
                };
                let sum = found.iter().map(mixed).fold(0, u64::wrapping_add);
                digest = digest.wrapping_mul(3).wrapping_add(sum);
            }),
        );
        Self { farthest, digest }
    }

    /// Fails unless another's are the same, but for the order in which it added squares up.
    pub(crate) fn compare(&self, name: &str, other: &Self) -> anyhow::Result<()> {
        ensure!(self.farthest.len() == other.farthest.len(), "{name}: other queries");
        for (at, (mine, theirs)) in self.farthest.iter().zip(&other.farthest).enumerate() {
            let close = (mine.0 - theirs.0).abs() <= 2e-6 * mine.0;
            ensure!(close && mine.1 == theirs.1, "{name}: query {at}: {theirs:?} and not {mine:?}");
        }
        Ok(())
    }
}

/// What another process is told of them: all but the digest.
impl fmt::Display for Answers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.farthest.iter().try_for_each(|(distance, count)| write!(f, "{}/{count} ", distance.to_bits()))
    }
}

impl FromStr for Answers {
    type Err = anyhow::Error;

    fn from_str(text: &str) -> anyhow::Result<Self> {
        let one = |word: &str| {
            let (bits, count) = word.split_once('/').context("an answer")?;
            anyhow::Ok((f32::from_bits(bits.parse()?), count.parse()?))
        };
        Ok(Self { farthest: text.split_whitespace().map(one).collect::<Result<_, _>>()?, digest: 0 })
    }
}
