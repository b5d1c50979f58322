//! Do the numbers agree with what can be known otherwise, from the trace as text and the plainest of caches?

use crate::streams::{records, searches};
use crate::support::Folder;
use pm_formats::{Photon, Query};
use std::collections::{BTreeSet, HashMap};

/// A trace of the built-in scene in this order, as `t.pmt`.
fn trace(deferred: Option<&str>) -> Folder {
    let folder = Folder::with_streams();
    let queries = match deferred {
        Some(order) => {
            folder.run(&format!("pm-reorder {order} q.pmq -o r.pmq")).ok();
            "r.pmq"
        }
        None => "q.pmq",
    };
    folder.run(&format!("pm-gather map.pmp {queries} -k 30 -o t.pmt")).ok();
    folder
}

/// First and last byte address of every read, in order, and the number of queries, from the text that `pm-view` prints.
fn reads(folder: &Folder) -> (Vec<(u64, u64)>, u64) {
    let text = folder.run("pm-view --records t.pmt").ok();
    let mut lines = text.text().lines();
    assert_eq!(lines.next(), Some("search\tbatch\tkind\tregion\toffset\tlength\taddress"));
    let (mut reads, mut queries) = (vec![], 0);
    for line in lines {
        let fields: Vec<&str> = line.split('\t').collect();
        match fields[2] {
            "pixels" => queries += fields[3].split(',').count() as u64,
            "read" => {
                let address = fields[6].strip_prefix("0x").expect("hexadecimal");
                let address = u64::from_str_radix(address, 16).expect("an address");
                let length: u64 = fields[5].parse().expect("a length");
                reads.push((address, address + length - 1));
            }
            other => panic!("what is a {other}?"),
        }
    }
    (reads, queries)
}

/// Lines touched, one for each line that a record lies in.
fn lines(reads: &[(u64, u64)], line: u64) -> Vec<u64> {
    reads.iter().flat_map(|&(first, last)| first / line..=last / line).collect()
}

/// Fetches of a cache of sets, each a list of the lines it holds, the most recently used last.
fn naive_lru(lines: &[u64], sets: usize, ways: usize) -> u64 {
    let mut cache = vec![Vec::<u64>::new(); sets];
    let mut fetches = 0;
    for &line in lines {
        let set = &mut cache[(line % sets as u64) as usize];
        if let Some(at) = set.iter().rposition(|&held| held == line) {
            set.remove(at);
        } else {
            fetches += 1;
            if set.len() == ways {
                set.remove(0);
            }
        }
        set.push(line);
    }
    fetches
}

/// Rows of `pm-cachesim` by the name of the cache: column by name.
fn simulated(folder: &Folder, options: &str) -> HashMap<String, HashMap<String, f64>> {
    let json = folder.run(&format!("pm-cachesim --format json {options} t.pmt")).ok();
    let json: serde_json::Value = serde_json::from_str(json.text()).expect("JSON");
    let rows = json["rows"].as_array().expect("rows").iter();
    rows.map(|row| {
        let row = row.as_object().expect("an object");
        let numbers = row.iter().filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)));
        (row["cache"].as_str().expect("a name").to_owned(), numbers.collect())
    })
    .collect()
}

#[track_caller]
fn is(row: &HashMap<String, f64>, column: &str, expected: u64) {
    assert_eq!(row[column], expected as f64, "{column}");
}

