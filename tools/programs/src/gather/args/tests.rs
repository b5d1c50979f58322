//! Which map answers where none is named?

use super::*;

fn read(line: &str) -> Args {
    let (command, read) = command(&pm_maps::structures());
    let words = ["pm-gather"].into_iter().chain(line.split_whitespace());
    read(&command.get_matches_from(words)).unwrap_or_else(|error| panic!("{line}: {error}"))
}

#[test]
fn the_fastest_answers_where_nobody_asks_what_it_reads() {
    for (line, word, carry) in [
        ("-o t.pmt", "kd", false),
        ("-o t.pmt --image x.exr", "kd", false),
        ("-o t.pmt --map wide", "wide", false),
        ("--no-trace", "wide", true),
        ("--no-trace --image x.exr --precomputed", "wide", true),
        ("--no-trace --map auto", "wide", true),
        ("--no-trace --map kd", "kd", false),
        ("--no-trace --map kd --carry", "kd", true),
        // Who asks for a kind of kd-tree gets it, with its searches as the paper has them.
        ("--no-trace --report r.csv", "kd", false),
        ("--no-trace --reread", "kd", false),
    ] {
        let args = read(line);
        assert_eq!((args.map.entry.word(), args.carry()), (word, carry), "{line}");
    }
    let args = read("--no-trace --layout veb");
    assert_eq!((args.map.entry.word(), args.map.values.get("layout").is_some()), ("kd", true));
}

#[test]
fn what_no_such_map_takes_is_refused() {
    let (command, read) = command(&pm_maps::structures());
    let matches = command.get_matches_from(["pm-gather", "--no-trace", "--slots", "8"]);
    let error = read(&matches).err().expect("neither takes it").to_string();
    assert!(error.contains("not for kd: leave --slots out"), "{error}");
}
