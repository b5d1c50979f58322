//! Does a file appear whole or not at all, under every name and whatever goes wrong?

use crate::streams::{check, records};
use crate::support::{Folder, Outcome, SMALL, wait_until};
use nix::sys::signal::{Signal, kill};
use nix::sys::stat::Mode;
use nix::unistd::{Pid, mkfifo};
use pm_formats::Query;
use std::fs::{self, Permissions};
use std::io::Read as _;
use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _, symlink};
use std::process::Stdio;

/// A folder with `map.pmp`, `q.pmq`, and `half.pmq`, which is not whole.
fn folder() -> Folder {
    let folder = Folder::with_streams();
    let queries = folder.read("q.pmq");
    folder.write("half.pmq", &queries[..queries.len() / 2]);
    folder
}

/// Every way to ask for a file, and its name.
fn writers() -> [(String, &'static str); 6] {
    [
        ("pm-photons -n 500 -o out.pmp".into(), "out.pmp"),
        (format!("pm-queries {SMALL} -o out.pmq"), "out.pmq"),
        (format!("pm-queries {SMALL} --base out.exr"), "out.exr"),
        ("pm-reorder hilbert q.pmq -o out.pmq".into(), "out.pmq"),
        ("pm-gather map.pmp q.pmq -o out.pmt".into(), "out.pmt"),
        ("pm-gather map.pmp q.pmq --image out.exr --no-trace".into(), "out.exr"),
    ]
}

#[test]
fn success_leaves_the_file_and_nothing_else() {
    for (line, name) in writers() {
        let folder = folder();
        folder.run(&line).ok();
        let mut names = vec!["half.pmq", "map.pmp", "q.pmq", name];
        names.sort_unstable();
        assert_eq!(folder.names(), names, "`{line}`");
        if !name.ends_with(".exr") {
            assert!(check(&folder.read(name)).is_ok(), "`{line}`");
        }
    }
}

#[test]
fn a_run_that_fails_leaves_nothing_and_keeps_what_was_there() {
    let folder = folder();
    let names = folder.names();
    let lines = [
        ("pm-reorder hilbert half.pmq -o ", "out.pmq", 3),
        ("pm-reorder random --per batch half.pmq -o ", "out.pmq", 3),
        ("pm-gather map.pmp half.pmq -o ", "out.pmt", 3),
        ("pm-gather map.pmp half.pmq -t 3 --no-trace --image ", "out.exr", 3),
        // Queries where photons are needed: asked wrongly.
        ("pm-gather half.pmq q.pmq -o ", "out.pmt", 2),
    ];
    for (line, name, code) in lines {
        let line = &format!("{line}{name}");
        let _ = folder.run(line).fails(code);
        assert_eq!(folder.names(), names, "`{line}`");
        folder.write(name, "before");
        let _ = folder.run(line).fails(code);
        assert_eq!(folder.read(name), b"before", "`{line}`");
        fs::remove_file(folder.path(name)).unwrap();
        assert_eq!(folder.names(), names, "`{line}`");
    }
    // A picture that cannot be, found out after all queries were answered: no trace either.
    folder.write("bad.exr", "no picture");
    let _ = folder.run("pm-gather map.pmp q.pmq --base bad.exr --image out.exr -o out.pmt").fails(1);
    fs::remove_file(folder.path("bad.exr")).unwrap();
    assert_eq!(folder.names(), names);
}

#[test]
fn a_program_told_to_stop_takes_its_half_written_files_with_it() {
    for signal in [Signal::SIGTERM, Signal::SIGINT, Signal::SIGHUP] {
        let folder = Folder::new();
        folder.write("out.pmq", "before");
        let line = "pm-queries --size 4000x4000 -o out.pmq --base direct.exr";
        let child = folder.command(line).spawn().unwrap();
        let begun = |name: &str| folder.names().iter().any(|file| file.starts_with(name) && file.ends_with(".tmp"));
        wait_until("temporary files", || begun(".out.pmq.") && begun(".direct.exr."));
        kill(Pid::from_raw(child.id().cast_signed()), signal).unwrap();
        let outcome = Outcome::when_done(line, child);
        assert_eq!(outcome.code, 128 + signal as i32, "{signal}");
        assert_eq!(folder.names(), ["out.pmq"], "{signal}");
        assert_eq!(folder.read("out.pmq"), b"before");
    }
}

#[test]
fn two_outputs_of_one_name_are_refused_and_so_is_an_output_that_is_read() {
    let folder = Folder::with_streams();
    symlink("q.pmq", folder.path("link.pmq")).unwrap();
    symlink("nowhere.exr", folder.path("link.exr")).unwrap();
    let names = folder.names();
    let (queries, photons) = (folder.read("q.pmq"), folder.read("map.pmp"));
    for (line, said) in [
        (format!("pm-queries {SMALL} --base x.exr -o x.exr"), "two outputs of one name"),
        (format!("pm-queries {SMALL} --base x.exr -o ./x.exr"), "two outputs of one name"),
        (format!("pm-queries {SMALL} --base link.exr -o nowhere.exr"), "two outputs of one name"),
        ("pm-gather map.pmp q.pmq --image y.exr -o y.exr".into(), "two outputs of one name"),
        ("pm-gather map.pmp q.pmq --no-trace --image y.exr --image y.exr".into(), "two outputs of one name"),
        ("pm-gather map.pmp q.pmq --report y.csv -o y.csv".into(), "two outputs of one name"),
        ("pm-gather map.pmp q.pmq -o map.pmp".into(), "is read and would be written"),
        ("pm-gather map.pmp q.pmq -o q.pmq".into(), "is read and would be written"),
        ("pm-reorder hilbert q.pmq -o q.pmq".into(), "is read and would be written"),
        ("pm-reorder hilbert q.pmq -o link.pmq".into(), "is read and would be written"),
        ("pm-queries --guide map.pmp -o map.pmp".into(), "is read and would be written"),
    ] {
        let outcome = folder.run(&line);
        let message = outcome.fails(2);
        assert!(message.contains(said), "`{line}`: {message}");
        assert_eq!(folder.names(), names, "`{line}`");
    }
    assert!(folder.read("q.pmq") == queries && folder.read("map.pmp") == photons);
    // What is no file may stand for both.
    folder.run("pm-gather map.pmp q.pmq --report /dev/null -o /dev/null").ok();
}

#[test]
fn a_symlink_stays_and_its_target_is_replaced() {
    for (line, name) in writers() {
        let folder = folder();
        fs::create_dir(folder.path("else")).unwrap();
        folder.write("else/target", "before");
        symlink("else/target", folder.path(name)).unwrap();
        folder.run(&line).ok();
        assert!(fs::symlink_metadata(folder.path(name)).unwrap().is_symlink(), "`{line}`");
        assert!(folder.read("else/target").len() > 100, "`{line}`");
        assert_eq!(fs::read_dir(folder.path("else")).unwrap().count(), 1, "`{line}`");
    }
}

#[test]
fn a_symlink_to_nothing_stays_and_its_target_appears() {
    let folder = Folder::new();
    fs::create_dir(folder.path("else")).unwrap();
    symlink("else/target", folder.path("middle.pmp")).unwrap();
    symlink("middle.pmp", folder.path("out.pmp")).unwrap();
    folder.run("pm-photons -n 500 -o out.pmp").ok();
    for link in ["middle.pmp", "out.pmp"] {
        assert!(fs::symlink_metadata(folder.path(link)).unwrap().is_symlink(), "{link}");
    }
    assert!(check(&folder.read("else/target")).is_ok());
    assert_eq!(folder.names(), ["else", "middle.pmp", "out.pmp"]);
}

#[test]
fn a_symlink_to_itself_is_an_error() {
    let folder = Folder::new();
    symlink("out.pmp", folder.path("out.pmp")).unwrap();
    assert!(folder.run("pm-photons -n 500 -o out.pmp").fails(1).contains("out.pmp"));
    assert_eq!(folder.names(), ["out.pmp"]);
}

#[test]
fn permissions_are_those_of_the_file_before_or_of_any_new_file() {
    let folder = Folder::new();
    let mode = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o7777;
    folder.write("any", "");
    folder.run("pm-photons -n 500 -o out.pmp").ok();
    assert_eq!(mode("out.pmp"), mode("any"));
    // Also those that the umask would take from a new file.
    for before in [0o600, 0o640, 0o666, 0o755] {
        fs::set_permissions(folder.path("out.pmp"), Permissions::from_mode(before)).unwrap();
        folder.run("pm-photons -n 500 -o out.pmp").ok();
        assert_eq!(mode("out.pmp"), before, "{before:o}");
    }
}

#[test]
fn a_full_disk_is_an_error_with_its_name() {
    let folder = folder();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let names = folder.names();
    for line in [
        "pm-photons -n 500",
        "pm-photons -n 200000 -t 2",
        &format!("pm-queries {SMALL}"),
        "pm-reorder hilbert q.pmq",
        "pm-gather map.pmp q.pmq",
        "pm-gather map.pmp q.pmq -t 2",
        "pm-cachesim t.pmt",
        "pm-view t.pmt",
        "pm-view --check t.pmt",
        "pm-view --history t.pmt",
        "pm-view --records t.pmt",
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let child = folder.command(line).stdout(full).spawn().unwrap();
        let outcome = Outcome::when_done(line, child);
        let message = outcome.fails(1);
        assert!(message.contains("standard output") && message.contains("No space left"), "{message}");
        if !line.starts_with("pm-view") && !line.starts_with("pm-cachesim") {
            let line = format!("{line} -o /dev/full");
            let message = folder.run(&line).fails(1).to_owned();
            assert!(message.contains("/dev/full") && message.contains("No space left"), "{message}");
        }
    }
    assert_eq!(folder.names(), names);
    assert!(!fs::metadata("/dev/full").unwrap().is_file());
}

#[test]
fn a_file_that_may_not_grow_is_an_error_with_its_name() {
    // The shell's limit on the size of files, four times 512 bytes or four kilobytes, stands for a disk that fills while
    // a file is written: the write fails, and there is a temporary file to be removed.
    let folder = folder();
    let names = folder.names();
    for line in [
        "pm-photons -n 500 -o out.pmp",
        "pm-photons -n 50000 -t 2 -o out.pmp",
        "pm-queries --size 64x64 --gathers 16 -o out.pmp",
        "pm-gather map.pmp q.pmq -k 300 -o out.pmp",
    ] {
        let outcome = folder.sh(&format!("trap '' XFSZ; ulimit -f 4; exec {line}"));
        assert_eq!(outcome.code, 1, "`{line}`: {}", outcome.stderr);
        let message = outcome.stderr.strip_suffix('\n').filter(|one| !one.contains('\n')).unwrap_or_default();
        assert!(message.contains(": cannot write out.pmp: File too large"), "`{line}`: {}", outcome.stderr);
        assert_eq!(folder.names(), names, "`{line}`");
    }
}

#[test]
fn memory_that_is_refused_is_an_error_in_a_line() {
    let folder = folder();
    let names = folder.names();
    let mut refused = 0;
    for line in
        ["pm-photons -n 50000 -o out.pmp", "pm-photons -n 50000 -t 8 -o out.pmp", "pm-reorder hilbert q.pmq -o out.pmq"]
    {
        // From too little to begin with up to enough.
        for megabytes in [10, 12, 14, 16, 20, 30, 45, 60, 100, 160] {
            let outcome = folder.sh(&format!("ulimit -v {}; exec {line}", megabytes << 10));
            let said = format!("{megabytes} MB, `{line}`: {} {}", outcome.code, outcome.stderr);
            match outcome.code {
                // The system could not load it.
                127 => {}
                0 => folder
                    .names()
                    .iter()
                    .filter(|name| !names.contains(name))
                    .for_each(|name| fs::remove_file(folder.path(name)).unwrap()),
                1 => {
                    refused += 1;
                    let message =
                        outcome.stderr.strip_suffix('\n').filter(|one| !one.contains('\n')).unwrap_or_default();
                    assert!(message.contains("not enough memory"), "{said}");
                }
                _ => panic!("{said}"),
            }
            assert_eq!(folder.names(), names, "{said}");
        }
    }
    assert!(refused > 0, "memory was never refused");
}

#[test]
fn a_fifo_is_written_as_it_is() {
    let folder = folder();
    let expected = folder.run("pm-reorder hilbert q.pmq").ok().stdout;
    mkfifo(&folder.path("fifo"), Mode::S_IRWXU).unwrap();
    let fifo = folder.path("fifo");
    let reader = std::thread::spawn(move || fs::read(fifo));
    folder.run("pm-reorder hilbert q.pmq -o fifo").ok();
    // A pipe is no place to compress for: the same records, and each of them whole.
    let came = reader.join().unwrap().unwrap();
    let (in_file, in_pipe) = (check(&expected).unwrap(), check(&came).unwrap());
    assert_eq!(in_file, in_pipe);
    let whole = usize::try_from(in_pipe.records).unwrap() * size_of::<Query>();
    assert!(expected.len() < whole && whole < came.len() && came.len() < whole + 4096, "{whole}: {}", came.len());
    assert_eq!(records::<Query>(&expected), records::<Query>(&came));
    assert!(fs::symlink_metadata(folder.path("fifo")).unwrap().file_type().is_fifo());
    assert_eq!(folder.names(), ["fifo", "half.pmq", "map.pmp", "q.pmq"]);

    // And read, as a file named on the command line.
    let writer = folder.command("pm-photons -n 500 -o fifo").spawn().unwrap();
    folder.run("pm-gather fifo q.pmq -o t.pmt").ok();
    Outcome::when_done("pm-photons", writer).ok();
}

#[test]
fn where_no_file_can_be_the_message_is_one_clear_line() {
    let folder = folder();
    let names = folder.names();
    for line in ["pm-photons", "pm-queries --size 4x4", "pm-reorder hilbert q.pmq", "pm-gather map.pmp q.pmq"] {
        let outcome = folder.run(&format!("{line} -o ."));
        let message = outcome.fails(2);
        assert!(message.contains(". is a folder"), "{message}");
        let outcome = folder.run(&format!("{line} -o missing/out.pmq"));
        let message = outcome.fails(1);
        assert!(message.contains("cannot write missing/out.pmq: No such file or directory"), "{message}");
    }
    assert!(folder.run("pm-gather map.pmp q.pmq --image missing/a.exr").fails(1).contains("missing/a.exr"));
    assert!(folder.run("pm-queries --base missing/a.exr").fails(1).contains("missing/a.exr"));
    assert_eq!(folder.names(), names);
}

#[test]
fn an_input_that_cannot_be_read_is_an_error_with_its_name() {
    let folder = folder();
    fs::create_dir(folder.path("dir")).unwrap();
    let names = folder.names();
    for line in ["pm-reorder hilbert NAME -o out", "pm-gather NAME q.pmq -o out", "pm-gather map.pmp NAME -o out"]
        .into_iter()
        .chain(["pm-cachesim NAME", "pm-view NAME", "pm-view --check map.pmp NAME"])
    {
        let run = |name: &str| folder.run(&line.replace("NAME", name));
        assert!(run("nosuch.pmp").fails(1).contains("nosuch.pmp: No such file or directory"));
        assert!(run("dir").fails(2).contains("dir is a folder; a stream is expected"));
        // What can be opened and not read, by nobody: there is nothing at address 0.
        assert!(run("/proc/self/mem").fails(1).contains("/proc/self/mem: cannot read: Input/output error"));
    }
    assert_eq!(folder.names(), names);
    assert!(folder.run("pm-photons nosuch.obj -o out").fails(1).contains("nosuch.obj"));
    assert!(folder.run("pm-queries nosuch.obj -o out").fails(1).contains("nosuch.obj"));
    assert!(folder.run("pm-gather map.pmp q.pmq --base no.exr --image a.exr -o out").fails(1).contains("no.exr"));
    assert_eq!(folder.names(), names);

    // Standard input that can only be written.
    let file = fs::File::options().write(true).open(folder.path("q.pmq")).unwrap();
    let child = folder.command("pm-reorder hilbert").stdin(file).spawn().unwrap();
    assert!(Outcome::when_done("pm-reorder hilbert", child).fails(1).contains("standard input"));
}

#[test]
fn the_base_picture_is_whole_before_the_stream_ends() {
    // Whoever has read the end block may read the picture: so both programs of a pipe may name the same file.
    let folder = folder();
    let line = format!("pm-queries {SMALL} --base direct.exr");
    let mut child = folder.command(&line).stdout(Stdio::piped()).spawn().unwrap();
    let mut stream = vec![];
    child.stdout.take().unwrap().read_to_end(&mut stream).unwrap();
    assert!(check(&stream).is_ok());
    assert!(pm_pictures::Picture::decode_exr(&folder.read("direct.exr")).is_ok());
    Outcome::when_done(&line, child).ok();

    let pipe = "pm-queries --size 16x12 --base both.exr | pm-gather --base both.exr --image out.exr --no-trace";
    folder.sh(pipe).ok();
    assert_ne!(folder.read("both.exr"), folder.read("out.exr"));
}
