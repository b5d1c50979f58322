//! Pieces of HTML.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// Text as HTML has it, in elements and in attributes in double quotes.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // What no HTML may hold.
            '\u{0}'..='\u{8}' | '\u{b}' | '\u{e}'..='\u{1f}' | '\u{7f}' => safe.push('\u{fffd}'),
            _ => safe.push(letter),
        }
    }
    safe
}

/// An attribute ` id="..."`, if there is an id.
pub(super) fn id_attribute(id: Option<&str>) -> String {
    id.map_or(String::new(), |id| format!(" id=\"{}\"", escaped(id)))
}

/// Bytes as an address that holds them.
pub(super) fn data_uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}

/// A name for links, made of the words of a heading.
pub(super) fn slug(heading: &str) -> String {
    let words = heading.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let slug = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    if slug.is_empty() { "section".to_owned() } else { slug }
}

/// Width and height of a PNG file.
pub(super) fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    (bytes.starts_with(b"\x89PNG\r\n\x1a\n") && bytes.get(12..16)? == b"IHDR").then_some(())?;
    Some((number(16)?, number(20)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_text_is_markup() {
        assert_eq!(escaped("a < b & \"c\" > d\u{7}"), "a &lt; b &amp; &quot;c&quot; &gt; d\u{fffd}");
    }

    #[test]
    fn headings_have_names() {
        assert_eq!(slug("Where methods fail: LRU, MIN"), "where-methods-fail-lru-min");
        assert_eq!(slug("?"), "section");
    }

    #[test]
    fn data_addresses_hold_the_bytes() {
        // RFC 4648, section 10.
        assert_eq!(data_uri("text/csv", b"foobar"), "data:text/csv;base64,Zm9vYmFy");
    }
}
