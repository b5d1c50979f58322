//! A stage killed in the middle: does the last program of the pipe notice?

use crate::support::{Folder, Outcome};
use std::io::{Read as _, Write as _};
use std::process::{Child, Stdio};

/// More than any buffer between two programs holds: who has written so much works, and is far from done.
const MIDDLE: usize = 1 << 20;

fn start(folder: &Folder, line: &str, input: Stdio) -> Child {
    folder.command(line).stdin(input).spawn().expect("the program starts")
}

/// Hands the first [`MIDDLE`] bytes of `from` on to `to`, kills `from`, and hands on what it left behind. The reader
/// being here, `from` cannot have finished before it is killed, whatever the machine does meanwhile.
fn killed_in_the_middle(mut from: Child, to: &mut Child) {
    let mut output = from.stdout.take().expect("a pipe");
    let mut input = to.stdin.take().expect("a pipe");
    let mut bytes = vec![0; MIDDLE];
    output.read_exact(&mut bytes).expect("the program writes");
    input.write_all(&bytes).expect("the next program reads");
    // SIGKILL: no handler, no last words.
    from.kill().expect("it still runs");
    std::io::copy(&mut output, &mut input).expect("the rest is handed on");
    let status = from.wait().expect("it ends");
    assert!(!status.success());
}

/// The pipe after the killed program: each complains, the last with exit 3 and no table.
#[track_caller]
fn no_table(lines: &[&str], children: Vec<Child>) {
    let count = children.len();
    for (i, (line, child)) in lines.iter().zip(children).enumerate() {
        let outcome = Outcome::when_done(line, child);
        let _ = outcome.fails(3);
        assert!(i + 1 < count || outcome.stdout.is_empty(), "`{line}` printed a table");
    }
}

#[test]
fn queries_killed_in_the_middle() {
    let folder = Folder::new();
    folder.run("pm-photons -n 100 -o map.pmp").ok();
    for reorder in ["pm-reorder hilbert -q", "pm-reorder random --per batch"] {
        let lines = [reorder, "pm-gather -k 1", "pm-cachesim"];
        let queries = start(&folder, "pm-queries --size 2000x2000 --gathers 16", Stdio::null());
        let mut first = start(&folder, lines[0], Stdio::piped());
        let mut gather = start(&folder, lines[1], first.stdout.take().expect("a pipe").into());
        let last = start(&folder, lines[2], gather.stdout.take().expect("a pipe").into());
        killed_in_the_middle(queries, &mut first);
        no_table(&lines, vec![first, gather, last]);
    }
}

#[test]
fn gather_killed_in_the_middle() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    let mut queries = start(&folder, "pm-queries --size 2000x2000 --gathers 16", Stdio::null());
    let gather = start(&folder, "pm-gather -k 50", queries.stdout.take().expect("a pipe").into());
    let mut last = start(&folder, "pm-cachesim --sizes 1K", Stdio::piped());
    killed_in_the_middle(gather, &mut last);
    // Nobody reads what the first program writes: that is no fault of its own.
    let queries = Outcome::when_done("pm-queries", queries).ok();
    assert!(queries.stdout.is_empty());
    no_table(&["pm-cachesim --sizes 1K"], vec![last]);
}

#[test]
fn photons_killed_in_the_middle() {
    let folder = Folder::new();
    folder.run("pm-queries --size 4x3 --gathers 1 -o q.pmq").ok();
    let photons = start(&folder, "pm-photons -n 100000000", Stdio::null());
    let line = "pm-gather - q.pmq";
    let mut gather = start(&folder, line, Stdio::piped());
    killed_in_the_middle(photons, &mut gather);
    no_table(&[line], vec![gather]);
}

#[test]
fn a_shell_without_pipefail_sees_it_too() {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    // Whoever has got so much of the trace kills the first program of the pipe, which has by far not finished.
    let outcome = folder
        .sh("sh -c 'echo $$ > pid; exec pm-queries --size 2000x2000' | pm-reorder random --per batch | pm-gather |
         { head -c 300000 > part; kill -9 $(cat pid); cat part -; } | pm-cachesim");
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    assert!(outcome.stdout.is_empty());
    assert!(outcome.stderr.contains("pm-reorder: standard input: after "), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("pm-cachesim: standard input: after "), "{}", outcome.stderr);
}
