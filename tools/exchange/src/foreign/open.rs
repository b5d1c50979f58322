//! What is it that comes in: a trace of ours, or whose?

use super::entries::{Entries, LONGEST_LINE, Parser, begins_as};
use super::unpack::{Bytes, peek, unpack};
use super::{Form, TOLD_BY_CONTENT, Trace};
use crate::fault::{bad_input, bad_question};
use pm_formats::{BlockReader, MAGIC};
use pm_registry::Choice as _;
use std::io::{BufReader, Read};

/// How an input is to be read.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Its format; `None`: as its content tells.
    pub form: Option<Form>,
    /// Bytes of every access, whatever the entries say; `None`: as they say, or the format's custom.
    pub access_size: Option<u32>,
    /// Bytes that one unit of an address stands for.
    pub address_unit: u64,
    /// Names of the columns of a CSV file without names.
    pub columns: Option<Vec<String>>,
    /// Which entries count.
    pub references: References,
}

pm_registry::choices! {
    /// Which entries of a trace that has instructions too.
    #[derive(Debug)]
    pub enum References {
        /// Data alone
        Data = "data",
        /// Instructions alone
        Instructions = "instructions",
        /// Data and instructions
        All = "all",
    }
}

/// An input whose nature is known.
pub enum Opened {
    /// A stream of ours.
    Ours(BlockReader<Bytes>),
    /// A trace of another program, read to its end.
    Foreign(Trace),
}

/// Looks at an input and reads a foreign one.
///
/// Compression is undone wherever the first bytes show it. A headerless binary format is never guessed: what is neither a
/// stream of ours nor a text that is known by its first line is refused, so that a damaged stream stays an error.
///
/// # Errors
/// If the input is not of the form asked for, or of none that is known; with the line or record.
pub fn open(input: impl Read + 'static, reading: &Reading) -> anyhow::Result<Opened> {
    let input: Bytes = Box::new(BufReader::with_capacity(1 << 17, input));
    identify(input, reading)
}

pub(super) fn identify(input: Bytes, reading: &Reading) -> anyhow::Result<Opened> {
    let input = unpack(input)?;
    if let Some(form) = reading.form {
        return read(form, input, reading);
    }
    // No more than the signature first: a header can be judged before the blocks have come.
    let (head, input) = peek(input, MAGIC.len())?;
    if head.starts_with(&MAGIC) || MAGIC.starts_with(&head) {
        return Ok(Opened::Ours(BlockReader::new(input)?));
    }
    let (beginning, input) = peek(input, LONGEST_LINE as usize)?;
    let form = told(&beginning, reading).ok_or_else(|| {
        bad_input(
            "this is neither a pm stream (it does not begin with its signature) nor a text trace that is known; \
             a binary trace has to be named with --input",
        )
    })?;
    read(form, input, reading)
}

/// The form of a text that begins so.
fn told(beginning: &[u8], reading: &Reading) -> Option<Form> {
    if reading.columns.is_some() {
        return Some(Form::Csv);
    }
    TOLD_BY_CONTENT.into_iter().find(|&form| begins_as(form, beginning))
}

fn read(form: Form, input: Bytes, reading: &Reading) -> anyhow::Result<Opened> {
    if reading.columns.is_some() && form != Form::Csv {
        return Err(bad_question(format!("--columns belongs to csv; the input is {}", form.word())));
    }
    let parser = Parser::new(form, reading.columns.as_deref())?;
    Ok(Opened::Foreign(Trace::read(form, Entries::new(input, parser), reading)?))
}
