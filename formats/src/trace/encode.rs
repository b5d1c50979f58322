//! Searches into blocks.

use super::Waits;
use super::access::{Access, AccessKind};
use super::bits::BitWriter;
use super::groups::{Group, nodes_of};
use super::heap_walk;
use super::in_turns::InTurns;
use super::varint::{push, zigzag};
use crate::container::{Block, BlockMeta};
use crate::digest::Tally;
use crate::error::{Error, Result};
use crate::region::{Coding, MAX_ACCESS, Region};

/// zstd level of trace blocks: decision bits gain a third at level 3 and little beyond.
const LEVEL: i32 = 3;

/// Codes the searches of one block.
///
/// For each search: [`begin`](Self::begin), any number of [`records`](Self::records) and [`access`](Self::access), then
/// [`end`](Self::end). What a search costs and what its digest is do not depend on the searches around it.
pub struct BlockEncoder<'a> {
    regions: &'a [Region],
    groups: Vec<Group>,
    in_turns: InTurns,
    heads: Vec<u8>,
    destinations: Vec<u8>,
    walks: BitWriter,
    others: Vec<u8>,
    last_pixel: u32,
    tally: Tally,
    /// Bytes of the longest access.
    longest: u32,
    current: Current,
    scratch: Vec<u8>,
}

/// What is known of the search being coded.
#[derive(Default)]
struct Current {
    segments: u64,
    heads: Vec<u8>,
    walks_from: usize,
    others_from: usize,
    /// Record index or offset last coded generically.
    last: i64,
    /// Accesses to addresses, all of this kind and length, that have no segment yet, and how many.
    run: Option<(AccessKind, u32, u64)>,
    /// Reads of records of regions that are coded together, all of one group, that have no segment yet.
    together: Vec<(u16, u32)>,
    /// What those of regions that are read in turns wait for.
    waits: Vec<Waits>,
    pixels: Vec<u32>,
}

impl<'a> BlockEncoder<'a> {
    /// An encoder for accesses to these regions.
    #[must_use]
    pub fn new(regions: &'a [Region]) -> Self {
        Self {
            regions,
            groups: Group::of(regions),
            in_turns: InTurns::of(regions),
            heads: vec![],
            destinations: vec![],
            walks: BitWriter::default(),
            others: vec![],
            last_pixel: 0,
            tally: Tally::default(),
            longest: 0,
            current: Current::default(),
            scratch: vec![],
        }
    }

    /// A search begins that serves one query for each of `destinations`.
    pub fn begin(&mut self, destinations: &[u32]) {
        push(&mut self.destinations, destinations.len() as u64);
        for &pixel in destinations {
            push(&mut self.destinations, zigzag(i64::from(pixel) - i64::from(self.last_pixel)));
            self.last_pixel = pixel;
        }
        let current = &mut self.current;
        current.segments = 0;
        current.heads.clear();
        current.walks_from = self.walks.bytes().len();
        current.others_from = self.others.len();
        current.last = 0;
        current.run = None;
        current.together.clear();
        current.waits.clear();
        self.in_turns.restart();
        current.pixels.clear();
        current.pixels.extend_from_slice(destinations);
    }

    /// The search reads whole records of a region, given by index, in this order.
    ///
    /// Where the region's coding implies second touches they are not among `indices`, which then must be walks.
    ///
    /// # Panics
    /// If they are not; if the region is all addresses, which has no records.
    pub fn records(&mut self, region: u16, indices: &[u32]) {
        assert!(!self.regions[usize::from(region)].is_addresses(), "addresses are no records");
        let group = self.groups[usize::from(region)];
        if !self.current.together.last().is_none_or(|&(before, _)| self.groups[usize::from(before)].is_with(group)) {
            self.end_together();
        }
        if group != Group::Alone {
            self.current.together.extend(indices.iter().map(|&index| (region, index)));
            if matches!(group, Group::Turns { .. }) {
                self.current.waits.resize(self.current.together.len(), Waits::NOTHING);
            }
            return;
        }
        let mut rest = indices;
        if let Coding::HeapWalk { nodes, reread } = self.regions[usize::from(region)].coding {
            while let Some(len) = heap_walk::encode(rest, nodes, &mut self.walks) {
                self.segment(region, true, 0);
                rest = &rest[len..];
            }
            assert!(rest.is_empty() || !reread, "second touches are implied by walks only");
        }
        if !rest.is_empty() {
            self.spelled_out(region, rest.iter().copied());
        }
    }

    /// The same, and says what each of the reads waits for, if the region's coding has a place for that.
    ///
    /// # Panics
    /// As [`records`](Self::records), and, here or later, if one waits for a level that nothing was read at.
    pub fn waiting_records(&mut self, region: u16, indices: &[u32], waits: &[Waits]) {
        assert_eq!(indices.len(), waits.len(), "each of the reads waits for something, or for nothing");
        self.records(region, indices);
        if let Group::Turns { .. } = self.groups[usize::from(region)] {
            let from = self.current.waits.len() - waits.len();
            self.current.waits[from..].copy_from_slice(waits);
        }
    }

    /// Reads of records of one region, one by one.
    fn spelled_out(&mut self, region: u16, indices: impl ExactSizeIterator<Item = u32>) {
        self.segment(region, false, indices.len() as u64);
        for index in indices {
            let delta = i64::from(index) - self.current.last;
            push(&mut self.others, zigzag(delta) << 1);
            self.current.last = i64::from(index);
        }
    }

