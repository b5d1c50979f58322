//! Are a DRAM's counts those of a simulator of DRAMs, for the searches of a picture?

use crate::support::Folder;

/// Order, and what DRAMsim3 found of the misses of 128K (DDR4-3200, 8 Gb x8, reads of 64 bytes; 12,575 queries, 450,000
/// photons): the share of reads that found their row open, and activations for each fetch of 128 bytes.
const DRAMSIM3: [(&str, f64, f64); 3] =
    [("scanline", 0.913, 0.176), ("hilbert", 0.934, 0.133), ("random", 0.911, 0.180)];

#[test]
fn rows_are_opened_about_as_often_as_dramsim3_opens_them() {
    let folder = Folder::new();
    folder.run("pm-photons -q -n 450000 -o map.pmp").ok();
    folder.run("pm-queries -q --size 16x16 --gathers 64 -o scanline.pmq").ok();
    for order in ["hilbert", "random"] {
        folder.run(&format!("pm-reorder -q {order} scanline.pmq -o {order}.pmq")).ok();
    }
    for (order, open, activates) in DRAMSIM3 {
        folder.run(&format!("pm-gather -q map.pmp {order}.pmq --map kd -k 100 -o t.pmt")).ok();
        let line = "pm-cachesim -q t.pmt --cache 128K,full,128,lru --dram 32,8K,open --format csv";
        let csv = folder.run(line).ok();
        let mut reader = csv::Reader::from_reader(csv.text().as_bytes());
        let names = reader.headers().expect("names").clone();
        let row = reader.records().next().expect("a row").expect("as many cells as names");
        let number = |name: &str| -> f64 {
            let at = names.iter().position(|known| known == name).expect("a column");
            row[at].parse().expect("a number")
        };
        assert_eq!(number("queries"), 12_575.0);
        let ours = number("activates") / number("fetches");
        let off = ours / activates - 1.0;
        // Without a controller that looks ahead there are more, never fewer.
        assert!((0.0..0.15).contains(&off), "{order}: {ours:.4} activations a fetch, DRAMsim3 {activates}");
        // A fetch is two reads, of which the second finds the row open.
        let hits = 1.0 - ours / 2.0;
        assert!((hits - open).abs() < 0.02, "{order}: {hits:.4} of the reads find their row open, DRAMsim3 {open}");
    }
}
