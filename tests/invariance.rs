//! Do the answers stay the same for every order, every exact photon map, any number of threads, pipe or files?

use crate::streams::{Search, check, records, searches, sorted_records};
use crate::support::{Folder, SMALL, same_bytes, same_text};
use pm_formats::{Query, Tally};
use pm_pictures::Picture;
use std::collections::BTreeMap;

/// Orders in which `pm-queries` goes through the picture; the last tile is the whole of it.
const GENERATIVE: [&str; 9] = [
    "--order scanline",
    "--order tiled --tile 1",
    "--order tiled --tile 3",
    "--order tiled",
    "--order tiled --tile 99",
    "--strata shuffled",
    "--order direction-binned --tile 3",
    "--order direction-binned --tile 99 --bins 3 --strata shuffled",
    "--order direction-binned --tile 1 --bins 2",
];

/// Orders that `pm-reorder` brings queries into.
const DEFERRED: [&str; 5] =
    ["hilbert", "hilbert --per batch", "random", "random --per batch", "random --seed 7 --per image"];

/// More of them, for some of the orders above.
const MORE_DEFERRED: [&str; 11] = [
    "morton",
    "leaf --photons map.pmp",
    "hashed --buckets 5 --capacity 8",
    "hashed --per batch --cell 0.1",
    "partition --storage 8K",
    "partition --storage 64K --record compact --per batch",
    "cells --photons map.pmp --leaf-photons 200 --per batch",
    "snowplow --storage 4K",
    "snowplow --storage 256 --record compact --per batch",
    "buffered --storage 16K",
    "buffered --storage 2K --photons map.pmp --leaf-photons 100",
];

/// These, and any order that is in neither list.
fn more_deferred() -> Vec<String> {
    let listed = |word: &str| DEFERRED.iter().chain(&MORE_DEFERRED).any(|line| line.split(' ').next() == Some(word));
    let orders = pm_orders::orders();
    let others = orders.iter().filter(|order| !listed(order.word()));
    let others = others.map(|order| format!("{} {}", order.word(), order.forms()[0]));
    MORE_DEFERRED.map(str::to_owned).into_iter().chain(others).collect()
}

/// These maps, and any structure of which there is none among them.
fn maps<'a>(listed: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut maps: Vec<String> = listed.into_iter().map(str::to_owned).collect();
    let is_listed = |maps: &[String], word| maps.iter().any(|map| map.split(' ').next() == Some(word));
    let others: Vec<_> = pm_maps::structures().words().into_iter().filter(|word| !is_listed(&maps, word)).collect();
    maps.extend(others.into_iter().map(str::to_owned));
    maps
}

/// Runs a command with 1, 2 and 5 threads; `get` must find the same bytes after each.
fn same_for_any_threads(folder: &Folder, line: &str, get: impl Fn(&[u8]) -> Vec<u8>) {
    let run = |threads: u32| get(&folder.run(&format!("{line} -t {threads}")).ok().stdout);
    let one = run(1);
    assert!(!one.is_empty(), "{line}");
    for threads in [2, 5] {
        same_bytes(&format!("`{line}` with {threads} threads"), &one, &run(threads));
    }
}

