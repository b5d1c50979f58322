//! Text with words in braces that something stands for: `--tile {tile}`.

use std::borrow::Cow;

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(String),
    /// What stands in braces.
    Name(String),
}

/// Text with names in braces. `${name}` is the shell's, and so is what holds more than a name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Template(Vec<Part>);

/// Whether a text is what braces may hold and a column be called.
pub(crate) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-')
}

impl Template {
    pub(crate) fn new(text: &str) -> Self {
        let (mut parts, mut plain, mut rest) = (vec![], String::new(), text);
        while let Some(open) = rest.find('{') {
            let (before, braced) = rest.split_at(open);
            let name = braced[1..].split_once('}').map(|(name, _)| name).filter(|name| is_name(name));
            plain += before;
            match name.filter(|_| !before.ends_with('$')) {
                Some(name) => {
                    parts.extend([Part::Text(std::mem::take(&mut plain)), Part::Name(name.into())]);
                    rest = &braced[name.len() + 2..];
                }
                None => {
                    plain.push('{');
                    rest = &braced[1..];
                }
            }
        }
        plain += rest;
        parts.push(Part::Text(plain));
        Self(parts)
    }

    /// The names in braces.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|part| match part {
            Part::Name(name) => Some(name.as_str()),
            Part::Text(_) => None,
        })
    }

    /// The text, with what stands for each name; a name that nothing stands for is left in its braces.
    pub(crate) fn filled<'a>(&self, stands_for: impl Fn(&str) -> Option<&'a str>) -> String {
        let part = |part: &Part| match part {
            Part::Text(text) => Cow::Owned(text.clone()),
            Part::Name(name) => stands_for(name).map_or_else(|| Cow::Owned(format!("{{{name}}}")), Cow::Borrowed),
        };
        self.0.iter().map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_braces_and_the_shells_own() {
        let template = Template::new("{a}-{b_2} ${a} { echo; } {1,2} {} {c");
        assert_eq!(template.names().collect::<Vec<_>>(), ["a", "b_2"]);
        let filled = template.filled(|name| (name == "a").then_some("{b_2}"));
        assert_eq!(filled, "{b_2}-{b_2} ${a} { echo; } {1,2} {} {c", "what is filled in is not filled again");
    }
}
