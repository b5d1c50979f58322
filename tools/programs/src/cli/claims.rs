//! Files of a run: no two outputs have one name, and none is an input as well, for one of them would be lost.

use super::usage::usage;
use std::cell::RefCell;
use std::fs;
use std::path::{Path, PathBuf};

#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    Read,
    Written,
}

// Files are opened by the thread that runs the program; a test runs several programs, each in a thread.
thread_local! {
    static CLAIMS: RefCell<Vec<(PathBuf, Use)>> = const { RefCell::new(Vec::new()) };
}

/// A run begins.
pub(super) fn clear() {
    CLAIMS.with_borrow_mut(Vec::clear);
}

/// A file is about to be read.
///
/// # Errors
/// If it is an output of the same run.
pub(crate) fn read(path: &Path) -> anyhow::Result<()> {
    claim(path, Use::Read)
}

/// A file is about to be written under this name, which no link stands for.
///
/// # Errors
/// If the same run reads it, or writes something else there.
pub(super) fn write(path: &Path) -> anyhow::Result<()> {
    claim(path, Use::Written)
}

fn claim(path: &Path, wanted: Use) -> anyhow::Result<()> {
    // Devices and pipes are no files: what is written there is not what is read.
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Ok(());
    }
    let file = identity(path);
    CLAIMS.with_borrow_mut(|claims| {
        let other = claims.iter().find(|(known, other)| *known == file && (*other, wanted) != (Use::Read, Use::Read));
        match other {
            Some((_, Use::Written)) if wanted == Use::Written => {
                Err(usage(format!("{}: two outputs of one name; give each its own", path.display())))
            }
            Some(_) => {
                Err(usage(format!("{}: is read and would be written; give the output another name", path.display())))
            }
            None => {
                claims.push((file, wanted));
                Ok(())
            }
        }
    })
}

/// The file's one name, be it there or not.
fn identity(path: &Path) -> PathBuf {
    if let Ok(path) = fs::canonicalize(path) {
        return path;
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    path.file_name().map_or(folder.clone(), |name| folder.join(name))
}