    /// Writes the segments of the reads that were kept to be coded together.
    fn end_together(&mut self) {
        let mut reads = std::mem::take(&mut self.current.together);
        match reads.first().map(|&(region, _)| (region, self.groups[usize::from(region)])) {
            None | Some((_, Group::Alone)) => {}
            Some((region, Group::Turns { .. })) => {
                self.segment(region, true, 0);
                push(&mut self.current.heads, reads.len() as u64);
                for (&(region, index), &waits) in reads.iter().zip(&self.current.waits) {
                    let Group::Turns { rank } = self.groups[usize::from(region)] else { unreachable!("one group") };
                    self.in_turns.encode(rank, index, waits, &mut self.others);
                }
            }
            Some((_, Group::Tree { inner, leaves })) => {
                // A record that no node is ends every walk.
                let above = leaves.saturating_sub(1);
                let node = |&(region, index): &(u16, u32)| match region == inner {
                    true if index < above => index,
                    true => u32::MAX,
                    false => above.saturating_add(index),
                };
                let nodes: Vec<u32> = reads.iter().map(node).collect();
                let mut at = 0;
                while let Some(len) = heap_walk::encode(&nodes[at..], nodes_of(leaves), &mut self.walks) {
                    self.segment(inner, true, 0);
                    at += len;
                }
                for run in reads[at..].chunk_by(|a, b| a.0 == b.0) {
                    self.spelled_out(run[0].0, run.iter().map(|&(_, index)| index));
                }
            }
        }
        reads.clear();
        self.current.waits.clear();
        self.current.together = reads;
    }

    /// The search makes an access of any kind.
    #[expect(clippy::cast_possible_wrap, reason = "offsets lie within a region, far below 2^63")]
    pub fn access(&mut self, access: Access) {
        self.longest = self.longest.max(access.len);
        if self.regions[usize::from(access.region)].is_addresses() {
            return self.address(access);
        }
        let size = u64::from(self.regions[usize::from(access.region)].record_size.max(1));
        let whole = access.kind == AccessKind::Read
            && u64::from(access.len) == size
            && access.offset.is_multiple_of(size)
            && access.offset / size <= u64::from(u32::MAX);
        if whole {
            #[expect(clippy::cast_possible_truncation, reason = "checked above")]
            return self.records(access.region, &[(access.offset / size) as u32]);
        }
        self.end_together();
        self.segment(access.region, false, 1);
        push(&mut self.others, ((access.kind as u64) << 1) | 1);
        push(&mut self.others, zigzag(access.offset as i64 - self.current.last));
        push(&mut self.others, u64::from(access.len));
        self.current.last = access.offset as i64;
    }

    /// An access of all addresses: eight bytes, as many accesses as are of one kind and length in a segment.
    fn address(&mut self, access: Access) {
        match &mut self.current.run {
            Some((kind, len, count)) if (*kind, *len) == (access.kind, access.len) => *count += 1,
            _ => {
                self.end_run();
                self.current.run = Some((access.kind, access.len, 1));
            }
        }
        self.others.extend_from_slice(&access.offset.to_le_bytes());
    }

    /// Writes the segment of the accesses that have none.
    fn end_run(&mut self) {
        if let Some((kind, len, count)) = self.current.run.take() {
            // The region is the only one.
            self.segment(0, true, 0);
            [count, kind as u64, len.into()].into_iter().for_each(|number| push(&mut self.current.heads, number));
        }
    }

    fn segment(&mut self, region: u16, walk: bool, count: u64) {
        self.current.segments += 1;
        push(&mut self.current.heads, u64::from(region) << 1 | u64::from(walk));
        if !walk {
            push(&mut self.current.heads, count);
        }
    }

    /// The search is over.
    pub fn end(&mut self) {
        self.end_run();
        self.end_together();
        self.walks.align();
        let from = self.heads.len();
        push(&mut self.heads, self.current.segments);
        self.heads.extend_from_slice(&self.current.heads);
        let scratch = &mut self.scratch;
        scratch.clear();
        scratch.extend_from_slice(&(self.current.pixels.len() as u64).to_le_bytes());
        self.current.pixels.iter().for_each(|pixel| scratch.extend_from_slice(&pixel.to_le_bytes()));
        scratch.extend_from_slice(&self.heads[from..]);
        scratch.extend_from_slice(&self.walks.bytes()[self.current.walks_from..]);
        scratch.extend_from_slice(&self.others[self.current.others_from..]);
        self.tally.count(scratch);
    }

    /// As if no access had been too long.
    #[cfg(test)]
    pub(super) fn forget_lengths(&mut self) {
        self.longest = 0;
    }

    /// Compresses the searches into a block.
    ///
    /// # Errors
    /// [`Error::Invalid`] if they are too many for one, or an access is longer than [`MAX_ACCESS`].
    pub fn finish(self, meta: BlockMeta) -> Result<(Block, Tally)> {
        if self.longest > MAX_ACCESS {
            return Err(Error::Invalid(format!("an access of {} bytes; the most is {MAX_ACCESS}", self.longest)));
        }
        let planes = [&self.heads[..], &self.destinations, self.walks.bytes(), &self.others];
        let mut payload = Vec::with_capacity(12 + planes.iter().map(|plane| plane.len()).sum::<usize>());
        for plane in &planes[..3] {
            let len = u32::try_from(plane.len()).map_err(|_| Error::Invalid("too many searches in a block".into()))?;
            payload.extend_from_slice(&len.to_le_bytes());
        }
        planes.iter().for_each(|plane| payload.extend_from_slice(plane));
        let records = u32::try_from(self.tally.records).expect("a block's worth of searches");
        let meta = BlockMeta { records, ..meta };
        // Addresses are spelled out, and what repeats of them is long and far apart.
        let block = match self.regions.iter().any(Region::is_addresses) {
            true => Block::encode_long(meta, &payload, LEVEL)?,
            false => Block::encode(meta, &payload, LEVEL)?,
        };
        Ok((block, self.tally))
    }
}
