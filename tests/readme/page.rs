//! A page of documentation: its blocks, and which of them are commands.

use std::path::{Path, PathBuf};
use std::{fs, iter};

/// A page, by its path from the top of the repository.
pub(super) struct Page {
    pub(super) path: String,
    pub(super) text: String,
}

/// Commands that stand on a page, and what the page says they print, if it does.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Script {
    pub(super) commands: String,
    pub(super) printed: Option<String>,
}

/// What a line of commands begins with; other blocks are what is printed, or read, or drawn.
const COMMANDS: [&str; 20] = [
    "cargo",
    "cd",
    "dramsim3main",
    "export",
    "for",
    "gcc",
    "head",
    "hyperqueue",
    "hq",
    "llvm-mc",
    "make",
    "pip",
    "python3",
    "salloc",
    "spike",
    "srun",
    "valgrind",
    "zstd",
    "bash",
    "man",
];

impl Page {
    /// All pages of the repository.
    pub(super) fn all() -> Vec<Self> {
        fn visit(folder: &Path, found: &mut Vec<PathBuf>) {
            for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
                let path = entry.expect("an entry").path();
                let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                if path.is_dir() && !name.starts_with('.') && !["target", "out"].contains(&&*name) {
                    visit(&path, found);
                } else if name.ends_with(".md") {
                    found.push(path);
                }
            }
        }
        let root = root();
        let mut found = vec![];
        visit(&root, &mut found);
        found.sort();
        let page = |path: PathBuf| Self {
            text: fs::read_to_string(&path).expect("a text"),
            path: path.strip_prefix(&root).expect("below the root").display().to_string(),
        };
        found.into_iter().map(page).collect()
    }

    /// Its commands, from top to bottom.
    pub(super) fn scripts(&self) -> Vec<Script> {
        let mut scripts: Vec<Script> = vec![];
        // Does what comes next follow commands, with nothing but empty lines between?
        let mut follows = false;
        for chunk in chunks(&self.text) {
            match chunk {
                Chunk::Prose => follows = false,
                Chunk::Block(text) if is_commands(&text) => {
                    scripts.push(Script { commands: text, printed: None });
                    follows = true;
                }
                Chunk::Block(text) => {
                    if let Some(script) = scripts.last_mut().filter(|_| follows) {
                        // Empty lines are part of what is printed.
                        let printed = script.printed.take().map_or(String::new(), |before| format!("{before}\n"));
                        script.printed = Some(printed + &text);
                    }
                }
            }
        }
        scripts
    }
}

pub(super) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository")
}

#[derive(Debug, PartialEq, Eq)]
enum Chunk {
    Prose,
    /// Lines that are indented by four, without that.
    Block(String),
}

fn chunks(text: &str) -> Vec<Chunk> {
    let mut chunks = vec![];
    let mut block = String::new();
    for line in text.lines().chain(iter::once("")) {
        if let Some(line) = line.strip_prefix("    ") {
            block.push_str(line);
            block.push('\n');
        } else {
            if !block.is_empty() {
                chunks.push(Chunk::Block(std::mem::take(&mut block)));
            }
            if !line.is_empty() {
                chunks.push(Chunk::Prose);
            }
        }
    }
    chunks
}

fn is_commands(block: &str) -> bool {
    let first = block.split_whitespace().next().unwrap_or_default();
    first.starts_with("pm-") || COMMANDS.contains(&first)
}

#[test]
fn what_is_indented_below_commands_is_what_they_print() {
    let text = "# A\n\nSo:\n\n    pm-view a\n    pm-view b\n\n    one\n    two\n\n    three\n\nThen:\n\n    a drawing\n\n    make b\n";
    let page = Page { path: String::new(), text: text.into() };
    let expected = Script { commands: "pm-view a\npm-view b\n".into(), printed: Some("one\ntwo\n\nthree\n".into()) };
    assert_eq!(page.scripts(), [expected, Script { commands: "make b\n".into(), printed: None }]);
}
