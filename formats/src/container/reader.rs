//! Streams, read block by block.

use super::block::Block;
use super::block_header::{BlockHeader, HEADER_BYTES};
use super::end::SealedEnd;
use super::order::{OrderProof, Sequence};
use super::section::Section;
use super::spelling::{MAX_RECORD, decode};
use super::{End, FORMAT_VERSION, Header, MAGIC, MAX_PIXELS, PROVES_ORDER, StreamKind};
use crate::digest::Tally;
use crate::error::{Error, Result};
use std::io::{ErrorKind, Read};
use xxhash_rust::xxh3::xxh3_64;

/// Bytes before the header record: magic, version, kind, length, checksum.
const PRELUDE_BYTES: usize = 24;

/// Reads a stream block by block, whatever its records are.
pub struct BlockReader<R> {
    input: R,
    version: u16,
    kind: StreamKind,
    header: Header,
    order: OrderProof,
    sequence: Sequence,
    blocks: u64,
    records: u64,
    end: Option<End>,
}

impl<R: Read> BlockReader<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// [`Error::NotAStream`], [`Error::Version`], [`Error::Incomplete`], [`Error::Damaged`] or [`Error::Io`].
    pub fn new(mut input: R) -> Result<Self> {
        let damaged = |what| Error::Damaged { block: 0, what };
        let incomplete = Error::Incomplete { blocks: 0, records: 0 };
        let mut prelude = [0; PRELUDE_BYTES];
        let got = read_up_to(&mut input, &mut prelude)?;
        if prelude[..got.min(8)] != MAGIC[..got.min(8)] {
            return Err(Error::NotAStream);
        }
        if got < PRELUDE_BYTES {
            return Err(incomplete);
        }
        let half = |at: usize| u16::from_le_bytes([prelude[at], prelude[at + 1]]);
        let version = half(8);
        if !(1..=FORMAT_VERSION).contains(&version) {
            return Err(Error::Version { found: version, known: FORMAT_VERSION });
        }
        let len = u32::from_le_bytes(prelude[12..16].try_into().expect("four bytes")) as usize;
        if len > MAX_RECORD {
            return Err(damaged("the header makes no sense"));
        }
        let mut bytes = prelude[..16].to_vec();
        // `take` and not a buffer of `len` bytes: memory grows with what is there, not with what is claimed.
        (&mut input).take(len as u64).read_to_end(&mut bytes)?;
        if bytes.len() < 16 + len {
            return Err(incomplete);
        }
        if prelude[16..24] != xxh3_64(&bytes).to_le_bytes() {
            return Err(damaged("the header does not fit its checksum"));
        }
        let kind = StreamKind::from_number(half(10))
            .ok_or(damaged("it holds records of a sort this program does not know"))?;
        let header: Header = decode(&bytes[16..]).ok_or(damaged("the header cannot be decoded"))?;
        if header.pixels() > MAX_PIXELS {
            return Err(damaged("the header speaks of an image of more than 2^28 pixels"));
        }
        let (order, sequence) = (OrderProof::new(&prelude), Sequence::of(&header));
        Ok(Self { input, version, kind, header, order, sequence, blocks: 0, records: 0, end: None })
    }

    /// What the stream is about.
    #[must_use]
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// The version of the format that it is written in.
    #[must_use]
    pub const fn version(&self) -> u16 {
        self.version
    }

    /// What its records are.
    #[must_use]
    pub const fn kind(&self) -> StreamKind {
        self.kind
    }

    /// The stream must hold records of this kind.
    ///
    /// # Errors
    /// [`Error::WrongKind`] if it holds others.
    pub fn expect_kind(self, kind: StreamKind) -> Result<Self> {
        if self.kind == kind {
            Ok(self)
        } else {
            Err(Error::WrongKind { found: self.kind.plural(), wanted: kind.plural() })
        }
    }

    /// Number of whole blocks read so far.
    #[must_use]
    pub const fn blocks(&self) -> u64 {
        self.blocks
    }

    /// The next block, of records or of what stands beside them, or `None` at the end block.
    ///
    /// # Errors
    /// [`Error::Incomplete`] if the stream stops, [`Error::Damaged`] if it contradicts itself, [`Error::Io`].
    pub fn next_block(&mut self) -> Result<Option<Block>> {
        if self.end.is_some() {
            return Ok(None);
        }
        let mut bytes = [0; HEADER_BYTES];
        if read_up_to(&mut self.input, &mut bytes)? < HEADER_BYTES {
            return Err(self.incomplete());
        }
        let header = BlockHeader::parse(&bytes).map_err(|what| self.damaged(what))?;
        let mut payload = Vec::with_capacity(header.stored_len.min(1 << 20));
        (&mut self.input).take(header.stored_len as u64).read_to_end(&mut payload)?;
        if payload.len() < header.stored_len {
            return Err(self.incomplete());
        }
        let block = Block::of_header(&header, payload).map_err(|what| self.damaged(what))?;
        block.check_memory()?;
        self.sequence.next(block.section, block.meta).map_err(|what| self.damaged(what))?;
        match block.section {
            Section::Records | Section::IrradianceRecords | Section::PixelWeights => {
                self.blocks += 1;
                self.order.add(&bytes);
                // Only the stream's own records are counted; what stands beside them is in the digest.
                if block.section == Section::Records {
                    self.records += u64::from(block.meta.records);
                }
                Ok(Some(block))
            }
            Section::End => {
                let end = block.decode().and_then(|bytes| self.decode_end(&bytes));
                let (end, order) = end.ok_or_else(|| self.damaged("the end block cannot be decoded"))?;
                if order.is_some_and(|order| order != self.order.sum()) {
                    return Err(self.damaged("the end block speaks of other blocks, or of these in another order"));
                }
                if read_up_to(&mut self.input, &mut [0])? > 0 {
                    return Err(self.damaged("bytes follow the end block"));
                }
                // Now only: who asks for the end after an error is to have none.
                self.end = Some(end);
                Ok(None)
            }
        }
    }

    /// The end, and what proves the order of the blocks before it, which the first version had not.
    fn decode_end(&self, bytes: &[u8]) -> Option<(End, Option<u64>)> {
        if self.version < PROVES_ORDER {
            return Some((decode(bytes)?, None));
        }
        decode(bytes).map(|SealedEnd { end, order }| (end, Some(order)))
    }

    /// The end block, after [`next_block`](Self::next_block) has returned `None`, given what was counted on the way.
    ///
    /// # Errors
    /// [`Error::Incomplete`] if it has not been reached, [`Error::Damaged`] if the records read are not those it speaks of.
    pub fn end(&self, tally: Tally) -> Result<&End> {
        let end = self.end.as_ref().ok_or_else(|| self.incomplete())?;
        if end.tally.records != tally.records {
            Err(self.damaged("the end block speaks of another number of records"))
        } else if end.tally.digest != tally.digest {
            Err(self.damaged("the records do not fit the digest in the end block"))
        } else {
            Ok(end)
        }
    }

    /// The error that the block read last does not hold what it should.
    #[must_use]
    pub const fn damaged(&self, what: &'static str) -> Error {
        Error::Damaged { block: self.blocks, what }
    }

    const fn incomplete(&self) -> Error {
        Error::Incomplete { blocks: self.blocks, records: self.records }
    }
}

/// Fills `buffer` as far as the input goes; returns the number of bytes read.
fn read_up_to(input: &mut impl Read, buffer: &mut [u8]) -> Result<usize> {
    let mut got = 0;
    while got < buffer.len() {
        match input.read(&mut buffer[got..]) {
            Ok(0) => break,
            Ok(n) => got += n,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(got)
}
