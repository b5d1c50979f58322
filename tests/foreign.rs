//! Do traces of other simulators come in and go out, with the counts that they must have?

use crate::support::{Folder, row, same_text};
use pm_formats::trace::{Access, AccessKind, BlockEncoder, Coding, TraceWriter, lay_out};
use pm_formats::{BlockMeta, Header};
use std::collections::BTreeMap;

const CACHES: [&str; 4] = ["2K,full,64,lru", "2K,4,64,lru", "2K,1,64,lru", "16K,8,64,lru"];

/// What each cache counts, in these columns.
fn counts(folder: &Folder, arguments: &str, columns: &[&str]) -> Vec<Vec<String>> {
    let count = |cache: &&str| {
        let csv = folder.run(&format!("pm-cachesim --format csv --cache {cache} {arguments}")).ok();
        let row = row(csv.text());
        columns.iter().map(|column| row[*column].clone()).collect()
    };
    CACHES.iter().map(count).collect()
}

/// A trace of all kinds of accesses, of many lengths, in regions that lie apart.
fn mixed_trace() -> Vec<u8> {
    let mut header = Header::empty();
    header.regions = lay_out([("a".into(), 9000, 20, Coding::Records), ("b".into(), 100_000, 1, Coding::Records)]);
    header.regions[1].base += 1 << 28;
    let mut random = 1u64;
    let mut below = |n: u64| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) % n
    };
    let mut writer = TraceWriter::new(vec![], &header).unwrap();
    for _ in 0..3 {
        let mut encoder = BlockEncoder::new(&header.regions);
        for pixel in 0..200 {
            encoder.begin(&[pixel]);
            let start = below(90_000);
            for _ in 0..below(40) {
                let kind = [AccessKind::Read, AccessKind::Write, AccessKind::ReadModifyWrite][below(3) as usize];
                let (region, offset) = if below(2) == 0 { (0, below(8800)) } else { (1, start + below(2000)) };
                encoder.access(Access { kind, region, len: 1 + below(150) as u32, offset });
            }
            encoder.end();
        }
        let (block, tally) = encoder.finish(BlockMeta::default()).unwrap();
        writer.write(&block, tally).unwrap();
    }
    writer.finish(vec![]).unwrap()
}

#[test]
fn what_is_exported_has_the_counts_of_the_trace() {
    let folder = Folder::new();
    folder.write("t.pmt", mixed_trace());
    let all = ["reads", "raw_bytes", "accesses", "fetches", "bytes_fetched", "bytes_written_back", "compulsory"];
    let lines = ["fetches", "bytes_fetched", "bytes_written_back", "compulsory"];
    let fetched = ["fetches", "bytes_fetched", "compulsory"];
    let expected = |columns: &[&str]| counts(&folder, "t.pmt", columns);
    // Everything, where the form says everything; it tells itself.
    for form in ["lackey", "csv"] {
        folder.run(&format!("pm-view --export {form} t.pmt -o t.{form}")).ok();
        assert_eq!(counts(&folder, &format!("t.{form}"), &all), expected(&all), "{form}");
    }
    // A modify is a read and then a write: one more access, nothing else. Without sizes, lines; without kinds, fetches.
    for (form, export, import, columns) in [
        ("xdin", "", "", &lines[..]),
        ("dinb", "", "--input dinb", &lines),
        ("xdin", "--line 64", "", &lines),
        ("din", "--line 64", "", &lines),
        ("dramsim3", "--line 64", "", &lines),
        ("ramulator2", "--line 64", "", &lines),
        ("raw32", "--line 64", "--input raw32", &fetched),
        ("raw64", "--line 64", "--input raw64", &fetched),
        ("oracleGeneral", "--line 64", "--input oracleGeneral", &fetched),
    ] {
        folder.run(&format!("pm-view --export {form} {export} t.pmt -o t.out")).ok();
        assert_eq!(counts(&folder, &format!("{import} t.out"), columns), expected(columns), "{form} {export}");
    }
    // Per query there is nothing, and the row says what was read.
    let csv = folder.run("pm-cachesim --format csv t.lackey").ok();
    let row = row(csv.text());
    assert_eq!((&*row["order"], &*row["queries"], &*row["fetches_per_query"]), ("lackey", "0", ""));
}

