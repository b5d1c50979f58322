//! What the targets begin with: whole inputs of every sort.

mod foreign;
mod streams;

use super::mutate::LONGEST;
use super::targets::{archive, unpacked};
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the whole project, from any crate that stands two folders below it.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Inputs of a target: those that are kept in the tree, small ones made here, and all that was ever found.
///
/// # Panics
/// If there are none.
#[must_use]
pub fn seeds(target: &str) -> Vec<Vec<u8>> {
    let mut seeds = match target {
        "streams" => all_streams(),
        "mended" => all_streams().iter().flat_map(|stream| [stream.clone(), unpacked(stream)]).collect(),
        "parts" => parts(),
        "traces" => foreign::traces(),
        "rows" => foreign::rows(),
        "scenes" => scenes(),
        "tables" => {
            let scripts = root().join("scripts");
            let mut tables =
                [files(&scripts, ".toml"), files(&scripts, ".csv"), files(&scripts.join("sweeps"), ".csv")].concat();
            tables.push(b"a,b\n# x\n1,\"2\n3\"\n4,5e3\n".to_vec());
            tables
        }
        _ => vec![],
    };
    seeds.extend(regressions(target).into_iter().map(|(_, data)| data));
    assert!(!seeds.is_empty(), "no inputs for {target}");
    seeds
}

/// What was found once, by the name of its file.
#[must_use]
pub fn regressions(target: &str) -> Vec<(String, Vec<u8>)> {
    let named = |path: PathBuf| Some((path.file_name()?.to_string_lossy().into_owned(), fs::read(&path).ok()?));
    let begins = format!("{target}-");
    paths(&root().join("tests/fuzz/regressions"))
        .into_iter()
        .filter_map(named)
        .filter(|(name, _)| name.starts_with(&begins))
        .collect()
}

fn paths(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok).map(|entry| entry.path());
    let mut paths: Vec<_> = entries.filter(|path| path.is_file()).collect();
    paths.sort();
    paths
}

/// The files of a folder with this ending that are no longer than an input.
fn files(folder: &Path, ending: &str) -> Vec<Vec<u8>> {
    let paths = paths(folder).into_iter().filter(|path| path.to_string_lossy().ends_with(ending));
    paths.filter_map(|path| fs::read(path).ok()).filter(|bytes| bytes.len() < LONGEST).collect()
}

fn all_streams() -> Vec<Vec<u8>> {
    let mut all = files(&root().join("formats/tests/golden"), "");
    all.extend([streams::photons(), streams::unrounded(), streams::queries(None, true), streams::trace(None)]);
    all.push(streams::waits());
    all.extend([streams::trace(None), streams::walks()].map(|trace| archive(&trace)));
    all
}

/// Pieces as the target cuts them: their number, and before each its length.
fn parts() -> Vec<Vec<u8>> {
    let pieces = |streams: &[Vec<u8>]| {
        let mut all = vec![u8::try_from(streams.len()).expect("few pieces")];
        for stream in streams.iter().map(|stream| unpacked(stream)) {
            all.extend(u16::try_from(stream.len()).expect("a short stream").to_le_bytes());
            all.extend(stream);
        }
        all
    };
    let pair = |stream: &dyn Fn(&str) -> Vec<u8>| pieces(&[stream("1/2"), stream("2/2")]);
    vec![
        pair(&|part| streams::queries(Some(part), true)),
        pair(&|part| streams::queries(Some(part), false)),
        pair(&|part| streams::trace(Some(part))),
        pieces(&[streams::queries(Some("1/1"), false)]),
    ]
}

/// An OBJ file, a byte 0, and its materials.
fn scenes() -> Vec<Vec<u8>> {
    let scene = |object: &[u8], materials: &[u8]| [object, b"\0", materials].concat();
    let read = |path: &Path| fs::read(path).unwrap_or_default();
    let kept = [root().join("scenes"), root().join("tests/scenes")]
        .iter()
        .flat_map(|folder| paths(folder))
        .collect::<Vec<_>>();
    let objects = kept.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "obj"));
    let mut all: Vec<_> = objects.map(|path| scene(&read(&path), &read(&path.with_extension("mtl")))).collect();
    all.retain(|scene| scene.len() < LONGEST);
    all.push(scene(
        b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1 -1\ng x\nf 1 2 3\n",
        b"newmtl a\nKd 0.5 0.5 0.5\nKe 1 1 1\nKs 0.2 0.2 0.2\nNs 10\nd 0.5\nTf 1 1 1\n",
    ));
    all
}
