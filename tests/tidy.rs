//! Are the invariants of the code map kept: who may know whom, and the rules of the house?

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Who may know whom, among the crates in `tools`: a new crate needs a line here, a new acquaintance a word, and both a
/// reason. `formats` stands for the crate `pm-formats`.
const MAY_KNOW: &[(&str, &[&str])] = &[
    ("random", &[]),
    ("parallel", &[]),
    ("registry", &[]),
    ("size", &[]),
    ("curves", &["formats"]),
    ("spool", &["formats"]),
    ("film", &["formats"]),
    ("pictures", &[]),
    ("sampling", &["random"]),
    ("orders", &["curves", "random", "registry", "size", "formats"]),
    ("light", &["curves", "film", "orders", "parallel", "random", "registry", "formats"]),
    // Never light: a map is built from photons in a stream.
    ("maps", &["curves", "random", "registry", "formats"]),
    ("gathering", &["curves", "film", "maps", "parallel", "random", "registry", "formats"]),
    // Never maps: a cache sees accesses only.
    ("caches", &["random", "registry", "sampling", "size", "spool", "formats"]),
    // Never caches: it says what was accessed, not what that costs.
    ("exchange", &["random", "registry", "formats"]),
    // Never caches: what is fetched is found by running the programs.
    ("plan", &["gathering", "light", "maps", "orders", "pictures", "random", "sampling", "formats"]),
    ("report", &["registry", "size"]),
    // Never caches or maps: it knows programs by what they print.
    ("sweep", &["registry", "sampling"]),
    ("verdicts", &["registry", "report", "sweep"]),
];

/// The crate of the command line, which may know all others and which none may know.
const PROGRAMS: &str = "programs";

/// Packages that only the programs may depend on: the command line, the terminal, the process.
const OF_THE_PROGRAMS: &[&str] = &["clap", "clap_complete", "clap_mangen", "indicatif", "nix", "signal-hook"];

/// Files that may say `unsafe`, each with its reason.
const UNSAFE: &[(&str, &str)] = &[
    (
        "tools/maps/src/wide/instructions.rs",
        "vector instructions that not every machine has, called where they are there; plain loops find the same elsewhere",
    ),
    (
        "tools/caches/src/lines/changes/instructions.rs",
        "the same, by which line accesses are packed: a sixth of a run of one cache",
    ),
    (
        "tools/light/src/transport/bvh/lanes.rs",
        "the same, by which rays meet boxes and triangles: a third of the time of casting a picture's rays",
    ),
];

/// Longest file, in lines: beyond this it has more than one subject.
const MOST_LINES: usize = 600;

/// Longest function, in lines, and the length that half of all files stay within.
const MOST_LINES_OF_A_FUNCTION: usize = 100;
const MEDIAN_LINES: usize = 110;

/// Functions that may be longer, each a table of data.
const TABLES_OF_DATA: &[&str] = &[];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The Rust files under a folder of the repository: path from the root, and text.
pub(crate) fn sources(folder: &str) -> Vec<(String, String)> {
    fn visit(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                visit(&path, found);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                found.push(path);
            }
        }
    }
    let mut found = vec![];
    visit(&root().join(folder), &mut found);
    found.sort();
    assert!(!found.is_empty(), "no sources in {folder}");
    let name = |path: &Path| path.strip_prefix(root()).expect("below the root").display().to_string();
    found.iter().map(|path| (name(path), fs::read_to_string(path).expect("a text"))).collect()
}

fn all_sources() -> Vec<(String, String)> {
    ["formats", "tools", "tests"].into_iter().flat_map(sources).collect()
}

/// A file's code without comments (of whole lines, as rustfmt leaves them, and at ends of lines) and what strings hold.
pub(crate) fn code(text: &str) -> String {
    let mut code = String::new();
    for line in text.lines() {
        let (mut quoted, mut escaped, mut before) = (false, false, ' ');
        for letter in line.chars() {
            match letter {
                _ if escaped => escaped = false,
                '\\' if quoted => escaped = true,
                // Not the character '"'.
                '"' if before != '\'' => quoted = !quoted,
                '/' if !quoted && before == '/' => {
                    code.pop();
                    break;
                }
                _ if quoted => {}
                _ => code.push(letter),
            }
            before = letter;
        }
        code.push('\n');
    }
    code
}

