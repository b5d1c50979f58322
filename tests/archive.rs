//! Traces that are kept: does every program read them as those that they were made of?

use crate::support::{Folder, same_bytes, same_text};

/// Queries enough for their walks to tell of one another.
const QUERIES: &str = "pm-queries --size 32x32 --gathers 4 --order tiled --tile 16";

#[test]
fn archives_are_read_as_the_traces_they_were_made_of() {
    let folder = Folder::new();
    folder.run("pm-photons -n 3000 -o map.pmp").ok();
    for (order, map) in
        [("hilbert --per batch", "kd"), ("random", "kd --reread"), ("random", "bucket-kd"), ("hilbert", "wide")]
    {
        folder.sh(&format!("{QUERIES} | pm-reorder {order} | pm-gather map.pmp -k 20 --map {map} -o plain.pmt")).ok();
        folder.run("pm-view --archive plain.pmt -o kept.pmt").ok();
        let (plain, kept) = (folder.read("plain.pmt"), folder.read("kept.pmt"));
        assert!(kept.len() < plain.len(), "{order}, {map}: {} and {} bytes", kept.len(), plain.len());
        for line in [
            "pm-cachesim --sizes 1K,4K --format csv",
            "pm-cachesim --curve",
            "pm-cachesim --lanes 1,4",
            "pm-view --export raw64",
            "pm-view --history",
        ] {
            let said = |name: &str| folder.run(&format!("{line} {name}")).ok().stdout;
            let (of_plain, of_kept) = (said("plain.pmt"), said("kept.pmt"));
            if line.contains("--export") {
                same_bytes(line, &of_plain, &of_kept);
            } else {
                let text = |bytes| String::from_utf8(bytes).expect("a text");
                same_text(line, &text(of_plain), &text(of_kept).replace("kept.pmt", "plain.pmt"));
            }
        }
        folder.run("pm-view --check kept.pmt").ok();
        same_bytes("an archive of an archive", &kept, &folder.run("pm-view --archive kept.pmt").ok().stdout);
        // Damage is seen, and nothing looks whole.
        for at in [kept.len() / 3, kept.len() / 2] {
            let mut damaged = kept.clone();
            damaged[at] ^= 8;
            folder.write("damaged.pmt", &damaged);
            let outcome = folder.run("pm-cachesim damaged.pmt");
            outcome.fails(3);
            assert!(outcome.stdout.is_empty());
        }
    }
}

#[test]
fn parts_that_were_kept_are_put_together() {
    let folder = Folder::new();
    folder.run("pm-photons -n 3000 -o map.pmp").ok();
    let trace = |part: &str| format!("{QUERIES} {part} | pm-reorder random --per batch | pm-gather map.pmp -k 20");
    folder.sh(&format!("{} -o whole.pmt", trace(""))).ok();
    folder.run("pm-view --archive whole.pmt -o kept.pmt").ok();
    for part in 1..=2 {
        folder.sh(&format!("{} | pm-view --archive - -o kept-{part}.pmt", trace(&format!("--part {part}/2")))).ok();
    }
    folder.run("pm-view --merge kept-1.pmt kept-2.pmt -o merged.pmt").ok();
    same_bytes("parts of an archive", &folder.read("kept.pmt"), &folder.read("merged.pmt"));
    let table = |of: &str| folder.run(&format!("pm-cachesim --format csv {of}")).ok().text().replace(of, "it");
    same_text("parts that were kept", &table("whole.pmt"), &table("kept-1.pmt kept-2.pmt"));
}
