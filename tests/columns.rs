//! Is every column of pm-cachesim in the dictionary, and nothing else; and do its rows say what they are of?

use crate::support::Folder;
use std::collections::BTreeSet;

/// The names of the columns in a row of names.
fn names(csv: &str) -> Vec<String> {
    csv.lines().next().expect("names").split(',').map(str::to_owned).collect()
}

/// Names in the first cells of the tables of the dictionary.
fn dictionary() -> BTreeSet<String> {
    let page = include_str!("../tools/caches/COLUMNS.md");
    let cells = page.lines().filter(|line| line.starts_with("| `")).filter_map(|line| line.split('|').nth(1));
    cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(str::to_owned).collect()
}

#[test]
fn every_column_stands_in_the_dictionary() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    folder.run("pm-sample --every 64 --window 16 --warm-up 4 q.pmq -o w.pmq").ok();
    folder.run("pm-gather map.pmp w.pmq -o w.pmt").ok();
    folder.run("pm-gather --waits map.pmp q.pmq -o c.pmt").ok();
    let mut found = BTreeSet::new();
    for options in [
        "t.pmt",
        "w.pmt",
        "--dinero --dram 32,8K,open t.pmt",
        "--miss-chain c.pmt",
        "--prefetch treelet:512 t.pmt",
        "--private 2 --shared 1M,full,128,lru t.pmt",
        "--curve --shards 0.5 t.pmt",
    ] {
        let csv = folder.run(&format!("pm-cachesim -q --format csv {options}")).ok();
        found.extend(names(csv.text()));
    }
    let regions = ["fetches_kd_nodes", "fetches_kd_nodes_error"];
    let written = dictionary();
    for name in &found {
        let generic = name.replace("_kd_nodes", "_REGION");
        assert!(written.contains(name) || written.contains(&generic), "COLUMNS.md does not say what {name} is");
    }
    assert!(regions.iter().all(|name| found.contains(*name)), "{found:?}");
    for name in written.iter().filter(|name| !name.contains("REGION")) {
        assert!(found.contains(name) || name.starts_with("--"), "COLUMNS.md has {name}, which no table has");
    }
}

#[test]
fn rows_say_which_trace_and_map_they_are_of() {
    let folder = Folder::with_streams();
    for map in ["kd", "grid"] {
        folder.run(&format!("pm-gather map.pmp q.pmq --map {map} -o {map}.pmt")).ok();
    }
    let csv = folder.run("pm-cachesim --format csv kd.pmt grid.pmt").ok().text().to_owned();
    assert_eq!(names(&csv)[..3], ["trace", "map", "order"]);
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|row| row.split(',').take(3).collect()).collect();
    assert_eq!(rows, [["kd.pmt", "kd", "scanline"], ["grid.pmt", "grid", "scanline"]]);
    let curve = folder.run("pm-cachesim --curve --sizes 4K --format csv grid.pmt").ok();
    assert!(curve.text().lines().nth(1).is_some_and(|row| row.starts_with("grid.pmt,grid,scanline,")));

    // The table shows them where nothing else tells rows apart.
    let table = folder.run("pm-cachesim kd.pmt grid.pmt").ok();
    assert!(table.text().contains("kd.pmt") && table.text().contains("grid.pmt"), "{}", table.text());
    let alone = folder.run("pm-cachesim kd.pmt").ok();
    assert!(!alone.text().contains("kd.pmt"), "{}", alone.text());
}

#[test]
fn the_table_goes_where_it_is_asked_to() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let printed = folder.run("pm-cachesim --format csv t.pmt").ok();
    assert!(folder.run("pm-cachesim --format csv t.pmt -o t.csv").ok().stdout.is_empty());
    assert_eq!(folder.read("t.csv"), printed.stdout);
    // Misses take standard output; the table may have a file.
    let line = "pm-cachesim --cache 4K,4,64,lru --misses - --format csv t.pmt -o first.csv | pm-cachesim --format csv -o second.csv";
    folder.sh(line).ok();
    assert!(names(std::str::from_utf8(&folder.read("first.csv")).unwrap()).contains(&"fetches".to_owned()));
    assert!(folder.path("second.csv").exists());
    assert!(folder.run("pm-cachesim t.pmt -o t.pmt").fails(2).contains("t.pmt"));
}

#[test]
fn a_share_of_the_map_is_a_size() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    // 2000 photons of 20 bytes: 40,000 bytes, 313 lines of 128 bytes.
    let column = |line: &str, name: &str| -> Vec<String> {
        let csv = folder.run(line).ok().text().to_owned();
        // The name of the cache has commas, in quotes.
        let cut = |row: &str| -> Vec<String> {
            let mut quoted = false;
            row.split(|c: char| {
                quoted ^= c == '"';
                c == ',' && !quoted
            })
            .map(str::to_owned)
            .collect()
        };
        let at = names(&csv).iter().position(|other| other == name).expect("the column");
        csv.lines().skip(1).map(|row| cut(row)[at].clone()).collect()
    };
    let line = "pm-cachesim --format csv t.pmt --sizes 10%,50%,100%";
    assert_eq!(column(line, "cache_bytes"), [31 * 128, 156 * 128, 313 * 128].map(|bytes: u32| bytes.to_string()));
    let fetches: Vec<u64> = column(line, "fetches").iter().map(|text| text.parse().unwrap()).collect();
    assert!(fetches.is_sorted_by(|a, b| a > b), "{fetches:?}");
    assert_eq!(column("pm-cachesim --format csv t.pmt --sizes 10% --ways 4", "cache_bytes"), ["3584"]);
    let curve = "pm-cachesim --curve --format csv t.pmt --sizes 10%,50%,100%";
    assert_eq!(column(curve, "fetches"), fetches.iter().map(ToString::to_string).collect::<Vec<_>>());
    folder.write("t.raw", [0; 64]);
    assert!(folder.run("pm-cachesim --input raw64 --sizes 10% t.raw").fails(2).contains("a share is one of the map"));
}