/// Names of the packages that a crate's manifest lists, without those for its tests.
fn dependencies(manifest: &str) -> BTreeSet<String> {
    let text = fs::read_to_string(root().join(manifest)).unwrap_or_else(|error| panic!("{manifest}: {error}"));
    let table: toml::Table = text.parse().unwrap_or_else(|error| panic!("{manifest}: {error}"));
    table.get("dependencies").and_then(toml::Value::as_table).into_iter().flat_map(toml::Table::keys).cloned().collect()
}

/// The crates in `tools`.
pub(crate) fn crates() -> BTreeSet<String> {
    let entries = fs::read_dir(root().join("tools")).expect("a folder").map(|entry| entry.expect("an entry").path());
    let crates = entries.filter(|path| path.join("Cargo.toml").exists());
    crates.map(|path| path.file_name().expect("a name").to_string_lossy().into_owned()).collect()
}

#[test]
fn crates_know_only_whom_they_may() {
    let mut listed: BTreeSet<String> = MAY_KNOW.iter().map(|(name, _)| (*name).to_owned()).collect();
    listed.insert(PROGRAMS.into());
    assert_eq!(crates(), listed, "left: folders in tools, right: MAY_KNOW");
    for (name, may_know) in MAY_KNOW {
        let all = dependencies(&format!("tools/{name}/Cargo.toml"));
        let ours: BTreeSet<&str> = all.iter().filter_map(|package| package.strip_prefix("pm-")).collect();
        assert_eq!(ours, may_know.iter().copied().collect(), "left: {name}'s manifest, right: MAY_KNOW");
        let theirs: Vec<_> = OF_THE_PROGRAMS.iter().filter(|package| all.contains(**package)).collect();
        assert!(theirs.is_empty(), "{name} depends on {theirs:?}, which is for the programs");
    }
    let formats = dependencies("formats/Cargo.toml");
    assert!(formats.iter().all(|package| !package.starts_with("pm-")), "formats knows none of ours");
    assert!(OF_THE_PROGRAMS.iter().all(|package| !formats.contains(*package)));
    assert!(dependencies("tools/programs/Cargo.toml").contains("clap"), "manifests are read as they are meant");
}

#[test]
fn arrows_go_one_way() {
    // Each crate stands below all that it knows.
    for (at, (name, may_know)) in MAY_KNOW.iter().enumerate() {
        let above: Vec<&str> = MAY_KNOW[..at].iter().map(|(name, _)| *name).chain(["formats"]).collect();
        assert!(may_know.iter().all(|known| above.contains(known)), "{name} knows one that stands below it");
    }
}

#[test]
fn the_code_map_says_the_same() {
    let readme = fs::read_to_string(root().join("tools/README.md")).expect("tools/README.md");
    // Rows of three cells: name, what it is about, whom it may know.
    let rows = readme.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let &[name, _, may_know] = &cells[..] else { return None };
        let name = name.strip_prefix('`')?.strip_suffix('`')?;
        Some((name, may_know.split('`').skip(1).step_by(2).collect::<BTreeSet<&str>>()))
    });
    let rows: BTreeMap<&str, BTreeSet<&str>> = rows.filter(|(name, _)| *name != PROGRAMS).collect();
    let table = MAY_KNOW.iter().map(|(name, known)| (*name, known.iter().copied().collect())).collect();
    assert_eq!(rows, table, "left: tools/README.md, right: this file");
}

#[test]
fn no_program_prints_past_its_output() {
    // `println!` panics when the reader has gone, and standard output is for results only.
    for (path, text) in all_sources().into_iter().filter(|(path, _)| path.contains("/src/")) {
        let code = code(&text);
        for word in ["println!", "print!", "eprintln!", "eprint!", "dbg!"] {
            let found = code.match_indices(word).any(|(at, _)| {
                let before = code[..at].chars().next_back();
                !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
            });
            assert!(!found, "{path}: {word}");
        }
    }
}

