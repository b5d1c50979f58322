//! Helpers: a fresh folder, commands that run in it, and what came of them.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::io::{Read as _, Seek as _, Write as _};
use std::os::unix::process::ExitStatusExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The programs, and where cargo has just built them.
pub(crate) const PROGRAMS: [(&str, &str); 12] = [
    ("pm-photons", env!("CARGO_BIN_EXE_pm-photons")),
    ("pm-queries", env!("CARGO_BIN_EXE_pm-queries")),
    ("pm-reorder", env!("CARGO_BIN_EXE_pm-reorder")),
    ("pm-sample", env!("CARGO_BIN_EXE_pm-sample")),
    ("pm-gather", env!("CARGO_BIN_EXE_pm-gather")),
    ("pm-cachesim", env!("CARGO_BIN_EXE_pm-cachesim")),
    ("pm-chart", env!("CARGO_BIN_EXE_pm-chart")),
    ("pm-view", env!("CARGO_BIN_EXE_pm-view")),
    ("pm-scene", env!("CARGO_BIN_EXE_pm-scene")),
    ("pm-picture", env!("CARGO_BIN_EXE_pm-picture")),
    ("pm-plan", env!("CARGO_BIN_EXE_pm-plan")),
    ("pm-sweep", env!("CARGO_BIN_EXE_pm-sweep")),
];

/// A picture small enough for a test, with several batches in every order.
pub(crate) const SMALL: &str = "--size 16x12 --gathers 4";

/// No program takes so long here, however busy the machine; one that does waits for something that never comes.
const PATIENCE: Duration = Duration::from_secs(600);

fn binary(program: &str) -> &'static str {
    PROGRAMS.iter().find(|(name, _)| *name == program).unwrap_or_else(|| panic!("no program {program}")).1
}

/// A fresh folder, removed at the end of the test. Commands run in it.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    /// A folder with `map.pmp` and `q.pmq` of the built-in scene.
    pub(crate) fn with_streams() -> Self {
        let folder = Self::new();
        folder.run("pm-photons -n 2000 -o map.pmp").ok();
        folder.run(&format!("pm-queries {SMALL} -o q.pmq")).ok();
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    }

    /// Names of the files in the folder, hidden ones included.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("the folder can be listed");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// A command in this folder, from a line without quotes. Nothing is on its standard input.
    pub(crate) fn command(&self, line: &str) -> Command {
        let mut words = line.split_whitespace();
        let mut command = Command::new(binary(words.next().expect("a program")));
        command.args(words).current_dir(self.0.path()).stdin(Stdio::null()).stdout(Stdio::piped());
        command.stderr(Stdio::piped());
        command
    }

    /// Runs a command with nothing on its standard input.
    pub(crate) fn run(&self, line: &str) -> Outcome {
        Outcome::of(line, self.command(line))
    }

    /// Runs a command with these bytes on its standard input.
    pub(crate) fn feed(&self, line: &str, input: &[u8]) -> Outcome {
        let mut command = self.command(line);
        command.stdin(Stdio::piped());
        Outcome::into_file(line, command, |mut child| {
            let mut stdin = child.stdin.take().expect("a pipe");
            std::thread::scope(|scope| {
                scope.spawn(move || {
                    // A program that has seen enough stops reading.
                    let _ = stdin.write_all(input);
                });
                Outcome::when_done(line, child)
            })
        })
    }

    /// Runs a line through the shell, our programs first in its path.
    pub(crate) fn sh(&self, line: &str) -> Outcome {
        let programs = Path::new(PROGRAMS[0].1).parent().expect("a folder of programs");
        let mut path = OsString::from(programs);
        path.push(":");
        path.push(std::env::var_os("PATH").unwrap_or_default());
        let mut command = Command::new("sh");
        command.args(["-c", line]).current_dir(self.0.path()).env("PATH", path);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        Outcome::of(line, command)
    }
}

