//! Outputs: standard output, or a file that appears whole or not at all.

use super::claims;
use super::usage::usage;
use anyhow::Context as _;
use pm_formats::{Compression, Header, Record, RecordWriter};
use std::fmt;
use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, IsTerminal as _, Write};
use std::os::fd::AsFd as _;
use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use tempfile::NamedTempFile;

/// Where a program writes its stream.
#[derive(clap::Args, Clone, Debug)]
pub struct OutputArgs {
    /// File to write; it appears when it is whole. `-` is standard output, even if that is a terminal
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

impl OutputArgs {
    /// Begins a stream of records there.
    ///
    /// # Errors
    /// As [`create`](Self::create), and if the header cannot be written.
    pub fn begin<T: Record>(&self, header: &Header) -> anyhow::Result<RecordWriter<T, Output>> {
        let output = self.create()?;
        let compression = output.compression();
        Ok(RecordWriter::new(output, header)?.with_compression(compression))
    }

    /// Opens the output for binary data.
    ///
    /// # Errors
    /// If it would go to a terminal unasked, or cannot be opened.
    pub fn create(&self) -> anyhow::Result<Output> {
        match &self.output {
            Some(path) => create_output(path),
            None if io::stdout().is_terminal() => {
                Err(usage("binary data is not written to a terminal; pipe it (`| pm-view`) or give `-o FILE`"))
            }
            None => create_output(Path::new("-")),
        }
    }
}

/// Whoever read standard output has closed it.
#[derive(Debug)]
pub(super) struct ReaderGone;

impl fmt::Display for ReaderGone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the reader of standard output left")
    }
}

impl std::error::Error for ReaderGone {}

/// Temporary files that stand for outputs not yet whole, and the names these shall have.
static UNFINISHED: Mutex<Vec<(PathBuf, PathBuf)>> = Mutex::new(Vec::new());

/// An output. Only [`commit`](Self::commit) makes a file of it.
pub struct Output {
    name: String,
    target: Target,
}

enum Target {
    /// Standard output.
    Standard(BufWriter<File>),
    /// A device or FIFO, which is written as it is.
    Direct(BufWriter<File>),
    /// A file under a temporary name beside `path`.
    Atomic { file: BufWriter<NamedTempFile>, path: PathBuf },
}

/// Opens an output; `-` is standard output.
///
/// # Errors
/// If it cannot be opened.
pub fn create_output(path: &Path) -> anyhow::Result<Output> {
    const CAPACITY: usize = 1 << 18;
    if path == Path::new("-") {
        let file = File::from(io::stdout().as_fd().try_clone_to_owned().context("standard output")?);
        widen(&file);
        let target = Target::Standard(BufWriter::with_capacity(CAPACITY, file));
        return Ok(Output { name: "standard output".into(), target });
    }
    let name = path.display().to_string();
    let path = behind_symlinks(path).with_context(|| format!("cannot write {name}"))?;
    let existing = fs::metadata(&path).ok();
    if existing.as_ref().is_some_and(fs::Metadata::is_dir) {
        return Err(usage(format!("{name} is a folder; name a file")));
    }
    if existing.as_ref().is_some_and(|metadata| !metadata.is_file()) {
        let file = File::options().write(true).open(&path).with_context(|| format!("cannot write {name}"))?;
        widen(&file);
        return Ok(Output { name, target: Target::Direct(BufWriter::with_capacity(CAPACITY, file)) });
    }
    claims::write(&path)?;
    let folder = folder_of(&path);
    if !folder.is_dir() {
        return Err(anyhow::anyhow!(
            "cannot write {name}: No such file or directory: make the folder {} first",
            folder.display()
        ));
    }
    // A new file gets what the umask leaves, an old one keeps its permissions.
    let mode = existing.as_ref().map_or(0o666, |metadata| metadata.permissions().mode());
    // Held until the file is listed: a signal in between waits, and takes the file with it.
    let mut listed = unfinished();
    let file = tempfile::Builder::new()
        .prefix(&format!(".{}.", path.file_name().unwrap_or_default().to_string_lossy()))
        .suffix(".tmp")
        .permissions(Permissions::from_mode(mode))
        .tempfile_in(folder)
        .with_context(|| format!("cannot write {name}"))?;
    listed.push((file.path().to_owned(), path.clone()));
    drop(listed);
    if let Some(metadata) = existing {
        // The umask has taken its part of them.
        file.as_file().set_permissions(metadata.permissions()).with_context(|| format!("cannot write {name}"))?;
    }
    Ok(Output { name, target: Target::Atomic { file: BufWriter::with_capacity(CAPACITY, file), path } })
}

