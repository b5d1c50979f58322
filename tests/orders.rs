//! Orders through the program: sorted on disk as in memory, told what they cost, sampled?

use crate::streams::{check, records, sorted_records};
use crate::support::{Folder, Outcome, peak_memory, same_bytes};
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{End, Query, RecordReader, Section, StreamKind};
use std::fs;
use std::io::Write as _;
use std::process::Stdio;

/// Queries that fill the least memory a few dozen times.
const SIZE: &str = "--size 64x48 --gathers 16";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.run(&format!("pm-queries {SIZE} -t 2 -o q.pmq")).ok();
    folder.run(&format!("pm-queries {SIZE} --order tiled --tile 32 -t 2 -o tiled.pmq")).ok();
    fs::create_dir(folder.path("tmp")).unwrap();
    folder
}

/// The end block of a stream of queries.
fn end(stream: &[u8]) -> End {
    let mut reader = RecordReader::<Query, _>::new(stream).unwrap();
    while reader.next_block().unwrap().is_some() {}
    reader.end().unwrap().clone()
}

fn measure(stream: &[u8], name: &str) -> f64 {
    end(stream).measure(name).unwrap_or_else(|| panic!("no {name}")).as_f64()
}

#[test]
fn a_pass_is_a_bin_of_the_hemisphere() {
    let folder = Folder::new();
    let line = "pm-queries --size 24x18 --gathers 16 --order direction-binned --tile 100 --bins 4";
    let stream = folder.run(line).ok().stdout;
    // Four by four strata, two by two of them to a bin.
    let bin = |query: &Query| {
        let stratum = query.sample % 16;
        stratum / 4 / 2 * 2 + stratum % 4 / 2
    };
    let queries = records::<Query>(&stream);
    let passes: Vec<&[Query]> = queries.chunk_by(|a, b| bin(a) == bin(b)).collect();
    // What is seen directly, and then what is seen in the mirror and through the glass.
    let bins: Vec<u32> = passes.iter().map(|pass| bin(&pass[0])).collect();
    assert_eq!(bins, [0, 1, 2, 3, 0, 1, 2, 3]);
    assert!(passes.iter().all(|pass| pass.is_sorted_by_key(|query| query.pixel)));
    assert!(passes[..4].iter().all(|direct| direct.len() > passes[4].len()));
    // Each later pass casts the eye rays again: three for what is seen directly, four for the rest.
    assert_eq!(measure(&stream, measure::EYE_RAYS_AGAIN), 7.0 * measure(&stream, measure::EYE_RAYS));
}

#[test]
fn sorted_on_disk_is_sorted_in_memory() {
    let folder = folder();
    folder.run("pm-queries --size 48x48 --gathers 16 --irradiance-cache 0.05 -o cached.pmq").ok();
    for (order, input) in [
        ("hilbert", "q.pmq"),
        ("random", "q.pmq"),
        ("partition --storage 64K", "q.pmq"),
        ("hilbert --per batch", "tiled.pmq"),
        ("morton", "cached.pmq"),
    ] {
        let in_memory = folder.run(&format!("pm-reorder {order} {input}")).ok().stdout;
        let line = format!("pm-reorder {order} {input} --memory 64K");
        let mut command = folder.command(&line);
        command.env("TMPDIR", folder.path("tmp"));
        let on_disk = Outcome::of(&line, command);
        let said = on_disk.fails(0);
        assert!(said.contains("more than --memory 64K holds: sorting in temporary files in "), "{said}");
        assert!(said.contains("/tmp"), "{said}");
        same_bytes(&line, &in_memory, &on_disk.stdout);
        folder.run(&format!("{line} -q -o out.pmq")).ok();
        same_bytes(&line, &in_memory, &folder.read("out.pmq"));
        assert_eq!(fs::read_dir(folder.path("tmp")).unwrap().count(), 0, "`{line}` left something behind");
    }
}

#[test]
fn a_sort_on_disk_that_fails_leaves_nothing_behind() {
    let folder = folder();
    let queries = folder.read("q.pmq");
    folder.write("half.pmq", &queries[..queries.len() * 3 / 4]);
    let names = folder.names();
    let line = "pm-reorder hilbert --memory 64K -q half.pmq -o out.pmq";
    let mut command = folder.command(line);
    let outcome = Outcome::when_done(line, command.env("TMPDIR", folder.path("tmp")).spawn().unwrap());
    let _ = outcome.fails(3);
    // Killed while it sorts: the files have no name that could stay.
    let mut child = folder
        .command("pm-reorder hilbert --memory 64K -q")
        .env("TMPDIR", folder.path("tmp"))
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.as_mut().unwrap().write_all(&queries[..queries.len() / 2]).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(folder.names(), names);
    assert_eq!(fs::read_dir(folder.path("tmp")).unwrap().count(), 0);
}

