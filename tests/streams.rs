//! Streams read in process by the formats library: what they hold, and whether they are whole.

use pm_formats::trace::{Access, TraceReader, TraceSink};
use pm_formats::{BlockReader, Photon, Query, Record, RecordReader, Result, StreamKind, Tally, UnroundedPhoton};

/// All there is to check, as every program checks it: the tally of a whole stream, or what is wrong with it.
pub(crate) fn check(stream: &[u8]) -> Result<Tally> {
    let blocks = BlockReader::new(stream)?;
    match blocks.kind() {
        StreamKind::Photons => check_records::<Photon>(blocks),
        StreamKind::Queries => check_records::<Query>(blocks),
        StreamKind::UnroundedPhotons => check_records::<UnroundedPhoton>(blocks),
        StreamKind::Trace => {
            let mut reader = TraceReader::from_blocks(blocks)?;
            while reader.replay_block(&mut Events::default())?.is_some() {}
            Ok(reader.end()?.tally)
        }
    }
}

fn check_records<T: Record>(blocks: BlockReader<&[u8]>) -> Result<Tally> {
    let mut reader = RecordReader::<T, _>::from_blocks(blocks)?;
    while reader.next_block()?.is_some() {}
    Ok(reader.end()?.tally)
}

/// The records of a whole stream in their order.
pub(crate) fn records<T: Record>(stream: &[u8]) -> Vec<T> {
    let mut reader = RecordReader::<T, _>::new(stream).expect("a stream of these records");
    let mut all = vec![];
    while let Some((_, records)) = reader.next_block().expect("a whole stream") {
        all.extend(records);
    }
    all
}

/// The records of a whole stream, sorted: equal for equal multisets.
pub(crate) fn sorted_records<T: Record>(stream: &[u8]) -> Vec<Vec<u8>> {
    let mut all: Vec<_> = records::<T>(stream).iter().map(|record| bytemuck::bytes_of(record).to_vec()).collect();
    all.sort();
    all
}

/// The searches of a whole trace in their order.
pub(crate) fn searches(stream: &[u8]) -> Vec<Search> {
    let mut reader = TraceReader::new(stream).expect("a trace");
    let mut events = Events::default();
    while reader.replay_block(&mut events).expect("a whole trace").is_some() {}
    events.0
}

/// A search: whom it serves, and what it reads.
#[derive(Debug, PartialEq)]
pub(crate) struct Search {
    pub(crate) batch: u64,
    pub(crate) pixels: Vec<u32>,
    pub(crate) accesses: Vec<Access>,
}

#[derive(Default)]
struct Events(Vec<Search>, u64);

impl TraceSink for Events {
    fn block(&mut self, batch: u64, _: bool) {
        self.1 = batch;
    }

    fn search(&mut self, destinations: &[u32]) {
        self.0.push(Search { batch: self.1, pixels: destinations.to_vec(), accesses: vec![] });
    }

    fn access(&mut self, access: Access) {
        self.0.last_mut().expect("accesses belong to a search").accesses.push(access);
    }
}
