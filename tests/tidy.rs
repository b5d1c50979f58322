//! Are the invariants of the code map kept: who may know whom, and the rules of the house?

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Who may know whom, among the modules of `tools`: a new module needs a line here, a new acquaintance a word, and both a
/// reason. `formats` stands for the crate `pm_formats`. Programs (`bin`) may know anything and nobody knows them.
const MAY_KNOW: &[(&str, &[&str])] = &[
    ("cache", &["size", "random", "spool", "statistics", "formats"]), // never photon_map: it sees accesses only
    ("chart", &["size"]),
    ("cli", &["formats"]),
    ("curve", &["formats"]),
    ("film", &[]),
    ("foreign", &["cli", "spool", "formats"]), // never cache: it says what was accessed, not what that costs
    ("gather", &["photon_map", "irradiance", "film", "parallel", "random", "formats"]),
    ("hemisphere", &[]),
    ("image", &["cli"]),
    ("irradiance", &["hemisphere", "film", "formats"]),
    ("make_scene", &["random", "scene"]), // scene only for what is copied from the built-in one
    ("order", &["curve", "random", "formats"]),
    ("page", &["chart", "size"]),
    ("parallel", &[]),
    ("photon_map", &["curve", "random", "formats"]), // never scene or transport: it is built from photons in a stream
    ("random", &[]),
    ("report", &[]),
    ("scene", &[]),
    ("setting", &["cli", "scene", "formats"]),
    ("size", &[]),
    ("spool", &["formats"]),
    ("statistics", &[]),
    ("transport", &["scene", "irradiance", "hemisphere", "curve", "order", "parallel", "random", "formats"]),
    ("view", &["cli", "image", "random", "report", "formats"]),
    ("windows", &["random"]),
];

/// What tests may know beyond what their module may: where random numbers come from.
const TESTS_MAY_KNOW: &[&str] = &["random"];

/// Files that may say `unsafe`, each with its reason.
const UNSAFE: &[(&str, &str)] = &[];

