//! What is it that comes in: a trace of ours, or whose?

use super::entries::{Entries, LONGEST_LINE};
use super::known::{Known, is_text, known};
use super::recognise::{Recognised, recognise};
use super::unpack::{Bytes, peek, unpack};
use super::{Reading, Trace, TraceImport};
use crate::BadQuestion;
use crate::fault::bad_input;
use pm_formats::{BlockReader, MAGIC};
use pm_registry::Registry;
use std::io::BufRead;

/// An input whose nature is known.
pub enum Opened {
    /// A stream of ours.
    Ours(BlockReader<Bytes>),
    /// A trace of another program, of which only the beginning was read.
    Foreign(Trace),
}

/// Looks at an input, which may be a foreign one, of one of the formats `imports`.
///
/// Compression is undone wherever the first bytes show it. What has a signature is what its signature says, whatever it was
/// said to be, and a text is no binary trace. A binary format without a signature is never guessed: what is neither a stream
/// of ours nor a text that is known by its first lines is refused, so that a damaged stream stays an error.
///
/// # Errors
/// If the input is not of the format asked for, of none that is known, or of several; with the line or record.
pub fn open(
    input: impl BufRead + 'static,
    reading: &Reading,
    imports: &Registry<dyn TraceImport>,
) -> anyhow::Result<Opened> {
    let input = unpack(Box::new(input))?;
    // No more than the signature first: a header can be judged before the blocks have come.
    let (head, input) = peek(input, MAGIC.len())?;
    if reading.format.is_none() && (head.starts_with(&MAGIC) || MAGIC.starts_with(&head)) {
        return Ok(Opened::Ours(BlockReader::new(input)?));
    }
    let (beginning, input) = peek(input, LONGEST_LINE as usize)?;
    let format = format_of(&beginning, reading, imports)?;
    let input = if format.shape().is_text() { without_mark(&beginning, input)? } else { input };
    foreign(format, input, reading, imports)
}

/// The format of a foreign input that begins so.
fn format_of(
    beginning: &[u8],
    reading: &Reading,
    imports: &Registry<dyn TraceImport>,
) -> anyhow::Result<&'static dyn TraceImport> {
    match (known(beginning, imports), reading.format) {
        (Some(Known::Other(what)), _) => return Err(bad_input(format!("this is no trace that is read: {what}"))),
        (Some(Known::Trace(found)), asked) => {
            return match asked {
                Some(asked) if asked.word() != found.word() => Err(not_as_asked(asked, found.word())),
                _ => Ok(found),
            };
        }
        (Some(Known::Ours), Some(asked)) => return Err(not_as_asked(asked, "a stream of ours")),
        (_, Some(asked)) if !asked.shape().is_text() && is_text(beginning) => {
            return Err(not_as_asked(asked, "a text"));
        }
        (_, Some(asked)) => return Ok(asked),
        (_, None) => {}
    }
    if reading.columns.is_some() {
        // Only formats with columns have columns that can be named.
        if let Some(format) = imports.iter().find(|import| import.parser_of_columns().is_some()) {
            return Ok(format);
        }
    }
    let text = beginning.strip_prefix(MARK).unwrap_or(beginning);
    match recognise(text, beginning.len() < LONGEST_LINE as usize, imports) {
        Recognised::Known(format) => Ok(format),
        Recognised::Doubtful(formats) => {
            let words: Vec<_> = formats.iter().map(|format| format.word()).collect();
            let question = format!("this text may be {}: say which with --input", words.join(" or "));
            Err(BadQuestion::new(question).into())
        }
        Recognised::Unknown if WIDE_MARKS.iter().any(|mark| beginning.starts_with(mark)) => Err(bad_input(WIDE)),
        Recognised::Unknown => Err(bad_input(
            "this is neither a pm stream (it does not begin with its signature) nor a text trace that is known; \
             a binary trace has to be named with --input",
        )),
    }
}

fn not_as_asked(asked: &dyn TraceImport, found: &str) -> anyhow::Error {
    BadQuestion::new(format!("--input {}, but the input is {found}: leave --input out", asked.word())).into()
}

/// A byte-order mark of UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";
/// Byte-order marks of UTF-16.
const WIDE_MARKS: [&[u8]; 2] = [b"\xff\xfe", b"\xfe\xff"];
/// What is said of one.
const WIDE: &str = "this is a text in UTF-16; convert it with iconv -f UTF-16 -t UTF-8";

/// A text without its byte-order mark.
fn without_mark(beginning: &[u8], mut input: Bytes) -> anyhow::Result<Bytes> {
    if WIDE_MARKS.iter().any(|mark| beginning.starts_with(mark)) {
        return Err(bad_input(WIDE));
    }
    if beginning.starts_with(MARK) {
        input.read_exact(&mut [0; MARK.len()])?;
    }
    Ok(input)
}

fn foreign(
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
    let entries = Entries::new(input, format.shape(), parser, reading.access_size.is_none())?;
    Ok(Opened::Foreign(Trace::new(format, entries, reading)))
}
