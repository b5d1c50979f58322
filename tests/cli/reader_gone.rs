//! A reader that leaves early is no error, unless something else was asked for that now cannot be.

use crate::support::{Folder, Outcome, SMALL};
use std::io::pipe;

/// Runs a command whose standard output nobody reads.
fn unread(folder: &Folder, line: &str) -> Outcome {
    let (reader, writer) = pipe().unwrap();
    drop(reader);
    let child = folder.command(line).stdout(writer).spawn().unwrap();
    Outcome::when_done(line, child)
}

#[test]
fn nobody_reads_and_that_is_fine() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    for line in [
        "pm-photons -n 500",
        "pm-photons -n 10000000 -t 2",
        &format!("pm-queries {SMALL}"),
        "pm-queries --size 3000x3000 -t 2",
        "pm-reorder hilbert q.pmq",
        "pm-reorder random --per batch q.pmq",
        "pm-gather map.pmp q.pmq",
        "pm-gather map.pmp q.pmq -t 2",
        "pm-cachesim t.pmt",
        "pm-view t.pmt",
        "pm-view --check t.pmt",
        "pm-view --history t.pmt",
        "pm-view --records t.pmt",
        "pm-view --help",
        "pm-view --version",
        "pm-view --generate man",
    ] {
        unread(&folder, line).ok();
    }
}

#[test]
fn head_is_quiet() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    for line in [
        "pm-photons -n 10000000",
        "pm-queries --size 3000x3000",
        "pm-view --records t.pmt",
        "pm-queries --size 3000x3000 | pm-reorder random --per batch",
        "pm-queries --size 3000x3000 | pm-gather",
    ] {
        let outcome = folder.sh(&format!("{{ {line}; echo $? > code; }} | head -c 100")).ok();
        assert_eq!(outcome.stdout.len(), 100, "`{line}`");
        assert_eq!(folder.read("code"), b"0\n", "`{line}`");
    }
}

#[test]
fn a_picture_that_was_asked_for_is_missed() {
    let folder = Folder::with_streams();
    folder.write("direct.exr", "before");
    let names = folder.names();
    for (line, file) in [
        ("pm-queries --size 3000x3000 --base direct.exr", "direct.exr"),
        ("pm-queries --size 3000x3000 --base direct.png -t 2", "direct.png"),
        ("pm-gather map.pmp q.pmq --image out.exr", "out.exr"),
        ("pm-gather map.pmp q.pmq --image out.png -t 2", "out.png"),
    ] {
        let outcome = unread(&folder, line);
        let message = outcome.fails(1);
        assert!(message.contains("the reader of standard output left early"), "{message}");
        assert!(message.contains(&format!("{file} not written")), "{message}");
    }
    assert_eq!(folder.names(), names);
    assert_eq!(folder.read("direct.exr"), b"before");
}
