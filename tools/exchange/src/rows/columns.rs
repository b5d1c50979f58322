//! Which column holds what.

use crate::fault::bad_question;
use anyhow::{bail, ensure};

/// Three columns that belong together, or none of them.
pub(super) type Triple = Option<[usize; 3]>;

/// The names of a file's columns.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    pub(super) names: Vec<String>,
    /// Named on the command line and not by the file.
    asked: bool,
}

impl Columns {
    /// Columns as named by the file, or on the command line if `asked`.
    ///
    /// # Errors
    /// If two have the same name.
    pub(super) fn new(names: Vec<String>, asked: bool) -> anyhow::Result<Self> {
        let columns = Self { names, asked };
        for (i, name) in columns.names.iter().enumerate() {
            if name != "_" && columns.names[..i].contains(name) {
                return Err(columns.wrong(format!("two columns are named `{name}`; call one of them `_`")));
            }
        }
        Ok(columns)
    }

    /// A fault of the names: of the command line if they stood there, of the file otherwise.
    fn wrong(&self, text: String) -> anyhow::Error {
        if self.asked { bad_question(text) } else { anyhow::anyhow!(text) }
    }

    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// The columns of a triple of these names.
    ///
    /// # Errors
    /// If there are some of them but not all.
    pub(super) fn triple(&self, names: [&str; 3]) -> anyhow::Result<Triple> {
        match names.map(|name| self.find(name)) {
            [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
            [None, None, None] => Ok(None),
            found => {
                let missing = (0..3).find(|&i| found[i].is_none()).expect("one is missing");
                let text = format!("there is no column {}, but others of {}", names[missing], names.join(", "));
                Err(self.wrong(text))
            }
        }
    }

    /// The columns of the positions.
    ///
    /// # Errors
    /// If there are none.
    pub(super) fn position(&self) -> anyhow::Result<[usize; 3]> {
        let how = if self.asked { "name them in --columns" } else { "name the columns with --columns" };
        let missing = || self.wrong(format!("columns x, y and z are needed; {how}"));
        self.triple(["x", "y", "z"])?.ok_or_else(missing)
    }

    /// Names in the file that are none of `known`, and not skipped; on the command line there may be none.
    ///
    /// # Errors
    /// If names typed are not known.
    pub(super) fn unknown(&self, known: &[&str]) -> anyhow::Result<Vec<String>> {
        let unknown = self.names.iter().filter(|name| *name != "_" && !known.contains(&name.as_str()));
        let unknown: Vec<String> = unknown.cloned().collect();
        if self.asked && !unknown.is_empty() {
            let known = known.join(", ");
            return Err(bad_question(format!(
                "--columns: no column is named {}; there are {known}, and _",
                unknown.join(", ")
            )));
        }
        Ok(unknown)
    }
}

/// The fields of a line of names.
///
/// # Errors
/// If the line holds numbers.
pub(super) fn names_of(fields: &[&str]) -> anyhow::Result<Vec<String>> {
    let clean = |field: &&str| field.trim_matches(['"', '\'']).trim().to_owned();
    let names: Vec<String> = fields.iter().map(clean).collect();
    if names.iter().any(|name| name.parse::<f64>().is_ok()) {
        bail!("the first line holds numbers, not the names of the columns; name them with --columns");
    }
    ensure!(!names.is_empty(), "the file is empty: not even a line of names");
    Ok(names)
}
