//! What documentation and help say of the formats, from the formats' own lines.

use super::{AssumedSize, TraceExport, TraceImport};
use pm_registry::Registry;
use std::fmt::Write as _;

/// The formats as a table in Markdown, a row each: what it is, bytes of an access, whether it is read and written.
#[must_use]
pub fn table(imports: &Registry<dyn TraceImport>, exports: &Registry<dyn TraceExport>) -> String {
    let mut table =
        String::from("| format | an entry | bytes of an access | read | written |\n| --- | --- | --- | --- | --- |\n");
    for import in imports.iter() {
        let size = match import.assumed_size() {
            None => "as it says".to_owned(),
            Some(AssumedSize { bytes, aligned: true }) => format!("{bytes}, and the address that of a word"),
            Some(AssumedSize { bytes, .. }) if import.example().entries.iter().any(|entry| entry.len.is_some()) => {
                format!("as it says, or {bytes}")
            }
            Some(AssumedSize { bytes, .. }) => bytes.to_string(),
        };
        let written = if exports.find(import.word()).is_ok() { "yes" } else { "" };
        let _ = writeln!(table, "| `{}` | {} | {size} | yes | {written} |", import.word(), import.help());
    }
    for export in exports.iter().filter(|export| imports.find(export.word()).is_err()) {
        let _ = writeln!(table, "| `{}` | {} | | | yes |", export.word(), export.help());
    }
    table
}

/// How many bytes are taken for an access where the entry does not say, format by format, in words for a help.
#[must_use]
pub fn assumed_sizes(imports: &Registry<dyn TraceImport>) -> String {
    let mut sizes: Vec<(AssumedSize, Vec<&str>)> = vec![];
    for import in imports.iter() {
        match import.assumed_size() {
            None | Some(AssumedSize::BYTE) => {}
            Some(size) => match sizes.iter_mut().find(|(known, _)| *known == size) {
                Some((_, words)) => words.push(import.word()),
                None => sizes.push((size, vec![import.word()])),
            },
        }
    }
    let said = sizes.iter().map(|(size, words)| {
        let word = if size.aligned { " and the address that of a word" } else { "" };
        let words = match words.split_last() {
            Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
            _ => words.concat(),
        };
        format!("{words} {}{word}, ", size.bytes)
    });
    said.collect::<String>() + "others 1"
}

#[cfg(test)]
mod tests {
    use crate::traces::{exports, imports};

    #[test]
    fn the_documentation_has_the_row_of_every_format() {
        let documentation = include_str!("../../../../formats/EXCHANGE.md");
        let table = super::table(&imports(), &exports());
        assert!(documentation.contains(&table), "formats/EXCHANGE.md has not this table:\n{table}");
    }

    #[test]
    fn sizes_are_told_by_those_that_have_them() {
        let said = "din 4 and the address that of a word, spike 8, \
                    dramsim3, stl, ramulator1, ramulator-cpu and ramulator2 64, others 1";
        assert_eq!(super::assumed_sizes(&imports()), said);
    }
}
