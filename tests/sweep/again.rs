//! Is what was made with another variable, table or program made again, and nothing else?

use super::{TABLE, made, make, make_with, said, workshop};
use std::fs;

/// A small `make run`.
const RUN: &str = "-j2 run GATHERS=4 PHOTONS=500";

#[test]
fn another_size_gives_new_numbers() {
    let folder = workshop();
    let run = |size: &str| {
        let outcome = make(&folder, &format!("{RUN} SIZE={size}"));
        assert!(outcome.status.success(), "{}", said(&outcome));
        said(&outcome)
    };
    let (first, same) = (run("16x16"), run("16x16"));
    let rows = folder.read("out/scanline.csv");
    assert!(first.contains("pm-gather out/map.pmp") && !same.contains("pm-gather"), "{same}");
    let table = |text: &str| {
        let end = text.find("Picture:").expect("what lies where");
        text[text.find("per query").expect("a table")..end].to_owned()
    };
    assert_eq!(table(&first), table(&same));
    let other = run("32x16");
    assert!(table(&other) != table(&first) && rows != folder.read("out/scanline.csv"), "{other}");
    assert!(!other.contains("pm-photons -n 500"), "photons do not depend on it: {other}");
    assert_eq!(table(&run("16x16")), table(&first));
    assert_eq!(rows, folder.read("out/scanline.csv"));
}

#[test]
fn another_value_or_another_line_makes_its_points_again() {
    let folder = workshop();
    folder.write("my.csv", TABLE.replace("-n 500", "-n $(MY_PHOTONS)"));
    let sweep = |photons: &str, options: &str| {
        let outcome = make_with(&folder, &format!("sweep SWEEP=my.csv {options}"), &[("MY_PHOTONS", photons)]);
        assert!(outcome.status.success(), "{}", said(&outcome));
        outcome
    };
    sweep("500", "");
    let first = folder.read("out/my.csv");
    assert!(made(&sweep("600", "-n"), "scanline.10"), "make -n tells");
    assert!(!said(&sweep("500", "")).contains("pm-gather"), "what is only told leaves no trace");
    assert!(made(&sweep("600", ""), "scanline.10"));
    assert_ne!(folder.read("out/my.csv"), first);
    let back = sweep("500", "");
    assert!(made(&back, "scanline.10"), "{}", said(&back));
    assert_eq!(folder.read("out/my.csv"), first);

    // One line more, one option more: their points only.
    let line = "tiled,scanline,10,-n $(MY_PHOTONS),--size 16x16 --gathers 4 --order tiled,-k {k}\n";
    folder.write("my.csv", TABLE.replace("-n 500", "-n $(MY_PHOTONS)") + line);
    let more = sweep("500", "");
    assert!(made(&more, "tiled") && !made(&more, "scanline.10"), "{}", said(&more));
    folder.write("my.csv", TABLE.replace("-n 500", "-n $(MY_PHOTONS)") + &line.replace("-k {k}", "-k {k} --reread"));
    let other = sweep("500", "");
    assert!(made(&other, "tiled") && !made(&other, "scanline.10"), "{}", said(&other));
    // A point less, and its row is in the table of all no more.
    folder.write("my.csv", TABLE.replace("-n 500", "-n $(MY_PHOTONS)"));
    assert!(said(&sweep("500", "")).contains("out/my.csv: 4 rows"));
    assert_eq!(folder.read("out/my.csv"), first);
}

#[test]
fn what_other_programs_made_is_made_again_unless_it_is_to_be_kept() {
    let folder = workshop();
    assert!(make(&folder, "sweep SWEEP=my.csv").status.success());
    let fingerprint = folder.run("pm-sweep fingerprint").ok();
    let programs = fingerprint.text().lines().next().and_then(|line| line.strip_prefix("PROGRAMS := ")).unwrap();
    assert!(programs.len() == 32 && programs.chars().all(|c| c.is_ascii_hexdigit()), "{programs}");
    assert_eq!(folder.read("out/.made/PROGRAMS"), format!("{programs}\n").as_bytes());

    folder.write("out/.made/PROGRAMS", "others\n");
    let kept = make(&folder, "KEEP=yes sweep SWEEP=my.csv");
    assert!(kept.status.success() && !said(&kept).contains("pm-gather"), "{}", said(&kept));
    let again = make(&folder, "sweep SWEEP=my.csv");
    assert!(again.status.success() && made(&again, "scanline.10"), "{}", said(&again));
    assert!(said(&again).contains("pm-photons") && said(&again).contains("pm-queries"), "{}", said(&again));
    let other = make(&folder, "KEEP=no sweep SWEEP=my.csv");
    assert!(!other.status.success() && said(&other).contains("KEEP=no: yes or nothing"), "{}", said(&other));
}

#[test]
fn streams_may_be_removed_when_the_rows_are_there() {
    let folder = workshop();
    assert!(make(&folder, "sweep SWEEP=my.csv").status.success());
    fs::remove_dir_all(folder.path("out/streams")).unwrap();
    let again = make(&folder, "sweep SWEEP=my.csv");
    assert!(again.status.success() && !said(&again).contains("pm-"), "{}", said(&again));
}
