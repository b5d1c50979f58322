//! A foreign trace, read as it is replayed.

use super::beyond::Beyond;
use super::entries::Entries;
use super::unpack::Bytes;
use super::{AssumedSize, EntryKind, Numbered, Reading, References, TraceImport};
use pm_formats::trace::{Access, AccessKind, Region, TraceSink};

/// A trace in another simulator's format. It is read once, while it is replayed, and nothing of it is kept.
pub struct Trace {
    format: &'static dyn TraceImport,
    entries: Entries<Bytes>,
    reading: Reading,
    regions: [Region; 1],
    left_out: u64,
    /// Where addresses are of more than 64 bits.
    beyond: Beyond,
}

impl Trace {
    /// The trace that has these entries.
    pub(super) fn new(format: &'static dyn TraceImport, entries: Entries<Bytes>, reading: &Reading) -> Self {
        let regions = [Region::addresses(format.word())];
        Self { format, entries, reading: reading.clone(), regions, left_out: 0, beyond: Beyond::default() }
    }

    /// Its format.
    #[must_use]
    pub fn format(&self) -> &'static dyn TraceImport {
        self.format
    }

    /// Its region, which is all addresses.
    #[must_use]
    pub fn regions(&self) -> &[Region] {
        &self.regions
    }

    /// Entries that were not asked for, of those replayed: instructions, or data.
    #[must_use]
    pub fn left_out(&self) -> u64 {
        self.left_out
    }

    /// Replays all accesses as one block without searches.
    ///
    /// # Errors
    /// If an entry is not of the format, with its line or record; what the input reports. What was replayed before that is
    /// then worthless.
    pub fn replay(&mut self, sink: &mut impl TraceSink) -> anyhow::Result<()> {
        sink.block(0, false);
        let mut batch = vec![];
        while self.replay_batch(&mut batch, sink)? {}
        Ok(())
    }

    /// Replays the next accesses, with a `batch` to keep them in; false if there are no more.
    fn replay_batch(&mut self, batch: &mut Vec<Numbered>, sink: &mut impl TraceSink) -> anyhow::Result<bool> {
        if !self.entries.next_batch(batch)? {
            return Ok(false);
        }
        let Reading { access_size, address_unit: unit, references, .. } = self.reading;
        let assumed = self.format.assumed_size().unwrap_or(AssumedSize::BYTE);
        // The low bits of an address that say nothing.
        let idle = if assumed.aligned { u64::from(assumed.bytes) - 1 } else { 0 };
        for &Numbered { number, reference } in &*batch {
            let kind = match (reference.kind, references) {
                (EntryKind::Instruction, References::Data) | (EntryKind::Data(_), References::Instructions) => {
                    self.left_out += 1;
                    continue;
                }
                (EntryKind::Instruction, _) => AccessKind::Read,
                (EntryKind::Data(kind), _) => kind,
            };
            let (len, idle) = match access_size.or(reference.len) {
                Some(len) => (len, 0),
                None => (assumed.bytes, idle),
            };
            let within = match unit {
                1 => {
                    Some(reference.address & !idle).filter(|first| first.checked_add((len.max(1) - 1).into()).is_some())
                }
                _ => self.beyond.address(reference.address, unit, idle, len),
            };
            let Some(offset) = within else {
                let text = format!("{len} bytes at address {:#x} x {unit}", reference.address);
                return Err(self.entries.wrong_at(number, &format!("{text} reach beyond the last 64-bit address")));
            };
            sink.access(Access { kind, region: 0, len, offset });
        }
        Ok(true)
    }
}
