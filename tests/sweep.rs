//! Does a table of experiments become its rows: each once, whole or not at all, and nothing believed that is not there?

mod again;
mod folder;
mod mistakes;

use crate::support::{Folder, PROGRAMS, same_bytes};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const TABLE: &str = "\
# Two orders, two k.
point,order,k,photons,queries,gather
{order}.{k},scanline tiled-hilbert,10 20,-n 500,--size 16x16 --gathers 4,-k {k}
";

/// A folder in which `make` finds what it finds in the repository, and the programs that were just built.
fn workshop() -> Folder {
    let folder = Folder::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository");
    for name in ["Makefile", "scripts", "scenes"] {
        symlink(root.join(name), folder.path(name)).expect("a link");
    }
    fs::create_dir_all(folder.path("target/release")).expect("a folder");
    for (name, file) in PROGRAMS {
        symlink(file, folder.path("target/release").join(name)).expect("a link");
    }
    folder.write("my.csv", TABLE);
    folder
}

/// `make` with these words and these variables in its environment; it builds nothing.
fn command(folder: &Folder, words: &str, variables: &[(&str, &str)]) -> Command {
    let words = words.split_whitespace();
    let mut command = Command::new("make");
    command.args(["CARGO=true", "THREADS=1"]).args(words).current_dir(folder.path("."));
    // A make that runs these tests must not hand its own options on.
    command.env_remove("MAKEFLAGS").env_remove("MFLAGS").envs(variables.iter().copied()).stdin(Stdio::null());
    command
}

fn make_with(folder: &Folder, words: &str, variables: &[(&str, &str)]) -> Output {
    command(folder, words, variables).output().expect("make runs")
}

