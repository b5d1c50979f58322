//! What an entry of a registry may be asked besides its word: options that are declared as data.

use crate::{Choice, ParameterError, Value};

/// An option of an entry: `--name VALUE` on a command line.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Lower case, hyphens.
    pub name: &'static str,
    /// Which values it takes.
    pub domain: Domain,
    /// How its value is called in the help: `N`, `BYTES`.
    pub value_name: &'static str,
    /// What it says: one line that begins with a small letter and has no full stop.
    pub help: &'static str,
    /// What else a long help says; may be empty.
    pub details: &'static str,
    /// Its value where nothing is said, as it would be typed.
    pub default: Option<&'static str>,
    /// Must it be given?
    pub is_needed: bool,
    /// Is it seldom of use, and left out of a short help?
    pub is_hidden: bool,
}

/// A set of values.
#[derive(Clone, Copy, Debug)]
pub enum Domain {
    /// Said or not; takes no value.
    Flag,
    /// Whole numbers between these two, multiples of the third.
    Count {
        /// The least.
        least: u64,
        /// The greatest.
        most: u64,
        /// All are multiples of it.
        multiple_of: u64,
    },
    /// Any 64-bit number, from which random numbers are drawn.
    Seed,
    /// Above 0 and at most 1.
    Share,
    /// Finite and above 0, in scene units.
    Length,
    /// One of some words.
    Word(fn() -> Vec<Word>),
    /// The name of a file, or `-`.
    File,
}

/// One of the words that a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// The word that is listed.
    pub word: &'static str,
    /// Words that are understood as well.
    pub aliases: &'static [&'static str],
    /// What is said of it.
    pub help: &'static str,
}

/// The words of a choice: `Domain::Word(words_of::<Layout>)`.
#[must_use]
pub fn words_of<T: Choice>() -> Vec<Word> {
    T::ALL.iter().map(|named| Word { word: named.word, aliases: named.aliases, help: named.help() }).collect()
}

impl Parameter {
    /// A parameter that may be left out and has no default.
    #[must_use]
    pub const fn new(name: &'static str, domain: Domain, help: &'static str) -> Self {
        let value_name = match domain {
            Domain::Flag => "",
            Domain::Count { .. } | Domain::Seed => "N",
            Domain::Share | Domain::Length => "X",
            Domain::Word(_) => "WORD",
            Domain::File => "FILE",
        };
        Self { name, domain, value_name, help, details: "", default: None, is_needed: false, is_hidden: false }
    }

    /// The same, with a value where nothing is said, as it would be typed.
    #[must_use]
    pub const fn or(self, default: &'static str) -> Self {
        Self { default: Some(default), ..self }
    }

    /// The same, with another name for its value.
    #[must_use]
    pub const fn called(self, value_name: &'static str) -> Self {
        Self { value_name, ..self }
    }

    /// The same, with more to say in a long help.
    #[must_use]
    pub const fn with_details(self, details: &'static str) -> Self {
        Self { details, ..self }
    }

    /// The same, not to be left out.
    #[must_use]
    pub const fn needed(self) -> Self {
        Self { is_needed: true, ..self }
    }

    /// The same, left out of a short help.
    #[must_use]
    pub const fn hidden(self) -> Self {
        Self { is_hidden: true, ..self }
    }

    /// Does it take no value?
    #[must_use]
    pub const fn is_flag(&self) -> bool {
        matches!(self.domain, Domain::Flag)
    }

    /// The value that this text stands for; the text after a flag is not looked at.
    ///
    /// # Errors
    /// If there is no such value; the error says what is expected.
    pub fn parse(&self, text: &str) -> Result<Value, ParameterError> {
        let found = self.domain.parse(text);
        found.map_err(|expected| ParameterError::Value { name: self.name, text: text.to_owned(), expected })
    }
}

impl Domain {
    /// Whole numbers from `least` to `most`.
    #[must_use]
    pub const fn count(least: u64, most: u64) -> Self {
        Self::Count { least, most, multiple_of: 1 }
    }

    /// Does this text stand for a value?
    ///
    /// # Errors
    /// If not; the text says what is expected.
    pub fn check(&self, text: &str) -> Result<(), String> {
        self.parse(text).map(|_| ())
    }

    /// The value that this text stands for, or what is expected.
    pub(crate) fn parse(&self, text: &str) -> Result<Value, String> {
        match *self {
            Self::Flag => Ok(Value::Flag(true)),
            Self::Count { least, most, multiple_of } => {
                let number = text.parse().ok().filter(|n: &u64| (least..=most).contains(n));
                let number = number.ok_or_else(|| format!("a whole number from {least} to {most} is expected"))?;
                match number.is_multiple_of(multiple_of) {
                    true => Ok(Value::Count(number)),
                    false => Err(format!("a multiple of {multiple_of} is expected")),
                }
            }
            Self::Seed => {
                text.parse().map(Value::Count).map_err(|_| format!("a whole number up to {} is expected", u64::MAX))
            }
            Self::Share => match text.parse() {
                Ok(share) if share > 0.0 && share <= 1.0 => Ok(Value::Share(share)),
                _ => Err("a share above 0 and at most 1 is expected".into()),
            },
            Self::Length => match text.parse::<f32>() {
                Ok(length) if length > 0.0 && length.is_finite() => Ok(Value::Length(length)),
                _ => Err("a length above 0 is expected, in scene units".into()),
            },
            Self::Word(words) => {
                let words = words();
                let found = words.iter().find(|word| word.word == text || word.aliases.contains(&text));
                let listed = || words.iter().map(|word| word.word).collect::<Vec<_>>().join(", ");
                found.map(|word| Value::Word(word.word)).ok_or_else(|| format!("there are {}", listed()))
            }
            Self::File => Ok(Value::File(text.to_owned())),
        }
    }

    /// Are they the same values?
    #[must_use]
    pub fn is_same_as(&self, other: &Self) -> bool {
        match (self, other) {
            (
                Self::Count { least, most, multiple_of },
                Self::Count { least: least_too, most: most_too, multiple_of: multiple_too },
            ) => least == least_too && most == most_too && multiple_of == multiple_too,
            (Self::Word(words), Self::Word(words_too)) => words() == words_too(),
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(domain: Domain, text: &str) -> String {
        Parameter::new("x", domain, "").parse(text).unwrap_err().to_string()
    }

    #[test]
    fn values_are_those_of_the_domain_and_others_are_told_what_is_expected() {
        assert_eq!(Domain::count(1, 9).parse("9"), Ok(Value::Count(9)));
        assert_eq!(said(Domain::count(1, 9), "10"), "--x 10: a whole number from 1 to 9 is expected");
        assert_eq!(said(Domain::count(1, 9), "-1"), "--x -1: a whole number from 1 to 9 is expected");
        let fours = Domain::Count { least: 4, most: 40, multiple_of: 4 };
        assert_eq!(
            (fours.parse("8"), said(fours, "9")),
            (Ok(Value::Count(8)), "--x 9: a multiple of 4 is expected".into())
        );
        assert_eq!(Domain::Seed.parse("18446744073709551615"), Ok(Value::Count(u64::MAX)));
        assert_eq!(Domain::Share.parse("1"), Ok(Value::Share(1.0)));
        for wrong in ["0", "1.01", "nan", "half"] {
            assert!(said(Domain::Share, wrong).ends_with("at most 1 is expected"));
        }
        assert_eq!(Domain::Length.parse("0.5"), Ok(Value::Length(0.5)));
        for wrong in ["0", "-1", "inf", "nan"] {
            assert!(said(Domain::Length, wrong).ends_with("a length above 0 is expected, in scene units"));
        }
    }
}
