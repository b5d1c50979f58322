//! Streams in parts: are they, put together, the very stream that one machine makes, and is anything else refused?

use crate::streams::check;
use crate::support::{Folder, Outcome, SMALL, same_bytes, same_text};

/// Orders of `pm-queries`, each with batches of its own.
const GENERATIVE: [&str; 3] = ["--order scanline", "--order tiled --tile 4", "--order direction-binned --tile 5"];

/// Makes all parts, named `NAME-1`, `NAME-2` and so on; `line` has `PART` where the option stands.
fn make_parts(folder: &Folder, line: &str, name: &str, of: u32) -> String {
    let part = |number: u32| {
        let output = format!("{name}-{number}");
        let line = line.replace("PART", &format!("--part {number}/{of}")).replace("NUMBER", &number.to_string());
        let made = folder.sh(&format!("{line} -o {output}")).ok();
        assert!(check(&folder.read(&output)).is_ok(), "{}", made.line);
        output
    };
    (1..=of).map(part).collect::<Vec<_>>().join(" ")
}

/// Parts put together are the whole, byte for byte.
#[track_caller]
fn parts_are_the_whole(folder: &Folder, line: &str, of: u32) {
    let whole = folder.sh(&line.replace("PART", "").replace("-NUMBER", "")).ok().stdout;
    let parts = make_parts(folder, line, "part", of);
    let merged = folder.run(&format!("pm-view --merge {parts}")).ok().stdout;
    same_bytes(&format!("{of} parts of `{line}`"), &whole, &merged);
}

#[test]
fn photons_of_parts_are_those_of_the_whole() {
    let folder = Folder::new();
    // One batch of paths has some 8,000 photons: the whole ends within the first batch, and behind several.
    for (photons, of) in [(1, 3), (700, 1), (700, 2), (40_000, 1), (40_000, 2), (40_000, 3), (40_000, 8)] {
        parts_are_the_whole(&folder, &format!("pm-photons -n {photons} PART --seed 3"), of);
    }
    parts_are_the_whole(&folder, "pm-photons PART --caustics -n 5000", 3);
    for threads in [2, 7] {
        let one = folder.run("pm-photons -n 40000 --part 2/3").ok().stdout;
        let more = folder.run(&format!("pm-photons -n 40000 --part 2/3 -t {threads}")).ok().stdout;
        same_bytes("a part by several threads", &one, &more);
    }
}

#[test]
fn queries_of_parts_are_those_of_the_whole() {
    let folder = Folder::new();
    for order in GENERATIVE {
        // Twelve batches at most: of twenty parts some have none.
        for of in [1, 2, 5, 20] {
            parts_are_the_whole(&folder, &format!("pm-queries {SMALL} {order} PART"), of);
        }
        for threads in [2, 7] {
            let line = format!("pm-queries {SMALL} {order} --part 2/3");
            let (one, more) = (folder.run(&line), folder.run(&format!("{line} -t {threads}")));
            same_bytes("a part by several threads", &one.ok().stdout, &more.ok().stdout);
        }
    }
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    for line in [
        "--gathers 9 --irradiance-cache 0.2 PART",
        "--gathers 4 --guide map.pmp --part=NUMBER/3",
        "--gathers 4 PART --only-tiles 7 --order tiled --tile 4",
        "--gathers 4 PART --only-tiles 9 --window 20",
        "--direct-visualisation PART --samples 2",
    ] {
        if line.contains("--part=") {
            let whole = folder.run("pm-queries --size 16x12 --gathers 4 --guide map.pmp").ok().stdout;
            let parts = make_parts(&folder, &format!("pm-queries --size 16x12 {line}"), "part", 3);
            same_bytes(line, &whole, &folder.run(&format!("pm-view --merge {parts}")).ok().stdout);
        } else {
            parts_are_the_whole(&folder, &format!("pm-queries --size 16x12 {line}"), 3);
        }
    }
}

