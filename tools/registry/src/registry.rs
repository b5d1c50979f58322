//! Open sets of words.

use std::fmt;

/// A thing that can be chosen by its word.
pub trait Registered {
    /// The word: lower case, hyphens.
    fn word(&self) -> &'static str;

    /// What is said of it: one line, without a full stop.
    fn help(&self) -> &'static str;

    /// Words that are understood as well.
    fn aliases(&self) -> &'static [&'static str] {
        &[]
    }
}

/// Things that can be chosen by their words, in the order in which they are listed.
pub struct Registry<T: ?Sized + 'static> {
    /// What the things are, in the singular: "order".
    what: &'static str,
    entries: Vec<&'static T>,
}

impl<T: ?Sized> Clone for Registry<T> {
    fn clone(&self) -> Self {
        Self { what: self.what, entries: self.entries.clone() }
    }
}

/// There is no such word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownWord {
    what: &'static str,
    word: String,
    words: Vec<&'static str>,
}

impl fmt::Display for UnknownWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, word, words } = self;
        write!(f, "`{word}` is no {what}: there are {}", words.join(", "))
    }
}

impl std::error::Error for UnknownWord {}

impl<T: Registered + ?Sized> Registry<T> {
    /// These things, each of which is a `what`.
    ///
    /// # Panics
    /// If two have one word: a mistake in the source.
    #[must_use]
    pub fn new(what: &'static str, entries: &[&'static T]) -> Self {
        entries.iter().fold(Self { what, entries: vec![] }, |registry, entry| registry.with(*entry))
    }

    /// The same and one more, listed last.
    ///
    /// # Panics
    /// If its word is taken: a mistake in the source.
    #[must_use]
    pub fn with(mut self, entry: &'static T) -> Self {
        for word in entry.aliases().iter().chain([&entry.word()]) {
            assert!(self.find(word).is_err(), "the word {word} stands for two {}s", self.what);
        }
        self.entries.push(entry);
        self
    }

    /// What the things are, in the singular.
    #[must_use]
    pub const fn what(&self) -> &'static str {
        self.what
    }

    /// All of them, in the order in which they are listed.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &'static T> + '_ {
        self.entries.iter().copied()
    }

    /// Their words.
    #[must_use]
    pub fn words(&self) -> Vec<&'static str> {
        self.iter().map(Registered::word).collect()
    }

    /// The one with this word.
    ///
    /// # Errors
    /// If there is none; the error lists the words there are.
    pub fn find(&self, word: &str) -> Result<&'static T, UnknownWord> {
        let found = self.iter().find(|entry| entry.word() == word || entry.aliases().contains(&word));
        found.ok_or_else(|| UnknownWord { what: self.what, word: word.to_owned(), words: self.words() })
    }

    /// A table of them in Markdown, a row each, as documentation shows it.
    #[must_use]
    pub fn table(&self) -> String {
        let rows = self.iter().map(|entry| format!("| `{}` | {} |\n", entry.word(), entry.help()));
        format!("| {} | |\n| --- | --- |\n{}", self.what, rows.collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Tool(&'static str);

    impl Registered for Tool {
        fn word(&self) -> &'static str {
            self.0
        }
        fn help(&self) -> &'static str {
            "Does it"
        }
        fn aliases(&self) -> &'static [&'static str] {
            if self.0 == "saw" { &["Säge"] } else { &[] }
        }
    }

    #[test]
    fn a_word_finds_its_thing_and_another_is_told_of_all() {
        let tools = Registry::new("tool", &[&Tool("saw"), &Tool("axe")]);
        assert_eq!(tools.find("Säge").map(|tool| tool.0), Ok("saw"));
        let said = tools.find("sew").err().map(|error| error.to_string());
        assert_eq!(said.as_deref(), Some("`sew` is no tool: there are saw, axe"));
        assert_eq!(tools.with(&Tool("file")).words(), ["saw", "axe", "file"]);
    }

    #[test]
    fn the_table_has_a_row_for_each() {
        let tools = Registry::new("tool", &[&Tool("saw")]);
        assert_eq!(tools.table(), "| tool | |\n| --- | --- |\n| `saw` | Does it |\n");
    }

    #[test]
    #[should_panic(expected = "the word Säge stands for two tools")]
    fn no_word_stands_for_two() {
        let _ = Registry::new("tool", &[&Tool("Säge"), &Tool("saw")]);
    }
}