#[test]
fn exports_of_a_gathered_trace_and_pipes() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let columns = ["reads", "raw_bytes", "accesses", "fetches", "compulsory"];
    let expected = counts(&folder, "t.pmt", &columns);
    // All records are of 20 bytes, so that bare addresses will do.
    folder.run("pm-view --export raw64 t.pmt -o t.raw").ok();
    assert_eq!(counts(&folder, "--input raw64 --access-size 20 t.raw", &columns), expected);
    let piped = folder.sh("pm-view --export csv t.pmt | pm-cachesim --format csv --cache 2K,full,64,lru").ok();
    assert_eq!(row(piped.text())["fetches"], expected[0][3]);
    folder.sh("gzip -c t.pmt > t.gz && pm-cachesim t.gz > a && pm-cachesim t.pmt > b && cmp a b").ok();
}

#[test]
fn faults_are_one_line_and_leave_nothing() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    folder.write("bad.din", "0 1a\n0 xyz\n");
    let fault = folder.run("pm-cachesim bad.din");
    same_text("fault", "pm-cachesim: bad.din: line 2: `xyz` is no hexadecimal number", fault.fails(3));
    assert!(fault.stdout.is_empty());
    folder.write("t.raw", [1, 2, 3, 4, 5, 6, 7, 8]);
    assert!(folder.run("pm-cachesim t.raw").fails(3).contains("--input"));
    assert!(folder.run("pm-cachesim --input raw64 --cache 64,full,64,lru t.raw").ok().text().contains("raw64"));
    assert!(
        folder.run("pm-cachesim --input oracleGeneral t.raw").fails(3).contains("record 1: the input ends after 8")
    );
    // A stream of ours with damage stays one, whatever it could be taken for.
    let mut trace = folder.read("t.pmt");
    trace[0] ^= 0x80;
    folder.write("damaged.pmt", &trace);
    let _ = folder.run("pm-cachesim damaged.pmt").fails(3);
    folder.sh("gzip -c t.pmt | head -c 3000 > cut.gz").ok();
    assert!(folder.run("pm-cachesim cut.gz").fails(3).contains("compressed input (gzip) is damaged"));
    let _ = folder.run("pm-cachesim nosuch.din").fails(1);
    let _ = folder.run("pm-cachesim --columns address --input din bad.din").fails(2);
    let _ = folder.run("pm-cachesim --lanes 2 --input raw64 t.raw").fails(2);
    let _ = folder.run("pm-view --export din --line 48 t.pmt").fails(2);
    let _ = folder.run("pm-view --export din t.pmt t.pmt").fails(2);
    let _ = folder.run("pm-view --export din map.pmp -o out.din").fails(2);
    assert!(!folder.names().contains(&"out.din".to_owned()));
}

#[test]
fn one_lane_is_the_plain_run_and_several_are_as_many_rows() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let print = |options: &str| {
        let line = format!("pm-cachesim --sizes 2K,8K --ways full,4 --lines 64 --format csv {options} t.pmt");
        folder.run(&line).ok().text().to_owned()
    };
    let plain = print("");
    assert_eq!(print("--lanes 1"), plain);
    assert_eq!(print("--lanes 1 --lanes-from parts"), plain);
    for from in ["stream", "parts"] {
        let several = print(&format!("--lanes 1,4,16 --lanes-from {from}"));
        let lines: Vec<&str> = several.lines().collect();
        assert_eq!(lines.len(), 1 + 3 * 4);
        assert_eq!(lines[..5], plain.lines().collect::<Vec<_>>()[..]);
        assert_eq!(lines[5..], print(&format!("--lanes 4,16 --lanes-from {from}")).lines().collect::<Vec<_>>()[1..]);
        // The searches are the same, so are reads and distinct lines; what is fetched is not.
        let of = |line: &str, name: &str| row(&format!("{}\n{line}", lines[0]))[name].clone();
        for (one, sixteen) in lines[1..5].iter().zip(&lines[9..]) {
            for name in ["queries", "reads", "accesses", "compulsory", "cache"] {
                assert_eq!(of(one, name), of(sixteen, name), "{name}");
            }
            assert_eq!((of(one, "lanes"), of(sixteen, "lanes")), ("1".into(), "16".into()));
            assert_ne!(of(one, "fetches"), of(sixteen, "fetches"));
        }
    }
    assert!(folder.run("pm-cachesim --lanes 1,4 t.pmt").ok().text().contains("lanes"));
    assert!(!folder.run("pm-cachesim t.pmt").ok().text().contains("lanes"));
    assert_eq!(folder.run("pm-cachesim --lanes 0 t.pmt").code, 2);
}

