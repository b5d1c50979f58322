//! The header of the whole, from those of its parts.

use super::PartsError;
use super::history::whole_history;
use crate::container::{Header, StreamKind};
use crate::history::Step;
use crate::vocabulary::{Part, meaning};

/// Which part of a stream a header is of, if it is one of a part.
#[must_use]
pub fn part_of(header: &Header) -> Option<Part> {
    header.meaning(meaning::PART)?.parse().ok()
}

/// The header of the stream that these are the parts of, each given with its name, in whatever order.
///
/// # Errors
/// [`PartsError::Unfit`] if one is missing, doubled, or of another stream.
pub fn whole_header(parts: &[(&str, StreamKind, &Header)]) -> Result<(StreamKind, Header), PartsError> {
    let unfit = |what: String| Err(PartsError::Unfit(what));
    let Some(&(first, kind, header)) = parts.first() else { return unfit("no part is given".into()) };
    let mut found = vec![];
    for &(name, other, header) in parts {
        let Some(part) = header.meaning(meaning::PART) else {
            return unfit(format!("{name}: not a part of a stream, but a whole one; parts are made with --part"));
        };
        let Ok(part) = part.parse::<Part>() else {
            return unfit(format!("{name}: its header says that it is part `{part}`; 2/8, say, is expected"));
        };
        if other != kind {
            return unfit(format!("{name} holds {}, but {first} {}", other.plural(), kind.plural()));
        }
        found.push((name, part));
    }
    each_part_once(&found)?;
    let plain = without_history(header);
    for &(name, _, header) in parts {
        if let Some(what) = difference(&plain, &without_history(header)) {
            return unfit(format!("{first} and {name} are parts of two streams: {what} differ"));
        }
    }
    let histories: Vec<(&str, &[Step])> = parts.iter().map(|(name, _, header)| (*name, &header.history[..])).collect();
    Ok((kind, Header { history: whole_history(&histories)?, ..plain }))
}

/// Checks that these are all parts of one division, each once; they are given with their names.
///
/// # Errors
/// [`PartsError::Unfit`] if they are not.
pub fn each_part_once(parts: &[(&str, Part)]) -> Result<(), PartsError> {
    let unfit = |what: String| Err(PartsError::Unfit(what));
    let Some((first, of)) = parts.first().map(|(name, part)| (*name, part.of())) else {
        return unfit("no part is given".into());
    };
    let mut have: Vec<Option<&str>> = vec![None; usize::try_from(of).expect("at most Part::MOST")];
    for &(name, part) in parts {
        if part.of() != of {
            return unfit(format!("{name} is part {part}, but {first} is one of {of}"));
        }
        let place = &mut have[usize::try_from(part.number() - 1).expect("below the number of parts")];
        if let Some(known) = place.replace(name) {
            return unfit(format!("{known} and {name} are both part {part}: give each once"));
        }
    }
    let mut missing = (1..=of).zip(&have).filter(|(_, name)| name.is_none()).map(|(number, _)| number);
    match (missing.next(), missing.count()) {
        (None, _) => Ok(()),
        (Some(number), 0) => unfit(format!("part {number}/{of} is missing")),
        (Some(number), more) => unfit(format!("{} parts are missing, the first of them {number}/{of}", more + 1)),
    }
}

/// What the whole says but for its history.
fn without_history(header: &Header) -> Header {
    let mut header = Header { history: vec![], ..header.clone() };
    header.meaning.retain(|(name, _)| name != meaning::PART);
    header
}

/// What two parts do not say alike.
fn difference(a: &Header, b: &Header) -> Option<String> {
    if a.meaning != b.meaning {
        let differs = |(name, value): &&(String, String)| b.meaning(name) != Some(value);
        let name = a.meaning.iter().find(differs).map_or("what their records mean", |(name, _)| name);
        return Some(format!("`{name}`"));
    }
    let what = match () {
        () if a.image != b.image => "their images",
        () if a.materials != b.materials => "their materials",
        () if a.regions != b.regions => "the regions of memory",
        () if a.expected_records != b.expected_records => "the numbers of records to come",
        // Bounds may be not a number, and are the same where their bits are.
        () if [a.bounds.min, a.bounds.max].map(|p| p.map(f32::to_bits))
            != [b.bounds.min, b.bounds.max].map(|p| p.map(f32::to_bits)) =>
        {
            "their bounds"
        }
        () => return None,
    };
    Some(what.into())
}
