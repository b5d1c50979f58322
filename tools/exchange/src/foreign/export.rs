//! A trace of ours into another simulator's format.

use super::oracle_general::Requests;
use super::{Form, dinb};
use anyhow::{Context as _, anyhow};
use pm_formats::trace::{Access, AccessKind, Region, TraceSink};
use pm_registry::Choice as _;
use std::io::Write;

/// Writes what is replayed into it.
///
/// A format that does not know accesses that read and write gets a read and then a write; one that knows neither gets the
/// address once. Searches and regions are not carried, nor which blocks warm up.
pub struct Exporter<'a, W> {
    form: Form,
    /// Line to which accesses are cut, in bytes, a power of two.
    line: Option<u64>,
    regions: &'a [Region],
    output: W,
    requests: Option<Requests>,
    /// Accesses written.
    number: u64,
    /// Searches begun.
    searches: u64,
    fault: Option<anyhow::Error>,
}

/// What becomes an entry: an access, or its part in one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// What is done.
    pub kind: AccessKind,
    /// First byte.
    pub address: u64,
    /// Bytes.
    pub len: u32,
}

impl<'a, W: Write> Exporter<'a, W> {
    /// Writes to `output` in this form; accesses to `regions` are cut where lines of `line` bytes end. Forms without sizes
    /// then get the addresses of the lines.
    ///
    /// # Errors
    /// If a temporary file is needed and cannot be made.
    pub fn new(form: Form, line: Option<u64>, regions: &'a [Region], mut output: W) -> anyhow::Result<Self> {
        let requests = (form == Form::OracleGeneral).then(Requests::new).transpose().context("temporary file")?;
        if form == Form::Csv {
            output.write_all(b"address,size,kind\n")?;
        }
        Ok(Self { form, line, regions, output, requests, number: 0, searches: 0, fault: None })
    }

    /// What went wrong so far, if anything.
    ///
    /// # Errors
    /// That.
    pub fn check(&mut self) -> anyhow::Result<()> {
        self.fault.take().map_or(Ok(()), Err)
    }

    /// Writes what could not be written before the end.
    ///
    /// # Errors
    /// What went wrong, now or earlier.
    pub fn finish(mut self) -> anyhow::Result<W> {
        self.check()?;
        if let Some(requests) = self.requests {
            requests.finish(&mut self.output)?;
        }
        Ok(self.output)
    }

    fn write(&mut self, piece: Piece) -> anyhow::Result<()> {
        let Piece { kind, address, len } = piece;
        let output = &mut self.output;
        let steps = match kind {
            AccessKind::Read => &[false][..],
            AccessKind::Write => &[true],
            AccessKind::ReadModifyWrite => &[false, true],
        };
        let beyond = || anyhow!("{len} bytes at address {address:#x} do not fit {}", self.form.word());
        match self.form {
            Form::Raw32 => output.write_all(&u32::try_from(address).map_err(|_| beyond())?.to_le_bytes())?,
            Form::Raw64 => output.write_all(&address.to_le_bytes())?,
            Form::OracleGeneral => {
                let requests = self.requests.as_mut().expect("made for this form");
                requests.push(self.searches.saturating_sub(1) as u32, address, len).context("temporary file")?;
            }
            Form::Lackey => {
                let letter = match kind {
                    AccessKind::Read => 'L',
                    AccessKind::Write => 'S',
                    AccessKind::ReadModifyWrite => 'M',
                };
                writeln!(output, " {letter} {address:08x},{len}")?;
            }
            Form::Csv => {
                let kind = match kind {
                    AccessKind::Read => "read",
                    AccessKind::Write => "write",
                    AccessKind::ReadModifyWrite => "rmw",
                };
                writeln!(output, "{address:#x},{len},{kind}")?;
            }
            Form::Din | Form::Xdin | Form::Dinb | Form::Dramsim3 | Form::Ramulator2 => {
                for &write in steps {
                    match self.form {
                        Form::Din => writeln!(output, "{} {address:x}", u8::from(write))?,
                        Form::Xdin => writeln!(output, "{} {address:x} {len:x}", if write { 'w' } else { 'r' })?,
                        Form::Dinb => output.write_all(&dinb::record(address, len, write).ok_or_else(beyond)?)?,
                        // There is no clock in a trace of ours: the cycle is the number of the transaction.
                        Form::Dramsim3 => {
                            writeln!(output, "{address:#x} {} {}", if write { "WRITE" } else { "READ" }, self.number)?;
                            self.number += 1;
                        }
                        _ => writeln!(output, "{} {address:#x}", if write { "ST" } else { "LD" })?,
                    }
                }
            }
        }
        Ok(())
    }
}

impl<W: Write> TraceSink for Exporter<'_, W> {
    fn search(&mut self, _: &[u32]) {
        self.searches += 1;
    }

    fn access(&mut self, access: Access) {
        if self.fault.is_some() {
            return;
        }
        let address = self.regions[usize::from(access.region)].base + access.offset;
        let whole = Piece { kind: access.kind, address, len: access.len };
        let outcome = match self.line {
            Some(line) => pieces(whole, line, !carries_size(self.form)).try_for_each(|piece| self.write(piece)),
            None => self.write(whole),
        };
        self.fault = outcome.err();
    }
}

/// Whether an entry says how many bytes it touches, so that the part of a line need not stand for the line.
fn carries_size(form: Form) -> bool {
    matches!(form, Form::Xdin | Form::Dinb | Form::Lackey | Form::Csv)
}

/// The parts of an access in lines of `line` bytes: where they begin in each, or the whole lines.
fn pieces(access: Piece, line: u64, whole: bool) -> impl Iterator<Item = Piece> {
    let last = access.address + u64::from(access.len.max(1) - 1);
    (access.address / line..=last / line).map(move |number| {
        let (begin, end) = (number * line, number * line + (line - 1));
        if whole {
            return Piece { address: begin, len: line as u32, ..access };
        }
        let (first, last) = (begin.max(access.address), end.min(last));
        let len = if access.len == 0 { 0 } else { (last - first + 1) as u32 };
        Piece { address: first, len, ..access }
    })
}