fn make(folder: &Folder, words: &str) -> Output {
    make_with(folder, words, &[])
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// Whether a run of make simulated this point.
fn made(output: &Output, point: &str) -> bool {
    said(output).contains(&format!("> out/my/{point}.csv.part"))
}

#[test]
fn a_table_becomes_a_row_for_each_point_and_a_rerun_makes_what_is_missing() {
    let folder = workshop();
    let first = make(&folder, "-j2 sweep SWEEP=my.csv");
    assert!(first.status.success(), "{}", said(&first));
    assert!(said(&first).contains("out/my.csv: 4 rows"), "{}", said(&first));
    let joined = String::from_utf8(folder.read("out/my.csv")).unwrap();
    let lines: Vec<&str> = joined.lines().collect();
    assert!(lines[0].starts_with("point,order,k,"), "{}", lines[0]);
    assert_eq!(lines[0].split(',').filter(|&name| name == "order").count(), 1, "the label stands for the column");
    let starts = ["scanline.10,scanline,10,", "scanline.20,scanline,20,", "tiled-hilbert.10,tiled-hilbert,10,"];
    assert!(lines[1..].iter().zip(starts).all(|(line, start)| line.starts_with(start)), "{joined}");
    // The same searches in another order: as many reads, in the same column of both.
    let reads = |line: &str| {
        let quoteless = line.replace("\"128K,full,128,lru\"", "cache");
        let column = lines[0].split(',').position(|name| name == "reads").unwrap();
        quoteless.split(',').nth(column).unwrap().to_owned()
    };
    assert_eq!(reads(lines[1]), reads(lines[3]));
    assert_ne!(reads(lines[1]), reads(lines[2]));

    let again = make(&folder, "sweep SWEEP=my.csv");
    assert!(again.status.success());
    assert!(!said(&again).contains("pm-gather"), "{}", said(&again));

    fs::remove_file(folder.path("out/my/scanline.20.csv")).unwrap();
    let third = make(&folder, "sweep SWEEP=my.csv");
    assert!(third.status.success());
    assert!(made(&third, "scanline.20") && !made(&third, "scanline.10"), "{}", said(&third));
    assert_eq!(joined.as_bytes(), folder.read("out/my.csv"));
}

#[test]
fn queries_that_others_begin_with_are_cast_once_and_kept() {
    let folder = workshop();
    let table = "point,order,photons,queries\n\
        a,tiled,-n 500,--size 16x16 --gathers 4 || pm-sample -q --queries 2\n\
        b,tiled,-n 500,--size 16x16 --gathers 4 || pm-sample -q --queries 3 | pm-reorder -q hilbert\n\
        c,tiled,-n 500,--size 16x16 --gathers 4 | pm-sample -q --queries 5\n\
        d,tiled,-n 500,--size 16x16 --gathers 4 || pm-reorder -q leaf --photons {photons}\n";
    folder.write("my.csv", table);
    let outcome = make(&folder, "sweep SWEEP=my.csv");
    assert!(outcome.status.success(), "{}", said(&outcome));
    // Those that keep them share them, the word `tiled` among their options; the third casts its own.
    assert_eq!(said(&outcome).matches("pm-queries -q").count(), 2, "{}", said(&outcome));
    assert!(folder.path("out/streams/size-16x16-gathers-4-order-tiled.pmq").exists());
    // The row is that of one pipe, but for the names of the files in its history.
    let pipe = "export PATH=$PWD/target/release:$PATH; pm-queries -q --size 16x16 --gathers 4 --order tiled | \
        pm-sample -q --queries 3 | pm-reorder -q hilbert | pm-gather -q out/streams/n-500.pmp | pm-cachesim -q --format csv";
    let piped = Command::new("bash").args(["-c", pipe]).current_dir(folder.path(".")).output().expect("bash runs");
    let row = |csv: Vec<u8>| {
        let csv = String::from_utf8(csv).unwrap();
        let row = csv.lines().nth(1).expect("a row");
        let history = row.find("pm-queries").min(row.find("pm-photons"));
        row[..history.expect("a history")].to_owned()
    };
    assert_eq!(row(folder.read("out/my/b.csv")), row(piped.stdout));
    assert_ne!(row(folder.read("out/my/a.csv")), row(folder.read("out/my/b.csv")));
}

#[test]
fn points_that_differ_in_caches_alone_gather_once_and_have_the_rows_of_pipes() {
    let folder = workshop();
    let table = "point,size,k,photons,queries,gather,cache\n\
        {k}.{size},1K 4K 16K,10,-n 500,--size 8x8 --gathers 4,-k {k},--sizes {size}\n\
        {k}.{size},4K,20,-n 500,--size 8x8 --gathers 4,-k {k},--sizes {size}\n";
    folder.write("my.csv", table);
    let outcome = make(&folder, "-j2 sweep SWEEP=my.csv");
    assert!(outcome.status.success(), "{}", said(&outcome));
    // The recipes of one trace, and of the point that shares it with nobody.
    assert_eq!(said(&outcome).matches("'pm-gather -q ").count() + said(&outcome).matches("(pm-gather -q ").count(), 2);
    for (k, size) in [(10, "1K"), (10, "4K"), (10, "16K"), (20, "4K")] {
        let pipe = format!(
            "export PATH=$PWD/target/release:$PATH; pm-gather -q out/streams/n-500.pmp out/streams/size-8x8-gathers-4.pmq -k {k} | \
             pm-cachesim -q --format csv --sizes {size}"
        );
        let piped = Command::new("bash").args(["-c", &pipe]).current_dir(folder.path(".")).output().expect("bash runs");
        same_bytes(&format!("{k}.{size}"), &folder.read(&format!("out/my/{k}.{size}.csv")), &piped.stdout);
    }
    // Of a row that is missing, its simulation alone.
    fs::remove_file(folder.path("out/my/10.4K.csv")).unwrap();
    let again = make(&folder, "sweep SWEEP=my.csv");
    assert!(made(&again, "10.4K") && !said(&again).contains("pm-gather"), "{}", said(&again));
}

#[test]
fn a_row_that_does_not_come_says_why_and_those_that_come_how_many_are_left() {
    let folder = workshop();
    let table = "point,command\n\
        a,echo a remark >&2; printf \"x\\n1\\n\"\n\
        b,echo first words >&2; echo last words >&2; exit 5\n\
        c,printf \"x\\n1\\n\"; exit 6\n";
    folder.write("my.csv", table);
    let outcome = make(&folder, "-k sweep SWEEP=my.csv");
    let said = said(&outcome);
    assert!(!outcome.status.success());
    for told in [
        "3 rows to make",
        "a remark",
        "out/my/a.csv: row 1 of 3, about ",
        "out/my/b.csv: no row came back; what makes it ended with code 5; it said last: last words",
        "first words",
        "out/my/c.csv: no row came back; what makes it ended with code 6",
    ] {
        assert!(said.contains(told), "{told}: {said}");
    }
    assert_eq!(folder.read("out/my/b.csv.said"), b"first words\nlast words\n");
    assert!(folder.path("out/my/a.csv").exists() && !folder.path("out/my/a.csv.said").exists());
    // What is left alone is not counted.
    folder.write("my.csv", table.replace("; exit 5", "; printf \"x\\n1\\n\"").replace("; exit 6", ""));
    let again = make(&folder, "sweep SWEEP=my.csv");
    assert!(again.status.success() && self::said(&again).contains("2 rows to make"), "{}", self::said(&again));
    assert!(!folder.path("out/my/b.csv.said").exists());
}

#[test]
fn a_launcher_that_does_nothing_and_says_0_is_not_believed() {
    let folder = workshop();
    for goal in ["sweep SWEEP=my.csv", "run"] {
        let outcome = make(&folder, &format!("LAUNCH=true {goal}"));
        assert!(!outcome.status.success(), "{goal}: {}", said(&outcome));
    }
    // Not even when the streams are there.
    assert!(make(&folder, "sweep SWEEP=my.csv").status.success());
    fs::remove_file(folder.path("out/my/scanline.20.csv")).unwrap();
    let outcome = make(&folder, "LAUNCH=true sweep SWEEP=my.csv");
    assert!(!outcome.status.success());
    assert!(said(&outcome).contains("out/my/scanline.20.csv: no row came back"), "{}", said(&outcome));
    assert!(!folder.path("out/my/scanline.20.csv").exists());
}

#[test]
fn a_point_that_fails_leaves_no_row_and_the_others_theirs() {
    let folder = workshop();
    folder.write("my.csv", TABLE.replace("10 20", "10 none"));
    let outcome = make(&folder, "-k sweep SWEEP=my.csv");
    assert!(!outcome.status.success());
    let there = |name: &str| folder.path("out/my").join(name).exists();
    assert!(there("scanline.10.csv") && there("tiled-hilbert.10.csv"), "{}", said(&outcome));
    assert!(!there("scanline.none.csv") && !folder.path("out/my.csv").exists());
}

/// With results that are all 1, every sentence of the paper still gets a verdict, and so does every claim of later work.
#[test]
fn every_claim_of_the_paper_has_a_verdict() {
    every_claim_has_a_verdict("scripts/claims.csv", 50);
    every_claim_has_a_verdict("scripts/later-claims.csv", 20);
}

/// The same of one table, whose claims need more files than so many.
fn every_claim_has_a_verdict(claims: &str, least: usize) {
    let folder = workshop();
    let judge = |settings: &str| {
        let outcome = folder.run(&format!("pm-sweep derive claims {settings} {claims}"));
        (outcome.code == 0, outcome.text().to_owned(), outcome.stderr)
    };
    let (listed, files, _) = judge("--with list=1");
    assert!(listed && files.lines().count() > least, "{files}");
    let columns = ["bytes_fetched", "bytes_per_query", "fetches_per_query", "fetches_per_block", "reads_per_query"];
    let columns = [&columns[..], &["queries", "blocks", "blocks_unreferenced", "miss_chain"]].concat();
    let columns = [&columns[..], &["ordering_seconds", "gathering_seconds", "structure_bytes"]].concat();
    let columns = [&columns[..], &["rel_mse", "max_difference", "fetches_waiting_searches"]].concat();
    let columns = [&columns[..], &["query_bytes", "total_bytes"]].concat();
    let columns = [&columns[..], &["prefetch_accuracy", "prefetch_coverage", "prefetch_traffic"]].concat();
    let (mut names, mut ones) = ("private,cache_bytes,ways".to_owned(), String::new());
    for column in columns {
        names = format!("{names},{column}");
        ones += ",1";
    }
    let (mut rows, mut elements) = (names, [1, 16, 64].into_iter().chain(100..));
    for size in [4, 16, 32, 128, 256, 1024] {
        for ways in ["full", "8"] {
            let private = elements.next().expect("numbers never end");
            rows += &format!("\n{private},{},{ways}{ones}", size * 1024);
        }
    }
    for file in files.lines() {
        fs::create_dir_all(folder.path(file).parent().unwrap()).unwrap();
        folder.write(file, &rows);
    }
    let (done, table, why) = judge("");
    assert!(done, "{why}");
    let asked = fs::read_to_string(folder.path(claims)).unwrap().lines().filter(|l| !l.starts_with('#')).count();
    assert_eq!(table.lines().count(), asked);
    for line in table.lines().skip(1) {
        let verdicts = [",confirmed,", ",not confirmed,", ",cannot be decided,"];
        assert_eq!(verdicts.iter().filter(|&&verdict| line.contains(verdict)).count(), 1, "{line}");
    }
    // A result that is missing is no verdict.
    fs::remove_file(folder.path(files.lines().next().unwrap())).unwrap();
    assert!(!judge("").0);
}

/// Sweeps and claims name one another rightly: what a claim needs is a point of a sweep.
#[test]
fn every_result_that_a_claim_needs_is_a_point_of_a_sweep() {
    let folder = workshop();
    let asked = make(&folder, "-n out/paper/claims.csv out/later/claims.csv");
    assert!(asked.status.success(), "{}", said(&asked));
}
