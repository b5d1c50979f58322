//! Where the bytes of a scene's files come from.

use std::io;
use std::path::Path;

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