/// Longest file, in lines: beyond this it has more than one subject.
const MOST_LINES: usize = 600;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The Rust files under a folder of the repository: path from the root, and text.
fn sources(folder: &str) -> Vec<(String, String)> {
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
fn code(text: &str) -> String {
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

/// The code before the first `#[cfg(test)]`, and from there on: by our custom tests stand at the foot.
fn split_tests<'a>(path: &str, code: &'a str) -> (&'a str, &'a str) {
    if path.ends_with("/tests.rs") || path.contains("/tests/") {
        return ("", code);
    }
    code.split_at(code.find("#[cfg(test)]").unwrap_or(code.len()))
}

/// Modules of ours that a piece of code names: first words after `crate::` or `pm_tools::`, and `formats`.
fn known(code: &str) -> BTreeSet<String> {
    let mut known = BTreeSet::new();
    for prefix in ["crate::", "pm_tools::"] {
        for (at, _) in code.match_indices(prefix) {
            let rest = &code[at + prefix.len()..];
            // `crate::{a::X, b}`: the first word of each branch.
            let branches: Vec<&str> = match rest.strip_prefix('{') {
                Some(group) => top_level(group),
                None => vec![rest],
            };
            for branch in branches {
                let word: String =
                    branch.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                known.insert(word);
            }
        }
    }
    if code.contains("pm_formats") {
        known.insert("formats".into());
    }
    known.remove("");
    known
}

/// The branches of a group of imports, up to its closing brace.
fn top_level(group: &str) -> Vec<&str> {
    let (mut branches, mut depth, mut from) = (vec![], 0, 0);
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth == 0 => {
                branches.push(&group[from..at]);
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                branches.push(&group[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    branches
}

/// The module of `tools` that a file belongs to: `cache` for `tools/src/cache.rs` and `tools/src/cache/lines.rs`.
fn module(path: &str) -> Option<&str> {
    let rest = path.strip_prefix("tools/src/")?;
    let first = rest.split('/').next().expect("split gives at least one");
    Some(first.strip_suffix(".rs").unwrap_or(first)).filter(|module| !["lib", "bin"].contains(module))
}

#[test]
fn modules_know_only_whom_they_may() {
    let table: BTreeMap<&str, &[&str]> = MAY_KNOW.iter().copied().collect();
    let mut faults = vec![];
    let mut met = BTreeSet::new();
    for (path, text) in sources("tools/src") {
        let Some(module) = module(&path) else { continue };
        let Some(may_know) = table.get(module) else {
            faults.push(format!("{path}: module `{module}` has no line in MAY_KNOW"));
            continue;
        };
        met.insert(module.to_owned());
        let code = code(&text);
        let (work, tests) = split_tests(&path, &code);
        for (part, more) in [(work, &[][..]), (tests, TESTS_MAY_KNOW)] {
            for other in known(part) {
                let allowed = other == module || may_know.contains(&&*other) || more.contains(&&*other);
                if !allowed {
                    faults.push(format!("{path}: `{module}` must not know `{other}`"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(met.iter().eq(table.keys()), "MAY_KNOW has lines for modules that are gone");
}

#[test]
fn the_map_of_the_code_is_this_table() {
    let readme = fs::read_to_string(root().join("tools/README.md")).expect("tools/README.md");
    // Rows of modules: name, what it is about, whom it may know.
    let rows = readme.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let &[name, _, may_know] = &cells[..] else { return None };
        let name = name.strip_prefix('`')?.strip_suffix('`')?;
        let mut known: BTreeSet<&str> = may_know.split('`').skip(1).step_by(2).collect();
        if may_know.split(|c: char| !c.is_alphanumeric()).any(|word| word == "formats") {
            known.insert("formats");
        }
        Some((name, known))
    });
    let rows: BTreeMap<&str, BTreeSet<&str>> = rows.collect();
    let table = MAY_KNOW.iter().map(|(name, known)| (*name, known.iter().copied().collect())).collect();
    assert_eq!(rows, table, "left: tools/README.md, right: this file");

    let library = fs::read_to_string(root().join("tools/src/lib.rs")).expect("tools/src/lib.rs");
    let modules = library.lines().filter_map(|line| line.trim().strip_suffix(';')?.split_once("mod ")).map(|(_, m)| m);
    for module in modules {
        assert!(rows.contains_key(module), "module `{module}` of tools/src/lib.rs is not in tools/README.md");
    }
}

#[test]
fn formats_knows_nothing_of_the_tools() {
    for (path, text) in sources("formats") {
        assert!(!code(&text).contains("pm_tools"), "{path}");
    }
    let manifest = fs::read_to_string(root().join("formats/Cargo.toml")).unwrap();
    assert!(!manifest.contains("pm-tools"));
}

#[test]
fn imports_are_found_however_they_are_written() {
    let words = |text: &str| known(&code(text)).into_iter().collect::<Vec<_>>();
    assert_eq!(words("use crate::scene::Scene; // crate::cli"), ["scene"]);
    assert_eq!(
        words("use crate::{film, scene::{Camera, Scene}, size::Bytes};\nlet s = \"crate::cli\";"),
        ["film", "scene", "size"]
    );
    assert_eq!(
        words("let x = crate::cli::usage(\"a \\\" crate::view\"); pm_tools::order::f(); use pm_formats::End;"),
        ["cli", "formats", "order"]
    );
    assert_eq!(split_tests("a/b.rs", "work #[cfg(test)] mod tests {}"), ("work ", "#[cfg(test)] mod tests {}"));
    assert_eq!(module("tools/src/cache/lines.rs"), Some("cache"));
    assert_eq!(module("tools/src/bin/pm-view.rs"), None);
}

#[test]
fn no_program_prints_past_its_output() {
    // `println!` panics when the reader has gone, and standard output is for results only.
    for (path, text) in sources("tools/src").into_iter().chain(sources("formats/src")) {
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
