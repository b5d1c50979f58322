//! Blocks for keeping: the walks of a tree coded by what walks before them did, in an order in which that tells much.
//!
//! The payload that comes back is the very one that was packed. What is not walks is left to zstd; the walks are coded symbol
//! by symbol, each with the frequencies of its context: what was done last at this node, beside it, and on the way there. Searches of
//! neighbouring places walk alike, so walks are coded by the first leaf that they come to, and the order goes along.

mod memory;
mod planes;
mod rans;
mod segments;
mod tables;
mod units;

use super::bits::BitReader;
use super::heap_walk;
use crate::container::{compress_long, content_size, decompress};
use crate::region::Region;
use memory::{Coder, DECISION_CONTEXTS, Memory};
use planes::{HEADS, WALKS, join, split};
use rans::{Decoder, Share};
use segments::Walks;
use tables::{Counts, Tables, decision};
use units::{DECISIONS, way};

pub(super) use planes::Joined;
pub(super) use segments::has_tree;

/// Most searches of a block that is packed so.
pub(super) const MOST_SEARCHES: u32 = 1 << 16;
/// Longest payload of a block that is packed so, in bytes: what a few bytes can mean takes time to read.
pub(super) const MOST_PAYLOAD: usize = 1 << 23;
/// zstd level of what is no walk, and of blocks without walks.
pub(super) const LEVEL: i32 = 19;
/// Nothing but where walks begin is told of their order.
const AS_THEY_STAND: u8 = 0;
/// The place in the block of each walk follows.
const SORTED: u8 = 1;

/// The payload in fewer bytes; `None` if it has no walks, or too many, or would not come back as it is.
pub(super) fn pack(payload: &[u8], searches: u32, regions: &[Region]) -> Option<Vec<u8>> {
    if payload.len() > MOST_PAYLOAD || searches > MOST_SEARCHES {
        return None;
    }
    let planes = split(payload)?;
    let walks = Walks::of(planes[HEADS], searches, regions)?;
    let begins = begins(planes[WALKS], &walks)?;
    let as_they_stand: Vec<u16> = (0..searches).map(|search| search as u16).collect();
    let mut sorted = as_they_stand.clone();
    sorted.sort_by_key(|&search| begins[usize::from(search)].1);
    let mut places = vec![SORTED];
    sorted.iter().for_each(|search| places.extend_from_slice(&search.to_le_bytes()));
    let coded = |mut bytes: Vec<u8>, order: &[u16]| {
        let counted = Counted { bits: BitReader::new(&[]), counts: Counts::new(), symbols: vec![] };
        let mut memory = Memory::new(walks.nodes);
        let counted = order.iter().map(|&search| usize::from(search)).try_fold(counted, |mut counted, search| {
            counted.bits = BitReader::new(&planes[WALKS][begins[search].0..]);
            (0..walks.of_search[search]).try_for_each(|_| memory.walk(&mut counted)).map(|()| counted)
        })?;
        let written = counted.counts.tables();
        let tables = Tables::read(&written).expect("tables that were written can be read");
        push_frame(&mut bytes, &written)?;
        bytes.extend(rans::encode(counted.symbols.iter().map(|&symbol| share(&tables, symbol))));
        Some(bytes)
    };
    let ways = [coded(vec![AS_THEY_STAND], &as_they_stand)?, coded(places, &sorted)?];
    let mut packed = vec![];
    push_frame(&mut packed, &join([planes[0], planes[1], &[], planes[3]]))?;
    packed.extend(ways.into_iter().min_by_key(Vec::len)?);
    // Bits that fill a last byte are not told: another program may have set them.
    (unpack(&packed, payload.len(), searches, regions)? == payload).then_some(packed)
}

