//! Text from files as it may be shown: nothing in it moves the cursor, hides a line or begins one.

use std::borrow::Cow;

/// The text, with what is no mark on paper spelled out as Rust spells it (`\u{1b}`).
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    if text.chars().all(is_printable) {
        return Cow::Borrowed(text);
    }
    let spell = |c: char| if is_printable(c) { c.to_string() } else { c.escape_default().to_string() };
    Cow::Owned(text.chars().map(spell).collect())
}

/// Neither a control character nor one that turns the direction of what follows.
fn is_printable(c: char) -> bool {
    !c.is_control() && !matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_a_cursor_is_spelled_out() {
        assert_eq!(printable("grün, \"x\" \\ 7"), "grün, \"x\" \\ 7");
        assert_eq!(printable("a\u{1b}[2J\nb\u{202e}c\u{7f}\u{9b}"), "a\\u{1b}[2J\\nb\\u{202e}c\\u{7f}\\u{9b}");
    }
}