#[test]
fn parts_go_through_every_order_and_the_gather() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    for order in pm_orders::orders().iter() {
        let deferred = format!("pm-reorder {} {} --per batch --storage 2K", order.word(), order.forms()[0]);
        parts_are_the_whole(&folder, &format!("pm-queries {SMALL} --order tiled --tile 4 PART | {deferred}"), 3);
    }
    let queries = format!("pm-queries {SMALL} --order tiled --tile 5 PART | pm-reorder hilbert --per batch");
    for gather in ["", "--map grid --carry", "--precomputed -q"] {
        parts_are_the_whole(&folder, &format!("{queries} | pm-gather map.pmp {gather}"), 4);
    }
    // In files on the way: as if it had been a pipe.
    let whole = folder.sh(&format!("{} | pm-gather map.pmp", queries.replace("PART", ""))).ok().stdout;
    make_parts(&folder, &queries, "q", 2);
    let parts = make_parts(&folder, "pm-gather map.pmp q-NUMBER", "t", 2);
    same_bytes("parts in files", &whole, &folder.run(&format!("pm-view --merge {parts}")).ok().stdout);
    // What the whole says of itself can be typed.
    folder.run(&format!("pm-view --merge {parts} -o whole.pmt")).ok();
    let history = folder.run("pm-view --history whole.pmt").ok();
    let again = history.text().lines().last().unwrap().to_owned();
    same_bytes("its history typed again", &whole, &folder.sh(&again).ok().stdout);
}

#[test]
fn caches_see_parts_as_the_whole() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    for (sample, caches) in [
        ("", "--sizes 1K,4K --lines 64,128 --policies lru,min,random"),
        ("", "--curve"),
        ("", "--lanes 1,4"),
        ("--only-tiles 9", "--sizes 1K,4K"),
        ("--only-tiles 9 --window 30", "--sizes 1K"),
    ] {
        let pipe = format!("pm-queries {SMALL} {sample} PART | pm-gather map.pmp");
        folder.sh(&format!("{} -o whole.pmt", pipe.replace("PART", ""))).ok();
        let parts = make_parts(&folder, &pipe, "t", 4);
        for format in ["table", "csv"] {
            let line = |traces: &str| format!("pm-cachesim {caches} --format {format} {traces}");
            let whole = folder.run(&line("whole.pmt")).ok();
            // A row says what it is of.
            let found = folder.run(&line(&parts)).ok().text().replace(&parts, "whole.pmt");
            same_text(caches, whole.text(), &found);
        }
        // Two traces, one of them in parts.
        let both = folder.run(&format!("pm-cachesim {caches} --format csv {parts} whole.pmt")).ok();
        let twice = folder.run(&format!("pm-cachesim {caches} --format csv whole.pmt whole.pmt")).ok();
        same_text("with another trace", twice.text(), &both.text().replace(&parts, "whole.pmt"));
    }
    let alone = folder.run("pm-cachesim t-2");
    assert_eq!(alone.fails(2), "pm-cachesim: 3 parts are missing, the first of them 1/4");
}

#[test]
fn counts_of_parts_are_added_up() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    for (sample, caches, of) in [
        ("--only-tiles 9", "--sizes 1K,10% --lines 64,128 --ways full,2", 3),
        ("--only-tiles 9 --window 30", "--cache 1K,4,64,lru,hash --cache none --page 4K --span first", 3),
        // Parts of which there are no windows.
        ("--only-tiles 2", "", 5),
    ] {
        let pipe = format!("pm-queries {SMALL} --order tiled --tile 4 {sample} PART | pm-gather map.pmp");
        folder.sh(&format!("{} -o whole.pmt", pipe.replace("PART", ""))).ok();
        make_parts(&folder, &pipe, "t", of);
        let counts = |number: u32| {
            folder.run(&format!("pm-cachesim --counts {caches} t-{number} -o c-{number}")).ok();
            format!("c-{number}")
        };
        // In whatever order they are given.
        let counts = (1..=of).rev().map(counts).collect::<Vec<_>>().join(" ");
        for format in ["table", "csv", "json"] {
            let whole = folder.run(&format!("pm-cachesim {caches} --format {format} whole.pmt")).ok();
            let added = folder.run(&format!("pm-cachesim --add --format {format} {counts}")).ok();
            same_text(sample, whole.text(), &added.text().replace(&counts, "whole.pmt"));
        }
    }
}

