//! Vocabularies: what the words of some labels add to the stages.

use crate::line::with_variables;
use crate::table::{Table, lines};
use crate::template::Template;
use crate::{Stage, TableError};
use pm_registry::Choice as _;

/// What a word does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// It adds a text to a stage.
    Adds(Stage, Template),
    /// It adds nothing, and the line has to say it: this text stands somewhere in what runs.
    Said(String),
}

/// The word of a line that stands for [`Meaning::Said`].
const SAID: &str = "said";

struct Entry {
    label: String,
    word: String,
    meaning: Option<Meaning>,
}

/// The vocabularies of a file such as `scripts/words.csv`: lines of label, word, stage and text.
#[derive(Default)]
pub struct Words {
    /// What the file is called in messages.
    file: String,
    entries: Vec<Entry>,
}

impl Words {
    /// Reads vocabularies; `variable` is the value of a variable, as in tables.
    ///
    /// # Errors
    /// If a line is not of four cells, or its stage is none that words can add to.
    pub fn read(file: &str, text: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<Self, TableError> {
        let mut words = Self { file: file.into(), entries: vec![] };
        for line in lines(file, text)?.iter().skip(1) {
            let error = |what: String| TableError { file: file.into(), line: line.number, what };
            let [label, word, stage, text] = &line.cells[..] else {
                return Err(error("four cells are expected: label, word, stage, text".into()));
            };
            let text = with_variables(text, variable).map_err(error)?;
            let meaning = match Stage::of_word(stage) {
                Some(stage @ (Stage::Photons | Stage::Queries | Stage::Stream | Stage::Gather | Stage::Cache)) => {
                    Some(Meaning::Adds(stage, Template::new(&text)))
                }
                _ if stage == SAID && !text.is_empty() => Some(Meaning::Said(text)),
                _ if stage.is_empty() && text.is_empty() => None,
                _ => return Err(error(format!("`{stage}` is no stage that a word adds to, nor `{SAID}`"))),
            };
            words.entries.push(Entry { label: label.clone(), word: word.clone(), meaning });
        }
        Ok(words)
    }

    /// Whether there is a vocabulary of this label.
    pub(crate) fn has(&self, label: &str) -> bool {
        self.entries.iter().any(|entry| entry.label == label)
    }

    /// The labels that there are vocabularies of.
    pub(crate) fn labels(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|entry| entry.label.as_str())
    }

    /// What a word of a label does; nothing if it adds nothing, or if the label has no vocabulary.
    pub(crate) fn meanings(&self, label: &str, word: &str) -> impl Iterator<Item = &Meaning> {
        let here = move |entry: &&Entry| entry.label == label && entry.word == word;
        self.entries.iter().filter(here).filter_map(|entry| entry.meaning.as_ref())
    }

    /// That a label with a vocabulary has a word of it.
    pub(crate) fn know(&self, table: &Table, line: u64, label: &str, word: &str) -> Result<(), TableError> {
        let of_label: Vec<&str> = self.entries.iter().filter(|e| e.label == label).map(|e| e.word.as_str()).collect();
        if of_label.is_empty() || of_label.contains(&word) {
            return Ok(());
        }
        let near = nearest(word, of_label.into_iter());
        let hint = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        Err(table.error(line, format!("`{word}` is no {label} that {} knows{hint}", self.file)))
    }
}

/// The word that may have been meant.
pub(crate) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let near = known.map(|other| (strsim::damerau_levenshtein(word, other), other));
    // Two letters off, but no more than a third of them.
    near.filter(|(off, other)| *off <= 2 && 3 * off <= other.len()).min_by_key(|(off, _)| *off).map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words() {
        let near = |word| nearest(word, ["photons", "queries", "map"].into_iter());
        assert_eq!((near("photon"), near("querise"), near("mpa")), (Some("photons"), Some("queries"), Some("map")));
        assert_eq!((near("k"), near("me"), near("maximum")), (None, None, None));
    }

    #[test]
    fn what_is_no_vocabulary_is_refused_with_its_line() {
        let read = |line: &str| Words::read("w.csv", &format!("label,word,stage,text\n{line}\n"), &|_| None);
        assert!(read("a,b,gather,-k 5").is_ok_and(|words| words.has("a") && !words.has("b")));
        for line in ["a,b,point,x", "a,b,gathers,-k 5", "a,b,,x", "a,b,said,", "a,b,gather", "a,b,gather,$(X)"] {
            assert!(read(line).is_err_and(|error| error.line == 2), "{line}");
        }
    }
}
