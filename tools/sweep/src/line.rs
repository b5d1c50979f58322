//! A line of a table with the values of its variables: texts of the stages, words of the labels.

use crate::template::Template;
use crate::{Column, Line, Stage, Table, TableError};
use std::collections::BTreeMap;

/// A label of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Label {
    pub(crate) name: String,
    /// At least one; an empty one for an empty cell.
    pub(crate) words: Vec<String>,
    /// Nothing that runs depends on it.
    pub(crate) remark: bool,
}

/// What a line gives.
#[derive(Clone, Debug)]
pub(crate) struct Given {
    pub(crate) line: u64,
    /// Cells that are not empty.
    pub(crate) texts: BTreeMap<Stage, Template>,
    /// Cells that hold a dash: words add nothing there.
    pub(crate) shut: Vec<Stage>,
    pub(crate) labels: Vec<Label>,
}

impl Given {
    pub(crate) fn new(
        table: &Table,
        line: &Line,
        variable: &dyn Fn(&str) -> Option<String>,
    ) -> Result<Self, TableError> {
        let mut given = Self { line: line.number, texts: BTreeMap::new(), shut: vec![], labels: vec![] };
        for (column, cell) in table.columns.iter().zip(&line.cells) {
            let text = with_variables(cell, variable).and_then(|text| readable(&text).map(|()| text));
            let text = text.map_err(|what| table.error(line.number, what))?;
            match column {
                Column::Stage(stage) if text == "-" => given.shut.push(*stage),
                Column::Stage(stage) => {
                    if stage.is_run() && text.contains('\'') {
                        let what =
                            "no ' may stand in what runs: it is one argument of a shell in single quotes; use \"";
                        return Err(table.error(line.number, what));
                    }
                    if !text.trim().is_empty() {
                        given.texts.insert(*stage, Template::new(&text));
                    }
                }
                Column::Label(name) => given.labels.push(label(name, &text, false, table, line.number)?),
                Column::Remark(name) => given.labels.push(label(name, &text, true, table, line.number)?),
            }
        }
        Ok(given)
    }

    /// A label of this name.
    pub(crate) fn label(&self, name: &str) -> Option<&Label> {
        self.labels.iter().find(|label| label.name == name)
    }
}

fn label(name: &str, text: &str, remark: bool, table: &Table, line: u64) -> Result<Label, TableError> {
    let inner = text.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
    let (text, remark) = (inner.unwrap_or(text), remark || inner.is_some());
    let mut words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
    if remark && words.len() > 1 {
        let what = format!("`{name}` is a remark here, and `{text}` would be {} points that do the same", words.len());
        return Err(table.error(line, what));
    }
    if words.is_empty() {
        words.push(String::new());
    }
    Ok(Label { name: name.into(), words, remark })
}

/// That no shell and no make would take a part of the text for a remark, or for two lines.
fn readable(text: &str) -> Result<(), String> {
    let remark = text.match_indices('#').any(|(at, _)| text[..at].chars().next_back().is_none_or(char::is_whitespace));
    match () {
        () if remark => {
            Err("a remark is a line of its own that begins with #: a shell would leave out the rest".into())
        }
        () if text.ends_with('\\') => Err("no \\ may end a cell".into()),
        () if text.chars().any(char::is_control) => Err("a cell holds a character that is none to be seen".into()),
        () => Ok(()),
    }
}

/// A cell with the values of the variables that it names as `$(NAME)`.
pub(crate) fn with_variables(text: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<String, String> {
    let (mut done, mut rest) = (String::new(), text);
    while let Some(at) = rest.find("$(") {
        let name = rest[at + 2..].split_once(')').map(|(name, _)| name);
        let is_name = |name: &&str| {
            name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
                && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        };
        let Some(name) = name.filter(is_name) else {
            // What looks like a command is the shell's.
            done += &rest[..at + 2];
            rest = &rest[at + 2..];
            continue;
        };
        let value = variable(name).ok_or_else(|| format!("$({name}) has no value: export it"))?;
        done += &rest[..at];
        done += &value;
        rest = &rest[at + name.len() + 3..];
    }
    Ok(done + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_and_what_is_the_shells() {
        let variable = |name: &str| (name == "SIZE_2").then(|| "8x8 $(X)".to_owned());
        let with = |text| with_variables(text, &variable);
        assert_eq!(with("a $(SIZE_2)b $((1 + 2)) $(seq 3) $x").unwrap(), "a 8x8 $(X)b $((1 + 2)) $(seq 3) $x");
        assert_eq!(with("$(NONE)").unwrap_err(), "$(NONE) has no value: export it");
        assert_eq!(with("$(open").unwrap(), "$(open");
    }

    #[test]
    fn remarks_within_cells() {
        for text in ["# x", "a #", "a # b"] {
            assert!(readable(text).is_err(), "{text}");
        }
        assert!(readable("a#b ${#c}").is_ok() && readable("a\u{7}").is_err() && readable("a\\").is_err());
    }
}
