//! What a derivation is.

use crate::Table;
use pm_registry::Registered;
use pm_report::ReportError;
use pm_report::sheet::Sheets;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::str::FromStr;

/// A table, or a text, made of tables.
pub struct Derivation {
    /// Its word.
    pub word: &'static str,
    /// What it tells, in a line.
    pub help: &'static str,
    /// Names of the settings that it takes.
    pub settings: &'static [&'static str],
    /// Makes it.
    pub derive: fn(&Asked<'_>) -> Result<Derived, ReportError>,
}

/// What a derivation is made of.
pub struct Asked<'a> {
    /// The tables, in the order in which they were given.
    pub tables: &'a [Table],
    /// Settings by name.
    pub settings: &'a BTreeMap<String, String>,
    /// Further results, looked up by the names of their files.
    pub results: &'a Sheets,
}

/// What came of it.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Derived {
    /// The table or text.
    pub text: String,
    /// What does not hold, if it judges.
    pub fault: Option<String>,
}

impl From<String> for Derived {
    fn from(text: String) -> Self {
        Self { text, fault: None }
    }
}

/// An error that says so.
pub(crate) fn fail<T>(text: impl Display) -> Result<T, ReportError> {
    Err(ReportError::asked(text.to_string()))
}

impl Registered for Derivation {
    fn word(&self) -> &'static str {
        self.word
    }

    fn help(&self) -> &'static str {
        self.help
    }
}

impl Asked<'_> {
    /// The table at a place.
    pub(crate) fn table(&self, at: usize) -> Result<&Table, ReportError> {
        self.tables.get(at).map_or_else(|| fail(format!("{} tables are wanted, or more", at + 1)), Ok)
    }

    /// A setting, if it was made.
    pub(crate) fn setting<T: FromStr>(&self, name: &str) -> Result<Option<T>, ReportError> {
        let Some(text) = self.settings.get(name) else { return Ok(None) };
        text.parse().map_or_else(|_| fail(format!("{name}={text} is not understood")), |value| Ok(Some(value)))
    }

    /// A setting that has to be made.
    pub(crate) fn needed<T: FromStr>(&self, name: &str) -> Result<T, ReportError> {
        self.setting(name)?.map_or_else(|| fail(format!("give --with {name}=...")), Ok)
    }
}

/// What is derived of tables, each with its name, and settings.
#[cfg(test)]
pub(crate) fn derived(
    derivation: &Derivation,
    tables: &[(&str, &str)],
    settings: &[(&str, &str)],
) -> Result<Derived, ReportError> {
    let tables = tables.iter().map(|(name, text)| Table::read(name, (*text).to_owned()));
    let tables = tables.collect::<Result<Vec<_>, ReportError>>()?;
    let settings = settings.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    (derivation.derive)(&Asked { tables: &tables, settings: &settings, results: &Sheets::default() })
}
