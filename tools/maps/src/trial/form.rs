//! Structures in the forms in which they are to be tried.

use super::{Fault, Verdict};
use crate::{AnyMap, BuildError, Setting, Structure};
use pm_formats::Photon;
use pm_registry::{Chosen, Registry};

/// A structure in one of its forms.
pub struct Form {
    /// How it is asked for: its word and options.
    pub line: String,
    /// The structure.
    pub chosen: Chosen<dyn Structure>,
}

/// Every structure in each of its forms.
///
/// # Errors
/// If one cannot be asked for like that.
pub fn forms(structures: &Registry<dyn Structure>) -> Result<Vec<Form>, Fault> {
    let forms = structures.iter().flat_map(|entry| entry.forms().iter().map(move |form| (entry.word(), form)));
    forms.map(|(word, form)| Form::new(structures, format!("{word} {form}").trim())).collect()
}

impl Form {
    /// The structure that a line asks for.
    ///
    /// # Errors
    /// If it asks for none.
    pub fn new(structures: &Registry<dyn Structure>, line: &str) -> Result<Self, Fault> {
        match structures.choose(line) {
            Ok(chosen) => Ok(Self { line: line.to_owned(), chosen }),
            Err(error) => Err(Fault { map: line.to_owned(), what: error.to_string() }),
        }
    }

    /// Its map of these photons, for searches of `k`.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn built(&self, photons: &[Photon], k: usize) -> Result<Box<dyn AnyMap>, BuildError> {
        self.chosen.entry.build(Setting { values: &self.chosen.values, photons, k })
    }

    /// The same where nothing should be refused.
    ///
    /// # Errors
    /// If it is.
    pub fn build(&self, photons: &[Photon], k: usize) -> Result<Box<dyn AnyMap>, Fault> {
        self.built(photons, k).map_err(|error| Fault { map: self.line.clone(), what: error.to_string() })
    }

    /// A fault of this map, unless something holds.
    pub(super) fn holds(&self, holds: bool, what: impl FnOnce() -> String) -> Verdict {
        if holds { Ok(()) } else { Err(Fault { map: self.line.clone(), what: what() }) }
    }
}
