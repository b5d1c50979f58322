//! What a map is to those who choose one by its word.

use super::{AnyMap, BuildError};
use pm_formats::Photon;
use pm_registry::{Registered, Values};

/// A structure of photon maps, as it stands in a registry.
pub trait Structure: Registered + Sync {
    /// Do its maps always find the nearest photons? A map of one that does not may still happen to: ask the map.
    fn is_exact(&self) -> bool {
        true
    }

    /// Options under which tests try it, each a line.
    fn forms(&self) -> &'static [&'static str] {
        &[""]
    }

    /// Names of parameters that a description of how near its answers come should tell.
    fn described_by(&self) -> &'static [&'static str] {
        &[]
    }

    /// The map of these photons.
    ///
    /// # Errors
    /// If the photons cannot be put into it, or the values do not go together.
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError>;
}

/// What a map is made from.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// What was said to the structure.
    pub values: &'a Values,
    /// The photons.
    pub photons: &'a [Photon],
    /// How many of them searches will ask for.
    pub k: usize,
}

impl Setting<'_> {
    /// Bytes of a line: leaf, block, page, bucket.
    #[must_use]
    pub fn line(&self) -> u32 {
        self.values.count(super::LINE.name)
    }
}
