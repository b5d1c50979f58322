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
fn more_series_than_can_be_told_apart_become_several_drawings() {
    let folder = Folder::new();
    let rows: String = (0..9).map(|i| format!("o{i},1,{i}\no{i},2,{}\n", i + 1)).collect();
    folder.write("t.csv", format!("order,size,fetches\n{rows}"));
    let line = "pm-chart t.csv -x size -y fetches --by order --title Many --size 640x400";
    folder.run(&format!("{line} -o t.svg")).ok();
    let svg = String::from_utf8(folder.read("t.svg")).expect("text");
    assert!(svg.starts_with("<svg width=\"640\" height=\"800\""), "{svg:.80}");
    assert!(svg.contains("Many (1 of 2)") && svg.contains("Many (2 of 2)"));
    let drawings = |text: &str, begins: &str| -> Vec<usize> {
        let named = |drawing: &str| (0..9).filter(|i| drawing.contains(&format!("\no{i}\n"))).count();
        text.split(begins).skip(1).map(|rest| named(rest.split("</svg>").next().expect("an end"))).collect()
    };
    assert_eq!(drawings(&svg, "<svg y="), [5, 4]);
    folder.run(&format!("{} -o t.html", line.replace(" --size 640x400", ""))).ok();
    let html = String::from_utf8(folder.read("t.html")).expect("text");
    assert_eq!(drawings(&html, "<svg class=\"wide\""), [5, 4], "where the lines end");
    assert_eq!(drawings(&html, "<svg class=\"narrow\""), [0, 0], "on a phone below the drawing");
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
