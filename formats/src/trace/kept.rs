//! Blocks of a trace that become one of an archive.

use super::archive::{Joined, LEVEL, MOST_PAYLOAD, MOST_SEARCHES, has_tree, pack};
use crate::container::{Block, BlockMeta, Section};
use crate::digest::Tally;
use crate::error::Result;
use crate::region::Region;
use crate::trace::decode::payload_of;

/// Fewer searches than this may be smaller by zstd.
const FEW: u32 = 1 << 12;

/// Blocks that follow one another, as many as go into one.
#[derive(Default)]
pub(super) struct Kept {
    first: Option<Block>,
    blocks: usize,
    searches: u32,
    bytes: usize,
    joined: Joined,
    tally: Tally,
}

impl Kept {
    /// Do the searches of one more go into the same block?
    pub(super) fn has_room_for(&self, block: &Block, regions: &[Region]) -> bool {
        let Some(first) = &self.first else { return true };
        let (one, other) = (first.meta, block.meta);
        (one.batch, one.warm_up, Section::Records) == (other.batch, other.warm_up, block.section)
            && has_tree(regions)
            && self.searches.checked_add(other.records).is_some_and(|searches| searches <= MOST_SEARCHES)
            && self.bytes + block.raw_len() <= MOST_PAYLOAD
    }

    /// Takes one more, which has been read and adds so much to the digest.
    pub(super) fn push(&mut self, block: Block, tally: Tally, regions: &[Region]) {
        let payload = payload_of(&block, regions);
        payload
            .and_then(|payload| self.joined.push(&payload, block.meta.records))
            .expect("searches that have been read");
        self.searches += block.meta.records;
        self.bytes += block.raw_len();
        self.tally += tally;
        self.blocks += 1;
        self.first.get_or_insert(block);
    }

    /// One block of all of them, the smallest there is; `None` if there are none.
    ///
    /// # Errors
    /// [`Error::Invalid`] if they are too large, [`Error::Io`].
    pub(super) fn finish(self, regions: &[Region]) -> Result<Option<(Block, Tally)>> {
        let Some(first) = self.first else { return Ok(None) };
        let payload = self.joined.payload();
        let meta = BlockMeta { records: self.searches, ..first.meta };
        let walks = pack(&payload, self.searches, regions).map(|bytes| Block::of_walks(meta, payload.len(), bytes));
        let mut forms: Vec<_> = walks.into_iter().collect();
        // A long block of walks is never smaller by zstd, which takes its time.
        if forms.is_empty() || self.searches < FEW {
            forms.push(Block::encode_long(meta, &payload, LEVEL)?);
        }
        if self.blocks == 1 {
            forms.push(first);
        }
        let block = forms.into_iter().min_by_key(Block::stored_len).expect("there is a form");
        Ok(Some((block, self.tally)))
    }
}
