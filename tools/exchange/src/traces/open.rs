//! What is it that comes in: a trace of ours, or whose?

use super::entries::{Entries, LONGEST_LINE};
use super::recognise::recognise;
use super::unpack::{Bytes, peek, unpack};
use super::{Reading, Trace, TraceImport};
use crate::BadQuestion;
use crate::fault::bad_input;
use pm_formats::{BlockReader, MAGIC};
use pm_registry::Registry;
use std::io::{BufReader, Read};

/// An input whose nature is known.
pub enum Opened {
    /// A stream of ours.
    Ours(BlockReader<Bytes>),
    /// A trace of another program, read to its end.
    Foreign(Trace),
}

/// Looks at an input and reads a foreign one, of one of the formats `imports`.
///
/// Compression is undone wherever the first bytes show it. A headerless binary format is never guessed: what is neither a
/// stream of ours nor a text that is known by its first line is refused, so that a damaged stream stays an error.
///
/// # Errors
/// If the input is not of the format asked for, or of none that is known; with the line or record.
pub fn open(
    input: impl Read + 'static,
    reading: &Reading,
    imports: &Registry<dyn TraceImport>,
) -> anyhow::Result<Opened> {
    let input: Bytes = Box::new(BufReader::with_capacity(1 << 17, input));
    let input = unpack(input)?;
    if let Some(format) = reading.format {
        return read(format, input, reading, imports);
    }
    // No more than the signature first: a header can be judged before the blocks have come.
    let (head, input) = peek(input, MAGIC.len())?;
    if head.starts_with(&MAGIC) || MAGIC.starts_with(&head) {
        return Ok(Opened::Ours(BlockReader::new(input)?));
    }
    let (beginning, input) = peek(input, LONGEST_LINE as usize)?;
    // Only formats with columns have columns that can be named.
    let told = match reading.columns {
        Some(_) => imports.iter().find(|import| import.parser_of_columns().is_some()),
        None => recognise(&beginning, imports),
    };
    let format = told.ok_or_else(|| {
        bad_input(
            "this is neither a pm stream (it does not begin with its signature) nor a text trace that is known; \
             a binary trace has to be named with --input",
        )
    })?;
    read(format, input, reading, imports)
}

fn read(
    format: &'static dyn TraceImport,
    input: Bytes,
    reading: &Reading,
    imports: &Registry<dyn TraceImport>,
) -> anyhow::Result<Opened> {
    let parser = match &reading.columns {
        None => format.parser(),
        Some(columns) => {
            let of_columns = format.parser_of_columns().ok_or_else(|| {
                let with = imports.iter().filter(|import| import.parser_of_columns().is_some());
                let with = with.map(|import| import.word()).collect::<Vec<_>>().join(", ");
                BadQuestion::new(format!("--columns belongs to {with}; the input is {}", format.word()))
            })?;
            of_columns(columns)?
        }
    };
    Ok(Opened::Foreign(Trace::read(format, Entries::new(input, format.shape(), parser), reading)?))
}