/// The payload of so many bytes; `None` if it is none.
pub(super) fn unpack(packed: &[u8], bytes: usize, searches: u32, regions: &[Region]) -> Option<Vec<u8>> {
    if bytes > MOST_PAYLOAD || searches > MOST_SEARCHES {
        return None;
    }
    let (rest, packed) = take_frame(packed, bytes)?;
    let planes = split(&rest).filter(|planes| planes[WALKS].is_empty())?;
    let walks = Walks::of(planes[HEADS], searches, regions)?;
    let (order, packed) = take_order(packed, searches)?;
    // The payload, with room for the walks where they go.
    let room = vec![0; bytes.checked_sub(rest.len())?];
    let mut payload = join([planes[0], planes[1], &room, planes[3]]);
    let begin = 12 + planes[0].len() + planes[1].len();
    unpack_walks(packed, &walks, order, &mut payload[begin..begin + room.len()])?;
    Some(payload)
}

/// The places in the block of the searches in the order in which their walks are coded, if that is another, and what is behind it.
fn take_order(packed: &[u8], searches: u32) -> Option<(Option<Vec<usize>>, &[u8])> {
    match packed.split_first()? {
        (&AS_THEY_STAND, packed) => Some((None, packed)),
        (&SORTED, packed) => {
            let (places, packed) = packed.split_at_checked(2 * searches as usize)?;
            let place = |place: &[u8]| usize::from(u16::from_le_bytes([place[0], place[1]]));
            Some((Some(places.chunks_exact(2).map(place).collect()), packed))
        }
        _ => None,
    }
}

/// Fills the plane of the walks; `None` if it is too long or too short for them.
fn unpack_walks(packed: &[u8], walks: &Walks, order: Option<Vec<usize>>, plane: &mut [u8]) -> Option<()> {
    let (written, symbols) = take_frame(packed, tables::MOST_BYTES)?;
    let (states, words) = rans::split(symbols)?;
    let tables = Tables::read(&written)?;
    let (decoder, bits) = (Decoder::new(states, &words), Bits::new(plane));
    let mut read = Read { decoder, ones: tables.ones(), tables: &tables, bits };
    let mut memory = Memory::new(walks.nodes);
    let mut ranges = vec![0..0; walks.of_search.len()];
    for at in 0..walks.of_search.len() {
        let search = order.as_ref().map_or(at, |order| order[at]);
        let begin = read.bits.at;
        for _ in 0..*walks.of_search.get(search)? {
            memory.walk(&mut read)?;
        }
        read.bits.align()?;
        ranges[search] = begin..read.bits.at;
    }
    if !read.decoder.is_done() || read.bits.at != plane.len() {
        return None;
    }
    if order.is_some() {
        // A search that comes twice in the order has no place for another.
        let sorted = plane.to_vec();
        let walked: Vec<_> = ranges.into_iter().map(|range| &sorted[range]).collect();
        let walked = walked.concat();
        plane.get_mut(..).filter(|plane| plane.len() == walked.len())?.copy_from_slice(&walked);
    }
    Some(())
}

/// Where the walks of each search begin in their plane, and the first leaf that each comes to; `None` if there is not just what
/// they say.
fn begins(plane: &[u8], walks: &Walks) -> Option<Vec<(usize, u32)>> {
    let (mut begin, mut visits) = (0, heap_walk::Visits::new());
    let mut begins = Vec::with_capacity(walks.of_search.len());
    for &count in &walks.of_search {
        let mut bits = BitReader::new(&plane[begin..]);
        let mut leaf = 0;
        for walk in 0..count {
            heap_walk::decode(&mut bits, walks.nodes, &mut visits, &mut |visits| {
                if walk == 0 && leaf == 0 {
                    let mut nodes = visits.iter().map(|visit| visit + 1);
                    // In the order of leaves from left to right, whatever their depths.
                    leaf = nodes.find(|node| 2 * node >= walks.nodes).map_or(0, |node| node << node.leading_zeros());
                }
            })?;
        }
        bits.align();
        begins.push((begin, leaf));
        begin += bits.bytes_read();
    }
    (begin == plane.len()).then_some(begins)
}

/// A zstd frame behind its length.
fn push_frame(bytes: &mut Vec<u8>, content: &[u8]) -> Option<()> {
    let frame = compress_long(content, LEVEL).ok()?;
    bytes.extend_from_slice(&u32::try_from(frame.len()).ok()?.to_le_bytes());
    bytes.extend_from_slice(&frame);
    Some(())
}