/// What `valgrind --tool=cachegrind --cache-sim=yes --D1=BYTES,WAYS,LINE` (3.19) says of the program in `data/sum.c`:
/// our name of the cache, and data misses. `data/README.md` has the commands.
const CACHEGRIND: [(&str, u64); 6] = [
    ("8K,2,64,lru", 1538),
    ("16K,4,64,lru", 883),
    ("32K,8,64,lru", 629),
    ("2K,full,64,lru", 5286),
    ("1K,1,32,lru", 10_305),
    ("512,2,128,lru", 8949),
];
/// Misses that libCacheSim 0.3.5 has in those files with an LRU of 8 objects, sizes left out.
const LIBCACHESIM_MISSES: u64 = 158;
/// Data references of the same run.
const REFERENCES: u64 = 86_004;

#[test]
fn a_real_program_misses_as_often_as_cachegrind_says() {
    let folder = Folder::new();
    folder.write("sum.lackey.zst", include_bytes!("data/sum.lackey.zst"));
    let mut equal = 0;
    for (cache, misses) in CACHEGRIND {
        let csv = folder.run(&format!("pm-cachesim -q --format csv --cache {cache} sum.lackey.zst")).ok();
        let row = row(csv.text());
        let count = |name: &str| row[name].parse::<u64>().unwrap();
        // An access over the end of a line is two for us; cachegrind counts one, and at most one miss.
        let spanning = count("accesses") - REFERENCES;
        let more = count("fetches").checked_sub(misses).expect("no fewer than cachegrind");
        assert!(more <= spanning, "{cache}: {more} more, {spanning} accesses span lines");
        equal += u32::from(more == 0);
    }
    assert_eq!(equal, 4);
    // Where a reference counts once, all are equal.
    for (cache, misses) in CACHEGRIND {
        let csv = folder.run(&format!("pm-cachesim -q --format csv --span once --cache {cache} sum.lackey.zst")).ok();
        let row = row(csv.text());
        assert_eq!((&*row["accesses"], &*row["fetches"]), (&*REFERENCES.to_string(), &*misses.to_string()), "{cache}");
    }
    let _ = folder.run("pm-cachesim --span once --curve sum.lackey.zst").fails(2);
    // Instructions are left out, and said.
    let all = folder.run("pm-cachesim --cache 8K,2,64,lru sum.lackey.zst");
    same_text("remark", "pm-cachesim: sum.lackey.zst: 340560 instructions left out (--references all)\n", &all.stderr);
}

#[test]
fn libcachesims_own_files_are_read_in_every_version() {
    let folder = Folder::new();
    let files: [&[u8]; 8] = [
        include_bytes!("data/lcs/v1.lcs.zst"),
        include_bytes!("data/lcs/v2.lcs.zst"),
        include_bytes!("data/lcs/v3.lcs.zst"),
        include_bytes!("data/lcs/v4.lcs.zst"),
        include_bytes!("data/lcs/v5.lcs.zst"),
        include_bytes!("data/lcs/v6.lcs.zst"),
        include_bytes!("data/lcs/v7.lcs.zst"),
        include_bytes!("data/lcs/v8.lcs.zst"),
    ];
    for (version, file) in (1..).zip(files) {
        folder.write("t.lcs.zst", file);
        // The objects, each of which is 4,096 bytes from the next, not their sizes.
        let csv = folder.run("pm-cachesim -q --format csv --cache 512,full,64,lru --access-size 64 t.lcs.zst").ok();
        let row = row(csv.text());
        let count = |name: &str| row[name].parse::<u64>().unwrap();
        // libCacheSim's own count of misses at 8 objects, by its class LRU.
        let found = (count("accesses"), count("compulsory"), count("fetches"));
        assert_eq!(found, (200, 40, LIBCACHESIM_MISSES), "version {version}");
        // As another format it is refused.
        let fault = folder.run("pm-cachesim --input oracleGeneral t.lcs.zst");
        assert!(fault.fails(2).contains("the input is lcs: leave --input out"));
    }
}