/// The table for `t.pmt`, in which all `records` of 20 bytes may be read, against a list of the lines touched.
fn assert_lru_is_that_of_a_plain_list(folder: &Folder, what: &str, records: &[u64]) {
    let (reads, queries) = reads(folder);
    for line in [32, 128, 512] {
        let touched = lines(&reads, line);
        assert!(touched.len() > reads.len(), "records that span two lines are part of the test");
        let distinct = touched.iter().collect::<BTreeSet<_>>().len() as u64;
        let rows = simulated(folder, &format!("--lines {line} --sizes 2K,4K,16K,32K,1M --ways full,1,2,4"));
        assert_eq!(rows.len(), 5 * 4, "{:?}", rows.keys());
        for (name, row) in &rows {
            let parts: Vec<&str> = name.split(',').collect();
            let kilobytes = parts[0].strip_suffix('K').map_or(1 << 10, |number| number.parse().unwrap());
            let places = (kilobytes * 1024 / line) as usize;
            let ways = parts[1].parse().unwrap_or(places);
            assert_eq!(row["fetches"], naive_lru(&touched, places / ways, ways) as f64, "{what}: {name}");
            is(row, "queries", queries);
            is(row, "reads", reads.len() as u64);
            is(row, "raw_bytes", reads.len() as u64 * 20);
            is(row, "accesses", touched.len() as u64);
            is(row, "compulsory", distinct);
            is(row, "bytes_fetched", row["fetches"] as u64 * line);
            is(row, "bytes_written_back", 0);
            is(row, "blocks", (records.iter().sum::<u64>() * 20).div_ceil(line));
        }
    }
}

#[test]
fn lru_is_that_of_a_plain_list() {
    for order in [None, Some("hilbert"), Some("random --per batch")] {
        let folder = trace(order);
        let map = records::<Photon>(&folder.read("map.pmp")).len() as u64;
        assert_lru_is_that_of_a_plain_list(&folder, &format!("{order:?}"), &[map]);
    }
}

#[test]
fn lru_is_that_of_a_plain_list_where_irradiance_is_precomputed() {
    let folder = Folder::with_streams();
    let photons = records::<Photon>(&folder.read("map.pmp")).len() as u64;
    let reads_per_query = |options: &str| {
        folder.run(&format!("pm-gather -q map.pmp q.pmq -k 30 {options} -o t.pmt")).ok();
        simulated(&folder, "--sizes 4K --lines 128").remove("4K,full,128,lru").expect("a row")["reads_per_query"]
    };
    let full = reads_per_query("");
    for share in [1, 4] {
        let own = reads_per_query(&format!("--precomputed --precomputed-share {share}"));
        assert!(own < full / 3.0, "{own} reads a query, {full} without");
        assert_lru_is_that_of_a_plain_list(&folder, &format!("1 of {share}"), &[photons, photons.div_ceil(share)]);
    }
}

#[test]
fn a_larger_cache_never_fetches_more() {
    for order in [None, Some("hilbert"), Some("random")] {
        let folder = trace(order);
        let sizes: Vec<u64> = (0..10).map(|i| 512 << i).collect();
        let list: Vec<String> = sizes.iter().map(u64::to_string).collect();
        let rows = simulated(&folder, &format!("--lines 64 --sizes {}", list.join(",")));
        let mut by_size: Vec<(u64, f64, f64)> = vec![];
        for (name, row) in &rows {
            let size = name.split(',').next().unwrap();
            let size = size.parse::<pm_size::Bytes>().unwrap().0;
            by_size.push((size, row["fetches"], row["compulsory"]));
        }
        by_size.sort_by_key(|row| row.0);
        assert_eq!(by_size.len(), sizes.len());
        assert!(by_size.windows(2).all(|pair| pair[0].1 >= pair[1].1), "{order:?}: {by_size:?}");
        // The smallest holds next to nothing, the largest all.
        let (smallest, largest) = (by_size[0], by_size[by_size.len() - 1]);
        assert_eq!(largest.1, largest.2, "what holds the map fetches each line once");
        assert!(smallest.1 > 4.0 * largest.1, "{by_size:?}");
    }
}

