//! Where a stream came from: one entry for each program that touched it.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::cell::Cell;
use std::fmt::Write as _;

/// What one program did to a stream. It holds nothing that could differ between two runs of the same work: no clock, no
/// host, no thread count.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Step {
    /// The program, such as `pm-reorder`.
    pub program: String,
    /// Its version with commit.
    pub version: String,
    /// The arguments that can change a record, as typed.
    pub arguments: Vec<String>,
    /// Seed of its random numbers, where it draws any.
    pub seed: Option<u64>,
    /// Name of the file that the stream was read from, as typed; `None` for a pipe, or where there was none to read.
    pub input: Option<String>,
    /// Other streams that were read as a whole, by the name typed: a photon map, say; `-` is standard input.
    #[serde(deserialize_with = "nested")]
    pub inputs: Vec<(String, Vec<Step>)>,
}

/// Streams read as a whole for streams read as a whole: as deep as a history goes.
const DEEPEST: u8 = 64;

thread_local! {
    /// How deep in a history the step is that is being read.
    static DEPTH: Cell<u8> = const { Cell::new(0) };
}

/// Reads the histories inside a history, none deeper than [`DEEPEST`]: a stack has an end.
fn nested<'de, D: Deserializer<'de>>(input: D) -> Result<Vec<(String, Vec<Step>)>, D::Error> {
    let depth = DEPTH.get();
    if depth == DEEPEST {
        return Err(D::Error::custom("a history is nested too deeply"));
    }
    DEPTH.set(depth + 1);
    let inputs = Vec::deserialize(input);
    DEPTH.set(depth);
    inputs
}

/// The history as commands that could be typed again: what was kept in files first, a line each, and the last pipe last.
#[must_use]
pub fn as_commands(history: &[Step]) -> String {
    let mut lines = String::new();
    let mut pipe = String::new();
    for step in history {
        if let Some(file) = step.input.as_ref().filter(|_| !pipe.is_empty()) {
            let _ = writeln!(lines, "{pipe} > {}", quoted(file));
            pipe.clear();
        }
        for (name, steps) in &step.inputs {
            let commands = as_commands(steps);
            let commands = commands.trim_end();
            if name == "-" {
                // The pipe that made it goes on here; the stream itself, then, was read from a file.
                let last = commands.rfind('\n').map_or(0, |end| end + 1);
                lines += &commands[..last];
                pipe.push_str(&commands[last..]);
            } else {
                let _ = writeln!(lines, "{commands} > {}", quoted(name));
            }
        }
        pipe += if pipe.is_empty() { "" } else { " | " };
        pipe += &quoted(&step.program);
        for argument in &step.arguments {
            pipe.push(' ');
            pipe += &quoted(argument);
        }
    }
    lines + &pipe + "\n"
}

/// A word as a POSIX shell would have it typed.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else if word.chars().any(char::is_control) {
        // As bash, zsh and ksh read it: what can be pasted shows all that it does.
        let spell = |c: char| match c {
            '\'' | '\\' => format!("\\{c}"),
            c if c.is_control() => c.to_string().bytes().map(|byte| format!("\\x{byte:02x}")).collect(),
            c => c.to_string(),
        };
        format!("$'{}'", word.chars().map(spell).collect::<String>())
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests;