#[test]
fn counts_that_do_not_belong_together_are_refused() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    let pipe = format!("pm-queries {SMALL} --only-tiles 9 PART | pm-gather map.pmp");
    folder.sh(&format!("{} -o whole.pmt", pipe.replace("PART", ""))).ok();
    make_parts(&folder, &pipe, "t", 2);
    make_parts(&folder, &format!("pm-queries {SMALL} PART | pm-gather map.pmp"), "u", 2);
    make_parts(&folder, &pipe.replace("map.pmp", "map.pmp -k 9"), "v", 2);
    for (line, name) in [
        ("t-1", "c-1"),
        ("t-2", "c-2"),
        ("--sizes 1K t-2", "d-2"),
        ("--page 4K t-2", "e-2"),
        ("--span first t-2", "f-2"),
        ("v-2", "v"),
    ] {
        folder.run(&format!("pm-cachesim --counts {line} -o {name}")).ok();
    }
    for (line, said) in [
        ("--counts whole.pmt", "--counts is for parts (--part i/N), and this is a whole trace"),
        ("--counts u-1", "u-1 is part 1/2 of a trace without windows: its caches go on from batch to batch"),
        ("--counts t-1 t-2", "--counts counts one part at a time"),
        ("--counts --dram 4,8K,open t-1", "cannot be used with"),
        ("--counts --policies random t-1", "random"),
        ("--add --sizes 1K c-1 c-2", "cannot be used with"),
        ("--add c-1", "part 2/2 is missing"),
        ("--add c-2 c-1 c-2", "are both part 2/2"),
        ("--add c-1 v", "`k` differ"),
        ("--add c-1 d-2", "c-1 and d-2 were counted for other caches"),
        ("--add c-1 e-2", "c-1 and e-2 were counted with another --page or --span"),
        ("--add c-1 f-2", "c-1 and f-2 were counted with another --page or --span"),
    ] {
        let outcome = folder.run(&format!("pm-cachesim {line}"));
        assert!(outcome.code == 2 && outcome.stderr.contains(said), "{line}: {}", outcome.stderr);
        assert!(outcome.stdout.is_empty(), "{line}");
    }
    let counts = String::from_utf8(folder.read("c-2")).expect("JSON is text");
    let half = &counts[..counts.len() / 2];
    for damaged in
        [half.to_owned(), "{}".to_owned(), counts.replace("\"both\"", "\"none\""), counts.replacen("[\n", "[\n -1,", 3)]
    {
        folder.write("damaged", damaged.as_bytes());
        let outcome = folder.run("pm-cachesim --add c-1 damaged");
        assert!(outcome.fails(3).contains("damaged: "), "{}", outcome.stderr);
    }
    // A batch of the other part.
    folder.write("twice", folder.run("pm-cachesim --counts t-1").ok().text().replace("312f32", "322f32").as_bytes());
    let outcome = folder.run("pm-cachesim --add c-1 twice");
    assert!(outcome.code != 0 && outcome.stdout.is_empty(), "{}", outcome.stderr);
}

