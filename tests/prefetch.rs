//! What is prefetched through the programs: is what is said of the cache without what a run without says, and what is refused?

use crate::support::{Folder, row};
use std::collections::BTreeMap;

#[test]
fn the_cache_without_is_that_of_a_run_without_and_lines_add_up() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq --layout veb -o t.pmt").ok();
    let read = |options: &str| {
        let csv = folder.run(&format!("pm-cachesim -q --format csv --sizes 8K {options} t.pmt")).ok().text().to_owned();
        row(&csv)
    };
    let number = |row: &BTreeMap<String, String>, name: &str| row[name].parse::<f64>().unwrap();
    let without = read("");
    for how in ["treelet:512", "next-line:2"] {
        let with = read(&format!("--prefetch {how}"));
        assert_eq!(with["prefetch"], how);
        assert_eq!(with["fetches_unprefetched"], without["fetches"]);
        for same in ["queries", "reads", "accesses", "compulsory", "lines_per_search_mean"] {
            assert_eq!(with[same], without[same], "{how}: {same}");
        }
        let lines = number(&with, "fetches") + number(&with, "prefetched");
        assert_eq!(number(&with, "bytes_fetched"), lines * 128.0, "{how}");
        assert!((number(&with, "prefetch_traffic") - lines / number(&without, "fetches")).abs() < 1e-4, "{how}");
        assert!(number(&with, "fetches") < number(&without, "fetches"), "{how} avoids nothing");
        assert!(number(&with, "prefetch_used") < number(&with, "prefetched"), "{how}: all is used");
        // What a cache of another kind would do is not known.
        assert_eq!((&*with["capacity"], &*with["page_switches"]), ("", ""));
    }
}

#[test]
fn what_cannot_be_done_is_refused() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    folder.run("pm-sample --every 64 --window 16 --warm-up 4 q.pmq -o w.pmq").ok();
    folder.run("pm-gather map.pmp w.pmq -o w.pmt").ok();
    folder.write("a.csv", "address\n128\n256\n");
    for (options, said) in [
        ("--prefetch treelet:512 --ways 8 t.pmt", "SIZE,full,LINE,lru"),
        ("--prefetch treelet:512 --policies fifo t.pmt", "SIZE,full,LINE,lru"),
        ("--prefetch treelet:128 t.pmt", "two or more whole lines"),
        ("--prefetch treelet:1M t.pmt", "does not fit"),
        ("--prefetch treelet:512 --span once t.pmt", "leave out --span once"),
        ("--prefetch treelet:512 w.pmt", "not known; leave it out"),
        ("--prefetch treelet:512 --input csv --columns address a.csv", "has no regions"),
    ] {
        let outcome = folder.run(&format!("pm-cachesim {options}"));
        assert!(outcome.fails(2).contains(said), "{options}: {}", outcome.stderr);
    }
    for (options, said) in
        [("--prefetch stream", "treelet:BYTES"), ("--prefetch next-line:1 --lanes 4", "cannot be used with")]
    {
        let outcome = folder.run(&format!("pm-cachesim {options} t.pmt"));
        assert!(outcome.code == 2 && outcome.stderr.contains(said), "{outcome:?}");
    }
}
