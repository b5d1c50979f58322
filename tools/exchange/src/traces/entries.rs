//! The entries of an input, one after another: lines of text, or records of a fixed length.

mod batch;

use super::reference::LONGEST_ACCESS;
use super::{EntryParser, EntryShape, Reference, text};
use crate::fault::bad_input;
use std::io::{BufRead, ErrorKind, Read as _};

/// Longest line, in bytes: a file without line ends is no text.
pub(super) const LONGEST_LINE: u64 = 1 << 16;

/// Reads entries and knows which it is at.
pub(super) struct Entries<R> {
    input: R,
    /// Bytes of a record, or nothing for lines.
    bytes: Option<usize>,
    parser: Box<dyn EntryParser>,
    /// Do the lengths count that entries tell?
    lengths: bool,
    entry: Vec<u8>,
    /// Lines or records read.
    number: u64,
}

impl<R: BufRead> Entries<R> {
    /// Begins to read; the lengths that entries tell are judged if they count.
    ///
    /// # Errors
    /// If the header is not there or not of the format; what the input reports.
    pub(super) fn new(
        input: R,
        shape: EntryShape,
        parser: Box<dyn EntryParser>,
        lengths: bool,
    ) -> anyhow::Result<Self> {
        let bytes = match shape {
            EntryShape::Line => None,
            EntryShape::Record { bytes } => Some(bytes),
            EntryShape::Headed { .. } => Some(0),
        };
        let mut entries = Self { input, bytes, parser, lengths, entry: vec![], number: 0 };
        if let EntryShape::Headed { header } = shape {
            let got = entries.fill(header)?;
            if got < header {
                return Err(bad_input(format!("the header: the input ends after {got} of its {header} bytes")));
            }
            let bytes =
                entries.parser.header(&entries.entry).map_err(|what| bad_input(format!("the header: {what}")))?;
            entries.bytes = Some(bytes);
        }
        Ok(entries)
    }

    /// The next access, where entries are lines.
    ///
    /// # Errors
    /// With the number of its entry, if that is not of the format; what the input reports.
    pub(super) fn next_reference(&mut self) -> anyhow::Result<Option<Reference>> {
        if let Some(reference) = self.parser.rest() {
            return self.judged(reference).map(Some);
        }
        loop {
            if !self.line()? {
                self.ended()?;
                return Ok(None);
            }
            match self.parser.parse(&self.entry) {
                Ok(Some(reference)) => return self.judged(reference).map(Some),
                Ok(None) => {}
                Err(what) => return Err(self.wrong(&what)),
            }
        }
    }

    /// The access, if it is none that only a misread format has.
    fn judged(&self, reference: Reference) -> anyhow::Result<Reference> {
        match reference.len {
            Some(len) if len > LONGEST_ACCESS && self.lengths => Err(self.wrong(&format!(
                "an access of {len} bytes; more than {LONGEST_ACCESS} are taken for another format that is misread \
                 (--access-size gives all accesses a size)"
            ))),
            _ => Ok(reference),
        }
    }

    /// The end was reached: may an input of the format end so?
    fn ended(&mut self) -> anyhow::Result<()> {
        self.parser.end().map_err(|what| bad_input(format!("the end: {what}")))
    }

    /// The error that something about the entry read last is wrong.
    pub(super) fn wrong(&self, what: &str) -> anyhow::Error {
        let unit = if self.bytes.is_none() { "line" } else { "record" };
        bad_input(format!("{unit} {}: {what}", self.number))
    }

    /// The next line that is not empty.
    fn line(&mut self) -> anyhow::Result<bool> {
        loop {
            if !self.any_line()? {
                return Ok(false);
            }
            if !self.entry.trim_ascii().is_empty() {
                return Ok(true);
            }
        }
    }

    /// The next line, without its end.
    fn any_line(&mut self) -> anyhow::Result<bool> {
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

    /// Reads so many bytes, fewer only at the end of the input, and says how many there were.
    fn fill(&mut self, bytes: usize) -> anyhow::Result<usize> {
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
        Ok(got)
    }
}
