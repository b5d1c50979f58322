//! Do the tables of our programs become charts, and do wrong ones not?

use crate::support::{Folder, same_bytes};

#[test]
fn a_table_of_caches_becomes_a_chart() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let csv = folder.run("pm-cachesim t.pmt --sizes 1K,4K,16K --format csv").ok().stdout;
    folder.write("t.csv", &csv);
    folder.run("pm-chart t.csv -x cache -y fetches --by order --title Fetches -o t.svg").ok();
    let svg = String::from_utf8(folder.read("t.svg")).expect("text");
    // Each cache is a tick, the order is in the legend, and each row is a mark; so is the legend's.
    for text in ["1K,full,128,lru", "4K,full,128,lru", "16K,full,128,lru", "scanline", "Fetches", "fetches"] {
        assert!(svg.contains(text), "{text}");
    }
    assert_eq!(svg.matches("<circle").count(), 3 + 1);
    let piped = folder.feed("pm-chart -x cache -y fetches --by order --title Fetches", &csv).ok();
    same_bytes("by a pipe", svg.as_bytes(), &piped.stdout);
}

#[test]
fn wrong_charts_are_refused_in_one_line() {
    let folder = Folder::new();
    folder.write("t.csv", "order,fetches\na,1\nb,many\n");
    for (line, code, hint) in [
        ("pm-chart t.csv -x order -y fetch", 2, "there is no column `fetch`; there are order, fetches"),
        ("pm-chart t.csv -x order -y fetches", 1, "t.csv, line 3: `many`"),
        ("pm-chart t.csv -x order -y fetches --only order=c", 2, "fits --only"),
        ("pm-chart none.csv -x a -y b", 1, "none.csv"),
    ] {
        let outcome = folder.run(&format!("{line} -o t.svg"));
        assert!(outcome.fails(code).contains(hint), "{line}: {}", outcome.stderr);
        assert_eq!(folder.names(), ["t.csv"]);
    }
}
