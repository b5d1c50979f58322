//! Terminal refused, `-` accepted, `| head` quiet, exit codes as written, help that helps?

mod advice;
mod help;
mod options;
mod reader_gone;
mod report;
mod terminal;

use crate::support::{Folder, Outcome, SMALL, same_bytes, same_text};

/// Asked wrongly: exit 2, and every line on standard error says who speaks.
#[track_caller]
pub(crate) fn asked_wrongly(outcome: &Outcome) -> &str {
    let Outcome { line, code, stdout, stderr } = outcome;
    let program = line.split_whitespace().next().expect("a program");
    assert_eq!(*code, 2, "`{line}`\n{stderr}");
    assert!(stdout.is_empty(), "`{line}` wrote something");
    let speaks = |said: &str| said.strip_prefix(program).is_some_and(|rest| rest.starts_with(": ") && rest.len() > 2);
    assert!(!stderr.is_empty() && stderr.lines().all(speaks), "`{line}`: who speaks?\n{stderr}");
    stderr
}

#[test]
fn wrong_arguments_are_refused_by_name() {
    let folder = Folder::with_streams();
    // The argument, and what the message must hold.
    for (line, named) in [
        ("pm-photons --nosuch", "--nosuch"),
        ("pm-photons -n", "-n"),
        ("pm-photons -n -5", "-5"),
        ("pm-photons -n many", "many"),
        ("pm-photons -t 0", "0"),
        ("pm-photons --seed x", "--seed"),
        ("pm-queries --size 512", "512x512"),
        ("pm-queries --size 0x4", "0x4"),
        ("pm-queries --size 99999x99999", "2^28"),
        ("pm-queries --gathers 0", "--gathers"),
        ("pm-queries --order diagonal", "scanline, tiled"),
        ("pm-queries --order tiled --tile 0", "--tile"),
        ("pm-queries --order direction-binned --gathers 4 --bins 5", "give at most 4"),
        ("pm-queries --order direction-binned --bins 0", "--bins"),
        ("pm-queries --eye 1,2", "1,2"),
        ("pm-queries --eye 1,2,inf", "1,2,inf"),
        ("pm-queries --base direct.jpg", "direct.jpg: an image's name ends in .exr or .png"),
        ("pm-reorder", "ORDER"),
        ("pm-reorder backwards q.pmq", "hilbert, morton"),
        ("pm-reorder hilbert q.pmq --per pixel", "batch, image"),
        ("pm-reorder hilbert q.pmq q.pmq", "q.pmq"),
        ("pm-reorder leaf q.pmq", "give --photons"),
        ("pm-reorder cells q.pmq", "give --photons"),
        ("pm-reorder hilbert --photons map.pmp q.pmq", "leave --photons out"),
        ("pm-reorder leaf --photons - -", "read only once"),
        ("pm-reorder buffered --cell 0.01 q.pmq", "a larger --cell"),
        ("pm-reorder hashed --cell 0 q.pmq", "a length above 0"),
        ("pm-reorder hashed --buckets 0 q.pmq", "--buckets"),
        ("pm-reorder hilbert --memory 1K q.pmq", "at least 64K"),
        ("pm-reorder hilbert --storage 1MB q.pmq", "write 1M"),
        ("pm-sample q.pmq", "--batches"),
        ("pm-sample --batches 2 --queries 2 q.pmq", "--queries"),
        ("pm-sample --batches 0 q.pmq", "--batches"),
        ("pm-sample --every 100 --window 30 q.pmq", "90 or 120 would do"),
        ("pm-gather - -", "standard input"),
        ("pm-gather map.pmp q.pmq -k 0", "-k"),
        ("pm-gather map.pmp q.pmq --max-dist=-1", "a distance of 0 or more"),
        ("pm-gather map.pmp q.pmq --max-dist nan", "a distance of 0 or more"),
        ("pm-gather map.pmp q.pmq --start-radius 0", "a radius above 0, `inf` or `auto`"),
        ("pm-gather map.pmp q.pmq --map octree", "kd, bucket-kd"),
        ("pm-gather map.pmp q.pmq --map kdb --pages boxes --line 32", "--pages compact"),
        ("pm-gather map.pmp q.pmq --map kdb --fill 1.5", "at most 1"),
        ("pm-gather map.pmp q.pmq --map vvh --pad", "--map kd"),
        ("pm-gather map.pmp q.pmq --line 33", "multiple of 4"),
        ("pm-gather map.pmp q.pmq --report -", "--no-trace"),
        ("pm-gather map.pmp q.pmq --precomputed-share 2", "--precomputed"),
        ("pm-gather map.pmp q.pmq --precomputed --precomputed-share 0", "0"),
        ("pm-gather map.pmp q.pmq --image out", "out: an image's name ends in .exr or .png"),
        ("pm-gather map.pmp q.pmq --base direct.exr", "--image"),
        ("pm-gather map.pmp q.pmq --no-trace -o t.pmt", "--no-trace"),
        ("pm-cachesim - -", "read only once"),
        ("pm-cachesim --sizes 128KB t.pmt", "write 128K"),
        ("pm-cachesim --sizes 1.5M t.pmt", "1.5M"),
        ("pm-cachesim --sizes 100 t.pmt", "128 would do"),
        ("pm-cachesim --lines 100 t.pmt", "128 would do"),
        ("pm-cachesim --ways 3 t.pmt", "would do"),
        ("pm-cachesim --ways 0 t.pmt", "0"),
        ("pm-cachesim --cache 128K,full,128,mru t.pmt", "mru"),
        (
            "pm-cachesim --policies lru,mru t.pmt",
            "lru, fifo, clock, clock-clear, random, random:SEED, plru, srrip, lfu, min, min-bypass",
        ),
        ("pm-cachesim --ways 3 --sizes 384 --policies plru t.pmt", "2 would do"),
        ("pm-cachesim --cache 128K,full,128,lru,hash t.pmt", "leave out"),
        ("pm-cachesim --cache none --policies min t.pmt", "--policies"),
        ("pm-cachesim --cache 128K t.pmt", "128K,full,128,lru"),
        ("pm-cachesim --cache none --sizes 64K t.pmt", "--sizes"),
        ("pm-cachesim --sizes 4M..4K t.pmt", "not from 4M to 4K"),
        ("pm-cachesim --curve --cache none t.pmt", "--cache"),
        ("pm-cachesim --curve --lines 100 t.pmt", "128 would do"),
        ("pm-cachesim --shards 0 t.pmt", "above 0"),
        ("pm-cachesim --shards nan t.pmt", "above 0"),
        ("pm-cachesim --misses x.pmt t.pmt", "--cache"),
        ("pm-cachesim --cache none --misses x.pmt t.pmt", "name one that has lines"),
        ("pm-cachesim --cache none --cache none --misses x.pmt t.pmt", "one --cache"),
        ("pm-cachesim --page 3K t.pmt", "a power of two"),
        ("pm-cachesim --dram 12,8K,open t.pmt", "power of two of banks"),
        ("pm-cachesim --dram 32,8K t.pmt", "BANKS,ROW,POLICY"),
        ("pm-cachesim --dram 32,8K,open --curve t.pmt", "--curve"),
        ("pm-cachesim --format xml t.pmt", "table, csv, json"),
        ("pm-view --check --history map.pmp", "--history"),
        ("pm-view --records=x map.pmp", "x"),
    ] {
        let outcome = folder.run(line);
        let message = asked_wrongly(&outcome);
        assert!(message.contains(named), "`{line}` should say `{named}`:\n{message}");
    }
    assert_eq!(folder.names(), ["map.pmp", "q.pmq"]);
}

