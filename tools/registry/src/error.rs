//! Why a question to an entry of a registry makes no sense.

use std::fmt;

/// Why parameters cannot be given as they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterError {
    /// No value of the parameter.
    Value {
        /// The parameter.
        name: &'static str,
        /// What was given.
        text: String,
        /// What is expected: a sentence without a full stop.
        expected: String,
    },
    /// The entry does not take it: an option that does nothing is refused.
    NotTaken {
        /// The word of the entry.
        entry: &'static str,
        /// The parameter.
        name: String,
        /// The words of those that take it.
        takers: Vec<&'static str>,
    },
    /// The entry needs it.
    Needed {
        /// The word of the entry.
        entry: &'static str,
        /// The parameter.
        name: &'static str,
        /// How its value is called.
        value_name: &'static str,
    },
    /// It was given twice.
    Twice(&'static str),
    /// Not an option, or one without its value.
    Unexpected(String),
    /// Values that each make sense do not go together.
    Unfit(String),
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value { name, text, expected } => write!(f, "--{name} {text}: {expected}"),
            Self::NotTaken { entry, name, takers } if takers.is_empty() => {
                write!(f, "{entry} takes no --{name}: leave --{name} out")
            }
            Self::NotTaken { entry, name, takers } => {
                write!(f, "--{name} is for {}, not for {entry}: leave --{name} out", takers.join(", "))
            }
            Self::Needed { entry, name, value_name } => {
                write!(f, "{entry} needs --{name}: give --{name} {value_name}")
            }
            Self::Twice(name) => write!(f, "--{name} is given twice"),
            Self::Unexpected(text) => write!(f, "`{text}` is no option, or its value is missing"),
            Self::Unfit(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for ParameterError {}

/// There is no such word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownWord {
    pub(crate) what: &'static str,
    pub(crate) word: String,
    pub(crate) words: Vec<&'static str>,
}

impl fmt::Display for UnknownWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, word, words } = self;
        write!(f, "`{word}` is no {what}: there are {}", words.join(", "))
    }
}

impl std::error::Error for UnknownWord {}

/// Why a line chooses no entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChoiceError {
    /// There is no such entry.
    Word(UnknownWord),
    /// Its parameters make no sense.
    Parameter(ParameterError),
}

impl fmt::Display for ChoiceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(error) => error.fmt(f),
            Self::Parameter(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ChoiceError {}

impl From<UnknownWord> for ChoiceError {
    fn from(error: UnknownWord) -> Self {
        Self::Word(error)
    }
}

impl From<ParameterError> for ChoiceError {
    fn from(error: ParameterError) -> Self {
        Self::Parameter(error)
    }
}
