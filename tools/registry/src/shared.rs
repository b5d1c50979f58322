//! A parameter of several entries: one option of a command line, and which of them it is for.

use crate::Parameter;

/// The parameters of one name in a registry.
#[derive(Clone, Debug)]
pub struct Shared {
    /// The entries that take it, each with its own declaration; of a common one that declaration alone.
    takers: Vec<(Option<&'static str>, &'static Parameter)>,
}

impl Shared {
    pub(crate) fn common(parameter: &'static Parameter) -> Self {
        Self { takers: vec![(None, parameter)] }
    }

    pub(crate) fn of(entry: &'static str, parameter: &'static Parameter) -> Self {
        Self { takers: vec![(Some(entry), parameter)] }
    }

    pub(crate) fn add(&mut self, entry: &'static str, parameter: &'static Parameter) {
        self.takers.push((Some(entry), parameter));
    }

    /// The first declaration: name and domain are those of all.
    #[must_use]
    pub fn parameter(&self) -> &'static Parameter {
        self.takers[0].1
    }

    /// Do all entries take it?
    #[must_use]
    pub fn is_common(&self) -> bool {
        self.takers[0].0.is_none()
    }

    /// The words of the entries that take it; none of a common one.
    #[must_use]
    pub fn takers(&self) -> Vec<&'static str> {
        self.takers.iter().filter_map(|(entry, _)| *entry).collect()
    }

    /// The default, where all entries have the same.
    #[must_use]
    pub fn default(&self) -> Option<&'static str> {
        let default = self.parameter().default?;
        self.takers.iter().all(|(_, parameter)| parameter.default == Some(default)).then_some(default)
    }

    /// Is it left out of a short help, whichever entry takes it?
    #[must_use]
    pub fn is_hidden(&self) -> bool {
        self.takers.iter().all(|(_, parameter)| parameter.is_hidden)
    }

    /// What it says, and to which entries: `kd, bucket-kd: where nodes lie in memory`.
    #[must_use]
    pub fn help(&self) -> String {
        if self.is_common() {
            let mut letters = self.parameter().help.chars();
            return letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
        }
        // Entries of which the same is said are listed together.
        let mut said: Vec<(Vec<&str>, String)> = vec![];
        for (entry, parameter) in &self.takers {
            let own = parameter.default.filter(|_| self.default().is_none());
            let text = own.map_or_else(
                || parameter.help.to_owned(),
                |default| format!("{} [default: {default}]", parameter.help),
            );
            match said.iter_mut().find(|(_, known)| *known == text) {
                Some((entries, _)) => entries.extend(entry),
                None => said.push((entry.iter().copied().collect(), text)),
            }
        }
        let said: Vec<_> = said.into_iter().map(|(entries, text)| format!("{}: {text}", entries.join(", "))).collect();
        said.join("; ")
    }

    /// What else a long help says; may be empty.
    #[must_use]
    pub fn details(&self) -> String {
        let mut details: Vec<&str> = self.takers.iter().map(|(_, parameter)| parameter.details).collect();
        details.dedup();
        details.join(" ").trim().to_owned()
    }
}