#[test]
fn threads_change_no_byte_of_a_stream() {
    let folder = Folder::with_streams();
    for line in [
        // Several times the paths that are traced as one piece of work.
        "pm-photons -n 40000",
        "pm-gather map.pmp q.pmq",
        "pm-gather --map brute --start-radius 0.01 map.pmp q.pmq",
        "pm-gather --carry map.pmp q.pmq",
        "pm-gather --map bucket-kd --carry --start-radius inf map.pmp q.pmq",
        "pm-gather --map wide --carry map.pmp q.pmq",
        "pm-gather --map kd --layout veb --pad map.pmp q.pmq",
        "pm-gather --map vvh map.pmp q.pmq",
        "pm-gather --map kdb map.pmp q.pmq",
        "pm-gather --map grid map.pmp q.pmq",
        "pm-gather --map block-hash map.pmp q.pmq",
        "pm-photons --caustics -n 20000",
        "pm-queries --size 16x12 --gathers 9 --irradiance-cache 0.2",
        "pm-queries --size 16x12 --gathers 4 --samples 3 --min-gather-dist 0.1 --sampling uniform",
        "pm-queries --size 16x12 --direct-visualisation",
        "pm-queries --size 16x12 --gathers 4 --guide map.pmp",
    ] {
        same_for_any_threads(&folder, line, <[u8]>::to_vec);
    }
    // Those above, which are maps of every structure but of a grid of fixed cells; and any other.
    for map in &maps(["kd", "bucket-kd", "wide", "vvh", "kdb", "grid", "block-hash", "brute"])[8..] {
        same_for_any_threads(&folder, &format!("pm-gather --map {map} map.pmp q.pmq"), <[u8]>::to_vec);
    }
    for order in GENERATIVE {
        same_for_any_threads(&folder, &format!("pm-queries {SMALL} {order}"), <[u8]>::to_vec);
    }
}

#[test]
fn threads_change_no_byte_of_a_picture() {
    let folder = Folder::with_streams();
    for order in GENERATIVE {
        let line = format!("pm-queries {SMALL} {order} --base direct.exr");
        same_for_any_threads(&folder, &line, |_| folder.read("direct.exr"));
    }
    let gather = "pm-gather map.pmp q.pmq --base direct.exr --no-trace --image out.exr --image out.png -q";
    same_for_any_threads(&folder, gather, |_| [folder.read("out.exr"), folder.read("out.png")].concat());
}

/// The queries of the built-in scene in every order, as files; their names.
fn queries_in_every_order(folder: &Folder) -> Vec<String> {
    if !folder.path("map.pmp").exists() {
        folder.run("pm-photons -n 2000 -o map.pmp").ok();
    }
    let mut names = vec![];
    let (some, all) = (DEFERRED.map(str::to_owned).to_vec(), more_deferred());
    for (g, generative) in GENERATIVE.iter().enumerate() {
        let name = format!("q{g}.pmq");
        folder.run(&format!("pm-queries {SMALL} {generative} -o {name}")).ok();
        // Scanline, tiled and direction-binned.
        let more = if [0, 2, 6].contains(&g) { &all[..] } else { &[] };
        for (d, deferred) in some.iter().chain(more).enumerate() {
            let reordered = format!("q{g}-{d}.pmq");
            folder.run(&format!("pm-reorder {deferred} {name} -o {reordered}")).ok();
            names.push(reordered);
        }
        names.push(name);
    }
    names
}

/// What `pm-view --check` says of a file, less its name: kind, number and digest.
fn checked(folder: &Folder, name: &str) -> String {
    let line = folder.run(&format!("pm-view --check {name}")).ok().text().to_owned();
    line.strip_prefix(&format!("{name}: ")).unwrap_or_else(|| panic!("{line}")).to_owned()
}

#[test]
fn every_order_holds_the_same_queries() {
    let folder = Folder::new();
    let names = queries_in_every_order(&folder);
    let first = folder.read(&names[0]);
    let (digest, sorted) = (checked(&folder, &names[0]), sorted_records::<Query>(&first));
    assert!(sorted.len() > 100);
    for name in &names {
        same_text(name, &digest, &checked(&folder, name));
        assert!(sorted_records::<Query>(&folder.read(name)) == sorted, "{name}: other records");
    }
}

