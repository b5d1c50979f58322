//! Tells the programs what they were built from: the version with commit and dirty mark, which streams carry, and fingerprints
//! of the sources, by which make tells whether rows were made by the programs that it has.

use std::path::{Path, PathBuf};
use std::process::Command;
use xxhash_rust::xxh3::Xxh3;

/// What the programs are built from, from the top of the repository.
const SOURCES: [&str; 5] = ["Cargo.lock", "Cargo.toml", "formats", "scenes", "tools"];

/// Folders of a crate that are not built into programs.
const NOT_BUILT: [&str; 4] = ["tests", "benches", "examples", "target"];

/// Sources that make tables and pages of rows, and no row and no stream.
const REPORTING: [&str; 7] =
    ["tools/report/", "tools/sweep/", "tools/verdicts/", "src/sweep", "src/chart", "bin/pm-sweep", "bin/pm-chart"];

fn main() {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let version = std::env::var("CARGO_PKG_VERSION").unwrap_or_default();
    let revision = git(&["rev-parse", "--short=8", "HEAD"]);
    // Of what the programs are built from: a page that was changed makes no other program.
    let root = Path::new("../..");
    let status = ["-C", "../..", "status", "--porcelain", "--untracked-files=no", "--", ":(exclude)*.md"];
    let dirty = git(&[&status[..], &SOURCES[..]].concat()).is_some_and(|status| !status.is_empty());
    let version = match revision {
        Some(revision) => format!("{version} (rev {revision}{})", if dirty { ", dirty" } else { "" }),
        None => format!("{version} (rev unknown)"),
    };
    println!("cargo::rustc-env=PM_VERSION={version}");
    // A new commit or a changed source changes the string. Not the index: every `git status` writes it anew.
    for name in ["HEAD", "logs/HEAD"] {
        let path = git(&["rev-parse", "--git-path", name]);
        if let Some(path) = path.filter(|path| Path::new(path).exists()) {
            println!("cargo::rerun-if-changed={path}");
        }
    }

    let mut files = vec![];
    SOURCES.iter().for_each(|source| list(&root.join(source), &mut files));
    files.sort();
    let is_reporting = |name: &str| REPORTING.iter().any(|part| name.contains(part));
    let (mut programs, mut reporting) = (Xxh3::new(), Xxh3::new());
    for file in files {
        // File by file: of a folder cargo watches all, pages and tests too.
        println!("cargo::rerun-if-changed={}", file.display());
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().into_owned();
        let fingerprint = if is_reporting(&name) { &mut reporting } else { &mut programs };
        let text = std::fs::read(&file).unwrap_or_default();
        fingerprint.update(format!("{name} {} ", text.len()).as_bytes());
        fingerprint.update(&text);
    }
    println!("cargo::rustc-env=PM_PROGRAMS={:032x}", programs.digest128());
    // Tables are made by what makes rows as well: of its formats and its numbers.
    reporting.update(&programs.digest128().to_le_bytes());
    println!("cargo::rustc-env=PM_REPORTING={:032x}", reporting.digest128());
}

/// The sources at a path.
fn list(path: &Path, files: &mut Vec<PathBuf>) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if path.is_dir() && !NOT_BUILT.contains(&&*name) {
        for entry in std::fs::read_dir(path).into_iter().flatten().flatten() {
            list(&entry.path(), files);
        }
    } else if path.is_file() && ![".md", ".png"].iter().any(|ending| name.ends_with(ending)) && !name.starts_with('.') {
        files.push(path.to_owned());
    }
}