/// The content of a frame, of at most so many bytes, and what is behind it.
fn take_frame(bytes: &[u8], most: usize) -> Option<(Vec<u8>, &[u8])> {
    let (length, bytes) = bytes.split_first_chunk::<4>()?;
    let (frame, behind) = bytes.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)?;
    let mut content = vec![0; content_size(frame).filter(|&size| size <= most)?];
    let length = decompress(frame, &mut content).ok()?;
    content.truncate(length);
    Some((content, behind))
}

/// A symbol and its context: a decision in the lowest bit, or a way.
#[derive(Clone, Copy)]
struct Symbol(u32);

const IS_WAY: u32 = 1 << 31;

fn share(tables: &Tables, Symbol(symbol): Symbol) -> Share {
    match symbol & IS_WAY {
        0 => decision(tables.ones()[symbol as usize >> 1].into(), symbol & 1),
        _ => tables.way((symbol & !IS_WAY) as usize >> 6, symbol as usize & 63),
    }
}

/// Walks that are there, as symbols.
struct Counted<'a> {
    bits: BitReader<'a>,
    counts: Counts,
    symbols: Vec<Symbol>,
}

impl Coder for Counted<'_> {
    #[inline]
    fn decision(&mut self, context: usize) -> Option<u32> {
        let bit = self.bits.bit()?;
        self.counts.decisions[context][bit as usize] += 1;
        self.symbols.push(Symbol((context as u32) << 1 | bit));
        Some(bit)
    }

    #[inline]
    fn way(&mut self, context: usize) -> Option<usize> {
        let way = way(|| self.bits.bit())?;
        self.counts.ways[context][way] += 1;
        self.symbols.push(Symbol(IS_WAY | (context as u32) << 6 | way as u32));
        Some(way)
    }
}

/// Symbols as walks.
struct Read<'a> {
    decoder: Decoder<'a>,
    ones: &'a [u16; DECISION_CONTEXTS],
    tables: &'a Tables,
    bits: Bits<'a>,
}

impl Coder for Read<'_> {
    #[inline(always)]
    fn decision(&mut self, context: usize) -> Option<u32> {
        let ones = u32::from(self.ones[context & (DECISION_CONTEXTS - 1)]);
        let bit = u32::from(self.decoder.number() < ones);
        self.decoder.take(decision(ones, bit));
        self.bits.push(bit, 1)?;
        Some(bit)
    }

    #[inline(always)]
    fn way(&mut self, context: usize) -> Option<usize> {
        let (way, share) = self.tables.way_of(context, self.decoder.number());
        self.decoder.take(share);
        let (bits, count) = DECISIONS[way];
        self.bits.push(bits, count)?;
        Some(way)
    }
}

/// Bits written into bytes that are there.
struct Bits<'a> {
    bytes: &'a mut [u8],
    at: usize,
    pending: u64,
    count: u32,
}

impl<'a> Bits<'a> {
    const fn new(bytes: &'a mut [u8]) -> Self {
        Self { bytes, at: 0, pending: 0, count: 0 }
    }

    /// So many bits, the lowest first; `None` where there are no bytes for them.
    #[inline(always)]
    fn push(&mut self, bits: u32, count: u32) -> Option<()> {
        self.pending |= u64::from(bits) << self.count;
        self.count += count;
        if self.count >= 32 {
            *self.bytes.get_mut(self.at..)?.first_chunk_mut()? = (self.pending as u32).to_le_bytes();
            self.at += 4;
            self.pending >>= 32;
            self.count -= 32;
        }
        Some(())
    }

    /// Fills the last byte with zeros.
    fn align(&mut self) -> Option<()> {
        let count = self.count.div_ceil(8) as usize;
        self.bytes.get_mut(self.at..self.at + count)?.copy_from_slice(&self.pending.to_le_bytes()[..count]);
        (self.at, self.pending, self.count) = (self.at + count, 0, 0);
        Some(())
    }
}

#[cfg(test)]
mod tests;