#[test]
fn orders_are_orders() {
    let folder = Folder::new();
    queries_in_every_order(&folder);
    let sequence = |name: &str| -> Vec<_> {
        records::<Query>(&folder.read(name)).iter().map(|query| (query.pixel, query.sample)).collect()
    };
    // Without this, doing nothing at all would pass for every order.
    let names = [
        "q0.pmq",
        "q2.pmq",
        "q5.pmq",
        "q6.pmq",
        "q7.pmq",
        "q8.pmq",
        "q0-0.pmq",
        "q0-1.pmq",
        "q0-2.pmq",
        "q0-3.pmq",
        "q0-4.pmq",
        "q2-1.pmq",
        "q0-5.pmq",
        "q0-6.pmq",
        "q0-7.pmq",
        "q0-8.pmq",
        "q2-11.pmq",
        "q0-12.pmq",
        "q2-13.pmq",
        "q0-14.pmq",
        "q0-15.pmq",
    ];
    let sequences = names.map(sequence);
    for (i, name) in names.iter().enumerate() {
        for (j, other) in names.iter().enumerate().skip(i + 1) {
            assert!(sequences[i] != sequences[j], "{name} and {other} are in the same order");
        }
    }
    assert!(sequences[0].is_sorted(), "scanline order is pixel by pixel");
    // One order for the whole image does not depend on the order before it, as long as no two keys are equal.
    assert_eq!(sequence("q0-2.pmq"), sequence("q3-2.pmq"));
}

#[test]
fn every_order_makes_the_same_searches() {
    let folder = Folder::with_streams();
    let names = queries_in_every_order(&folder);
    for map in maps([
        "kd",
        "kd --layout preorder",
        "kd --layout veb --pad",
        "kd --reread",
        "bucket-kd",
        "wide",
        "vvh",
        "kdb",
        "grid",
        "grid-fixed",
        "block-hash",
        "brute",
        // Larger batches hold other queries in another order, and have a search in common.
        "reverse --batch 1",
        "treelets --treelet 2000 --batch 1",
    ]) {
        let mut tallies: Vec<Tally> = vec![];
        for name in &names {
            let trace = folder.run(&format!("pm-gather --map {map} map.pmp {name}")).ok();
            tallies.push(check(&trace.stdout).unwrap_or_else(|error| panic!("{name}: {error}")));
        }
        assert!(tallies[0].records > 100);
        for (name, tally) in names.iter().zip(&tallies) {
            assert_eq!(*tally, tallies[0], "--map {map}, {name}: other searches than {}", names[0]);
        }
    }
}

#[test]
fn the_picture_is_the_same_to_the_last_bit() {
    let folder = Folder::with_streams();
    let names = queries_in_every_order(&folder);
    folder.run(&format!("pm-queries {SMALL} --base direct.exr -o q.pmq")).ok();
    let picture = |options: &str| {
        folder.run(&format!("pm-gather map.pmp {options} --base direct.exr --image out.exr --no-trace")).ok();
        folder.read("out.exr")
    };
    let expected = picture("q.pmq");
    for name in &names {
        same_bytes(name, &expected, &picture(name));
    }
    for options in [
        "--map kd --start-radius inf",
        "--map kd --start-radius auto -t 3",
        "--map kd --start-radius 1e-5",
        "--map kd --start-radius 1e9",
        "--map brute --start-radius inf",
        "--map brute --start-radius auto",
        "--map brute --start-radius 0.02 -t 5",
        "--map kd --layout preorder",
        "--map kd --layout preorder --reread --start-radius inf -t 2",
        "--map kd --layout veb --pad --line 64",
        "--map kd --carry -t 2",
        "--map bucket-kd",
        "--map bucket-kd --line 320 --carry --start-radius inf -t 3",
        "--map bucket-kd --layout veb --line 32",
        "--map wide",
        "--map wide --carry -t 2",
        "--map wide --start-radius inf",
        "--map wide --group 2",
        "--map wide --group 32 --start-radius inf -t 2",
        "--map wide --start-radius 1e-5 --carry",
        "--map vvh",
        "--map kdb --fill 0.6",
        "--map kdb --pages boxes --line 256 --carry",
        "--map grid --start-radius inf",
        "--map grid-fixed --slots 2000",
        "--map reverse --batch 37 --start-radius inf -t 2",
        "--map reverse --batch 4096 --candidates memory --line 320",
        "--map treelets --treelet 1000 -t 2",
        "--map treelets --treelet 100 --batch 37 --waiting chip",
        "--max-dist 1e9",
    ] {
        same_bytes(options, &expected, &picture(&format!("q0-2.pmq {options}")));
        same_bytes(options, &expected, &picture(&format!("q2-1.pmq {options}")));
    }
    for structure in pm_maps::structures().iter().filter(|structure| structure.is_exact()) {
        let options = format!("--map {}", structure.word());
        same_bytes(&options, &expected, &picture(&format!("q2-1.pmq {options}")));
    }

    // There is something in the picture: light in nearly every pixel, more of it than direct light alone, and another
    // picture for another question.
    let sum = |name: &str| {
        let pixels = Picture::decode_exr(&folder.read(name)).unwrap().pixels;
        assert_eq!(pixels.len(), 16 * 12);
        pixels.iter().flatten().map(|&x| f64::from(x)).sum::<f64>()
    };
    assert!(sum("out.exr") > 1.1 * sum("direct.exr") && sum("direct.exr") > 1.0);
    assert_ne!(expected, picture("q.pmq -k 10"));
    assert_ne!(expected, picture("q.pmq --max-dist 0.01"));
    // Approximate maps say so by another picture, where they have too little room to be right by chance.
    assert_ne!(expected, picture("q.pmq --map grid-fixed --slots 1"));
    assert_ne!(expected, picture("q.pmq --map block-hash --budget 1"));
}

