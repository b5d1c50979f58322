//! `pm-sweep hold`: one make at a time in a folder.
//!
//! The folder says which process holds it, on which machine, since when. A process that is gone holds nothing; whether one on
//! another machine is gone cannot be told, so that it holds until its file is removed.

use crate::cli::usage;
use anyhow::Context as _;
use nix::errno::Errno;
use nix::sys::signal::kill;
use nix::unistd::{Pid, gethostname};
use std::fs::{self, File};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub(super) struct Args {
    /// The folder
    folder: PathBuf,
    /// The process that holds it from now to its end
    #[arg(long, value_name = "PID")]
    by: i32,
    /// What that process does, for others to read
    #[arg(long, value_name = "WORDS")]
    what: String,
}

/// The file that says who holds the folder it lies in.
const HOLDER: &str = ".holder";

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    fs::create_dir_all(&args.folder).with_context(|| args.folder.display().to_string())?;
    let path = args.folder.join(HOLDER);
    let own = Holder { pid: args.by, host: host(), since: started(args.by), what: args.what.clone() };
    take(&path, &own).with_context(|| path.display().to_string())?.map_or(Ok(()), |other| {
        let remove = if other.host == own.host {
            String::new()
        } else {
            format!(" (if that is gone for good, remove {})", path.display())
        };
        let Holder { pid, host, what, .. } = other;
        let folder = args.folder.display();
        Err(usage(format!(
            "`{what}` holds {folder}/, process {pid} on {host}: wait for its end, or work in another folder{remove}"
        )))
    })
}

/// Whoever holds a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Holder {
    pid: i32,
    host: String,
    /// When the process began, in a unit of the system's; empty where that cannot be told.
    since: String,
    what: String,
}

impl Holder {
    fn write(&self) -> String {
        let Self { pid, host, since, what } = self;
        format!("{pid}\n{host}\n{since}\n{what}\n")
    }

    fn read(text: &str) -> Option<Self> {
        let mut lines = text.lines().map(str::to_owned);
        let pid = lines.next()?.parse().ok()?;
        Some(Self { pid, host: lines.next()?, since: lines.next()?, what: lines.next()? })
    }

    /// Whether it may still be there, as seen from a machine.
    fn may_be_there(&self, host: &str) -> bool {
        if self.host != host {
            return true;
        }
        // A process of another user may not be signalled, but is there. One that began at another time is another.
        let is_there = !matches!(kill(Pid::from_raw(self.pid), None), Err(Errno::ESRCH));
        is_there && started(self.pid) == self.since
    }
}

/// Takes the folder, or tells who holds it. Who reads and writes the file has locked it meanwhile.
fn take(path: &Path, own: &Holder) -> std::io::Result<Option<Holder>> {
    let mut file = File::options().read(true).write(true).create(true).truncate(false).open(path)?;
    // Some shared folders know no locks; there two that come at the same moment may both take it.
    let _ = file.lock();
    let mut text = String::new();
    file.read_to_string(&mut text)?;
    let is_own = |other: &Holder| (other.pid, &other.host, &other.since) == (own.pid, &own.host, &own.since);
    if let Some(other) = Holder::read(&text).filter(|other| !is_own(other) && other.may_be_there(&own.host)) {
        return Ok(Some(other));
    }
    file.set_len(0)?;
    file.rewind()?;
    file.write_all(own.write().as_bytes())?;
    Ok(None)
}

fn host() -> String {
    gethostname().map_or_else(|_| "this machine".into(), |name| name.to_string_lossy().into_owned())
}

/// When a process began: field 22 of `/proc/PID/stat`, after the name in parentheses, which may hold anything.
fn started(pid: i32) -> String {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let behind = stat.rsplit(')').next().unwrap_or_default();
    behind.split_whitespace().nth(19).unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn me(what: &str) -> Holder {
        let pid = i32::try_from(std::process::id()).unwrap();
        Holder { pid, host: host(), since: started(pid), what: what.into() }
    }

    #[test]
    fn who_is_there_holds_and_who_is_gone_does_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(HOLDER);
        let mut child = std::process::Command::new("sleep").arg("60").spawn().unwrap();
        let pid = i32::try_from(child.id()).unwrap();
        let other = Holder { pid, since: started(pid), ..me("make \"x\"\u{e4}") };
        assert_eq!(take(&path, &other).unwrap(), None);
        assert_eq!(take(&path, &me("make y")).unwrap(), Some(other.clone()));
        child.kill().unwrap();
        child.wait().unwrap();
        assert_eq!(take(&path, &me("make y")).unwrap(), None, "it is gone");
        assert_eq!(take(&path, &me("make y, begun again")).unwrap(), None, "its own");
    }

    #[test]
    fn another_process_of_the_same_number_and_one_elsewhere() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(HOLDER);
        fs::write(&path, Holder { pid: 1, since: "0".into(), ..me("make x") }.write()).unwrap();
        assert_eq!(take(&path, &me("make y")).unwrap(), None, "process 1 did not begin at 0");
        let elsewhere = Holder { host: "elsewhere".into(), ..me("make z") };
        fs::write(&path, elsewhere.write()).unwrap();
        assert_eq!(take(&path, &me("make y")).unwrap(), Some(elsewhere));
        fs::write(&path, "nonsense").unwrap();
        assert_eq!(take(&path, &me("make y")).unwrap(), None);
    }
}
