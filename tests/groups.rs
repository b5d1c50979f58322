//! Neighbours that share a search: are they served once each, with fewer reads and the same picture, whoever answers them?

use crate::streams::{check, searches};
use crate::support::Folder;
use pm_formats::{BlockReader, Query, decode_checked};

/// Answers queries in groups; the trace, and the picture.
fn gathered(folder: &Folder, queries: &str, options: &str) -> (Vec<u8>, Vec<u8>) {
    folder.run(&format!("pm-gather -q map.pmp {queries} -k 40 {options} --image i.exr -o t.pmt")).ok();
    (folder.read("t.pmt"), folder.read("i.exr"))
}

#[test]
fn a_group_is_one_search_for_neighbours_that_follow_each_other_in_a_block() {
    // Catches: groups cut by threads or across blocks, queries that nobody serves, a group that is too long.
    let folder = Folder::with_streams();
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    folder.run("pm-reorder random q.pmq -o r.pmq").ok();
    let reads = |trace: &[u8]| searches(trace).iter().map(|search| search.accesses.len()).sum::<usize>();
    for name in ["h.pmq", "q.pmq", "r.pmq"] {
        let plain = gathered(&folder, name, "--map wide --carry");
        for most in [2, 8, 32] {
            let grouped = gathered(&folder, name, &format!("--map wide --group {most} -t 2"));
            check(&grouped.0).unwrap();
            let all = searches(&grouped.0);
            assert!(all.iter().all(|search| (1..=most).contains(&search.pixels.len())));
            // In their order, whole blocks of them.
            let mut served = all.iter().flat_map(|search| search.pixels.clone());
            for block in blocks(&folder.read(name)) {
                assert!(served.by_ref().take(block.len()).eq(block), "{name}, {most}");
            }
            assert_eq!(served.next(), None);
            assert!(reads(&grouped.0) <= reads(&plain.0) || name == "q.pmq", "{name}, {most}");
            let again = gathered(&folder, name, &format!("--map wide --group {most} -t 1"));
            assert_eq!(searches(&again.0), all, "{name}, {most}: other groups by another number of threads");
            assert_eq!((&again.1, &grouped.1), (&plain.1, &plain.1), "{name}, {most}: another picture");
        }
        assert_eq!(gathered(&folder, name, "--map kd").1, plain.1, "{name}: another picture than of kd");
    }
    // Where they are neighbours they do share.
    folder.sh("pm-queries -q --size 16x12 --gathers 100 | pm-reorder -q hilbert -o d.pmq").ok();
    let trace = gathered(&folder, "d.pmq", "--map wide --group 32").0;
    let (grouped, queries) = (searches(&trace).len(), crate::streams::records::<Query>(&folder.read("d.pmq")).len());
    assert!(grouped * 4 < queries * 3, "{grouped} searches for {queries} queries");
}

/// The pixels of the queries of each block of a stream.
fn blocks(stream: &[u8]) -> Vec<Vec<u32>> {
    let mut blocks = BlockReader::new(stream).unwrap();
    let header = blocks.header().clone();
    let next = || blocks.next_block().unwrap();
    let pixels = |block| decode_checked::<Query>(&block, &header).unwrap().0.iter().map(|query| query.pixel).collect();
    std::iter::from_fn(next).map(pixels).collect()
}

#[test]
fn a_group_does_not_begin_in_the_block_before() {
    // Catches: what is known carried across blocks, and groups of queries of two.
    let folder = Folder::with_streams();
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    let all = searches(&gathered(&folder, "h.pmq", "--map wide --group 32").0);
    let mut at = 0;
    let stream = folder.read("h.pmq");
    for block in blocks(&stream) {
        // Nothing is known of the first: it is alone.
        assert_eq!(all[at].pixels.len(), 1);
        let mut left = block.len();
        while left > 0 {
            left = left.checked_sub(all[at].pixels.len()).expect("groups end with their block");
            at += 1;
        }
    }
    assert_eq!(at, all.len());
}

#[test]
fn groups_need_no_carry_and_say_so() {
    let folder = Folder::with_streams();
    let refused =
        |options: &str| folder.run(&format!("pm-gather map.pmp q.pmq --no-trace {options}")).fails(2).to_owned();
    let message = refused("--map wide --group 8 --carry");
    assert!(message.contains("--carry") && message.lines().count() == 1, "{message}");
    assert!(refused("--map kd --group 8").contains("--group"));
}