#[test]
fn no_policy_fetches_less_than_the_optimum() {
    let registry = pm_caches::policies();
    let of_caches = registry.iter().filter(|policy| policy.keeps_lines());
    let mut policies: Vec<&str> = of_caches.map(|policy| policy.word()).collect();
    policies.push("random:1");
    for order in [None, Some("hilbert")] {
        let folder = trace(order);
        for ways in ["full", "8", "2"] {
            let rows = simulated(&folder, &format!("--sizes 8K --ways {ways} --policies {}", policies.join(",")));
            assert_eq!(rows.len(), policies.len(), "{:?}", rows.keys());
            let fetches = |policy: &str| rows[&format!("8K,{ways},128,{policy}")]["fetches"];
            for &policy in &policies {
                let bypasses = registry.find(policy).is_ok_and(|entry| entry.bypasses());
                let least = if bypasses { "min-bypass" } else { "min" };
                assert!(fetches(least) <= fetches(policy), "{order:?}: {policy}, {ways} ways");
            }
            assert!(
                fetches("min-bypass") <= fetches("min") && fetches("min") < fetches("lru"),
                "{order:?}, {ways} ways"
            );
        }
    }
}

#[test]
fn without_a_cache_every_record_is_fetched() {
    let folder = trace(None);
    let (reads, _) = reads(&folder);
    let rows = simulated(&folder, "--cache none");
    let row = rows.values().next().expect("a row");
    is(row, "fetches", reads.len() as u64);
    is(row, "bytes_fetched", reads.len() as u64 * 20);
}

#[test]
fn orders_differ_in_fetches_and_in_nothing_else() {
    let options = "--sizes 4K --lines 128";
    let rows: Vec<_> = [None, Some("hilbert"), Some("random")]
        .map(|order| simulated(&trace(order), options).remove("4K,full,128,lru").expect("a row"))
        .into();
    for column in ["queries", "reads", "raw_bytes", "accesses", "compulsory", "blocks", "reads_per_query"] {
        assert!(rows.iter().all(|row| row[column] == rows[0][column]), "{column}");
    }
    // The project's claim at its smallest: neighbours in space as neighbours in time, fewer fetches than by chance.
    let fetches: Vec<f64> = rows.iter().map(|row| row["fetches"]).collect();
    assert!(fetches[1] < fetches[0] && fetches[1] < 0.8 * fetches[2], "scanline, hilbert, random: {fetches:?}");
}

#[test]
fn each_search_reads_its_nearest_photons_and_the_root_first() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -k 30 --start-radius inf -o t.pmt").ok();
    folder.run("pm-gather map.pmp q.pmq -k 30 --start-radius inf --map brute -o b.pmt").ok();
    let photons = records::<Photon>(&folder.read("map.pmp"));
    let walked = searches(&folder.read("t.pmt"));
    assert_eq!(walked.len(), records::<Query>(&folder.read("q.pmq")).len());
    for search in &walked {
        assert_eq!(search.accesses[0].offset, 0, "the root of the tree");
        let distinct: BTreeSet<u64> = search.accesses.iter().map(|access| access.offset).collect();
        assert_eq!(distinct.len(), search.accesses.len(), "no photon is read twice in one attempt");
        assert!((30..=photons.len()).contains(&distinct.len()));
    }
    // Brute force reads all, from the first to the last.
    let all: Vec<u64> = (0..photons.len() as u64).map(|i| i * 20).collect();
    for search in searches(&folder.read("b.pmt")) {
        assert!(search.accesses.iter().map(|access| access.offset).eq(all.iter().copied()));
    }
    // Read as text, the trace holds the same.
    let (text, queries) = reads(&folder);
    assert_eq!(queries, walked.len() as u64);
    assert_eq!(text.len(), walked.iter().map(|search| search.accesses.len()).sum::<usize>());

    // Where the nodes lie changes no number of reads; second touches come on top, at most one for each first.
    let total = |options: &str| {
        let trace = folder.run(&format!("pm-gather map.pmp q.pmq -k 30 --start-radius inf {options}")).ok();
        searches(&trace.stdout).iter().map(|search| search.accesses.len()).sum::<usize>()
    };
    assert_eq!(total("--layout preorder"), text.len());
    assert!((text.len() + 1..2 * text.len()).contains(&total("--reread")));
    assert_eq!(total("--reread"), total("--reread --layout preorder"));
}