#[test]
fn a_full_disk_while_sorting_is_an_error_that_says_what_to_do() {
    let folder = folder();
    // The limit on the size of files stands for a disk that fills. Temporary files of 64 kilobytes exceed it.
    let outcome = folder
        .sh("trap '' XFSZ; ulimit -f 40; TMPDIR=$PWD/tmp exec pm-reorder hilbert --memory 64K -q q.pmq > /dev/null");
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    let said = &outcome.stderr;
    assert!(said.starts_with("pm-reorder: cannot write a temporary file in ") && said.lines().count() == 1, "{said}");
    assert!(said.contains("File too large") && said.contains("set TMPDIR to a folder with room"), "{said}");
    assert_eq!(fs::read_dir(folder.path("tmp")).unwrap().count(), 0);

    let outcome = folder.sh("TMPDIR=/nosuch/folder pm-reorder hilbert --memory 64K -q q.pmq");
    assert_eq!(outcome.code, 1);
    assert!(outcome.stderr.contains("cannot make a temporary file in /nosuch/folder"), "{}", outcome.stderr);
}

#[test]
fn every_order_tells_what_it_costs() {
    let folder = folder();
    folder.run("pm-photons -n 3000 -o map.pmp").ok();
    let queries = check(&folder.read("q.pmq")).unwrap().records as f64;
    for entry in pm_orders::orders().iter() {
        let (order, streaming) = (format!("{} {}", entry.word(), entry.forms()[0]), entry.is_streaming());
        let full = folder.run(&format!("pm-reorder {order} --storage 256K q.pmq")).ok().stdout;
        let held = measure(&full, measure::PEAK_QUERIES_HELD);
        assert!(held > 0.0 && held <= queries && (held < queries) == streaming, "{order}: {held} of {queries}");
        assert_eq!(measure(&full, measure::STORAGE), held * 44.0, "{order}");
        assert_eq!(measure(&full, measure::STORAGE_COMPACT), held * 9.0, "{order}");
        let spilled = measure(&full, measure::SPILLED_WRITTEN);
        assert_eq!(spilled, measure(&full, measure::SPILLED_READ), "{order}");
        assert_eq!(spilled == 0.0, streaming, "{order}: {spilled}");
        assert!(spilled <= 1.1 * 44.0 * queries, "{order}: {spilled} bytes spilled of {queries} queries");
        let on_chip = measure(&full, measure::ON_CHIP);
        // The table of cells, where there is one, is beside the store.
        assert!(on_chip > 0.0 && on_chip <= f64::from(256 << 10) * 1.01, "{order}: {on_chip} on chip");

        // In compact records less is spilled; beyond what all queries take, nothing.
        let compact = folder.run(&format!("pm-reorder {order} --storage 256K --record compact q.pmq")).ok().stdout;
        assert!(streaming || measure(&compact, measure::SPILLED_WRITTEN) < 0.25 * spilled, "{order}");
        let cast_again = measure(&compact, measure::RAYS_CAST_AGAIN);
        assert_eq!(cast_again, 2.0 * queries, "{order}");
        let much = folder.run(&format!("pm-reorder {order} --storage 64M q.pmq")).ok().stdout;
        assert_eq!(measure(&much, measure::SPILLED_WRITTEN), 0.0, "{order}");
        // No accounting changes what a sorting order gives.
        assert!(streaming || records::<Query>(&full) == records::<Query>(&much), "{order}");
    }
}

#[test]
fn streaming_orders_need_no_more_memory_for_a_longer_stream() {
    let folder = Folder::new();
    folder.run("pm-queries --size 96x48 --gathers 32 -t 2 -o short.pmq").ok();
    folder.run("pm-queries --size 384x96 --gathers 32 -t 2 -o long.pmq").ok();
    let peak = |order: &str, input: &str| peak_memory(&folder, &format!("pm-reorder {order} {input}"));
    for order in ["hashed", "snowplow --storage 256K", "buffered --storage 256K"] {
        let (short, long) = (peak(order, "short.pmq"), peak(order, "long.pmq"));
        assert!(long < 1.2 * short + 500.0, "{order}: {short} KB, {long} KB for eight times the queries");
    }
    // It can be seen at all: an order that holds everything needs more.
    assert!(peak("hilbert", "long.pmq") > 1.5 * peak("hilbert", "short.pmq"));
}

