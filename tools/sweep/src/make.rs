//! Text as make reads it.

/// A text within the value of a variable or a recipe: what make would take for a variable or a remark stays the shell's.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    let mut backslashes = 0;
    for letter in text.chars() {
        match letter {
            '$' => escaped.push_str("$$"),
            // Backslashes before it are read in pairs.
            '#' => {
                escaped.push_str(&"\\".repeat(backslashes + 1));
                escaped.push('#');
            }
            _ => escaped.push(letter),
        }
        backslashes = if letter == '\\' { backslashes + 1 } else { 0 };
    }
    escaped
}

/// A word of a shell's in a recipe, whatever it holds.
pub(crate) fn quoted(word: &str) -> String {
    if !word.is_empty() && word.chars().all(|c| c.is_ascii_alphanumeric() || "._-+@/,:=".contains(c)) {
        return word.into();
    }
    // A recipe has no remarks of make's.
    format!("'{}'", word.replace('\'', "'\\''").replace('$', "$$"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_the_shells_stays_the_shells() {
        assert_eq!(escaped("$((1 + $x)) a#b c\\#d"), "$$((1 + $$x)) a\\#b c\\\\\\#d");
        assert_eq!(quoted("a/b-1.csv"), "a/b-1.csv");
        assert_eq!(quoted("my $x's/a#.csv"), "'my $$x'\\''s/a#.csv'");
        assert_eq!(quoted(""), "''");
    }
}