/// Room in a pipe for some blocks of records, so that those at its ends seldom wait for each other: as much as the system gives to
/// everybody. Without it a pipe has room for a third of a block.
#[cfg(target_os = "linux")]
fn widen(file: &File) {
    use nix::fcntl::{FcntlArg, fcntl};
    const CAPACITY: i32 = 1 << 20;
    if is_pipe(file) {
        // A system that gives no more has a pipe as well.
        let _ = fcntl(file, FcntlArg::F_SETPIPE_SZ(CAPACITY));
    }
}

/// Other systems have no such question.
#[cfg(not(target_os = "linux"))]
fn widen(_: &File) {}

pub(super) fn is_pipe(file: &File) -> bool {
    file.metadata().is_ok_and(|metadata| metadata.file_type().is_fifo())
}

/// The folder that a file is in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The file that a name stands for: a symlink stays and its target is written, be it there or not.
fn behind_symlinks(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            // No loop, for that would have been another error.
            let mut path = path.to_owned();
            while let Ok(target) = fs::read_link(&path) {
                path = path.parent().unwrap_or(Path::new("")).join(target);
            }
            Ok(path)
        }
        outcome => outcome,
    }
}

impl Output {
    /// What to do to blocks of records that go there. A pipe's reader would only undo their compression, which takes longer than all
    /// else that is done to a record on its way. (Traces go compressed: their searches take so long that nothing is gained.)
    fn compression(&self) -> Compression {
        let is_pipe = match &self.target {
            Target::Standard(file) | Target::Direct(file) => is_pipe(file.get_ref()),
            Target::Atomic { .. } => false,
        };
        if is_pipe { Compression::None } else { Compression::Zstd }
    }

    /// Flushes what is buffered and lets the file appear under its name.
    ///
    /// # Errors
    /// If the rest cannot be written or the file not be renamed.
    pub fn commit(mut self) -> anyhow::Result<()> {
        self.flush()?;
        let Target::Atomic { file, path } = self.target else { return Ok(()) };
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        let temporary = file.path().to_owned();
        // On disk before the name is: after a power cut there is the whole file, or what was there before.
        let on_disk = |file: &File| file.sync_all().with_context(|| format!("cannot write {}", self.name));
        on_disk(file.as_file())?;
        file.persist(&path).map_err(|error| error.error).with_context(|| format!("cannot write {}", self.name))?;
        unfinished().retain(|(known, _)| *known != temporary);
        // Not every file system can be asked for its folders.
        let _ = File::open(folder_of(&path)).and_then(|folder| folder.sync_all());
        Ok(())
    }

    fn explain(&self, error: io::Error) -> io::Error {
        if error.kind() == io::ErrorKind::BrokenPipe && matches!(self.target, Target::Standard(_)) {
            return io::Error::new(error.kind(), ReaderGone);
        }
        io::Error::new(error.kind(), format!("cannot write {}: {error}", self.name))
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = match &mut self.target {
            Target::Standard(file) | Target::Direct(file) => file.write(bytes),
            Target::Atomic { file, .. } => file.write(bytes),
        };
        written.map_err(|error| self.explain(error))
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = match &mut self.target {
            Target::Standard(file) | Target::Direct(file) => file.flush(),
            Target::Atomic { file, .. } => file.flush(),
        };
        flushed.map_err(|error| self.explain(error))
    }
}

fn unfinished() -> std::sync::MutexGuard<'static, Vec<(PathBuf, PathBuf)>> {
    UNFINISHED.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Names of the files that were asked for and have not appeared.
pub(super) fn unfinished_files() -> Vec<String> {
    unfinished().iter().map(|(_, path)| path.display().to_string()).collect()
}

/// Ends the process with this code, and the temporary files with it.
pub(super) fn remove_temporary_files(code: i32) -> ! {
    // Held to the end: no file appears meanwhile.
    let unfinished = unfinished();
    for (temporary, _) in unfinished.iter() {
        let _ = fs::remove_file(temporary);
    }
    std::process::exit(code);
}
