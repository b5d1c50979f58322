//! Where the bytes of a scene's files come from.

use std::io;
use std::path::{Path, PathBuf};

/// Files by their names: a file system, an archive, or what is built into a program. Closures are such as well.
pub trait Files {
    /// All bytes of a file.
    ///
    /// # Errors
    /// [`io::ErrorKind::NotFound`] if there is no such file, else why it cannot be read.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;
}

impl<F: Fn(&Path) -> io::Result<Vec<u8>>> Files for F {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self(path)
    }
}

/// The files of the system that the program runs on.
#[derive(Debug, Clone, Copy)]
pub struct FileSystem;

impl Files for FileSystem {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        std::fs::read(path)
    }
}

/// Where a file may be that another, `of`, names, with `/` between folders: beside it as the name says, or else by its bare
/// name. Exporters write paths of the machine they ran on: what they name often lies beside the file all the same.
pub(super) fn places(of: &Path, name: &str) -> Vec<PathBuf> {
    let bare = name.rsplit_once('/').map(|(_, bare)| bare).filter(|bare| !bare.is_empty());
    [name].into_iter().chain(bare).map(|name| of.with_file_name("").join(name)).collect()
}
