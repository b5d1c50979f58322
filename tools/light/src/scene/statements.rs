//! OBJ and MTL as numbered statements: byte-order mark, line ends, continued lines, comments.

use std::borrow::Cow;
use std::path::Path;

use super::error::{FileLine, SceneError};

/// One statement: its keyword, the rest of its text, and the line on which it begins.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Statement<'a> {
    pub(crate) line: u32,
    text: Cow<'a, str>,
}

impl Statement<'_> {
    /// The first word.
    pub(crate) fn keyword(&self) -> &str {
        self.text.split_whitespace().next().unwrap_or("")
    }

    /// All after the keyword, unsplit: names and paths may hold spaces and `#`.
    pub(crate) fn rest(&self) -> &str {
        self.text[self.keyword().len()..].trim()
    }

    /// The words after the keyword, up to a comment.
    pub(crate) fn words(&self) -> impl Iterator<Item = &str> {
        self.text.split_whitespace().skip(1).take_while(|word| !word.starts_with('#'))
    }

    /// Every word after the keyword as a finite number that single precision can hold.
    ///
    /// # Errors
    ///
    /// Names the first word that is not one.
    pub(crate) fn numbers(&self) -> Result<Vec<f32>, String> {
        self.words().map(number).collect()
    }
}

/// A finite single-precision number.
///
/// # Errors
///
/// Says what the word is instead.
pub(crate) fn number(word: &str) -> Result<f32, String> {
    match word.parse::<f32>() {
        Ok(x) if x.is_finite() => Ok(x),
        Ok(x) if x.is_nan() => Err(format!("{word:?} is not a number; export the file again or edit this line")),
        Ok(_) => Err(format!("{word:?} is infinite in single precision; scale the scene down")),
        Err(_) => Err(format!("{word:?} is not a number")),
    }
}

/// Cuts a file into its statements, without comments and empty lines.
///
/// Bytes that are not UTF-8 (Latin-1 names, say) become replacement characters, alike in OBJ and MTL.
///
/// # Errors
///
/// [`SceneError::Statement`] for a file with zero bytes: UTF-16, or not text at all.
pub(crate) fn statements<'a>(file: &Path, bytes: &'a [u8]) -> Result<Vec<Statement<'a>>, SceneError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if let Some(at) = bytes.iter().position(|&b| b == 0) {
        let line = 1 + bytes[..at].iter().filter(|&&b| b == b'\n').count() as u32;
        return Err(FileLine::new(file, line).error("a zero byte: not a text file; save it as UTF-8 text"));
    }
    // Files from before 2001 end their lines with a carriage return alone.
    let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    let mut out: Vec<Statement<'a>> = Vec::new();
    let mut continued = false;
    for (i, raw) in bytes.split(|&b| b == end).enumerate() {
        let text = trim(String::from_utf8_lossy(raw));
        let (text, continues) = match text.strip_suffix('\\') {
            Some(head) if !text.starts_with('#') => (trim(Cow::Owned(head.to_owned())), true),
            _ => (text, false),
        };
        match out.last_mut().filter(|_| continued) {
            Some(open) => {
                let joined = open.text.to_mut();
                joined.push(' ');
                joined.push_str(&text);
            }
            None => out.push(Statement { line: i as u32 + 1, text }),
        }
        continued = continues;
    }
    out.retain(|statement| !statement.text.trim().is_empty() && !statement.text.trim_start().starts_with('#'));
    for statement in &mut out {
        if statement.text.starts_with(char::is_whitespace) {
            statement.text = Cow::Owned(statement.text.trim().to_owned());
        }
    }
    Ok(out)
}

fn trim(text: Cow<'_, str>) -> Cow<'_, str> {
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim()),
        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keywords(bytes: &[u8]) -> Vec<(u32, String, String)> {
        let all = statements(Path::new("t.obj"), bytes).unwrap();
        all.iter().map(|s| (s.line, s.keyword().to_owned(), s.rest().to_owned())).collect()
    }

    fn row(line: u32, keyword: &str, rest: &str) -> (u32, String, String) {
        (line, keyword.to_owned(), rest.to_owned())
    }

    /// Is the first statement found behind a byte-order mark? (It is often `mtllib`.)
    #[test]
    fn byte_order_mark_does_not_hide_the_first_statement() {
        assert_eq!(keywords(b"\xef\xbb\xbfmtllib a.mtl\n"), [row(1, "mtllib", "a.mtl")]);
    }

    /// Do line numbers survive comments, empty lines, continued lines and all three line ends?
    #[test]
    fn lines_are_numbered_as_an_editor_does() {
        assert_eq!(keywords(b"# c\n\nf 1 2 \\\r\n 3\r\no x"), [row(3, "f", "1 2 3"), row(5, "o", "x")]);
        assert_eq!(keywords(b"v 1\rv 2"), [row(1, "v", "1"), row(2, "v", "2")]);
        assert_eq!(keywords(b"\\\n\\\n v 1"), [row(1, "v", "1")]);
    }

    /// Is UTF-16 named for what it is rather than read as an empty scene?
    #[test]
    fn zero_bytes_are_an_error() {
        let error = statements(Path::new("t.obj"), b"v 1\nv\0").unwrap_err().to_string();
        assert_eq!(error, "t.obj:2: a zero byte: not a text file; save it as UTF-8 text");
    }

    /// Are words before a comment numbers, and NaN, infinity and overflow none?
    #[test]
    fn numbers_are_finite() {
        let all = statements(Path::new("t"), b"v 1 -.5 1e3 # here\nv nan\nv 1e39\nv 1,5").unwrap();
        assert_eq!(all[0].numbers().unwrap(), [1.0, -0.5, 1000.0]);
        assert!(all[1].numbers().unwrap_err().contains("\"nan\" is not a number"));
        assert!(all[2].numbers().unwrap_err().contains("infinite"));
        assert!(all[3].numbers().unwrap_err().contains("\"1,5\""));
    }
}
