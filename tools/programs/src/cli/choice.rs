//! Words of the command line for things that know no command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use pm_registry::Choice;
use std::ffi::OsStr;
use std::marker::PhantomData;

/// Understands the words of a [`Choice`]; they, and what is said of them, are listed in the help.
pub struct ChoiceParser<T>(PhantomData<fn() -> T>);

/// The parser of a choice: `value_parser = choice::<Layout>()`.
#[must_use]
pub const fn choice<T: Choice>() -> ChoiceParser<T> {
    ChoiceParser(PhantomData)
}

impl<T> Clone for ChoiceParser<T> {
    fn clone(&self) -> Self {
        Self(PhantomData)
    }
}

impl<T: Choice> ChoiceParser<T> {
    fn words() -> impl Iterator<Item = PossibleValue> {
        T::ALL.iter().map(|named| PossibleValue::new(named.word).aliases(named.aliases).help(named.help()))
    }
}

impl<T: Choice> TypedValueParser for ChoiceParser<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<T, clap::Error> {
        let word = PossibleValuesParser::new(Self::words()).parse_ref(command, argument, value)?;
        Ok(T::of_word(&word).expect("a word that is listed"))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(Self::words()))
    }
}
