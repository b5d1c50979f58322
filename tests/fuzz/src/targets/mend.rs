//! Checksums made to fit, so that what lies behind them is reached.

use pm_formats::trace::{Access, TraceSink, decode_searches};
use pm_formats::{
    Block, BlockReader, BlockWriter, End, Photon, Query, Section, StreamKind, Tally, UnroundedPhoton, decode_checked,
    tally_beside,
};
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

/// Bytes of a stream before its header record, and of a block before its payload.
const PRELUDE: usize = 24;
const BLOCK: usize = 40;
/// First bytes of a block.
const TAG: &[u8; 4] = b"PMBL";
/// Number of the section that ends a stream.
const END: u8 = 255;

fn length(stream: &[u8], at: usize) -> usize {
    u32::from_le_bytes(stream[at..at + 4].try_into().expect("four bytes")) as usize
}

fn set(stream: &mut [u8], at: usize, number: usize) {
    stream[at..at + 4].copy_from_slice(&u32::try_from(number).expect("a small input").to_le_bytes());
}

/// The bytes as a stream whose lengths, tags, checksums and proof of order fit; what they hold stays.
///
/// # Panics
/// Beyond 4 GiB.
#[must_use]
pub fn mended(data: &[u8]) -> Vec<u8> {
    let mut stream = data.to_vec();
    stream.resize(stream.len().max(PRELUDE), 0);
    stream[..8].copy_from_slice(b"\x89PMS\r\n\x1a\n");
    stream[8] = if stream[8] == 1 { 1 } else { 2 };
    stream[9] = 0;
    stream[10] = 1 + stream[10].wrapping_sub(1) % 4;
    stream[11] = 0;
    let proves_order = stream[8] == 2;
    let header = reach(&stream, PRELUDE, length(&stream, 12));
    set(&mut stream, 12, header);
    let sum = xxh3_64(&[&stream[..16], &stream[PRELUDE..PRELUDE + header]].concat());
    stream[16..24].copy_from_slice(&sum.to_le_bytes());
    let mut order = Xxh3::new();
    order.update(&stream[..PRELUDE]);
    let mut at = PRELUDE + header;
    while at + BLOCK <= stream.len() {
        stream[at..at + 4].copy_from_slice(TAG);
        let section = stream[at + 4];
        stream[at + 4] = if section == END { END } else { section % 3 };
        stream[at + 5] &= 1;
        stream[at + 6] %= 3;
        stream[at + 7] = 0;
        let stored = reach(&stream, at + BLOCK, length(&stream, at + 24));
        set(&mut stream, at + 24, stored);
        let raw = stream[at + 6] == 0;
        if raw {
            set(&mut stream, at + 20, stored);
        }
        let payload = at + BLOCK..at + BLOCK + stored;
        let ends = stream[at + 4] == END;
        if ends && raw && proves_order && stored >= 8 {
            stream[payload.end - 8..payload.end].copy_from_slice(&order.digest().to_le_bytes());
        }
        let sum = xxh3_64(&stream[payload.clone()]);
        stream[at + 32..at + 40].copy_from_slice(&sum.to_le_bytes());
        let sum = xxh3_64(&stream[at..at + 28]).to_le_bytes();
        stream[at + 28..at + 32].copy_from_slice(&sum[..4]);
        order.update(&stream[at..at + BLOCK]);
        at = payload.end;
        if ends {
            stream.truncate(at);
        }
    }
    stream
}

/// How many bytes from here a length means: up to where the next block begins, if it does not lead to one.
fn reach(stream: &[u8], from: usize, length: usize) -> usize {
    let rest = &stream[from..];
    if length == rest.len() || rest.get(length..).is_some_and(|next| next.starts_with(TAG)) {
        return length;
    }
    rest.windows(TAG.len()).position(|window| window == TAG).unwrap_or_else(|| length.min(rest.len()))
}

