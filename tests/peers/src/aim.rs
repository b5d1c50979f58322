//! What is looked for.

use anyhow::Context as _;
use std::fmt;
use std::str::FromStr;

/// How many photons, and how far from the query at most: `100`, or `100@0.01`.
#[derive(Clone, Copy)]
pub(crate) struct Aim {
    pub(crate) k: usize,
    /// In scene units.
    pub(crate) max_dist: f32,
}

impl FromStr for Aim {
    type Err = anyhow::Error;

    fn from_str(word: &str) -> anyhow::Result<Self> {
        let (k, max_dist) = word.split_once('@').unwrap_or((word, "inf"));
        let parsed = || anyhow::Ok(Self { k: k.parse()?, max_dist: max_dist.parse()? });
        parsed().with_context(|| format!("{word}: not K or K@DISTANCE"))
    }
}

impl fmt::Display for Aim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.max_dist == f32::INFINITY {
            return f.pad(&self.k.to_string());
        }
        f.pad(&format!("{}@{}", self.k, self.max_dist))
    }
}