#[test]
fn pictures_of_parts_are_added_up() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    let queries = format!("pm-queries {SMALL} --order tiled --tile 5");
    folder.run(&format!("{queries} --base direct.exr -o q.pmq")).ok();
    let gather = "pm-gather --no-trace map.pmp";
    folder.run(&format!("{gather} q.pmq --base direct.exr --image whole.exr")).ok();
    let (mut bases, mut pictures) = (vec![], vec![]);
    for number in 1..=3 {
        folder.run(&format!("{queries} --part {number}/3 --base direct-{number}.exr -o q-{number}.pmq")).ok();
        let line = format!("{gather} q-{number}.pmq --base direct-{number}.exr --image picture-{number}.exr");
        folder.run(&line).ok();
        bases.push(format!("direct-{number}.exr"));
        pictures.push(format!("picture-{number}.exr"));
    }
    for (parts, whole) in [(&bases, "direct.exr"), (&pictures, "whole.exr")] {
        folder.run(&format!("pm-view --merge {} -o merged.exr", parts.join(" "))).ok();
        same_bytes(whole, &folder.read(whole), &folder.read("merged.exr"));
        std::fs::remove_file(folder.path("merged.exr")).unwrap();
    }
    for (line, said) in [
        ("pm-view --merge picture-1.exr picture-3.exr -o merged.exr", "part 2/3 is missing"),
        (
            "pm-view --merge picture-1.exr direct-2.exr picture-3.exr -o merged.exr",
            "what they say of themselves differs",
        ),
        ("pm-view --merge whole.exr -o merged.exr", "not a part of a picture"),
        ("pm-view --merge picture-1.exr picture-2.exr picture-3.exr", "name the whole by -o"),
        ("pm-gather --no-trace map.pmp q-1.pmq --image merged.png", "only an .exr says so"),
        ("pm-gather --no-trace map.pmp q-1.pmq --base direct-2.exr --image merged.exr", "direct-2.exr is part 2/3"),
        ("pm-gather --no-trace map.pmp q-1.pmq --base direct.exr --image merged.exr", "direct.exr is of the whole"),
        ("pm-gather --no-trace map.pmp q.pmq --base direct-2.exr --image merged.exr", "the queries are of the whole"),
        ("pm-queries --size 16x12 --part 1/2 --base merged.png -o x.pmq", "only an .exr says so"),
    ] {
        let said_of_it = folder.run(line);
        assert!(said_of_it.fails(2).contains(said), "{line}: {}", said_of_it.stderr);
        assert!(!folder.names().iter().any(|name| name.contains("merged")), "{line}: {:?}", folder.names());
    }
}

/// The line is refused, says so, and writes nothing.
#[track_caller]
fn refused(folder: &Folder, line: &str, said: &str) {
    let before = folder.names();
    let outcome = folder.run(line);
    assert!(outcome.fails(2).contains(said), "`{line}` says:\n{}", outcome.stderr);
    assert!(outcome.stdout.is_empty(), "`{line}` writes");
    assert_eq!(folder.names(), before, "`{line}`");
}

