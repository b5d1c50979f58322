//! A foreign trace, read to its end and ready to be replayed.

use super::entries::Entries;
use super::pages::Pages;
use super::{AssumedSize, EntryKind, Reading, References, TraceImport};
use anyhow::Context as _;
use pm_formats::trace::{Access, AccessKind, Region, TraceSink};
use pm_spool::{Event, Spool};
use std::io::BufRead;

/// A trace in another simulator's format. Its accesses wait in a temporary file, since the regions are known at the end.
pub struct Trace {
    format: &'static dyn TraceImport,
    regions: Vec<Region>,
    accesses: Spool,
    left_out: u64,
}

impl Trace {
    /// Reads all entries.
    pub(super) fn read<R: BufRead>(
        format: &'static dyn TraceImport,
        mut entries: Entries<R>,
        reading: &Reading,
    ) -> anyhow::Result<Self> {
        let (mut pages, mut spool, mut left_out) = (Pages::new(), Spool::new().context("temporary file")?, 0);
        let unit = reading.address_unit;
        let assumed = format.assumed_size().unwrap_or(AssumedSize::BYTE);
        while let Some(reference) = entries.next_reference()? {
            let kind = match (reference.kind, reading.references) {
                (EntryKind::Instruction, References::Data) | (EntryKind::Data(_), References::Instructions) => {
                    left_out += 1;
                    continue;
                }
                (EntryKind::Instruction, _) => AccessKind::Read,
                (EntryKind::Data(kind), _) => kind,
            };
            // The low bits of an address that say nothing.
            let (len, idle) = match reading.access_size.or(reference.len) {
                Some(len) => (len, 0),
                None if assumed.aligned => (assumed.bytes, u64::from(assumed.bytes) - 1),
                None => (assumed.bytes, 0),
            };
            let place = || {
                let first = reference.address.checked_mul(unit)? & !idle;
                Some((first, first.checked_add(u64::from(len.max(1) - 1))?))
            };
            let (first, last) = place().ok_or_else(|| {
                let text = format!("{len} bytes at address {:#x} x {unit}", reference.address);
                entries.wrong(&format!("{text} reach beyond the last 64-bit address"))
            })?;
            pages.touch(first, last);
            spool.access(Access { kind, region: 0, len, offset: first }).context("temporary file")?;
        }
        Ok(Self { format, regions: pages.regions(format.word()), accesses: spool, left_out })
    }

    /// Its format.
    #[must_use]
    pub fn format(&self) -> &'static dyn TraceImport {
        self.format
    }

    /// The pages it touches, runs of them at their addresses.
    #[must_use]
    pub fn regions(&self) -> &[Region] {
        &self.regions
    }

    /// Entries that were not asked for: instructions, or data.
    #[must_use]
    pub fn left_out(&self) -> u64 {
        self.left_out
    }

    /// Replays all accesses as one block without searches.
    ///
    /// # Errors
    /// What the temporary file reports.
    pub fn replay(&mut self, sink: &mut impl TraceSink) -> anyhow::Result<()> {
        self.accesses.flush().context("temporary file")?;
        let end = self.accesses.mark();
        let mut cursor = self.accesses.cursor(0, end);
        sink.block(0, false);
        let mut at = 0;
        while let Some(event) = cursor.next_event().context("temporary file")? {
            let Event::Access(access) = event else { continue };
            let address = access.offset;
            let region = &self.regions[at];
            if address < region.base || address - region.base >= region.size {
                at = self.regions.partition_point(|region| region.base <= address) - 1;
            }
            sink.access(Access { region: at as u16, offset: address - self.regions[at].base, ..access });
        }
        Ok(())
    }
}
