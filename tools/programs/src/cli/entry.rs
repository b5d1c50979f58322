//! Words of the command line for what stands in a registry.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use pm_registry::{Registered, Registry};
use std::ffi::OsStr;

/// Understands the words of a [`Registry`]; they, and what is said of them, are listed in the help.
pub struct EntryParser<T: ?Sized + 'static>(Registry<T>);

/// The parser of a registry's words, for entries without parameters: `value_parser = entry(&exports())`.
#[must_use]
pub fn entry<T: Registered + ?Sized>(registry: &Registry<T>) -> EntryParser<T> {
    EntryParser(registry.clone())
}

impl<T: ?Sized> Clone for EntryParser<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T: Registered + ?Sized> EntryParser<T> {
    fn words(&self) -> impl Iterator<Item = PossibleValue> {
        let word = |entry: &'static T| PossibleValue::new(entry.word()).aliases(entry.aliases()).help(entry.help());
        self.0.iter().map(word).collect::<Vec<_>>().into_iter()
    }
}

impl<T: Registered + Sync + ?Sized> TypedValueParser for EntryParser<T> {
    type Value = &'static T;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<&'static T, clap::Error> {
        let word = PossibleValuesParser::new(self.words()).parse_ref(command, argument, value)?;
        Ok(self.0.find(&word).expect("a word that is listed"))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.words()))
    }
}
