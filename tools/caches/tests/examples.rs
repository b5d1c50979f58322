//! Do the examples say what they are there to show?

use pm_formats::trace::{Access, AccessKind, BlockEncoder, Coding, TraceWriter, lay_out};
use pm_formats::{BlockMeta, Header};

#[path = "../examples/fetches_by_region.rs"]
#[allow(dead_code, reason = "its main is not run here")]
mod fetches_by_region;
#[path = "../examples/made_up_trace.rs"]
#[allow(dead_code, reason = "its main is not run here")]
mod made_up_trace;

#[test]
fn a_matrix_is_read_by_rows_and_by_columns() {
    let mut said = vec![];
    made_up_trace::run(&mut said).unwrap();
    // 4,096 lines of 16 numbers. By columns a cache has to keep 256 lines: the first does not, the second does, and in the
    // third they are in each other's way, which a hash of the line number helps.
    let expected = "\
by rows    8K,full,64,lru      4096 fetches,  262144 bytes
by rows    16K,full,64,lru     4096 fetches,  262144 bytes
by rows    16K,8,64,plru       4096 fetches,  262144 bytes
by rows    16K,8,64,plru,hash  4096 fetches,  262144 bytes
by rows    none,128           65536 fetches,  262144 bytes
by columns 8K,full,64,lru     65536 fetches, 4194304 bytes
by columns 16K,full,64,lru     4096 fetches,  262144 bytes
by columns 16K,8,64,plru      65536 fetches, 4194304 bytes
by columns 16K,8,64,plru,hash 12704 fetches,  813056 bytes
by columns none,128           65536 fetches,  262144 bytes
";
    assert_eq!(String::from_utf8(said).unwrap(), expected);
}

#[test]
fn the_accesses_of_a_trace_are_counted() {
    let regions = [("nodes", 1000), ("photons", 2000)].map(|(name, size)| (name.to_owned(), size, 20, Coding::Records));
    let header = Header { regions: lay_out(regions), ..Header::empty() };
    let mut writer = TraceWriter::new(vec![], &header).unwrap();
    let mut encoder = BlockEncoder::new(&header.regions);
    encoder.begin(&[1, 2]);
    for record in [0, 1, 2, 0] {
        encoder.access(Access::read(0, record * 20, 20));
    }
    encoder.access(Access { kind: AccessKind::Write, ..Access::read(1, 60, 20) });
    encoder.end();
    let (block, tally) = encoder.finish(BlockMeta::default()).unwrap();
    writer.write(&block, tally).unwrap();
    let stream = writer.finish(vec![]).unwrap();

    let mut said = vec![];
    fetches_by_region::run(&stream[..], &mut said).unwrap();
    let expected = "\
nodes               4 reads
photons             0 reads
2 queries, 3 lines of 64 bytes touched, 20 bytes written
";
    assert_eq!(String::from_utf8(said).unwrap(), expected);
    assert!(fetches_by_region::run(&stream[..stream.len() - 1], &mut vec![]).is_err(), "half a trace");
}
