//! A policy as it is chosen: `lru`, `random:7`.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::str::FromStr;

use pm_registry::Registry;
use thiserror::Error;

use super::{Policy, policies};

/// A policy, and the seed of its random numbers if it draws any.
///
/// Read and printed as `WORD` or `WORD:SEED`; the seed is 0 if not given, and then not printed.
#[derive(Clone, Copy)]
pub struct ChosenPolicy {
    entry: &'static dyn Policy,
    seed: u64,
}

/// Seed where none is given.
const DEFAULT_SEED: u64 = 0;

/// There is no policy of that name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no policy `{word}`; there are {known}")]
pub struct UnknownPolicy {
    word: String,
    known: String,
}

impl ChosenPolicy {
    /// A policy, with the usual seed.
    #[must_use]
    pub fn new(entry: &'static dyn Policy) -> Self {
        Self { entry, seed: DEFAULT_SEED }
    }

    /// Reads the policy of a cache, so none that keeps no lines.
    ///
    /// # Errors
    /// If there is none of that name; the error lists those there are.
    pub fn parse(text: &str, policies: &Registry<dyn Policy>) -> Result<Self, UnknownPolicy> {
        let (word, seed) = match text.split_once(':') {
            // `+8` is a number to Rust; to us it is a typing mistake.
            Some((word, seed)) if seed.bytes().all(|b| b.is_ascii_digit()) => (word, seed.parse().ok()),
            Some((word, _)) => (word, None),
            None => (text, Some(DEFAULT_SEED)),
        };
        let may_be_seeded = |entry: &dyn Policy| word == text || entry.draws_random_numbers();
        let found = policies.find(word).ok().filter(|&entry| entry.keeps_lines() && may_be_seeded(entry));
        let chosen = found.and_then(|entry| Some(Self { entry, seed: seed? }));
        chosen.ok_or_else(|| UnknownPolicy { word: text.to_owned(), known: spellings(policies) })
    }

    /// The policy's entry in its registry.
    #[must_use]
    pub fn entry(self) -> &'static dyn Policy {
        self.entry
    }

    /// Names its sequence of random numbers.
    #[must_use]
    pub fn seed(self) -> u64 {
        self.seed
    }
}

/// How policies are written, in one line.
fn spellings(policies: &Registry<dyn Policy>) -> String {
    let mut known = vec![];
    for entry in policies.iter().filter(|entry| entry.keeps_lines()) {
        known.push(entry.word().to_owned());
        known.extend(entry.draws_random_numbers().then(|| format!("{}:SEED", entry.word())));
    }
    let without = policies.iter().filter(|entry| !entry.keeps_lines());
    known.extend(without.map(|entry| format!("and {} for no cache", entry.word())));
    known.join(", ")
}

impl FromStr for ChosenPolicy {
    type Err = UnknownPolicy;

    /// One of the [`policies`] that keep lines.
    fn from_str(text: &str) -> Result<Self, UnknownPolicy> {
        Self::parse(text, &policies())
    }
}

impl fmt::Display for ChosenPolicy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.seed {
            DEFAULT_SEED => f.pad(self.entry.word()),
            seed => f.pad(&format!("{}:{seed}", self.entry.word())),
        }
    }
}

impl fmt::Debug for ChosenPolicy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

// In a registry no word stands for two.
impl PartialEq for ChosenPolicy {
    fn eq(&self, other: &Self) -> bool {
        (self.entry.word(), self.seed) == (other.entry.word(), other.seed)
    }
}

impl Eq for ChosenPolicy {}

impl Hash for ChosenPolicy {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.entry.word(), self.seed).hash(state);
    }
}

impl From<&'static dyn Policy> for ChosenPolicy {
    fn from(entry: &'static dyn Policy) -> Self {
        Self::new(entry)
    }
}