#[test]
fn what_is_carried_changes_the_reads_and_not_the_searches() {
    let folder = Folder::with_streams();
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    let trace = |options: &str| searches(&folder.run(&format!("pm-gather map.pmp h.pmq {options}")).ok().stdout);
    let reads = |searches: &[Search]| searches.iter().map(|search| search.accesses.len()).sum::<usize>();
    for map in ["--map kd", "--map bucket-kd", "--map wide"] {
        let (plain, carried) =
            (trace(&format!("{map} --start-radius inf")), trace(&format!("{map} --start-radius inf --carry")));
        assert_eq!(plain.len(), carried.len());
        assert!(plain.iter().zip(&carried).all(|(a, b)| a.pixels == b.pixels));
        assert!(reads(&carried) < reads(&plain), "{map}: {} {}", reads(&carried), reads(&plain));
    }
}

#[test]
fn padding_moves_records_and_changes_nothing_else() {
    let folder = Folder::with_streams();
    let trace = |options: &str| searches(&folder.run(&format!("pm-gather map.pmp q.pmq {options}")).ok().stdout);
    let (packed, padded) = (trace("--layout preorder"), trace("--layout preorder --pad --line 128"));
    for (packed, padded) in packed.iter().zip(&padded) {
        assert_eq!(
            (packed.batch, &packed.pixels, packed.accesses.len()),
            (padded.batch, &padded.pixels, padded.accesses.len())
        );
        for (a, b) in packed.accesses.iter().zip(&padded.accesses) {
            let record = a.offset / 20;
            assert_eq!((b.offset, b.len), (record / 6 * 128 + record % 6 * 20, 20));
            assert_eq!(b.offset / 128, (b.offset + 19) / 128, "crosses a line");
        }
    }
}

#[test]
fn a_report_describes_and_disturbs_nothing() {
    let folder = Folder::with_streams();
    let plain = folder.run("pm-gather map.pmp q.pmq").ok().stdout;
    let described = folder.run("pm-gather map.pmp q.pmq --report r.csv").ok().stdout;
    assert!(searches(&plain) == searches(&described));
    let report = |options: &str| -> BTreeMap<String, String> {
        folder.run(&format!("pm-gather map.pmp q.pmq {options} --no-trace --report r.csv")).ok();
        let text = String::from_utf8(folder.read("r.csv")).unwrap();
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
        lines.next().unwrap().zip(lines.next().unwrap()).collect()
    };
    let number = |report: &BTreeMap<String, String>, name: &str| report[name].parse::<f64>().unwrap();
    let kd = report("");
    assert_eq!(
        (&*kd["map"], &*kd["queries"], &*kd["short_lookups"]),
        ("kd", &*searches(&plain).len().to_string(), "0")
    );
    let reads = searches(&plain).iter().map(|search| search.accesses.len()).sum::<usize>();
    assert!((number(&kd, "reads_per_query") * number(&kd, "queries") - reads as f64).abs() < 0.01 * reads as f64);
    assert!(number(&kd, "lines_per_query") < number(&kd, "reads_per_query"));
    // Maps agree on what was found; the approximate one says how far it is from that.
    let bucket = report("--map bucket-kd");
    assert_eq!(kd["distance_p50"], bucket["distance_p50"]);
    let hash = report("--map block-hash --line 256");
    assert!(number(&hash, "recall_mean") > 0.9 && number(&hash, "dilation_mean") < 1.05, "{hash:?}");
    assert!(hash.contains_key("blocks_unreferenced") && hash.contains_key("blocks_unreached"));
}

