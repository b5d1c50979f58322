//! Errors as they are told: one line on standard error and an exit code.

use super::output::{ReaderGone, unfinished_files};
use super::usage::{Refusal, UsageError};
use pm_exchange::{BadInput, BadQuestion};
use pm_registry::ParameterError;
use std::io;

/// The exit code, and what went wrong, if anything.
pub(super) fn report(outcome: anyhow::Result<()>) -> (u8, Option<String>) {
    let Err(error) = outcome else { return (0, None) };
    if is_reader_gone(&error) {
        let files = unfinished_files();
        if files.is_empty() {
            return (0, None);
        }
        return (1, Some(format!("the reader of standard output left early: {} not written", files.join(", "))));
    }
    // Causes are joined on one line; a library that repeats its cause in its own message is not quoted twice.
    let mut text = String::new();
    for cause in error.chain() {
        let cause = cause.to_string().replace('\n', " ");
        if !text.ends_with(&cause) {
            if !text.is_empty() {
                text.push_str(": ");
            }
            text.push_str(&cause);
        }
    }
    let found = |test: fn(&(dyn std::error::Error + 'static)) -> bool| error.chain().any(test);
    let wrong_kind = |cause: &(dyn std::error::Error + 'static)| {
        matches!(cause.downcast_ref(), Some(pm_formats::Error::WrongKind { .. }))
    };
    let code = if found(wrong_kind)
        || found(|cause| cause.is::<UsageError>() || cause.is::<ParameterError>() || cause.is::<BadQuestion>())
    {
        2
    } else if found(|cause| cause.is::<Refusal>()) {
        4
    } else if is_bad_input(&error)
        || found(|cause| cause.downcast_ref::<pm_formats::Error>().is_some_and(pm_formats::Error::is_damage))
    {
        3
    } else {
        1
    };
    (code, Some(text))
}

fn is_reader_gone(error: &anyhow::Error) -> bool {
    error.chain().any(holds::<ReaderGone>)
}

fn is_bad_input(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| cause.is::<BadInput>() || holds::<BadInput>(cause))
}

/// Whether a cause is an error of input or output that was made from an error of this type.
fn holds<T: std::error::Error + 'static>(cause: &(dyn std::error::Error + 'static)) -> bool {
    let io = match cause.downcast_ref::<pm_formats::Error>() {
        Some(pm_formats::Error::Io(io)) => Some(io),
        _ => cause.downcast_ref::<io::Error>(),
    };
    io.and_then(io::Error::get_ref).is_some_and(|inner| inner.is::<T>())
}
