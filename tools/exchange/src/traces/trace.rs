//! A foreign trace, read as it is replayed.

use super::beyond::Beyond;
use super::entries::Entries;
use super::in_blocks::InBlocks;
use super::part::Fate;
use super::unpack::Bytes;
use super::{AssumedSize, EntryKind, Numbered, Reading, References, Sizes, TraceImport};
use crate::fault::bad_question;
use pm_formats::BlockMeta;
use pm_formats::trace::{Access, AccessKind, Region, TraceSink};

/// A trace in another simulator's format. It is read once, while it is replayed, and nothing of it is kept.
pub struct Trace {
    format: &'static dyn TraceImport,
    entries: Entries<Bytes>,
    reading: Reading,
    regions: [Region; 1],
    left_out: u64,
    /// Accesses met, where not all are replayed.
    seen: u64,
    /// Where addresses are of more than 64 bits.
    beyond: Beyond,
}

impl Trace {
    /// The trace that has these entries.
    pub(super) fn new(format: &'static dyn TraceImport, entries: Entries<Bytes>, reading: &Reading) -> Self {
        let regions = [Region::addresses(format.word())];
        Self { format, entries, reading: reading.clone(), regions, left_out: 0, seen: 0, beyond: Beyond::default() }
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

    /// Replays its part as one block without searches, or as two if it has warm-up.
    ///
    /// # Errors
    /// If an entry is not of the format, with its line or record; what the input reports; if the trace ends before anything
    /// counts that should. What was replayed before that is then worthless.
    pub fn replay(&mut self, sink: &mut impl TraceSink) -> anyhow::Result<()> {
        self.replay_checked(sink, |_| Ok(()))
    }

    /// The same in blocks of searches that serve no query; each is ended by `end_block`.
    ///
    /// # Errors
    /// As [`replay`](Self::replay), and what `end_block` says.
    pub fn replay_blocks<S: TraceSink>(
        &mut self,
        sink: &mut S,
        end_block: impl FnMut(&mut S, BlockMeta) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let mut in_blocks = InBlocks::new(sink, end_block);
        self.replay_checked(&mut in_blocks, InBlocks::check)?;
        in_blocks.finish()
    }

    fn replay_checked<S: TraceSink>(
        &mut self,
        sink: &mut S,
        mut check: impl FnMut(&mut S) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let part = self.reading.part;
        sink.block(0, part.warm_up > 0);
        let (mut batch, mut accesses) = (vec![], vec![]);
        while self.replay_plain(&mut accesses, sink)? || self.replay_batch(&mut batch, sink)? {
            check(sink)?;
        }
        let uncounted = part.skip.saturating_add(part.warm_up);
        if uncounted > 0 && self.seen <= uncounted {
            let text = format!("the trace has {} accesses: none is left to count after {uncounted}", self.seen);
            return Err(bad_question(text));
        }
        Ok(())
    }

    /// Replays the next accesses, with a `batch` to keep them in; false if there are no more.
    fn replay_batch(&mut self, batch: &mut Vec<Numbered>, sink: &mut impl TraceSink) -> anyhow::Result<bool> {
        if !self.entries.next_batch(batch)? {
            return Ok(false);
        }
        let whole = self.reading.part.is_whole();
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
            if !whole {
                let fate = self.reading.part.fate(self.seen);
                self.seen += 1;
                match fate {
                    Fate::LeftOut => continue,
                    Fate::Replayed => {}
                    Fate::First => sink.block(0, false),
                    Fate::Over => return Ok(false),
                }
            }
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

    /// The same where all are accesses to data at byte addresses, as most are; false, and none, if not, or if there are no more.
    fn replay_plain(&mut self, accesses: &mut Vec<Access>, sink: &mut impl TraceSink) -> anyhow::Result<bool> {
        let Reading { access_size, address_unit, references, part, .. } = &self.reading;
        let assumed = self.format.assumed_size().unwrap_or(AssumedSize::BYTE);
        if *address_unit != 1 || *references != References::Data || assumed.aligned || !part.is_whole() {
            return Ok(false);
        }
        let sizes = Sizes { all: *access_size, assumed: assumed.bytes };
        let plain = self.entries.plain_batch(sizes, accesses)?;
        if plain {
            sink.accesses(accesses);
        }
        Ok(plain)
    }
}
