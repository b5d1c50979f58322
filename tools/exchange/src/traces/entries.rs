//! The entries of an input, one after another: lines of text, or records of a fixed length.

use super::{EntryParser, EntryShape, Reference, text};
use crate::fault::bad_input;
use std::io::{BufRead, ErrorKind, Read as _};

/// Longest line, in bytes: a file without line ends is no text.
pub(super) const LONGEST_LINE: u64 = 1 << 16;

/// Reads entries and knows which it is at.
pub(super) struct Entries<R> {
    input: R,
    shape: EntryShape,
    parser: Box<dyn EntryParser>,
    entry: Vec<u8>,
    /// Lines or records read.
    number: u64,
}

impl<R: BufRead> Entries<R> {
    pub(super) fn new(input: R, shape: EntryShape, parser: Box<dyn EntryParser>) -> Self {
        Self { input, shape, parser, entry: vec![], number: 0 }
    }

    /// The next entry that is no comment.
    ///
    /// # Errors
    /// With its number, if it is not of the format; what the input reports.
    pub(super) fn next_reference(&mut self) -> anyhow::Result<Option<Reference>> {
        loop {
            let there = match self.shape {
                EntryShape::Record { bytes } => self.record(bytes)?,
                EntryShape::Line => self.line()?,
            };
            if !there {
                return Ok(None);
            }
            match self.parser.parse(&self.entry) {
                Ok(Some(reference)) => return Ok(Some(reference)),
                Ok(None) => {}
                Err(what) => return Err(self.wrong(&what)),
            }
        }
    }

    /// The error that something about the entry read last is wrong.
    pub(super) fn wrong(&self, what: &str) -> anyhow::Error {
        let unit = if self.shape.is_text() { "line" } else { "record" };
        bad_input(format!("{unit} {}: {what}", self.number))
    }

    fn line(&mut self) -> anyhow::Result<bool> {
        self.entry.clear();
        (&mut self.input).take(LONGEST_LINE).read_until(b'\n', &mut self.entry)?;
        if self.entry.is_empty() {
            return Ok(false);
        }
        self.number += 1;
        if self.entry.pop_if(|byte| *byte == b'\n').is_none() && self.entry.len() as u64 == LONGEST_LINE {
            return Err(self.wrong("longer than 65536 bytes: this is no text"));
        }
        if self.entry.contains(&0) {
            return Err(self.wrong(&format!("{} is no text", text::quoted(&self.entry))));
        }
        Ok(true)
    }

    fn record(&mut self, bytes: usize) -> anyhow::Result<bool> {
        self.entry.resize(bytes, 0);
        let mut got = 0;
        while got < bytes {
            match self.input.read(&mut self.entry[got..]) {
                Ok(0) => break,
                Ok(n) => got += n,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
        if got == 0 {
            return Ok(false);
        }
        self.number += 1;
        if got < bytes {
            return Err(self.wrong(&format!("the input ends after {got} of its {bytes} bytes")));
        }
        Ok(true)
    }
}
