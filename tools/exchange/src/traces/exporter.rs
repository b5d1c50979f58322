//! A trace of ours into another simulator's format.

use super::{Carried, Kinds, Piece, PieceWriter, TraceExport, Unwritten};
use anyhow::{Context as _, anyhow};
use pm_formats::trace::{Access, AccessKind, Region, TraceSink};
use std::io::Write;

/// Writes what is replayed into it.
///
/// A format that does not know accesses that read and write gets a read and then a write; one that knows neither gets the
/// address once. Searches and regions are not carried, nor which blocks warm up.
pub struct Exporter<'a, W> {
    format: &'static dyn TraceExport,
    carried: Carried,
    writer: Box<dyn PieceWriter>,
    /// Line to which accesses are cut, in bytes, a power of two.
    line: Option<u64>,
    regions: &'a [Region],
    output: W,
    /// Searches begun.
    searches: u64,
    fault: Option<anyhow::Error>,
}

impl<'a, W: Write> Exporter<'a, W> {
    /// Writes to `output` in this format; accesses to `regions` are cut where lines of `line` bytes end. Formats without
    /// sizes then get the addresses of the lines.
    ///
    /// # Errors
    /// If a temporary file is needed and cannot be made, or the beginning not be written.
    pub fn new(
        format: &'static dyn TraceExport,
        line: Option<u64>,
        regions: &'a [Region],
        mut output: W,
    ) -> anyhow::Result<Self> {
        let mut writer = format.writer().context("temporary file")?;
        writer.begin(&mut output)?;
        Ok(Self { format, carried: format.carried(), writer, line, regions, output, searches: 0, fault: None })
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
        self.writer.finish(&mut self.output)?;
        Ok(self.output)
    }

    /// Writes a piece as the format knows kinds of access.
    fn write(&mut self, piece: Piece) -> anyhow::Result<()> {
        let kinds: &[AccessKind] = match (self.carried.kinds, piece.kind) {
            (Kinds::None, _) | (_, AccessKind::Read) => &[AccessKind::Read],
            (_, AccessKind::Write) => &[AccessKind::Write],
            (Kinds::ReadsAndWrites, AccessKind::ReadModifyWrite) => &[AccessKind::Read, AccessKind::Write],
            (Kinds::All, AccessKind::ReadModifyWrite) => &[AccessKind::ReadModifyWrite],
        };
        kinds.iter().try_for_each(|&kind| {
            let Piece { address, len, .. } = piece;
            self.writer.write(&Piece { kind, ..piece }, &mut self.output).map_err(|why| match why {
                Unwritten::DoesNotFit => {
                    anyhow!("{len} bytes at address {address:#x} do not fit {}", self.format.word())
                }
                Unwritten::Output(error) => error.into(),
                Unwritten::TemporaryFile(error) => anyhow::Error::from(error).context("temporary file"),
            })
        })
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
        let search = self.searches.saturating_sub(1);
        let whole = Piece { kind: access.kind, address, len: access.len, search };
        let outcome = match self.line {
            Some(line) => whole.in_lines(line, !self.carried.sizes).try_for_each(|piece| self.write(piece)),
            None => self.write(whole),
        };
        self.fault = outcome.err();
    }
}
