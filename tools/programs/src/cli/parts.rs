//! Parts of streams: what is said of those that do not fit, and where only a whole will do.

use super::usage::usage;
use pm_formats::vocabulary::meaning;
use pm_formats::{Header, PartsError};

/// What is wrong with parts: they have to be given otherwise, or one of them is damaged.
#[must_use]
pub fn refuse_parts(error: PartsError) -> anyhow::Error {
    match error {
        PartsError::Unfit(what) => usage(what),
        error => error.into(),
    }
}

/// Refuses a part of a stream where what is asked for is no sum over batches.
///
/// # Errors
/// If the header is that of a part.
pub fn refuse_part(name: &str, header: &Header, why: &str) -> anyhow::Result<()> {
    match header.meaning(meaning::PART) {
        Some(part) => {
            Err(usage(format!("{name} is part {part} of a stream: {why}; pm-view --merge puts parts together")))
        }
        None => Ok(()),
    }
}
