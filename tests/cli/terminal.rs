//! Binary data never goes to a terminal unasked, and nobody waits for a stream to be typed.

use super::asked_wrongly;
use crate::support::{Folder, Outcome, SMALL, same_bytes};
use nix::fcntl::OFlag;
use nix::pty::{PtyMaster, grantpt, posix_openpt, ptsname_r, unlockpt};
use nix::sys::termios::{SetArg, cfmakeraw, tcgetattr, tcsetattr};
use std::fs::File;
use std::io::Read as _;
use std::os::unix::fs::OpenOptionsExt as _;
use std::process::{Command, Stdio};

/// A terminal's two ends: what a person sees, and what a program has. Closed in children, whoever starts one meanwhile.
fn terminal() -> (PtyMaster, File) {
    let master = posix_openpt(OFlag::O_RDWR | OFlag::O_NOCTTY | OFlag::O_CLOEXEC).expect("a pseudo-terminal");
    grantpt(&master).expect("a pseudo-terminal");
    unlockpt(&master).expect("a pseudo-terminal");
    let name = ptsname_r(&master).expect("its name");
    let slave = File::options().read(true).write(true).custom_flags(OFlag::O_NOCTTY.bits()).open(name);
    let slave = slave.expect("its other end");
    // Raw: bytes come through as they are.
    let mut modes = tcgetattr(&slave).expect("its modes");
    cfmakeraw(&mut modes);
    tcsetattr(&slave, SetArg::TCSANOW, &modes).expect("its modes");
    (master, slave)
}

/// Runs a command with a terminal where `place` puts it; what came of it, and what was shown there.
fn at_a_terminal(folder: &Folder, line: &str, place: impl FnOnce(&mut Command, Stdio)) -> (Outcome, Vec<u8>) {
    let (mut screen, terminal) = terminal();
    let mut command = folder.command(line);
    place(&mut command, terminal.into());
    let child = command.spawn().expect("the program starts");
    // With the command goes our copy of the terminal: when the program ends, the screen sees that all have left.
    drop(command);
    std::thread::scope(|scope| {
        let shown = scope.spawn(move || {
            let mut shown = vec![];
            // Linux has an error for "all have left".
            let _ = screen.read_to_end(&mut shown);
            shown
        });
        (Outcome::when_done(line, child), shown.join().expect("the screen was read"))
    })
}

fn stdout(command: &mut Command, terminal: Stdio) {
    command.stdout(terminal);
}

fn stdin(command: &mut Command, terminal: Stdio) {
    command.stdin(terminal);
}

fn stderr(command: &mut Command, terminal: Stdio) {
    command.stderr(terminal);
}

#[test]
fn binary_data_is_not_shown() {
    let folder = Folder::with_streams();
    for line in [
        "pm-photons -n 500",
        &format!("pm-queries {SMALL}"),
        "pm-reorder hilbert q.pmq",
        "pm-gather map.pmp q.pmq",
        "pm-gather map.pmp q.pmq --report r.csv",
    ] {
        let (outcome, shown) = at_a_terminal(&folder, line, stdout);
        let message = asked_wrongly(&outcome);
        assert!(message.contains("| pm-view") && message.contains("-o FILE"), "{message}");
        assert!(shown.is_empty(), "`{line}`");
    }
    assert_eq!(folder.names(), ["map.pmp", "q.pmq"]);
}

#[test]
fn a_dash_forces_it() {
    let folder = Folder::with_streams();
    for line in
        ["pm-photons -n 500", &format!("pm-queries {SMALL}"), "pm-reorder hilbert q.pmq", "pm-gather map.pmp q.pmq"]
    {
        let expected = folder.run(line).ok().stdout;
        let (outcome, shown) = at_a_terminal(&folder, &format!("{line} -o -"), stdout);
        outcome.ok();
        same_bytes(line, &expected, &shown);
    }
}

#[test]
fn results_and_other_files_need_no_dash() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    for line in
        ["pm-cachesim t.pmt", "pm-view t.pmt", "pm-view --records=3 map.pmp", "pm-view --check q.pmq", "pm-view -V"]
    {
        let expected = folder.run(line).ok().stdout;
        let (outcome, shown) = at_a_terminal(&folder, line, stdout);
        outcome.ok();
        same_bytes(line, &expected, &shown);
    }
    at_a_terminal(&folder, "pm-gather map.pmp q.pmq -o t.pmt", stdout).0.ok();
    at_a_terminal(&folder, "pm-gather map.pmp q.pmq --no-trace --image out.exr", stdout).0.ok();
}

#[test]
fn a_picture_is_made_at_a_terminal_without_a_trace() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq --no-trace --image expected.exr").ok();
    let (outcome, shown) = at_a_terminal(&folder, "pm-gather map.pmp q.pmq --image out.exr", stdout);
    outcome.ok();
    assert!(shown.is_empty());
    same_bytes("the picture", &folder.read("expected.exr"), &folder.read("out.exr"));
}

#[test]
fn nobody_waits_for_a_keyboard() {
    let folder = Folder::with_streams();
    for line in [
        "pm-reorder hilbert",
        "pm-reorder hilbert - -o out.pmq",
        "pm-gather",
        "pm-gather - q.pmq",
        "pm-gather map.pmp -",
        "pm-cachesim",
        "pm-cachesim -",
        "pm-view",
        "pm-view --check",
        "pm-view --records",
    ] {
        let (outcome, _) = at_a_terminal(&folder, line, stdin);
        let message = asked_wrongly(&outcome);
        assert!(message.contains("standard input") && message.contains("--help"), "{message}");
    }
    assert_eq!(folder.names(), ["map.pmp", "q.pmq"]);
}

#[test]
fn progress_is_for_someone_who_watches() {
    let folder = Folder::with_streams();
    let line = "pm-queries --size 200x200 --gathers 4 -o out.pmq";
    let shown = |line: &str, to_pipe: bool| {
        let (outcome, shown) = at_a_terminal(&folder, line, |command, terminal| {
            stderr(command, terminal);
            if !to_pipe {
                command.stdout(Stdio::null());
            }
        });
        outcome.ok();
        String::from_utf8_lossy(&shown).into_owned()
    };
    assert!(shown(line, false).contains("pixels"), "a terminal and no pipe: progress");
    assert_eq!(shown(&format!("{line} -q"), false), "", "quiet");
    assert_eq!(shown("pm-queries --size 200x200 --gathers 4", true), "", "in a pipe the last program draws");
    assert_eq!(shown("pm-reorder hilbert q.pmq", true), "");
    assert_eq!(shown("pm-gather map.pmp q.pmq", true), "");
}
