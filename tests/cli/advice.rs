//! Is one who asks in a way that is not understood told what to type?

use super::asked_wrongly;
use crate::support::Folder;

#[test]
fn what_is_typed_wrongly_is_advised_on() {
    let folder = Folder::with_streams();
    for (line, advice) in [
        ("pm-photons -n 0", "give at least 1"),
        ("pm-photons -n 1M", "write the number out: 1000000"),
        ("pm-photons -n 1.5e6", "write the number out: 1500000"),
        ("pm-queries --gathers -4", "invalid value '-4' for '--gathers"),
        ("pm-queries --size 128", "128x128"),
        ("pm-queries --order hilbert", "pm-queries | pm-reorder hilbert"),
        ("pm-gather map.pmp q.pmq --max-dist -3", "a distance of 0 or more"),
        ("pm-gather map.pmp q.pmq -k 20000000", "16777216"),
        ("pm-gather map.pmp q.pmq -k 500000", "give at most 20"),
        ("pm-gather q.pmq", "photons are needed first: pm-gather PHOTONS QUERIES"),
        ("pm-gather map.pmp q.pmq --map grid --layout veb", "leave --layout out"),
        ("pm-gather map.pmp q.pmq --map kd --budget 5", "leave --budget out"),
        ("pm-queries --tile 8", "leave --tile out"),
        ("pm-queries --bins 8", "leave --bins out"),
        ("pm-reorder hilbert --buckets 5 q.pmq", "leave --buckets out"),
        ("pm-reorder hilbert map.pmp", "queries are needed"),
        ("pm-cachesim q.pmq", "needed here"),
        ("pm-cachesim --sizes 0% t.pmt", "from above 0% to 100%"),
        ("pm-view a.png b.png", "give the .exr pictures"),
        ("pm-chart -x a -y b -o t.png", "name it *.svg or *.html"),
        ("pm-chart --page p.toml -o t.svg", "name it *.html"),
    ] {
        let outcome = folder.run(line);
        let message = asked_wrongly(&outcome);
        assert!(message.contains(advice), "`{line}` should say `{advice}`:\n{message}");
        assert!(!message.contains("use '-- "), "a number is no file: {message}");
    }
    assert_eq!(folder.names(), ["map.pmp", "q.pmq"]);
}

#[test]
fn photons_and_folders_that_are_not_there_are_named() {
    let folder = Folder::new();
    let outcome = folder.feed("pm-gather", b"");
    assert!(outcome.fails(1).contains("make it by `pm-photons -o map.pmp`"), "{}", outcome.stderr);
    let outcome = folder.run("pm-photons -n 5 -o there/map.pmp");
    assert!(outcome.fails(1).contains("make the folder there first"), "{}", outcome.stderr);
    assert!(folder.names().is_empty());
}

#[test]
fn a_column_that_is_not_there_has_near_ones() {
    let folder = Folder::with_streams();
    folder.sh("pm-gather map.pmp q.pmq | pm-cachesim --format csv -o t.csv").ok();
    let outcome = folder.run("pm-chart -x cache_byte -y fetches t.csv -o t.svg");
    let message = outcome.fails(2);
    assert!(message.contains("the nearest are cache_bytes, "), "{message}");
    assert!(message.len() < 200, "{message}");
}
