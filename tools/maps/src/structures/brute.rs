//! The oracle.

use crate::{AnyMap, BruteForce, BuildError, Setting, Structure};

pm_registry::registered! {
    /// No structure: every photon is read for every query; for checking
    pub struct Brute = "brute";
}

impl Structure for Brute {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(BruteForce::build(setting.photons)?))
    }
}
