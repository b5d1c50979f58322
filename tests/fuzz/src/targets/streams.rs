//! Streams of any kind, by every reader there is.

use super::mend;
use pm_formats::trace::{Access, Region, TraceReader, TraceSink, TraceWriter, Waits};
use pm_formats::{
    BlockReader, Photon, Query, Record, RecordReader, Section, StreamKind, UnroundedPhoton, as_commands,
    decode_irradiance, decode_weights,
};
use xxhash_rust::xxh3::xxh3_64;

/// Takes all accesses for one number, and sees that each lies in its region, if it is told of those.
#[derive(Default)]
pub(super) struct Sum {
    sum: u64,
    regions: Vec<Region>,
}

impl TraceSink for Sum {
    fn waits(&mut self, waits: Waits) {
        self.sum = self.sum.rotate_left(3) ^ u64::from(waits.level()) << 1 ^ u64::from(waits.is_for_all());
    }

    fn access(&mut self, access: Access) {
        let Access { region, offset, len, .. } = access;
        let within = self.regions.is_empty() || self.regions[usize::from(region)].holds(offset, len);
        assert!(within, "{len} bytes at {offset} of region {region} are beyond it");
        self.sum = self.sum.rotate_left(5).wrapping_add(offset ^ u64::from(len) ^ u64::from(region));
    }
}

/// A stream as it is.
pub(super) fn any(data: &[u8]) {
    accepted(data);
}

/// The same once all checksums fit, and once it ends behind the last block that holds what it says: then it is accepted.
pub(super) fn mended(data: &[u8]) {
    let mended = mend::mended(data);
    any(&mended);
    if let Some(whole) = mend::whole(&mended) {
        let known = BlockReader::new(&whole[..]).expect("a header that was read is read again");
        let regions_are_sound = known.kind() != StreamKind::Trace || TraceReader::new(&whole[..]).is_ok();
        assert_eq!(
            accepted(&whole),
            regions_are_sound,
            "blocks that were accepted are not, once they are a whole stream"
        );
    }
}

/// Is it a whole stream, whose records are fit for use?
fn accepted(data: &[u8]) -> bool {
    let Ok(blocks) = BlockReader::new(data) else { return false };
    let _ = as_commands(&blocks.header().history);
    match blocks.kind() {
        StreamKind::Photons => records::<Photon>(data),
        StreamKind::Queries => {
            beside(data);
            records::<Query>(data)
        }
        StreamKind::UnroundedPhotons => records::<UnroundedPhoton>(data),
        StreamKind::Trace => trace(data),
    }
}

fn records<T: Record>(data: &[u8]) -> bool {
    let Ok(mut reader) = RecordReader::<T, _>::new(data) else { return false };
    let whole = loop {
        match reader.next_block() {
            Ok(Some(_)) => {}
            last => break last.is_ok(),
        }
    };
    assert_eq!(reader.end().is_ok(), whole, "the end is to be had where there is one, and nowhere else");
    whole
}

/// Tables beside the queries, by those who use them.
fn beside(data: &[u8]) {
    let Ok(mut blocks) = BlockReader::new(data) else { return };
    while let Ok(Some(block)) = blocks.next_block() {
        match block.section {
            Section::IrradianceRecords => drop(decode_irradiance(&block)),
            Section::PixelWeights => drop(decode_weights(&block)),
            Section::Records | Section::End => {}
        }
    }
}

fn trace(data: &[u8]) -> bool {
    let Ok(mut reader) = TraceReader::new(data) else { return false };
    let mut sum = Sum { regions: reader.header().regions.clone(), ..Sum::default() };
    let whole = loop {
        match reader.replay_block(&mut sum) {
            Ok(Some(_)) => {}
            last => break last.is_ok(),
        }
    };
    assert_eq!(reader.end().is_ok(), whole, "the end is to be had where there is one, and nowhere else");
    if !whole {
        return false;
    }
    // What is whole can be kept, and is the same; that takes a hundred times as long, so not each is.
    if xxh3_64(data).is_multiple_of(64) {
        assert_eq!(archived(data), sum.sum, "an archive holds other searches");
    }
    true
}

/// The sum of a whole trace's accesses after it was archived.
fn archived(data: &[u8]) -> u64 {
    let kept = archive(data);
    let mut again = TraceReader::new(&kept[..]).expect("an archive is a stream");
    let mut sum = Sum::default();
    while again.replay_block(&mut sum).expect("an archive is whole").is_some() {}
    sum.sum
}

/// A whole trace, for keeping.
///
/// # Panics
/// If it is not whole.
#[must_use]
pub fn archive(trace: &[u8]) -> Vec<u8> {
    let mut reader = TraceReader::new(trace).expect("read before");
    let mut writer = TraceWriter::new(vec![], reader.header()).expect("a header that was read can be written");
    while let Some((block, tally)) = reader.next_archived().expect("read before") {
        writer.write(&block, tally).expect("memory takes all");
    }
    let stages = reader.end().expect("read before").stages.clone();
    writer.finish(stages).expect("memory takes all")
}