#[test]
fn a_sample_of_batches_holds_whole_batches() {
    let folder = Folder::new();
    folder.run("pm-queries --size 32x32 --gathers 4 --order tiled --tile 4 -o q.pmq").ok();
    let all = folder.read("q.pmq");
    let batches = |stream: &[u8]| {
        let mut reader = RecordReader::<Query, _>::new(stream).unwrap();
        let mut batches = vec![];
        while let Some((meta, queries)) = reader.next_block().unwrap() {
            batches.push((meta.batch, queries));
        }
        batches
    };
    let whole = batches(&all);
    let sample = folder.run("pm-sample --batches 4 q.pmq").ok().stdout;
    let kept = batches(&sample);
    // One of each four in a row; a tile that sees nothing has no batch.
    assert!(
        kept.len() >= whole.len() / 4 && kept.len() <= whole.len().div_ceil(4),
        "{} of {}",
        kept.len(),
        whole.len()
    );
    for (group, batch) in kept.iter().enumerate() {
        assert!(whole[4 * group..][..4].contains(batch), "group {group}");
    }
    // It is a stream like any other, and says what it is.
    let queries: usize = kept.iter().map(|(_, queries)| queries.len()).sum();
    assert_eq!(check(&sample).unwrap().records, queries as u64);
    assert_eq!(measure(&sample, measure::QUERIES_KEPT), queries as f64);
    assert_eq!(measure(&sample, measure::SHARE), queries as f64 / measure(&sample, measure::QUERIES_GIVEN));
    let header = RecordReader::<Query, _>::new(&sample[..]).unwrap().header().clone();
    assert_eq!(header.meaning(meaning::SAMPLE), Some("1 of 4 batches"));
    assert_eq!(header.history.last().unwrap().program, "pm-sample");
    // Another seed, other batches; one of one is all.
    assert!(batches(&folder.run("pm-sample --batches 4 --seed 1 q.pmq").ok().stdout) != kept);
    assert_eq!(
        sorted_records::<Query>(&folder.run("pm-sample --batches 1 q.pmq").ok().stdout),
        sorted_records::<Query>(&all)
    );
}

#[test]
fn a_sample_of_queries_keeps_their_order() {
    let folder = folder();
    let all = folder.run("pm-reorder hilbert q.pmq").ok().stdout;
    let sample = records::<Query>(&folder.feed("pm-sample --queries 16", &all).ok().stdout);
    let all = records::<Query>(&all);
    assert!(sample.len().abs_diff(all.len() / 16) <= 1);
    for (group, query) in sample.iter().enumerate() {
        assert!(all[16 * group..].iter().take(16).any(|known| known == query), "group {group}");
    }
}

#[test]
fn samples_have_their_edges() {
    let folder = folder();
    // A single batch is not the one that is kept of a million.
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    assert!(folder.run("pm-sample --batches 1000000 h.pmq").fails(1).contains("--queries"));
    folder.run("pm-queries --size 4x4 --gathers 1 --eye 0,0,100 --look-at 0,0,200 -q -o none.pmq").ok();
    assert_eq!(check(&folder.run("pm-sample --batches 5 none.pmq").ok().stdout).unwrap().records, 0);
    // Tables beside the queries go with them, and the trace can be made.
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    folder.run("pm-queries --size 24x16 --gathers 9 --irradiance-cache 0.2 -o cached.pmq").ok();
    let piped = folder.sh("pm-sample --batches 3 cached.pmq | tee sample.pmq | pm-gather -k 20 | pm-cachesim").ok();
    assert!(piped.text().lines().count() > 1);
    let beside = |name: &str| {
        let mut blocks = pm_formats::BlockReader::new(std::io::Cursor::new(folder.read(name))).unwrap();
        assert_eq!(blocks.kind(), StreamKind::Queries);
        let mut beside = vec![];
        while let Some(block) = blocks.next_block().unwrap() {
            // A query and a weight are of one size.
            if block.section != Section::Records {
                beside.extend(pm_formats::decode_weights(&block));
            }
        }
        beside
    };
    assert!(!beside("cached.pmq").is_empty() && beside("sample.pmq") == beside("cached.pmq"));
}
