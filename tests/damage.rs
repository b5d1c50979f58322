//! Cut at every byte, flip any bit: always exit 3, never a panic, never a silent half?

mod killed;
mod specimens;

use crate::streams::check;
use crate::support::{Folder, Outcome};
use pm_formats::StreamKind;
use specimens::{specimen, table_of, waiting_trace};

/// The program that takes a kind of stream for its work, reading it from standard input.
fn consumer(kind: StreamKind) -> &'static str {
    match kind {
        StreamKind::Photons => "pm-gather - q.pmq -k 3",
        StreamKind::Queries => "pm-reorder hilbert",
        StreamKind::Trace => "pm-cachesim --sizes 1K",
        StreamKind::UnroundedPhotons => "pm-view --merge -o merged.pmp",
    }
}

/// A folder with whole streams for the inputs that are not damaged.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("map.pmp", specimen(StreamKind::Photons));
    folder.write("q.pmq", specimen(StreamKind::Queries));
    folder
}

/// The program saw the damage, said so in one line, and passed on nothing that could be taken for a result.
#[track_caller]
fn refused(outcome: &Outcome, what: &str) {
    assert_eq!(outcome.code, 3, "{what}: exit code of `{}`\n{}", outcome.line, outcome.stderr);
    let _ = outcome.fails(3);
    if outcome.line.starts_with("pm-cachesim") || outcome.line.starts_with("pm-view") {
        assert!(outcome.stdout.is_empty(), "{what}: `{}` printed a result", outcome.line);
    } else {
        assert!(check(&outcome.stdout).is_err(), "{what}: `{}` wrote a whole stream", outcome.line);
    }
}

fn cut_everywhere(kind: StreamKind) {
    cut_at_every_byte(kind, &specimen(kind));
}

fn cut_at_every_byte(kind: StreamKind, stream: &[u8]) {
    let folder = folder();
    let _ = folder.feed(consumer(kind), stream).ok();
    for len in 0..stream.len() {
        for program in [consumer(kind), "pm-view --check"] {
            refused(&folder.feed(program, &stream[..len]), &format!("cut to {len} of {} bytes", stream.len()));
        }
    }
}

#[test]
fn a_part_of_photons_is_cut_everywhere_and_any_bit_of_it_flipped() {
    cut_everywhere(StreamKind::UnroundedPhotons);
    flip_a_bit_of_every_byte(StreamKind::UnroundedPhotons);
}

fn flip_a_bit_of_every_byte(kind: StreamKind) {
    flip_a_bit_each(kind, &specimen(kind));
}

fn flip_a_bit_each(kind: StreamKind, stream: &[u8]) {
    let folder = folder();
    for at in 0..stream.len() {
        // Each of the eight bits gets its turn.
        let bit = (at * 5 + at / 8) % 8;
        let mut flipped = stream.to_vec();
        flipped[at] ^= 1 << bit;
        refused(&folder.feed(consumer(kind), &flipped), &format!("bit {bit} of byte {at} flipped"));
    }
}

#[test]
fn photons_cut_at_every_byte_are_refused() {
    cut_everywhere(StreamKind::Photons);
}

#[test]
fn queries_cut_at_every_byte_are_refused() {
    cut_everywhere(StreamKind::Queries);
}

#[test]
fn traces_cut_at_every_byte_are_refused() {
    cut_everywhere(StreamKind::Trace);
}

#[test]
fn photons_with_a_flipped_bit_are_refused() {
    flip_a_bit_of_every_byte(StreamKind::Photons);
}

#[test]
fn queries_with_a_flipped_bit_are_refused() {
    flip_a_bit_of_every_byte(StreamKind::Queries);
}

#[test]
fn traces_with_a_flipped_bit_are_refused() {
    flip_a_bit_of_every_byte(StreamKind::Trace);
}

#[test]
fn a_trace_that_says_what_reads_wait_for_is_cut_everywhere_and_any_bit_of_it_flipped() {
    let stream = waiting_trace();
    assert_ne!(stream, specimen(StreamKind::Trace));
    cut_at_every_byte(StreamKind::Trace, &stream);
    flip_a_bit_each(StreamKind::Trace, &stream);
}

#[test]
fn the_library_refuses_every_cut_and_every_flipped_bit() {
    let waiting = ("a trace of what waits".to_owned(), waiting_trace());
    let plain = [StreamKind::Photons, StreamKind::Queries, StreamKind::Trace];
    let plain = plain.map(|kind| (format!("{kind:?}"), specimen(kind)));
    for (kind, mut stream) in plain.into_iter().chain([waiting]) {
        assert!(check(&stream).unwrap().records >= 12);
        for len in 0..stream.len() {
            let error = check(&stream[..len]).expect_err("a cut stream");
            assert!(error.is_damage(), "{kind} cut to {len}: {error}");
        }
        for at in 0..stream.len() {
            for bit in 0..8 {
                stream[at] ^= 1 << bit;
                let error = check(&stream).map_or_else(Some, |tally| panic!("{kind} {at}:{bit} passes as {tally:?}"));
                assert!(error.as_ref().is_some_and(pm_formats::Error::is_damage), "{kind} {at}:{bit}: {error:?}");
                stream[at] ^= 1 << bit;
            }
        }
        assert!(check(&stream).is_ok());
    }
}