#[test]
fn what_is_missing_doubled_foreign_or_mixed_is_refused() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    let queries = format!("pm-queries {SMALL}");
    for (line, name) in [
        (format!("{queries} PART"), "q"),
        (format!("{queries} PART --seed 1"), "r"),
        (format!("{queries} PART | pm-gather map.pmp"), "t"),
        (format!("{queries} PART | pm-gather map.pmp -k 9"), "u"),
        ("pm-photons -n 3000 PART".to_owned(), "p"),
        ("pm-photons -n 3001 PART".to_owned(), "o"),
    ] {
        make_parts(&folder, &line, name, 2);
    }
    folder.run(&format!("{queries} -o whole.pmq")).ok();
    folder.run(&format!("{queries} --part 2/3 -o third")).ok();
    for (parts, said) in [
        ("q-1", "part 2/2 is missing"),
        ("q-2 q-2", "q-2 and q-2 are both part 2/2: give each once"),
        ("q-1 q-2 q-1", "q-1 and q-1 are both part 1/2"),
        ("q-1 third", "third is part 2/3, but q-1 is one of 2"),
        ("q-1 r-2", "q-1 and r-2 were not made in the same way: `pm-queries"),
        ("q-1 t-2", "t-2 holds searches (a trace), but q-1 queries"),
        ("t-1 u-2", "`k` differ"),
        ("p-1", "part 2/2 is missing"),
        ("p-1 o-2", "the numbers of records to come differ"),
        ("p-1 q-2", "q-2 holds queries, but p-1 photons of a part"),
        ("whole.pmq", "whole.pmq: not a part of a stream, but a whole one"),
        ("map.pmp", "map.pmp: not a part of a stream, but a whole one"),
        ("- -", "standard input (`-`) can be read only once"),
    ] {
        refused(&folder, &format!("pm-view --merge {parts} -o merged"), said);
    }
    for (line, said) in [
        ("pm-reorder hilbert q-1 -o x.pmq", "q-1 is part 1/2 of a stream"),
        ("pm-sample --batches 2 q-1 -o x.pmq", "q-1 is part 1/2 of a stream"),
        ("pm-gather map.pmp q-1 --no-trace --report x.csv", "q-1 is part 1/2 of a stream"),
        ("pm-view --export din t-1 -o x.din", "t-1 is part 1/2 of a stream"),
        ("pm-cachesim --cache 1K,full,64,lru --misses x.pmt t-1", "t-1 is part 1/2 of a stream"),
        ("pm-cachesim t-1 u-2", "`k` differ"),
        ("pm-queries --part 3/2 -o x.pmq", "part of a stream, such as 2/8"),
        ("pm-photons --part 0/2 -o x.pmp", "part of a stream, such as 2/8"),
    ] {
        let outcome = folder.run(line);
        assert!(outcome.code == 2 && outcome.stderr.contains(said), "{line}: {}", outcome.stderr);
        assert!(!folder.names().iter().any(|name| name.starts_with(['x', '.'])), "{line}: {:?}", folder.names());
    }
    // Photons of a part are no photons yet.
    let early = folder.run("pm-gather p-1 whole.pmq -o x.pmt");
    assert!(early.fails(2).contains("to be put together by pm-view --merge"), "{}", early.stderr);
    // Cached irradiance is needed whole by every pixel.
    folder.run("pm-queries --size 16x12 --gathers 4 --irradiance-cache 0.2 --part 1/2 -o cached").ok();
    let cached = folder.run("pm-gather map.pmp cached --no-trace --image x.exr");
    assert!(cached.fails(2).contains("pixels take irradiance that other parts gather"), "{}", cached.stderr);
}

#[test]
fn a_damaged_part_makes_no_whole() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    make_parts(&folder, "pm-photons -n 30000 PART", "p", 2);
    make_parts(&folder, &format!("pm-queries {SMALL} PART"), "q", 2);
    make_parts(&folder, &format!("pm-queries {SMALL} PART | pm-gather map.pmp"), "t", 2);
    for name in ["p", "q", "t"] {
        let whole = folder.read(&format!("{name}-2"));
        for (cut, flip) in
            [(1, None), (60, None), (whole.len() / 2, None), (0, Some(whole.len() / 2)), (0, Some(whole.len() - 9))]
        {
            let mut damaged = whole[..whole.len() - cut].to_vec();
            flip.into_iter().for_each(|at| damaged[at] ^= 4);
            folder.write("damaged", &damaged);
            let merged: Outcome = folder.run(&format!("pm-view --merge {name}-1 damaged -o merged"));
            assert!(merged.fails(3).contains("damaged: "), "{}", merged.stderr);
            assert!(!folder.names().iter().any(|name| name.contains("merged")), "{:?}", folder.names());
        }
    }
    let cached = folder.feed("pm-view --merge t-1 - -o merged", &folder.read("t-2"));
    assert!(cached.code == 0 && folder.names().contains(&"merged".to_owned()), "a part may come by a pipe");
}
