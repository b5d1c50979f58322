//! Reverse photon mapping: are photons read once for each batch, whatever the order, and is that what is charged?

use crate::streams::{check, searches};
use crate::support::Folder;
use pm_formats::{BlockReader, Query, decode_checked};

#[test]
fn a_batch_is_one_search_that_reads_all_photons_once() {
    // Catches: photons read for each query, a batch that is cut by threads, queries that nobody serves.
    let folder = Folder::with_streams();
    folder.run("pm-reorder random q.pmq -o r.pmq").ok();
    let photons = crate::streams::records::<pm_formats::Photon>(&folder.read("map.pmp")).len();
    let queries = crate::streams::records::<Query>(&folder.read("q.pmq"));
    for (batch, line) in [(100, 128), (4096, 320), (1, 128)] {
        for name in ["q.pmq", "r.pmq"] {
            let options = format!("--map reverse --batch {batch} --line {line} --start-radius inf -t 2");
            folder.run(&format!("pm-gather -q map.pmp {name} {options} -o t.pmt")).ok();
            let trace = folder.read("t.pmt");
            check(&trace).unwrap();
            let all = searches(&trace);
            let mut served: Vec<u32> = all.iter().flat_map(|search| search.pixels.clone()).collect();
            served.sort_unstable();
            let mut asked: Vec<u32> = queries.iter().map(|query| query.pixel).collect();
            asked.sort_unstable();
            assert_eq!(served, asked, "each query is served once");
            let lines = photons.div_ceil(line / 20) as u64;
            for search in &all {
                assert!(search.pixels.len() <= batch);
                let offsets: Vec<u64> = search.accesses.iter().map(|access| access.offset / line as u64).collect();
                assert!(offsets.iter().copied().eq(0..lines), "{batch} {line}: {} reads", offsets.len());
            }
            // Batches are cut by blocks of the stream, and by nothing else.
            let expected: usize = blocks(&folder.read(name)).iter().map(|queries| queries.div_ceil(batch)).sum();
            assert_eq!(all.len(), expected, "{name}, batch {batch}");
        }
    }
}

/// The number of queries in each block of a stream.
fn blocks(stream: &[u8]) -> Vec<usize> {
    let mut blocks = BlockReader::new(stream).unwrap();
    let header = blocks.header().clone();
    let next = || blocks.next_block().unwrap();
    std::iter::from_fn(next).map(|block| decode_checked::<Query>(&block, &header).unwrap().0.len()).collect()
}

#[test]
fn candidates_in_memory_are_read_and_those_on_chip_are_charged() {
    let folder = Folder::with_streams();
    let gather = |options: &str| {
        folder.run(&format!("pm-gather -q map.pmp q.pmq -k 40 --map reverse --batch 256 {options} -o t.pmt")).ok();
        let trace = folder.read("t.pmt");
        let names: Vec<_> =
            BlockReader::new(&trace[..]).unwrap().header().regions.iter().map(|it| it.name.clone()).collect();
        (names, searches(&trace))
    };
    let (names, _) = gather("");
    assert_eq!(names, ["photons"]);
    let (names, all) = gather("--candidates memory --start-radius inf");
    assert_eq!(names, ["photons", "candidates"]);
    // Each is written once at least, and read when it is summed.
    for search in all {
        let candidates = search.accesses.iter().filter(|access| access.region == 1).count();
        assert!(candidates >= 2 * 40 * search.pixels.len(), "{candidates} for {}", search.pixels.len());
    }
    // A row of the report says what a batch takes on chip: records of 44 bytes, bounds, and 8 bytes a candidate.
    let report = |options: &str| {
        let line =
            format!("pm-gather -q map.pmp q.pmq -k 40 --map reverse --batch 256 {options} --no-trace --report r.csv");
        folder.run(&line).ok();
        let text = String::from_utf8(folder.read("r.csv")).unwrap();
        let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
        let at = rows[0].iter().position(|&name| name == "batch_bytes_on_chip").expect("it is said");
        rows[1][at].to_owned()
    };
    assert_eq!(report(""), (256 * (48 + 320)).to_string());
    assert_eq!(report("--candidates memory"), (256 * 48).to_string());
}

#[test]
fn what_a_batch_cannot_do_is_refused() {
    let folder = Folder::with_streams();
    let outcome = folder.run("pm-gather map.pmp q.pmq --map reverse --carry -o t.pmt");
    assert!(outcome.fails(2).contains("which carry nothing"), "{}", outcome.stderr);
    let outcome = folder.run("pm-gather map.pmp q.pmq --map kd --batch 7 -o t.pmt");
    assert!(outcome.fails(2).contains("--batch is for --map reverse"), "{}", outcome.stderr);
    let outcome = folder.run("pm-gather map.pmp q.pmq --map reverse --candidates memory --waits -o t.pmt");
    assert!(outcome.fails(2).contains("do not tell what their reads wait for"), "{}", outcome.stderr);
}
