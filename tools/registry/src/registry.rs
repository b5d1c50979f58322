//! Open sets of words.

use crate::{ChoiceError, Chosen, Parameter, ParameterError, Registered, Shared, UnknownWord, Values};

/// Things that can be chosen by their words, in the order in which they are listed.
pub struct Registry<T: ?Sized + 'static> {
    /// What the things are, in the singular: "order".
    what: &'static str,
    entries: Vec<&'static T>,
    /// What may be said to every one of them.
    common: &'static [Parameter],
}

impl<T: ?Sized> Clone for Registry<T> {
    fn clone(&self) -> Self {
        Self { what: self.what, entries: self.entries.clone(), common: self.common }
    }
}

impl<T: Registered + ?Sized> Registry<T> {
    /// These things, each of which is a `what`.
    ///
    /// # Panics
    /// If two have one word: a mistake in the source.
    #[must_use]
    pub fn new(what: &'static str, entries: &[&'static T]) -> Self {
        entries.iter().fold(Self { what, entries: vec![], common: &[] }, |registry, entry| registry.with(*entry))
    }

    /// The same and one more, listed last.
    ///
    /// # Panics
    /// If its word is taken, or a name of its parameters by one of other values: a mistake in the source.
    #[must_use]
    pub fn with(mut self, entry: &'static T) -> Self {
        for word in entry.aliases().iter().chain([&entry.word()]) {
            assert!(self.find(word).is_err(), "the word {word} stands for two {}s", self.what);
        }
        for parameter in entry.parameters() {
            let same = |shared: &Shared| !shared.is_common() && shared.parameter().domain.is_same_as(&parameter.domain);
            let known = self.parameters().into_iter().find(|shared| shared.parameter().name == parameter.name);
            assert!(known.is_none_or(|shared| same(&shared)), "--{} of {} is another's", parameter.name, entry.word());
        }
        self.entries.push(entry);
        self
    }

    /// The same, where all entries take these parameters, whether they are of use to them or not.
    #[must_use]
    pub fn with_common(self, common: &'static [Parameter]) -> Self {
        Self { common, ..self }
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

    /// What may be said to any of them: a line for each name, those first that are common to all.
    #[must_use]
    pub fn parameters(&self) -> Vec<Shared> {
        let mut all: Vec<Shared> = self.common.iter().map(Shared::common).collect();
        for entry in self.iter() {
            for parameter in entry.parameters() {
                match all.iter_mut().find(|shared| shared.parameter().name == parameter.name) {
                    Some(shared) => shared.add(entry.word(), parameter),
                    None => all.push(Shared::of(entry.word(), parameter)),
                }
            }
        }
        all
    }

    /// One of them, asked with these options: name and text of each.
    ///
    /// # Errors
    /// See [`Values::new`].
    pub fn ask<'a>(
        &self,
        entry: &'static T,
        given: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Chosen<T>, ParameterError> {
        let values = Values::new(entry.word(), self.common.iter().chain(entry.parameters()), given);
        let values = values.map_err(|error| match error {
            ParameterError::NotTaken { entry, name, .. } => {
                let known = self.parameters().into_iter().find(|shared| shared.parameter().name == name);
                ParameterError::NotTaken { entry, name, takers: known.map_or(vec![], |shared| shared.takers()) }
            }
            error => error,
        })?;
        Ok(Chosen { entry, values })
    }

    /// The one that a line asks for: its word, and options as on a command line (`kd --layout veb --pad`).
    ///
    /// # Errors
    /// If there is none, or it cannot be asked like this.
    pub fn choose(&self, line: &str) -> Result<Chosen<T>, ChoiceError> {
        let mut words = line.split_whitespace();
        let entry = self.find(words.next().unwrap_or_default())?;
        let parameters = self.parameters();
        let mut given = vec![];
        while let Some(word) = words.next() {
            let unexpected = || ParameterError::Unexpected(word.to_owned());
            let name = word.strip_prefix("--").ok_or_else(unexpected)?;
            let known = parameters.iter().find(|shared| shared.parameter().name == name);
            // What nobody takes is refused below, whatever follows it.
            let takes_value = known.map(|shared| !shared.parameter().is_flag());
            let text = if takes_value == Some(true) { words.next().ok_or_else(unexpected)? } else { "" };
            given.push((name, text));
            if takes_value.is_none() {
                break;
            }
        }
        Ok(self.ask(entry, given)?)
    }

    /// A table of them in Markdown, a row each, as documentation shows it; with their options if any has some.
    #[must_use]
    pub fn table(&self) -> String {
        let with_options = self.iter().any(|entry| !entry.parameters().is_empty());
        let options = |entry: &T| {
            let names: Vec<_> = entry.parameters().iter().map(|parameter| format!("`--{}`", parameter.name)).collect();
            if with_options { format!(" {} |", names.join(", ")) } else { String::new() }
        };
        let rows = self.iter().map(|entry| format!("| `{}` | {} |{}\n", entry.word(), entry.help(), options(entry)));
        let rows: String = rows.collect();
        let (head, rule) = if with_options { (" options |", " --- |") } else { ("", "") };
        format!("| {} | |{head}\n| --- | --- |{rule}\n{rows}", self.what)
    }
}

#[cfg(test)]
mod tests;