#[test]
fn what_is_no_whole_stream_is_refused_by_every_reader() {
    let folder = folder();
    for kind in [StreamKind::Photons, StreamKind::Queries, StreamKind::Trace, StreamKind::UnroundedPhotons] {
        let whole = specimen(kind);
        let half = &whole[..whole.len() / 2];
        // Readers of every way to read: for work, as a second input, checked, shown, as text.
        let mut readers = vec![consumer(kind), "pm-view", "pm-view --check"];
        match kind {
            StreamKind::Photons => readers.push("pm-gather - q.pmq --no-trace --image out.exr"),
            StreamKind::Queries => readers.extend(["pm-gather", "pm-gather -t 4", "pm-reorder random --per batch"]),
            StreamKind::Trace => readers.extend(["pm-cachesim --format json"]),
            StreamKind::UnroundedPhotons => {}
        }
        for reader in readers {
            let refuses = |what: &str, bytes: &[u8]| {
                let outcome = folder.feed(reader, bytes);
                let _ = outcome.fails(3);
                // What was read so far may be shown as such; what only the end can tell may not.
                let bare = Outcome { stdout: vec![], ..outcome };
                refused(&bare, what);
            };
            refuses("empty", b"");
            refuses("a text", b"photons\n1 2 3\n");
            refuses("a long text", &b"x = 1;\n".repeat(100_000));
            refuses("zeros", &[0; 4096]);
            refuses("half", half);
            refuses("garbage after the end", &[&whole[..], b"\n"].concat());
            refuses("two streams", &whole.repeat(2));
            refuses("half, then a whole one", &[half, &whole].concat());
            refuses("text-mode damage", &String::from_utf8_lossy(&whole).replace("\r\n", "\n").into_bytes());
            if !reader.starts_with("pm-view") {
                for other in [StreamKind::Photons, StreamKind::Queries, StreamKind::Trace]
                    .into_iter()
                    .filter(|other| *other != kind)
                {
                    // Asked wrongly: the stream is whole, and named where another belongs.
                    let outcome = folder.feed(reader, &specimen(other));
                    let _ = outcome.fails(2);
                    assert!(outcome.stdout.is_empty() || check(&outcome.stdout).is_err(), "{reader}: {other:?}");
                }
            }
        }
    }
    assert_eq!(folder.names(), ["map.pmp", "q.pmq"]);
}

#[test]
fn the_message_tells_how_far_it_got_and_what_to_do() {
    let folder = folder();
    let trace = specimen(StreamKind::Trace);
    let outcome = folder.feed("pm-cachesim", &trace[..trace.len() - 1]);
    let line = outcome.fails(3);
    assert!(line.contains("standard input: after 3 blocks, 12 records"), "{line}");
    assert!(line.contains("the program before this one did not finish"), "{line}");

    folder.write("half.pmt", &trace[..trace.len() / 2]);
    assert!(folder.run("pm-cachesim half.pmt").fails(3).contains("half.pmt"));
    assert!(folder.run("pm-view --check map.pmp half.pmt").stderr.contains("half.pmt"));
    // A stream of another kind is not damaged: it was named in the wrong place.
    let swapped = folder.run("pm-gather q.pmq map.pmp");
    assert!(swapped.fails(2).contains("q.pmq: the stream holds queries, but photons"), "{}", swapped.stderr);
    assert!(swapped.stderr.contains("pm-gather PHOTONS QUERIES"), "{}", swapped.stderr);
}

#[test]
fn one_damaged_trace_of_several_leaves_no_table() {
    let folder = folder();
    let trace = specimen(StreamKind::Trace);
    folder.write("whole.pmt", &trace);
    folder.write("half.pmt", &trace[..trace.len() / 2]);
    for format in ["table", "csv", "json"] {
        refused(&folder.run(&format!("pm-cachesim --format {format} whole.pmt half.pmt")), "half a trace");
    }
    assert!(!table_of(&folder, "whole.pmt").is_empty());
}

#[test]
fn a_flipped_bit_in_a_pipe_stops_every_program_after_it() {
    let folder = folder();
    let mut queries = specimen(StreamKind::Queries);
    let at = queries.len() * 2 / 3;
    queries[at] ^= 4;
    folder.write("bad.pmq", queries);
    let outcome = folder.sh("cat bad.pmq | pm-reorder random --per batch | pm-gather -k 3 | pm-cachesim");
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    assert!(outcome.stdout.is_empty());
    let first = outcome.stderr.lines().next().unwrap_or_default();
    assert!(first.starts_with("pm-reorder: standard input: the stream is damaged at block"), "{}", outcome.stderr);
}
