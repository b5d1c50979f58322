//! Searches that wait at treelets: is each query served once, what do batches save, and is what waits told?

use crate::streams::{check, records, searches};
use crate::support::Folder;
use pm_formats::{BlockReader, Query};

#[test]
fn each_query_is_served_once_and_a_batch_reads_what_its_searches_read() {
    let folder = Folder::with_streams();
    let mut asked: Vec<u32> = records::<Query>(&folder.read("q.pmq")).iter().map(|query| query.pixel).collect();
    asked.sort_unstable();
    let reads = |options: &str| {
        folder.run(&format!("pm-gather -q map.pmp q.pmq --map treelets --treelet 1000 {options} -o t.pmt")).ok();
        let trace = folder.read("t.pmt");
        check(&trace).unwrap();
        let all = searches(&trace);
        let mut served: Vec<u32> = all.iter().flat_map(|search| search.pixels.clone()).collect();
        served.sort_unstable();
        assert_eq!(served, asked, "{options}");
        let regions = BlockReader::new(&trace[..]).unwrap().header().regions.len();
        let of = |region: u16| {
            all.iter().flat_map(|search| &search.accesses).filter(|access| access.region == region).count()
        };
        (regions, all.len(), of(0), of(1))
    };
    let alone = reads("--batch 1 --waiting chip");
    let chip = reads("--batch 500 --waiting chip -t 2");
    let memory = reads("--batch 500");
    assert_eq!((alone.0, chip.0, memory.0), (1, 1, 2), "regions");
    assert_eq!((alone.2, chip.2), (memory.2, memory.2), "nodes are read by whoever wants them, together or alone");
    assert!(alone.1 == asked.len() && chip.1 < asked.len() / 10, "{} and {} searches", alone.1, chip.1);
    // There are more photons than a treelet has, so that every search waits.
    assert!(memory.3 > asked.len(), "{} lines of {} searches that waited", memory.3, asked.len());
}

#[test]
fn what_a_batch_takes_on_chip_is_told_and_what_it_cannot_do_is_refused() {
    let folder = Folder::with_streams();
    let photons = records::<pm_formats::Photon>(&folder.read("map.pmp")).len() as u64;
    let told = |options: &str| {
        let line = format!("pm-gather -q map.pmp q.pmq -k 40 --map treelets --batch 256 {options} --no-trace");
        folder.run(&format!("{line} --report r.csv")).ok();
        let text = String::from_utf8(folder.read("r.csv")).unwrap();
        let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
        let at = rows[0].iter().position(|&name| name == "batch_bytes_on_chip").expect("it is said");
        rows[1][at].parse::<u64>().unwrap()
    };
    // 44 bytes of the query and 4 for how much it has; 8 for each candidate, and for a node of each level and one more.
    let levels = (1..).find(|&levels| (1 << levels) > photons).expect("few photons");
    assert_eq!(told("--waiting chip"), 256 * (48 + 8 * (40 + levels + 1)));
    assert_eq!(told(""), 256 * 4);
    let outcome = folder.run("pm-gather map.pmp q.pmq --map treelets --carry -o t.pmt");
    assert!(outcome.fails(2).contains("which carry nothing"), "{}", outcome.stderr);
    let outcome = folder.run("pm-gather map.pmp q.pmq --map treelets --waits -o t.pmt");
    assert!(outcome.fails(2).contains("do not tell what their reads wait for"), "{}", outcome.stderr);
    let outcome = folder.run("pm-gather map.pmp q.pmq --map kd --treelet 4096 -o t.pmt");
    assert!(outcome.fails(2).contains("--treelet is for --map treelets"), "{}", outcome.stderr);
}
