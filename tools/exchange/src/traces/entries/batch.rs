//! Many entries at a time: of records none is read by itself.

use super::Entries;
use crate::traces::reference::LONGEST_ACCESS;
use crate::traces::{Numbered, Sizes};
use pm_formats::trace::Access;
use std::io::{BufRead, ErrorKind};

/// Entries read at once: few enough for them and what they say to stay in a core's own cache.
const BATCH: usize = 2048;

impl<R: BufRead> Entries<R> {
    /// Replaces what is in `batch` by the next entries that are no comments. False if there are no more.
    ///
    /// # Errors
    /// With its number, if an entry is not of the format; what the input reports. Those before it are in the batch.
    pub(in crate::traces) fn next_batch(&mut self, batch: &mut Vec<Numbered>) -> anyhow::Result<bool> {
        batch.clear();
        if let Some(bytes) = self.bytes {
            return self.records(bytes, batch);
        }
        while batch.len() < BATCH
            && let Some(reference) = self.next_reference()?
        {
            batch.push(Numbered { number: self.number, reference });
        }
        Ok(!batch.is_empty())
    }

    /// Replaces what is in `accesses` by those of the next records, if all are plain and lie in the input's buffer; false, and
    /// nothing was read, if not.
    ///
    /// # Errors
    /// What the input reports.
    pub(in crate::traces) fn plain_batch(&mut self, sizes: Sizes, accesses: &mut Vec<Access>) -> anyhow::Result<bool> {
        let Some(bytes) = self.bytes else { return Ok(false) };
        let records = (self.buffered()? / bytes).min(BATCH);
        if records == 0 {
            return Ok(false);
        }
        let here = &self.input.fill_buf()?[..records * bytes];
        let plain = self.parser.plain_records(here, bytes, sizes, accesses);
        if plain {
            self.number += records as u64;
            self.input.consume(records * bytes);
        }
        Ok(plain)
    }

    /// The error that something about an entry is wrong.
    pub(in crate::traces) fn wrong_at(&mut self, number: u64, what: &str) -> anyhow::Error {
        self.number = number;
        self.wrong(what)
    }

    /// Records for a batch, false if there are none left. They are read where they lie in the input's buffer; only one that
    /// goes on beyond it is copied.
    fn records(&mut self, bytes: usize, batch: &mut Vec<Numbered>) -> anyhow::Result<bool> {
        let buffered = self.buffered()?;
        let first = self.number + 1;
        let outcome = if buffered < bytes {
            let got = self.fill(bytes)?;
            if got == 0 {
                self.ended()?;
                return Ok(false);
            }
            if got < bytes {
                let what = format!("the input ends after {got} of its {bytes} bytes");
                return Err(self.wrong_at(first, &what));
            }
            self.number += 1;
            self.parser.parse_records(&self.entry, bytes, first, batch)
        } else {
            let records = (buffered / bytes).min(BATCH);
            self.number += records as u64;
            let here = &self.input.fill_buf()?[..records * bytes];
            let outcome = self.parser.parse_records(here, bytes, first, batch);
            self.input.consume(records * bytes);
            outcome
        };
        if self.lengths {
            let long = |entry: &&Numbered| entry.reference.len.is_some_and(|len| len > LONGEST_ACCESS);
            if let Some(&Numbered { number, reference }) = batch.iter().find(long) {
                self.number = number;
                self.judged(reference)?;
            }
        }
        outcome.map_err(|(number, what)| self.wrong_at(number, &what))?;
        Ok(true)
    }

    /// How many bytes of the input can be looked at where they are; none at its end.
    fn buffered(&mut self) -> anyhow::Result<usize> {
        loop {
            match self.input.fill_buf() {
                Ok(bytes) => return Ok(bytes.len()),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
    }
}