#[test]
fn a_dash_is_standard_input_or_output() {
    let folder = Folder::with_streams();
    let queries = folder.read("q.pmq");
    let hilbert = folder.feed("pm-reorder hilbert", &queries).ok().stdout;
    same_bytes("-o -", &hilbert, &folder.feed("pm-reorder hilbert -o -", &queries).ok().stdout);
    // A dash that is typed stands in the history; the records are the same.
    let typed = folder.feed("pm-reorder hilbert -", &queries).ok().stdout;
    assert_eq!(crate::streams::check(&hilbert).unwrap(), crate::streams::check(&typed).unwrap());
    let photons = folder.feed("pm-gather - q.pmq", &folder.read("map.pmp")).ok().stdout;
    let files = folder.run("pm-gather map.pmp q.pmq").ok().stdout;
    assert_eq!(crate::streams::check(&photons).unwrap(), crate::streams::check(&files).unwrap());
    let by_name = folder.run("pm-view q.pmq").ok();
    for line in ["pm-view", "pm-view -"] {
        same_text(line, by_name.text(), folder.feed(line, &queries).ok().text());
    }
    assert_eq!(folder.names(), ["map.pmp", "q.pmq"]);
}

#[test]
fn sizes_are_powers_of_1024() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let expected = folder.run("pm-cachesim --sizes 16K t.pmt").ok();
    assert!(expected.text().contains(" 16K,full,128,lru "));
    for options in
        ["--sizes 16384", "--sizes 16KiB", "--sizes 16k --lines 128 --ways full", "--cache 16384,full,128,lru"]
    {
        same_text(options, expected.text(), folder.run(&format!("pm-cachesim {options} t.pmt")).ok().text());
    }
    let several = folder.run("pm-cachesim --sizes 16K,32K --lines 64,128 --ways full,4 t.pmt").ok();
    assert_eq!(several.text().lines().count(), 2 + 2 * 2 * 2);
}

#[test]
fn quiet_means_no_remarks() {
    let folder = Folder::with_streams();
    // Photons that guide from another scene are worth a remark.
    folder.write("two.mtl", "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl lamp\nKe 9 9 9\n");
    folder.write(
        "two.obj",
        "mtllib two.mtl\nv -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nv -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1\n\
         usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n",
    );
    let line = "pm-queries two.obj --eye 0,2,4 --look-at 0,0,0 --size 8x8 --gathers 2 --guide map.pmp";
    let spoken = folder.run(line);
    assert_eq!(spoken.code, 0);
    assert!(spoken.stderr.contains("pm-queries: map.pmp is not of this scene: its bounds differ"), "{}", spoken.stderr);
    let silent = folder.run(&format!("{line} -q")).ok();
    same_bytes("quiet", &spoken.stdout, &silent.stdout);
    // Errors are no remarks.
    let _ = folder.run("pm-gather map.pmp nosuch.pmq -q").fails(1);
    let _ = folder.run(&format!("pm-queries {SMALL} -q")).ok();
}