#[test]
fn spikes_own_log_has_the_counts_of_spikes_own_caches() {
    let folder = Folder::new();
    folder.write("spike.log.zst", include_bytes!("data/spike.log.zst"));
    // What `spike --dc=SETS:1:LINE` says: misses of reads and of writes, lines written back before the end.
    for (cache, line, misses, written_back, lines) in [
        ("512,1,32,lru", 32, 251 + 201, 435, 16),
        ("512,1,64,lru", 64, 136 + 93, 220, 8),
        ("1K,1,16,lru", 16, 401 + 401, 644, 64),
    ] {
        let csv = folder.run(&format!("pm-cachesim -q --format csv --cache {cache} spike.log.zst")).ok();
        let row = row(csv.text());
        let count = |name: &str| row[name].parse::<u64>().unwrap();
        let found = (&*row["order"], count("accesses"), count("raw_bytes"), count("fetches"));
        assert_eq!(found, ("spike", 2401 + 4089, 10_808 + 27_712, misses), "{cache}");
        // Here what is left dirty in the cache is written back at the end.
        let at_the_end = count("bytes_written_back") / line - written_back;
        assert!(at_the_end <= lines, "{cache}: {at_the_end}");
    }
}

/// Needs python3 with pycachesim; `PYTHON` names the interpreter.
#[test]
#[ignore = "needs python3 with the package pycachesim"]
fn counts_equal_those_of_pycachesim() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    folder.write("mixed.pmt", mixed_trace());
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".into());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scripts/pycachesim_counts.py");
    // What is last used in a set after a store is another matter there, so stores meet one way only.
    for (trace, cache, sets, ways, line) in [
        ("t.pmt", "2K,full,64,lru", 1, 32, 64),
        ("t.pmt", "4K,8,64,lru", 8, 8, 64),
        ("t.pmt", "8K,2,32,lru", 128, 2, 32),
        ("t.pmt", "4K,1,128,lru", 32, 1, 128),
        ("mixed.pmt", "8K,1,32,lru", 256, 1, 32),
        ("mixed.pmt", "64K,1,128,lru", 512, 1, 128),
    ] {
        let theirs = folder.sh(&format!("pm-view --export xdin {trace} | {python} {script} {sets} {ways} {line}")).ok();
        let csv = folder.run(&format!("pm-cachesim --format csv --cache {cache} {trace}")).ok();
        let row = row(csv.text());
        let written = row["bytes_written_back"].parse::<u64>().unwrap() / line;
        assert_eq!(theirs.text().trim(), format!("{} {written}", row["fetches"]), "{trace} {cache}");
    }
}

/// Addresses of 64 bits, little-endian.
fn raw64(addresses: impl Iterator<Item = u64>) -> Vec<u8> {
    addresses.flat_map(u64::to_le_bytes).collect()
}

#[test]
fn pages_and_identifiers_may_lie_anywhere() {
    let folder = Folder::new();
    // More runs of pages than an access can name regions; identifiers that are hashes, as addresses and as numbers of lines.
    folder.write("pages", raw64((0..100_000).map(|i| (3 * i) << 12)));
    folder.write("shifted", raw64((0..65_537).map(|i| i << 40)));
    folder.write("hashes", raw64((1..=65_537u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15))));
    for (file, options, fetches) in [
        ("pages", "", "100000"),
        ("shifted", "", "65537"),
        ("hashes", "", "65537"),
        ("hashes", "--address-unit 128", "65537"),
    ] {
        for cache in ["128K,full,128,lru", "96K,8,128,lru", "64K,8,128,min"] {
            let line = format!("pm-cachesim --input raw64 {options} --cache {cache} --format csv {file}");
            let csv = folder.run(&line).ok();
            let row = row(csv.text());
            assert_eq!(row["fetches"], fetches, "{line}");
            let blocks = row["blocks"].parse::<u64>().unwrap();
            assert!(blocks <= 32 * fetches.parse::<u64>().unwrap(), "{line}: {blocks} blocks");
        }
    }
    let csv = folder.run("pm-cachesim --input raw64 --format csv pages").ok();
    assert_eq!((&*row(csv.text())["blocks"], &*row(csv.text())["fetches_per_block"]), ("3200000", "0.03125"));
}

