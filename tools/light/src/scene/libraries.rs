//! Which files an `mtllib` statement names.
//!
//! It takes a list of names split by blanks; but names have blanks too, some writers put them in quotes, and others name the
//! path that the file had on the machine they ran on.

use super::error::{FileLine, SceneError};
use super::files::{Files, places, remark_if_outside};
use super::statements::Statement;
use super::warnings::Warnings;
use std::io;
use std::path::{Path, PathBuf};

/// Most words that are tried together as one name.
const MOST_WORDS: usize = 16;

/// A file that was found, and what it holds.
type Library = (PathBuf, Vec<u8>);

/// The libraries that a statement of the OBJ file `obj` names and that are there.
///
/// # Errors
/// If one is missing and that is not tolerated.
pub(super) fn named(
    obj: &Path,
    statement: &Statement<'_>,
    files: &dyn Files,
    warnings: &mut Warnings,
) -> Result<Vec<Library>, SceneError> {
    let at_line = FileLine::new(obj, statement.line);
    let rest = statement.rest();
    if rest.is_empty() {
        warnings.tolerate("mtllib", at_line.error("mtllib without a name; give the MTL file's"), "it is left out")?;
        return Ok(vec![]);
    }
    let missing = |name: &str, source: io::Error, warnings: &mut Warnings| {
        let wrong = SceneError::MissingMtl { place: at_line.clone(), name: name.to_owned(), source };
        warnings.tolerate(&format!("mtllib {name}"), wrong, "its materials are grey 0.5")
    };
    let whole = match look(obj, rest.trim_matches('"'), &at_line, files, warnings) {
        Ok(library) => return Ok(vec![library]),
        Err(error) => error,
    };
    let words = words(rest);
    let mut found = vec![];
    let mut lost = vec![];
    let mut at = 0;
    while at < words.len() {
        // The longest name that is there counts.
        let ends = (at + 1..=words.len().min(at + MOST_WORDS)).rev();
        let library = ends.into_iter().find_map(|end| {
            let name = &rest[words[at].start..words[end - 1].end];
            look(obj, name.trim_matches('"'), &at_line, files, warnings).ok().map(|library| (library, end))
        });
        match library {
            Some((library, end)) => {
                found.push(library);
                at = end;
            }
            None => {
                lost.push(rest[words[at].clone()].trim_matches('"'));
                at += 1;
            }
        }
    }
    if found.is_empty() {
        missing(rest.trim_matches('"'), whole, warnings)?;
    } else {
        lost.iter().try_for_each(|name| missing(name, io::ErrorKind::NotFound.into(), warnings))?;
    }
    Ok(found)
}

/// A library of this name beside the OBJ, or of its bare name if it is the path of another machine.
fn look(obj: &Path, name: &str, at_line: &FileLine, files: &dyn Files, warnings: &mut Warnings) -> io::Result<Library> {
    let name = name.replace('\\', "/");
    let mut error = None;
    for path in places(obj, &name) {
        match files.read_named(&path) {
            Ok(bytes) => {
                if error.is_none() {
                    remark_if_outside(obj, &name, warnings);
                } else {
                    warnings.say(format!("{at_line}: there is no {name:?}; {} is taken for it", path.display()));
                }
                return Ok((path, bytes));
            }
            // Why the name itself cannot be read says more than why its end cannot.
            Err(why) => error = error.or(Some(why)),
        }
    }
    Err(error.unwrap_or_else(|| io::ErrorKind::NotFound.into()))
}

/// Where the words of a list of names are, up to a comment; what stands in quotes is one word.
fn words(rest: &str) -> Vec<std::ops::Range<usize>> {
    let mut words = vec![];
    let mut at = 0;
    loop {
        at += rest[at..].len() - rest[at..].trim_start().len();
        let word = &rest[at..];
        if word.is_empty() || word.starts_with('#') {
            return words;
        }
        let length = match word.strip_prefix('"').and_then(|quoted| quoted.find('"')) {
            Some(end) => end + 2,
            None => word.find(char::is_whitespace).unwrap_or(word.len()),
        };
        words.push(at..at + length);
        at += length;
    }
}
