//! Where the bytes of a scene's files come from.

use super::warnings::Warnings;
use std::io;
use std::path::{Path, PathBuf};

/// Files by their names: a file system, an archive, or what is built into a program. Closures are such as well.
pub trait Files {
    /// All bytes of a file.
    ///
    /// # Errors
    /// [`io::ErrorKind::NotFound`] if there is no such file, else why it cannot be read.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// The same of a file that another file names, and no person: only what is a file, and of a size that can be meant.
    ///
    /// # Errors
    /// As [`read`](Self::read), and if it is no such file.
    fn read_named(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.read(path)
    }
}

/// Most bytes of a material library or a texture.
const MOST_BYTES: u64 = 1 << 30;

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

    fn read_named(&self, path: &Path) -> io::Result<Vec<u8>> {
        let refused = |why| Err(io::Error::new(io::ErrorKind::InvalidInput, why));
        // Asked before it is opened: to open a pipe is to wait for whoever writes it.
        let file = std::fs::metadata(path)?;
        if !file.is_file() {
            return refused("it is not a regular file");
        }
        if file.len() > MOST_BYTES {
            return refused("it has more than 2^30 bytes");
        }
        self.read(path)
    }
}

/// Remarks if the name that `of` names a file by leads out of its folder.
pub(super) fn remark_if_outside(of: &Path, name: &str, warnings: &mut Warnings) {
    if name.starts_with('/') || name.split('/').any(|part| part == "..") {
        let of = of.display();
        warnings.once(&format!("outside {of}"), || format!("{of}: names files outside its folder, such as {name:?}"));
    }
}

/// Where a file may be that another, `of`, names, with `/` between folders: beside it as the name says, or else by its bare
/// name. Exporters write paths of the machine they ran on: what they name often lies beside the file all the same.
pub(super) fn places(of: &Path, name: &str) -> Vec<PathBuf> {
    let bare = name.rsplit_once('/').map(|(_, bare)| bare).filter(|bare| !bare.is_empty());
    [name].into_iter().chain(bare).map(|name| of.with_file_name("").join(name)).collect()
}
