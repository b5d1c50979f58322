//! By which names links reach the sections and blocks of a page.

use super::Description;
use crate::ReportError;
use std::collections::BTreeSet;

impl Description {
    /// A name for each section, the one given or the words of its heading; and all names that are taken.
    ///
    /// # Errors
    /// If a name that is given cannot be one, with its line.
    pub(super) fn ids(&self) -> Result<(Vec<String>, BTreeSet<String>), ReportError> {
        let mut taken: BTreeSet<String> = BTreeSet::new();
        // Names that are given come first, whatever headings there are.
        for section in &self.section {
            let inside = section.as_ref();
            let blocks = inside.blocks();
            let given = blocks.iter().filter_map(|(start, block)| Some((*start, block.id()?)));
            for (start, id) in inside.id.as_deref().map(|id| (section.span().start, id)).into_iter().chain(given) {
                if id.is_empty() || id.contains(char::is_whitespace) || !taken.insert(id.to_owned()) {
                    let wrong = format!("`{id}` as an id is empty, has blanks or is there twice");
                    return Err(ReportError::asked(wrong).at_line(self.line(start)));
                }
            }
        }
        let sections = self.section.iter().map(|section| match &section.as_ref().id {
            Some(id) => id.clone(),
            None => {
                let slug = slug(&section.as_ref().heading);
                let mut numbered = (2..).map(|number| format!("{slug}-{number}"));
                let mut id = slug.clone();
                while !taken.insert(id.clone()) {
                    id = numbered.next().unwrap_or_default();
                }
                id
            }
        });
        Ok((sections.collect(), taken))
    }
}

/// A name for links, made of the words of a heading.
fn slug(heading: &str) -> String {
    let words = heading.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let slug = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    if slug.is_empty() { "section".to_owned() } else { slug }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_have_names() {
        assert_eq!(slug("Where methods fail: LRU, MIN"), "where-methods-fail-lru-min");
        assert_eq!(slug("?"), "section");
    }
}
