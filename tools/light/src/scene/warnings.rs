//! Remarks on a scene, each said once however often its cause occurs.

use super::error::SceneError;
use std::collections::HashMap;

/// Collects remarks; the library keeps them, only programs print.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    strict: bool,
    said: Vec<(String, usize)>,
    by_key: HashMap<String, usize>,
}

impl Warnings {
    /// No remarks yet; if `strict`, what is wrong is no remark but an error.
    pub(crate) fn new(strict: bool) -> Self {
        Self { strict, ..Self::default() }
    }

    /// What is wrong but can be gone on with, if this is then done: said once under a key.
    pub(crate) fn tolerate(&mut self, key: &str, wrong: SceneError, then: &str) -> Result<(), SceneError> {
        if self.strict {
            return Err(wrong);
        }
        self.once(key, || format!("{wrong}: {then}"));
        Ok(())
    }

    /// Keeps `text` unless something was already said under this key; then only counts.
    pub(crate) fn once(&mut self, key: &str, text: impl FnOnce() -> String) {
        match self.by_key.get(key) {
            Some(&i) => self.said[i].1 += 1,
            None => {
                self.by_key.insert(key.to_owned(), self.said.len());
                self.said.push((text(), 1));
            }
        }
    }

    /// Keeps `text`.
    pub(crate) fn say(&mut self, text: String) {
        self.said.push((text, 1));
    }

    /// What was said under keys that begin so.
    pub(crate) fn under<'a>(&'a self, beginning: &'a str) -> impl Iterator<Item = &'a str> {
        let mut found: Vec<usize> =
            self.by_key.iter().filter(|(key, _)| key.starts_with(beginning)).map(|(_, &i)| i).collect();
        found.sort_unstable();
        found.into_iter().map(|i| &*self.said[i].0)
    }

    /// The remarks in the order in which their causes first occurred.
    pub(crate) fn into_lines(self) -> Vec<String> {
        let line = |(text, count)| match count {
            1 => text,
            _ => format!("{text} (and {} more like this)", count - 1),
        };
        self.said.into_iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Is a repeated cause one line with a count, in the order of first occurrence?
    #[test]
    fn repeated_causes_are_one_line() {
        let mut warnings = Warnings::default();
        warnings.once("x", || "x at 1".into());
        warnings.say("y".into());
        warnings.once("x", || unreachable!("already said"));
        warnings.once("x", || unreachable!("already said"));
        assert_eq!(warnings.into_lines(), ["x at 1 (and 2 more like this)", "y"]);
    }
}