#[test]
fn the_start_radius_changes_the_reads() {
    let folder = Folder::with_streams();
    let tally = |radius: &str| {
        let trace = folder.run(&format!("pm-gather map.pmp q.pmq --start-radius {radius}")).ok();
        check(&trace.stdout).unwrap()
    };
    assert_ne!(tally("inf").digest, tally("auto").digest);
    assert_ne!(tally("inf").digest, tally("0.001").digest);
    assert_eq!(tally("inf").records, tally("0.001").records);
}

#[test]
fn the_base_picture_does_not_depend_on_the_order() {
    let folder = Folder::new();
    let base = |order: &str| {
        folder.run(&format!("pm-queries {SMALL} {order} --base direct.exr")).ok();
        folder.read("direct.exr")
    };
    let expected = base("");
    for order in GENERATIVE {
        same_bytes(order, &expected, &base(order));
    }
}

#[test]
fn pipe_and_files_give_the_same_records() {
    let folder = Folder::with_streams();
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    folder.run("pm-gather map.pmp h.pmq -o t.pmt").ok();
    let pipe = folder.sh(&format!("pm-queries {SMALL} | tee p.pmq | pm-reorder hilbert | tee ph.pmq | pm-gather")).ok();
    for (file, piped) in [("q.pmq", "p.pmq"), ("h.pmq", "ph.pmq")] {
        assert_eq!(records::<Query>(&folder.read(file)), records::<Query>(&folder.read(piped)), "{file}");
    }
    assert!(searches(&folder.read("t.pmt")) == searches(&pipe.stdout));

    let table = folder.run("pm-cachesim t.pmt").ok();
    same_text("table", table.text(), folder.feed("pm-cachesim", &pipe.stdout).ok().text());
    same_text("table", table.text(), folder.feed("pm-cachesim -", &folder.read("t.pmt")).ok().text());
}

#[test]
fn cached_irradiance_is_the_same_for_every_order_and_thread_count() {
    let folder = Folder::new();
    folder.run("pm-photons -n 5000 -o map.pmp").ok();
    let options = "--size 20x16 --gathers 16 --irradiance-cache 0.2";
    let mut pictures = vec![];
    for (order, reorder, threads) in [
        ("", "", 1),
        ("--order tiled --tile 3", "", 3),
        ("--order direction-binned --tile 5 --bins 4", "", 2),
        ("", "| pm-reorder hilbert", 2),
        ("--order tiled", "| pm-reorder random --per batch", 1),
    ] {
        folder
            .sh(&format!(
                "pm-queries {options} {order} -t {threads} --base base.exr {reorder} |
                 pm-gather -t {threads} -k 20 --base base.exr --image x.exr -o x.pmt"
            ))
            .ok();
        pictures.push(folder.read("x.exr"));
        // The trace is whole as well: a search for each query of a record.
        folder.run("pm-cachesim x.pmt").ok();
    }
    for picture in &pictures[1..] {
        same_bytes("cached irradiance in another order", &pictures[0], picture);
    }
    // Without gradients it is another picture.
    folder.run(&format!("pm-queries {options} --base base.exr -o q.pmq")).ok();
    folder.run("pm-gather map.pmp q.pmq -k 20 --base base.exr --no-gradients --image x.exr --no-trace").ok();
    assert!(folder.read("x.exr") != pictures[0]);
}
