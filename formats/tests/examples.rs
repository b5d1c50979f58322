//! Do the examples do what they say?

#[expect(dead_code, reason = "its main is not run here")]
#[path = "../examples/count_accesses.rs"]
mod count_accesses;
#[expect(dead_code, reason = "its main is not run here")]
#[path = "../examples/query_stream.rs"]
mod query_stream;

use count_accesses::{Counts, count};
use pm_formats::trace::{Access, AccessKind, BlockEncoder, Coding, TraceWriter, lay_out};
use pm_formats::{BlockMeta, Header};

/// A trace of three searches, each of which reads twenty bytes twice and writes eight.
fn trace() -> Vec<u8> {
    let mut header = Header::empty();
    header.regions = lay_out([("photons".into(), 1000, 20, Coding::Records)]);
    let mut encoder = BlockEncoder::new(&header.regions);
    for pixel in 0..3 {
        encoder.begin(&[pixel]);
        encoder.access(Access::read(0, 40, 20));
        encoder.access(Access::read(0, 60, 20));
        encoder.access(Access { kind: AccessKind::Write, region: 0, len: 8, offset: 100 });
        encoder.end();
    }
    let (block, tally) = encoder.finish(BlockMeta::default()).unwrap();
    let mut writer = TraceWriter::new(vec![], &header).unwrap();
    writer.write(&block, tally).unwrap();
    writer.finish(vec![]).unwrap()
}

#[test]
fn accesses_are_counted_and_a_cut_trace_is_none() {
    let trace = trace();
    assert_eq!(count(&trace[..]).unwrap(), Counts { searches: 3, accesses: 9, writes: 3, bytes: 3 * 48 });
    assert!(count(&trace[..trace.len() - 1]).is_err());
}

#[test]
fn queries_are_read_as_they_were_written() {
    let stream = query_stream::write(vec![]).unwrap();
    let (order, queries) = query_stream::read(&stream[..]).unwrap();
    assert_eq!((order.unwrap().word.as_str(), queries.len()), ("scanline", 16));
    assert!(queries.iter().enumerate().all(|(number, query)| query.pixel as usize == number));
    assert!(query_stream::read(&stream[..stream.len() - 1]).is_err());
}