/// What came of a command.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) line: String,
    /// Exit code, or 128 and the signal, as a shell has it.
    pub(crate) code: i32,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Outcome {
    /// What comes of a command.
    pub(crate) fn of(line: &str, command: Command) -> Self {
        Self::into_file(line, command, |child| Self::when_done(line, child))
    }

    /// With standard output in a file, so that what comes there is what a file by `-o` would be: streams go through pipes otherwise.
    fn into_file(line: &str, mut command: Command, done: impl FnOnce(Child) -> Self) -> Self {
        let mut file = tempfile::tempfile().expect("a temporary file");
        command.stdout(file.try_clone().expect("a second hold of a file"));
        let child = command.spawn().unwrap_or_else(|error| panic!("`{line}`: {error}"));
        let outcome = done(child);
        let mut stdout = vec![];
        file.rewind().and_then(|()| file.read_to_end(&mut stdout)).expect("what was written");
        Self { stdout, ..outcome }
    }

    /// Waits for a command to end, with patience but not for ever.
    pub(crate) fn when_done(line: &str, child: Child) -> Self {
        let pid = nix::unistd::Pid::from_raw(i32::try_from(child.id()).expect("a process id"));
        let (sender, receiver) = mpsc::channel();
        std::thread::spawn(move || sender.send(child.wait_with_output()));
        let Ok(output) = receiver.recv_timeout(PATIENCE) else {
            let _ = nix::sys::signal::kill(pid, nix::sys::signal::Signal::SIGKILL);
            panic!("`{line}` is still running after {PATIENCE:?}");
        };
        let Output { status, stdout, stderr } = output.expect("the program can be waited for");
        let code = status.code().unwrap_or_else(|| 128 + status.signal().expect("a signal"));
        Self { line: line.into(), code, stdout, stderr: String::from_utf8_lossy(&stderr).into_owned() }
    }

    /// It went well, and had nothing to remark.
    #[track_caller]
    pub(crate) fn ok(self) -> Self {
        assert!(self.code == 0 && self.stderr.is_empty(), "`{}`: exit {}\n{}", self.line, self.code, self.stderr);
        self
    }

    /// It failed with this code and one line on standard error, begun with the name of the program; the line.
    #[track_caller]
    pub(crate) fn fails(&self, code: i32) -> &str {
        let Self { line, stderr, .. } = self;
        assert_eq!(self.code, code, "exit code of `{line}`\n{stderr}");
        let program = line.split_whitespace().next().expect("a program");
        let one = stderr.strip_suffix('\n').filter(|one| !one.contains('\n') && one.len() > program.len() + 2);
        let one = one.unwrap_or_else(|| panic!("`{line}`: one line was expected on standard error, not:\n{stderr}"));
        assert!(one.starts_with(&format!("{program}: ")), "`{line}`: who speaks?\n{one}");
        one
    }

    /// Standard output as text.
    #[track_caller]
    pub(crate) fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap_or_else(|_| panic!("`{}` prints no text", self.line))
    }
}

/// Waits until something is so that no event tells of.
#[track_caller]
pub(crate) fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < PATIENCE, "not in {PATIENCE:?}: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Columns of the first row of CSV, by name.
#[track_caller]
pub(crate) fn row(csv: &str) -> BTreeMap<String, String> {
    let mut rows = csv::Reader::from_reader(csv.as_bytes()).into_deserialize();
    rows.next().expect("a row").expect("names and values")
}

/// Two byte strings must be equal; says where they part.
#[track_caller]
pub(crate) fn same_bytes(what: &str, expected: &[u8], got: &[u8]) {
    if expected != got {
        let at = expected.iter().zip(got).take_while(|(a, b)| a == b).count();
        panic!("{what}: {} bytes were expected, {} came; they part at byte {at}", expected.len(), got.len());
    }
}

/// Two texts must be equal; prints both, drawn apart.
#[track_caller]
pub(crate) fn same_text(what: &str, expected: &str, got: &str) {
    assert!(expected == got, "{what}\n--- expected\n{expected}\n--- got\n{got}\n---");
}

/// Kilobytes that a program has needed at its peak when most of its output has been taken. The rest, which has to be there, is more
/// than a pipe (1 MiB) and a program's own buffers hold, so that it lives then.
pub(crate) fn peak_memory(folder: &Folder, line: &str) -> f64 {
    // Into a pipe both times: what goes to a file may be compressed.
    let length = folder.command(line).output().unwrap().stdout.len();
    let mut child = folder.command(line).spawn().unwrap();
    let mut output = child.stdout.take().unwrap();
    output.read_exact(&mut vec![0; length.checked_sub(2 << 20).expect("more output")]).unwrap();
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    output.read_to_end(&mut vec![]).unwrap();
    assert!(child.wait().unwrap().success());
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    kilobytes.and_then(|line| line.split_whitespace().next()).expect("a peak").parse().unwrap()
}