#[test]
fn names_in_streams_come_from_the_vocabulary() {
    let vocabulary = fs::read_to_string(root().join("formats/src/vocabulary/measure.rs")).expect("the vocabulary");
    let measures: Vec<&str> = vocabulary.split('"').skip(1).step_by(2).collect();
    assert!(measures.contains(&"emitted_paths"), "{measures:?}");
    for (path, text) in all_sources().into_iter().filter(|(path, _)| !path.starts_with("formats/src/vocabulary")) {
        // A call may be broken across lines.
        let dense: String = text.split_whitespace().collect();
        for call in ["meaning", "measure"] {
            let literal = format!("{call}(\"");
            assert!(
                !dense.contains(&literal),
                "{path}: {literal}...: a name that stands not in pm_formats::vocabulary"
            );
        }
        for name in &measures {
            let written = format!("(\"{name}\",Number::");
            assert!(!dense.contains(&written), "{path}: `{name}` stands in pm_formats::vocabulary::measure");
        }
    }
}

/// What is built into a program is in its own crate, so that `cargo package` takes all of it along.
#[test]
fn what_is_built_in_lies_in_the_crate() {
    let mut built_in = 0;
    for (name, text) in all_sources() {
        let Some(crate_end) = name.find("/src/") else { continue };
        let depth = name[crate_end + "/src/".len()..].matches('/').count() + 1;
        // Tests read pages of the whole house, and are not built into anything.
        let built = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        for macro_name in ["include_str!(\"", "include_bytes!(\""] {
            for path in built.split(macro_name).skip(1).filter(|_| !name.ends_with("tests.rs")) {
                built_in += 1;
                let path = path.split('"').next().unwrap_or_default();
                assert!(path.matches("../").count() <= depth, "{name}: {path} lies outside of the crate");
            }
        }
    }
    assert!(built_in > 5, "{built_in}");
}

#[test]
fn nothing_is_unsafe() {
    for (path, text) in all_sources() {
        let code = code(&text);
        let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let allowed = UNSAFE.iter().any(|(file, _)| *file == path);
        assert!(allowed || words.into_iter().all(|word| word != "unsafe"), "{path} is not in UNSAFE");
    }
}

#[test]
fn every_file_begins_with_its_subject_and_stays_with_it() {
    for (path, text) in all_sources() {
        let first = text.lines().next().unwrap_or_default();
        assert!(first.starts_with("//! ") && first.len() > 10, "{path} begins with: {first}");
        let lines = text.lines().count();
        assert!(lines <= MOST_LINES, "{path} has {lines} lines; the most is {MOST_LINES}");
    }
}

/// Names and lengths of the functions of a file that rustfmt has laid out: each ends with a brace under its own beginning.
fn functions(text: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut functions = vec![];
    for (at, line) in lines.iter().enumerate() {
        let indented = line.len() - line.trim_start().len();
        let words: Vec<&str> = line.split_whitespace().collect();
        let Some(keyword) = words.iter().position(|word| *word == "fn") else { continue };
        let heads = ["pub", "pub(crate)", "pub(super)", "const", "async", "unsafe", "default"];
        if !words[..keyword].iter().all(|word| heads.contains(word)) {
            continue;
        }
        let name = words[keyword + 1].split(['(', '<']).next().unwrap_or_default();
        let end = |line: &&str| {
            line.len() > indented && line[indented..].starts_with('}') && line[..indented].trim().is_empty()
        };
        // Without a body, or with all of it on the line.
        if line.ends_with(';') || line.ends_with('}') {
            continue;
        }
        if let Some(length) = lines[at..].iter().position(end) {
            functions.push((name.to_owned(), length + 1));
        }
    }
    functions
}

#[test]
fn functions_are_short_and_half_of_the_files_too() {
    let mut lengths = vec![];
    for (path, text) in all_sources() {
        lengths.push(text.lines().count());
        for (name, length) in functions(&text) {
            let fits = length <= MOST_LINES_OF_A_FUNCTION || TABLES_OF_DATA.contains(&&*name);
            assert!(fits, "{path}: {name} has {length} lines; the most is {MOST_LINES_OF_A_FUNCTION}");
        }
    }
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    assert!(median <= MEDIAN_LINES, "the median file has {median} lines; the most is {MEDIAN_LINES}");
}

#[test]
fn the_length_of_a_function_is_that_of_its_text() {
    let text = "fn a() {\n    b();\n}\n\nimpl X {\n    pub(crate) fn c<T>(\n        x: T,\n    ) -> T {\n        x\n    }\n    fn d() {}\n}\n";
    assert_eq!(functions(text), [("a".to_owned(), 3), ("c".to_owned(), 5)]);
}
