//! Streams that are kept: are those of every version read, and is one refused whose blocks are not as they were written?
//!
//! `golden/v1-*` were written by the programs when the end block did not prove an order; their numbers and digests are what those
//! programs said of them. `golden/v2-*` are the same blocks in version 2.

use pm_formats::trace::{Access, TraceReader, TraceSink, TraceWriter};
use pm_formats::{BlockReader, BlockWriter, Photon, Query, Record, RecordReader, StreamKind, Tally, UnroundedPhoton};
use std::fs;
use std::path::PathBuf;
use xxhash_rust::xxh3::xxh3_64;

const STREAMS: [(&str, u64, &str); 5] = [
    ("photons.pmp", 303, "1b015718399db3e5f671c9519d6aee1f"),
    ("tiled.pmq", 95, "b22812a89b49a74e44a0df4c7ec3da3c"),
    ("cached.pmq", 112, "56a6abe0cc22af86640e485ea51aeee7"),
    ("tiled.pmt", 95, "56ac14809c3609dff92f8cb580580110"),
    ("windows.pmt", 53, "cb3eed7fb799cb3d75116cb46ce817d4"),
];

/// Regions that are coded together, without and with what reads wait for, and walks that are apart, in their order and sorted: kept of version 2 only.
const STREAMS_OF_VERSION_2: [(&str, u64, &str); 5] = [
    ("apart.pmt", 95, "f492ed74e02a3fdd198bad03ff10dfd1"),
    ("turns.pmt", 95, "f5025c3c9fc0437901565e0c4da10cee"),
    ("waits.pmt", 95, "b9bfde3a0d09ad82728c3a1ad178ec12"),
    ("walks.pmt", 4616, "fab8562fa166365121bc82b4f1295549"),
    ("walks-sorted.pmt", 4616, "fab8562fa166365121bc82b4f1295549"),
];

