//! The points of a line: one for each combination of its words.

use crate::line::Given;
use crate::names::{misread_in_target, stays_below};
use crate::pipe::{Texts, with, work};
use crate::stage::{OUT, PHOTONS, QUERIES};
use crate::words::Meaning;
use crate::{Stage, Words, Work};

/// A point of a sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Its name, which names its file.
    pub name: String,
    /// The line of the table that it is of.
    pub line: u64,
    /// A word for each label of the table.
    pub words: Vec<String>,
    /// What it runs.
    pub work: Work,
}

/// All combinations of a line's words, those of the last label changing fastest.
pub(crate) fn combinations(given: &Given) -> Vec<Vec<&str>> {
    let mut all = vec![vec![]];
    for label in &given.labels {
        let mut longer = vec![];
        for front in &all {
            longer.extend(label.words.iter().map(|word| [&front[..], &[word.as_str()]].concat()));
        }
        all = longer;
    }
    all
}

/// The point of these words. Its command still has `{out}` in it.
pub(crate) fn point(given: &Given, chosen: &[&str], words: &Words) -> Result<Point, String> {
    let stands_for = |name: &str| {
        let at = given.labels.iter().position(|label| label.name == name)?;
        Some(chosen[at])
    };
    let mut texts: Texts = given.texts.iter().map(|(stage, text)| (*stage, text.filled(stands_for))).collect();
    let mut said = vec![];
    for (label, word) in given.labels.iter().zip(chosen).filter(|(label, _)| !label.remark) {
        for meaning in words.meanings(&label.name, word) {
            match meaning {
                Meaning::Adds(stage, _) if given.shut.contains(stage) => {}
                Meaning::Adds(stage, text) => {
                    let old = texts.remove(stage).unwrap_or_default();
                    texts.insert(*stage, added(*stage, &old, &text.filled(stands_for)));
                }
                Meaning::Said(text) => said.push((label, word, text)),
            }
        }
    }
    let work = work(&texts)?;
    let says = |text: &str| {
        let commands = work.streams.iter().map(|stream| &stream.command).chain([&work.command]);
        commands.into_iter().any(|command| command.contains(text))
    };
    if let Some((label, word, text)) = said.into_iter().find(|(_, _, text)| !says(text)) {
        return Err(format!(
            "`{word}` adds nothing by itself, and no stage says `{text}`: nothing stands for this {}",
            label.name
        ));
    }
    let name = match texts.get(&Stage::Point) {
        Some(name) => name.clone(),
        None => chosen.iter().fold(String::new(), |name, word| with(&name, word, ".")),
    };
    if let Some(letter) = misread_in_target(&name) {
        return Err(format!(
            "the point `{name}` names a file, and make would misread `{letter}`: give it another name in the column `point`"
        ));
    }
    if !stays_below(&name) {
        return Err(format!("the point `{name}` names no file below out/"));
    }
    Ok(Point { name, line: given.line, words: chosen.iter().map(|&word| word.to_owned()).collect(), work })
}

/// An option goes to the stage's own program, which is the first of a pipe; a program goes to the end.
fn added(stage: Stage, text: &str, more: &str) -> String {
    if stage == Stage::Stream {
        return with(text, more, " | ");
    }
    let (options, pipe) = text.split_at(text.find('|').unwrap_or(text.len()));
    with(&with(options.trim_end(), more, " "), pipe, " ")
}

/// The names that braces may hold in a stage, beside labels, in words.
pub(crate) fn files_in(stage: Stage) -> String {
    let braced = |file: &&str| format!("{{{file}}}");
    [PHOTONS, QUERIES, OUT]
        .iter()
        .filter(|file| stage.files().contains(file))
        .map(braced)
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_go_to_the_first_program_and_programs_to_the_end() {
        assert_eq!(
            added(Stage::Queries, "--size 8x8 || pm-sample", "--order tiled"),
            "--size 8x8 --order tiled || pm-sample"
        );
        assert_eq!(added(Stage::Queries, "| pm-sample", "--order tiled"), "--order tiled | pm-sample");
        assert_eq!(added(Stage::Gather, "", "-k 5"), "-k 5");
        assert_eq!(added(Stage::Stream, "pm-reorder a", "pm-reorder b"), "pm-reorder a | pm-reorder b");
    }
}