/// A whole stream of those blocks of a stream that hold what they say, up to the first that does not; `None` without a header.
pub(super) fn whole(stream: &[u8]) -> Option<Vec<u8>> {
    let mut blocks = BlockReader::new(stream).ok()?;
    let mut writer =
        BlockWriter::new(vec![], blocks.kind(), blocks.header()).expect("a header that was read can be written");
    let mut tally = Tally::default();
    while let Ok(Some(block)) = blocks.next_block() {
        let Some(more) = tally_of(&blocks, &block) else { break };
        tally += more;
        writer.write(&block).expect("memory takes all");
    }
    let stages = blocks.end(tally).map(|end| end.stages.clone()).unwrap_or_default();
    Some(writer.finish(&End { tally, stages }).expect("memory takes all"))
}

/// What a block adds to the digest; `None` if it does not hold what it says.
fn tally_of(blocks: &BlockReader<&[u8]>, block: &Block) -> Option<Tally> {
    let header = blocks.header();
    match (block.section, blocks.kind()) {
        (Section::Records, StreamKind::Photons) => Some(decode_checked::<Photon>(block, header).ok()?.1),
        (Section::Records, StreamKind::Queries) => Some(decode_checked::<Query>(block, header).ok()?.1),
        (Section::Records, StreamKind::UnroundedPhotons) => {
            Some(decode_checked::<UnroundedPhoton>(block, header).ok()?.1)
        }
        (Section::Records, StreamKind::Trace) => decode_searches(block, &header.regions, &mut Nobody),
        (_, StreamKind::Trace) => None,
        _ => tally_beside(block),
    }
}

struct Nobody;

impl TraceSink for Nobody {
    fn access(&mut self, _: Access) {}
}

/// The same stream with payloads as they are before compression: what is changed in them is then changed in what they say.
///
/// # Panics
/// If it is none.
#[must_use]
pub fn unpacked(stream: &[u8]) -> Vec<u8> {
    let mut at = PRELUDE + length(stream, 12);
    let mut plain = stream[..at].to_vec();
    while at + BLOCK <= stream.len() {
        let stored = length(stream, at + 24);
        let (header, payload) = (&stream[at..at + BLOCK], &stream[at + BLOCK..at + BLOCK + stored]);
        let begin = plain.len();
        plain.extend_from_slice(header);
        if header[6] == 1 {
            let raw = zstd::bulk::decompress(payload, length(header, 20)).expect("a whole stream");
            plain[begin + 6] = 0;
            set(&mut plain, begin + 24, raw.len());
            plain.extend(raw);
        } else if header[6] == 2 {
            let frames = plain_frames(payload);
            set(&mut plain, begin + 24, frames.len());
            plain.extend(frames);
        } else {
            plain.extend_from_slice(payload);
        }
        at += BLOCK + stored;
    }
    mended(&plain)
}

/// First bytes of a zstd frame (RFC 8878).
const FRAME_MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
/// Most bytes of a block in a zstd frame.
const FRAME_BLOCK: usize = 128 << 10;

/// Coded walks whose two frames hold their contents as they are.
fn plain_frames(mut payload: &[u8]) -> Vec<u8> {
    // The order of the walks stands between the frames, so the second is found by how it begins.
    let mut plain = vec![];
    while let Some(at) = payload.windows(8).position(|bytes| bytes[4..] == FRAME_MAGIC) {
        let (before, rest) = payload.split_at(at);
        let (frame, behind) = rest[4..].split_at(length(rest, 0));
        let content = zstd::stream::decode_all(frame).expect("a whole stream");
        assert!(content.len() < FRAME_BLOCK, "a small input");
        let size = u32::try_from(content.len()).expect("a small input");
        plain.extend_from_slice(before);
        plain.extend((size + 12).to_le_bytes());
        // A single segment that tells its size in four bytes, and one last block that is not compressed (RFC 8878, 3.1.1).
        plain.extend(FRAME_MAGIC);
        plain.push(0xa0);
        plain.extend(size.to_le_bytes());
        plain.extend(&(size << 3 | 1).to_le_bytes()[..3]);
        plain.extend(content);
        payload = behind;
    }
    plain.extend_from_slice(payload);
    plain
}