fn kept(version: u16, name: &str) -> Vec<u8> {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests/golden", &format!("v{version}-{name}")].iter().collect();
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

struct Nobody;

impl TraceSink for Nobody {
    fn search(&mut self, _: &[u32]) {}
    fn access(&mut self, _: Access) {}
}

fn records<T: Record>(stream: BlockReader<&[u8]>) -> pm_formats::Result<Tally> {
    let mut reader = RecordReader::<T, _>::from_blocks(stream)?;
    while reader.next_block()?.is_some() {}
    Ok(reader.end()?.tally)
}

/// Reads all of a stream and checks it.
fn read(bytes: &[u8]) -> pm_formats::Result<Tally> {
    let stream = BlockReader::new(bytes)?;
    match stream.kind() {
        StreamKind::Photons => records::<Photon>(stream),
        StreamKind::Queries => records::<Query>(stream),
        StreamKind::UnroundedPhotons => records::<UnroundedPhoton>(stream),
        StreamKind::Trace => {
            let mut reader = TraceReader::from_blocks(stream)?;
            while reader.replay_block(&mut Nobody)?.is_some() {}
            Ok(reader.end()?.tally)
        }
    }
}

/// The stream as it is written today.
fn rewritten(bytes: &[u8]) -> Vec<u8> {
    let mut reader = BlockReader::new(bytes).unwrap();
    let mut writer = BlockWriter::new(vec![], reader.kind(), reader.header()).unwrap();
    while let Some(block) = reader.next_block().unwrap() {
        writer.write(&block).unwrap();
    }
    writer.finish(reader.end(read(bytes).unwrap()).unwrap()).unwrap()
}

/// Header, blocks and end block of a stream, by offsets.
fn pieces(bytes: &[u8]) -> Vec<Vec<u8>> {
    let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let mut ends = vec![24 + length(12)];
    while ends[ends.len() - 1] < bytes.len() {
        let at = ends[ends.len() - 1];
        ends.push(at + 40 + length(at + 24));
    }
    let starts = [0].into_iter().chain(ends.iter().copied());
    starts.zip(&ends).map(|(start, &end)| bytes[start..end].to_vec()).collect()
}

/// A block with another byte in its header, and the checksum that goes with it.
fn with_byte(block: &[u8], at: usize, byte: u8) -> Vec<u8> {
    let mut block = block.to_vec();
    block[at] = byte;
    let sum = xxh3_64(&block[..28]).to_le_bytes();
    block[28..32].copy_from_slice(&sum[..4]);
    block
}

fn is_refused(what: &str, pieces: &[Vec<u8>]) {
    let outcome = read(&pieces.concat());
    assert!(outcome.as_ref().is_err_and(pm_formats::Error::is_damage), "{what}: {outcome:?}");
}

#[test]
fn every_version_is_read() {
    for (name, number, digest) in STREAMS {
        for version in [1, 2] {
            let bytes = kept(version, name);
            let tally = read(&bytes).unwrap_or_else(|error| panic!("v{version}-{name}: {error}"));
            assert_eq!((tally.records, &*tally.digest.to_string()), (number, digest), "v{version}-{name}");
            assert_eq!(BlockReader::new(&bytes[..]).unwrap().version(), version);
        }
    }
}

#[test]
fn streams_of_version_2_alone_are_read() {
    for (name, number, digest) in STREAMS_OF_VERSION_2 {
        let bytes = kept(2, name);
        let tally = read(&bytes).unwrap();
        assert_eq!((tally.records, &*tally.digest.to_string()), (number, digest), "{name}");
        assert!(rewritten(&bytes) == bytes, "{name}");
        let whole = pieces(&bytes);
        for at in 1..whole.len() - 1 {
            is_refused(name, &[&whole[..at], &whole[at + 1..]].concat());
        }
    }
}

#[test]
fn what_is_written_is_what_was_written() {
    for (name, ..) in STREAMS {
        assert!(rewritten(&kept(1, name)) == kept(2, name), "{name}");
    }
}

#[test]
fn blocks_that_are_moved_doubled_or_left_out_are_refused() {
    for (name, ..) in STREAMS {
        let whole = pieces(&kept(2, name));
        let blocks = 1..whole.len() - 1;
        for from in blocks.clone() {
            let mut without = whole.clone();
            let block = without.remove(from);
            is_refused(&format!("{name}: block {from} left out"), &without);
            for to in blocks.clone().filter(|&to| to != from) {
                let mut moved = without.clone();
                moved.insert(to, block.clone());
                is_refused(&format!("{name}: block {from} moved to {to}"), &moved);
                let mut doubled = whole.clone();
                doubled[to] = block.clone();
                is_refused(&format!("{name}: block {from} in the place of {to}"), &doubled);
            }
        }
    }
}

#[test]
fn what_a_block_says_of_itself_cannot_be_changed() {
    for (name, ..) in STREAMS {
        let whole = pieces(&kept(2, name));
        for at in 1..whole.len() - 1 {
            // Section, flags, the low byte of the batch.
            for byte in [4, 5, 8] {
                let mut changed = whole.clone();
                changed[at] = with_byte(&whole[at], byte, whole[at][byte] ^ 1);
                is_refused(&format!("{name}: byte {byte} of block {at}"), &changed);
            }
        }
    }
}

#[test]
fn another_streams_header_is_refused() {
    for kind in [".pmq", ".pmt"] {
        let names: Vec<&str> = STREAMS.iter().map(|(name, ..)| *name).filter(|name| name.ends_with(kind)).collect();
        for of in &names {
            for with in names.iter().filter(|with| *with != of) {
                let mut stream = pieces(&kept(2, of));
                stream[0] = pieces(&kept(2, with)).remove(0);
                is_refused(&format!("{of} under the header of {with}"), &stream);
            }
        }
    }
}

#[test]
fn the_new_end_block_makes_no_old_stream_whole_and_the_old_one_no_new_stream() {
    for (name, ..) in STREAMS {
        let (old, new) = (pieces(&kept(1, name)), pieces(&kept(2, name)));
        let swapped = |pieces: &[Vec<u8>], end: &[Vec<u8>]| {
            let mut pieces = pieces.to_vec();
            *pieces.last_mut().unwrap() = end.last().unwrap().clone();
            pieces
        };
        is_refused(name, &swapped(&old, &new));
        is_refused(name, &swapped(&new, &old));
    }
}

#[test]
fn what_a_reader_can_judge_is_refused_in_old_streams_too() {
    let mut windows = pieces(&kept(1, "windows.pmt"));
    windows.swap(1, 3);
    let said = read(&windows.concat()).unwrap_err().to_string();
    assert!(said.contains("windows are out of order"), "{said}");
    let mut cached = pieces(&kept(1, "cached.pmq"));
    let section = cached.remove(1);
    cached.insert(cached.len() - 1, section);
    let said = read(&cached.concat()).unwrap_err().to_string();
    assert!(said.contains("behind the first queries"), "{said}");
}

#[test]
fn archives_are_written_as_they_were() {
    // Whatever the machine and the build: how walks are coded is decided by whole numbers and by the four operations.
    for name in ["walks.pmt", "walks-sorted.pmt"] {
        let bytes = kept(2, name);
        let mut reader = TraceReader::new(&bytes[..]).unwrap();
        let mut writer = TraceWriter::new(vec![], reader.header()).unwrap();
        while let Some((block, tally)) = reader.next_archived().unwrap() {
            writer.write(&block, tally).unwrap();
        }
        assert!(writer.finish(reader.end().unwrap().stages.clone()).unwrap() == bytes, "{name}");
    }
}