#[test]
fn a_foreign_trace_goes_through_two_levels_and_out_again() {
    let folder = Folder::new();
    folder.write("sum.lackey.zst", include_bytes!("data/sum.lackey.zst"));
    let two = "--cache 2K,4,64,lru --cache 16K,8,64,plru --cache none --format csv";
    // In, and all counts are those of the foreign trace, but for its name and the commands that it came by.
    folder.run("pm-view -q --import trace --references all sum.lackey.zst -o sum.pmt").ok();
    let counts = |line: &str| {
        let csv = folder.run(line).ok();
        let mut of_all: Vec<BTreeMap<String, String>> = vec![];
        for text in csv.text().lines().skip(1) {
            let mut row = row(&format!("{}\n{text}", csv.text().lines().next().unwrap()));
            row.remove("history");
            row.remove("trace");
            of_all.push(row);
        }
        of_all
    };
    assert_eq!(
        counts(&format!("pm-cachesim {two} sum.pmt")),
        counts(&format!("pm-cachesim --references all {two} sum.lackey.zst"))
    );
    // The misses of the archive and of the foreign trace itself are the same reads.
    let first = "--cache 2K,4,64,lru --format csv";
    folder.run(&format!("pm-cachesim -q {first} --misses a.pmt sum.pmt")).ok();
    folder.run(&format!("pm-cachesim -q --references all {first} --misses b.pmt sum.lackey.zst")).ok();
    let records = |file: &str| folder.run(&format!("pm-view --export csv {file}")).ok().stdout;
    assert!(records("a.pmt") == records("b.pmt"));
    let row_of = |line: &str| row(folder.run(line).ok().text());
    let level = row_of(&format!("pm-cachesim {first} sum.pmt"));
    let second = row_of("pm-cachesim --format csv --cache 16K,8,64,lru a.pmt");
    assert_eq!(second["reads"], level["fetches"]);
    assert!(second["order"].contains("2K,4,64,lru"), "{}", second["order"]);
    // Out: another program gets what misses in both, and we read as much from it.
    folder.run("pm-cachesim --cache 16K,8,64,lru --format csv --misses c.pmt a.pmt").ok();
    folder.run("pm-view --export dramsim3 --line 64 c.pmt -o out.txt").ok();
    let out = row_of("pm-cachesim --format csv --cache none out.txt");
    assert_eq!(out["reads"], second["fetches"]);
    let _ = folder.run("pm-view --import trace sum.pmt -o d.pmt").fails(2);
    let _ = folder.run("pm-view --input raw64 sum.pmt").fails(2);
}

#[test]
fn misses_of_a_foreign_trace_go_to_a_pipe() {
    let folder = Folder::new();
    folder.write("t.xdin", "r 1000 4\nw 2000 4\nr 1000 4\n");
    let piped = folder
        .sh("pm-cachesim -q --misses - --cache 1K,full,64,lru t.xdin | pm-cachesim --format csv --cache none,64")
        .ok();
    let row = row(piped.text());
    assert_eq!((&*row["reads"], &*row["raw_bytes"], &*row["blocks"]), ("2", "128", "128"));
}

#[test]
fn parts_of_a_foreign_trace_are_counted() {
    let folder = Folder::new();
    folder.write("t", raw64((0..1000).map(|i| i % 100 * 64)));
    let counts = |options: &str| {
        let line = format!("pm-cachesim --input raw64 --format csv --cache 64K,full,64,lru {options} t");
        let csv = folder.run(&line).ok();
        let row = row(csv.text());
        ["reads", "fetches", "compulsory"].map(|column| row[column].parse::<u64>().unwrap())
    };
    assert_eq!(counts(""), [1000, 100, 100]);
    assert_eq!(counts("--skip 950"), [50, 50, 50]);
    assert_eq!(counts("--skip 50 --warm-up 75 --take 50"), [50, 25, 25]);
    assert_eq!(counts("--warm-up 100"), [900, 0, 0]);
    assert_eq!(counts("--take 30"), [30, 30, 30]);
    assert!(folder.run("pm-cachesim --input raw64 --skip 1000 t").fails(2).contains("1000 accesses"));
    // The warm-up of an archive is that of the trace.
    folder.run("pm-view --import trace --input raw64 --skip 50 --warm-up 75 --take 50 t -o t.pmt").ok();
    let csv = folder.run("pm-cachesim --format csv --cache 64K,full,64,lru t.pmt").ok();
    assert_eq!((&*row(csv.text())["reads"], &*row(csv.text())["fetches"]), ("50", "25"));
    let _ = folder.run("pm-cachesim --skip 1 t.pmt").fails(2);
}
