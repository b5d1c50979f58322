//! The order of blocks: proof that it is the one in which they were written, and what a reader can judge of it.

use super::block_header::HEADER_BYTES;
use super::section::{BlockMeta, Section};
use crate::Header;
use crate::vocabulary::meaning;
use xxhash_rust::xxh3::Xxh3;

/// A running hash of the stream's header and of every block's: each block's own checksum is in its header, so this one
/// number stands for all bytes before the end block, in their order.
pub(super) struct OrderProof(Box<Xxh3>);

impl OrderProof {
    /// Of a stream that begins with these bytes, which hold the checksum of its header.
    pub(super) fn new(prelude: &[u8]) -> Self {
        let mut hash = Box::new(Xxh3::new());
        hash.update(prelude);
        Self(hash)
    }

    /// A block follows.
    pub(super) fn add(&mut self, header: &[u8; HEADER_BYTES]) {
        self.0.update(header);
    }

    /// The proof of what was added so far.
    pub(super) fn sum(&self) -> u64 {
        self.0.digest()
    }
}

/// What can be seen to be out of order, whoever wrote it.
#[derive(Default)]
pub(super) struct Sequence {
    /// Batches are windows: their numbers ascend, and within each the warm-up comes first.
    windows: bool,
    /// Have there been records?
    begun: bool,
    /// Batch of the last records, and whether they are measured.
    last: (u64, bool),
}

impl Sequence {
    pub(super) fn of(header: &Header) -> Self {
        Self { windows: header.meaning(meaning::SAMPLE_WINDOWS).is_some(), ..Self::default() }
    }

    /// A block comes next.
    ///
    /// # Errors
    /// What is wrong with that.
    pub(super) fn next(&mut self, section: Section, meta: BlockMeta) -> Result<(), &'static str> {
        match section {
            Section::Records => {
                let at = (meta.batch, !meta.warm_up);
                if self.windows && self.begun && at < self.last {
                    return Err("its windows are out of order");
                }
                (self.begun, self.last) = (true, at);
                Ok(())
            }
            Section::IrradianceRecords | Section::PixelWeights if self.begun => {
                Err("cached irradiance stands behind the first queries")
            }
            Section::IrradianceRecords | Section::PixelWeights | Section::End => Ok(()),
        }
    }
}
