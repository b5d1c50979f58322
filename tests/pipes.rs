//! Does the whole chain run, and write streams that are whole and can be made again from what they say?

use crate::streams::{check, searches};
use crate::support::{Folder, SMALL, same_bytes, same_text};

#[test]
fn the_line_on_the_card_runs() {
    let folder = Folder::new();
    folder.run("pm-photons -n 500 -o map.pmp").ok();
    let table = folder.sh(&format!("pm-queries {SMALL} | pm-reorder hilbert | pm-gather | pm-cachesim")).ok();
    let lines: Vec<&str> = table.text().lines().collect();
    assert!(lines.get(1).is_some_and(|names| names.ends_with("per_block")), "{}", table.text());
    assert!(lines.last().is_some_and(|row| row.contains("hilbert") && row.contains("128K,full,128,lru")));
    assert_eq!(folder.names(), ["map.pmp"]);

    // The same with a copy of each stream kept on its way.
    let kept = folder.sh(&format!(
        "pm-queries {SMALL} | tee q.pmq | pm-reorder hilbert | tee r.pmq | pm-gather | tee t.pmt | pm-cachesim"
    ));
    same_text("table with tee", table.text(), kept.ok().text());
    let checked = folder.run("pm-view --check map.pmp q.pmq r.pmq t.pmt").ok();
    let checked: Vec<&str> = checked.text().lines().collect();
    assert_eq!(checked.len(), 4);
    for (line, name) in checked.iter().zip(["map.pmp", "q.pmq", "r.pmq", "t.pmt"]) {
        assert!(line.starts_with(&format!("{name}: whole, ")), "{line}");
    }
    assert_eq!(checked[1].strip_prefix("q.pmq"), checked[2].strip_prefix("r.pmq"));

    // Each query is searched for once, each search finds its photons, and the table counts them all.
    let (queries, searches) = (check(&folder.read("q.pmq")).unwrap().records, searches(&folder.read("t.pmt")));
    assert!(queries > 0 && queries == searches.len() as u64);
    assert!(searches.iter().all(|search| search.pixels.len() == 1 && search.accesses.len() >= 100));
    assert!(lines.last().is_some_and(|row| row.contains(&format!(" {queries} "))), "{queries}: {}", table.text());
}

/// Makes `t.pmt` by these lines, then again in a fresh folder by what its history says.
fn made_again(lines: &[&str]) -> String {
    let bring = |folder: &Folder| {
        for ending in ["obj", "mtl", "camera.toml"] {
            let scene = format!("{}/../../scenes/furnace.{ending}", env!("CARGO_MANIFEST_DIR"));
            folder.write(&format!("furnace.{ending}"), std::fs::read(scene).unwrap());
            folder.write(&format!("my furnace.{ending}"), folder.read(&format!("furnace.{ending}")));
        }
    };
    let folder = Folder::new();
    bring(&folder);
    for line in lines {
        folder.sh(line).ok();
    }
    let history = folder.run("pm-view --history t.pmt").ok().text().to_owned();
    let fresh = Folder::new();
    bring(&fresh);
    let again = fresh.sh(&history).ok();
    same_bytes(&history, &folder.read("t.pmt"), &again.stdout);
    history
}

#[test]
fn the_history_of_a_pipe_can_be_typed_again() {
    let history = made_again(&[
        "pm-photons -n 500 -t 2 -o map.pmp",
        "pm-queries -q --size 9x7 --gathers=2 --order tiled --tile 4 --seed=5 -t2 |
         pm-reorder random --seed 3 --per batch | pm-gather -k 20 --start-radius inf -qt 2 -o t.pmt",
    ]);
    let expected = "pm-photons -n 500 > map.pmp\n\
        pm-queries --size 9x7 --gathers=2 --order tiled --tile 4 --seed=5 | pm-reorder random --seed 3 --per batch | \
        pm-gather -k 20 --start-radius inf\n";
    same_text("history", expected, &history);
}

#[test]
fn the_history_of_files_can_be_typed_again() {
    made_again(&[
        "pm-photons --seed 7 -n 300 'my furnace.obj' > 'the map.pmp'",
        "pm-queries 'my furnace.obj' --size 8x8 --gathers 2 --eye -0.5,0.1,0 --base direct.exr -o 'a b.pmq'",
        "pm-reorder hilbert 'a b.pmq' > h.pmq",
        "pm-gather --map brute 'the map.pmp' h.pmq -o t.pmt",
    ]);
}

#[test]
fn the_history_of_photons_from_a_pipe_can_be_typed_again() {
    made_again(&["pm-queries --size 8x8 --gathers 2 -o q.pmq", "pm-photons -n 300 | pm-gather - q.pmq -o t.pmt"]);
}

#[test]
fn a_program_that_cannot_begin_leaves_no_table() {
    let folder = Folder::new();
    folder.run("pm-photons -n 500 -o map.pmp").ok();
    let outcome = folder.sh("pm-queries nosuch.obj | pm-reorder hilbert | pm-gather | pm-cachesim");
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    assert!(outcome.stdout.is_empty());
    // Each says in one line what it knows, nearest the cause first.
    let speakers: Vec<&str> = outcome.stderr.lines().filter_map(|line| line.split(": ").next()).collect();
    assert_eq!(speakers, ["pm-queries", "pm-reorder", "pm-gather", "pm-cachesim"], "{}", outcome.stderr);
    assert!(outcome.stderr.contains("nosuch.obj"));
}
