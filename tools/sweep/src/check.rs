//! What nobody uses: a label that nothing stands for would name results by what they do not depend on.

use crate::line::{Given, Label};
use crate::pipe::uses;
use crate::point::files_in;
use crate::template::Template;
use crate::words::{Meaning, nearest};
use crate::{Column, Stage, Table, TableError, Words};
use pm_registry::Choice as _;

/// Whether what runs depends on the text of a stage.
pub(crate) fn matters(given: &Given, stage: Stage) -> bool {
    let Some(command) = given.texts.get(&Stage::Command) else { return stage != Stage::Point };
    let plain = |text: Option<&Template>| text.map_or(String::new(), |text| text.filled(|_| None));
    let (photons, queries) = uses(&plain(Some(command)), &plain(given.texts.get(&Stage::Queries)));
    match stage {
        Stage::Command | Stage::Needs => true,
        Stage::Photons => photons,
        Stage::Queries => queries,
        Stage::Scene => photons || queries,
        Stage::Point | Stage::Stream | Stage::Gather | Stage::Cache => false,
    }
}

/// Whether a text that matters has this name in braces.
fn is_said(given: &Given, name: &str) -> bool {
    let mut texts = given.texts.iter().filter(|(stage, _)| matters(given, **stage)).map(|(_, text)| text);
    texts.any(|text| text.names().any(|other| other == name))
}

/// Whether what runs depends on the words of a label.
pub(crate) fn uses_label(given: &Given, label: &Label, words: &Words) -> bool {
    if is_said(given, &label.name) {
        return true;
    }
    let mut others = given.labels.iter().filter(|other| !other.remark);
    let says = |(stage, text): (Stage, &Template)| matters(given, stage) && text.names().any(|name| name == label.name);
    if others.any(|other| other.words.iter().any(|word| additions(words, other, word).into_iter().any(says))) {
        return true;
    }
    // Each of its words has to do what it does; a dash says that it shall not.
    let does = |(stage, _): (Stage, &Template)| matters(given, stage) || given.shut.contains(&stage);
    let stands = |word: &String| {
        let additions = additions(words, label, word);
        additions.is_empty() || additions.into_iter().any(does)
    };
    words.has(&label.name) && label.words.iter().all(stands)
}

/// What a word of a label adds to the stages.
fn additions<'a>(words: &'a Words, label: &Label, word: &str) -> Vec<(Stage, &'a Template)> {
    let addition = |meaning: &'a Meaning| match meaning {
        Meaning::Adds(stage, text) => Some((*stage, text)),
        Meaning::Said(_) => None,
    };
    words.meanings(&label.name, word).filter_map(addition).collect()
}

/// That each label of a line is used or a remark, each of its stages matters, and whatever stands in braces is known.
pub(crate) fn line(table: &Table, given: &Given, words: &Words) -> Result<(), TableError> {
    let error = |what: String| Err(table.error(given.line, what));
    for label in &given.labels {
        if label.remark {
            if is_said(given, &label.name) {
                let name = &label.name;
                return error(format!("`{name}` is a remark here, and {{{name}}} uses it: take away its parentheses"));
            }
            continue;
        }
        for word in label.words.iter().filter(|word| !word.is_empty()) {
            words.know(table, given.line, &label.name, word)?;
        }
        if !label.words[0].is_empty() && !uses_label(given, label, words) {
            let name = &label.name;
            return error(format!(
                "nothing in this line uses `{name}`: say {{{name}}} where its words belong, or `({})` if they are a remark",
                label.words.join(" ")
            ));
        }
    }
    for (&stage, text) in &given.texts {
        if !matters(given, stage) && stage != Stage::Point {
            return error(format!("the command does not use what stands in the column `{}`", stage.word()));
        }
        for name in text.names() {
            match given.label(name) {
                Some(label) if label.words[0].is_empty() => {
                    return error(format!("nothing stands for {{{name}}} in this line"));
                }
                None if !stage.files().contains(&name) => {
                    let labels: Vec<String> = table.labels().map(|label| format!("{{{label}}}")).collect();
                    let known = [labels.join(", "), files_in(stage)].join(", ");
                    let known = known.trim_matches([',', ' ']);
                    return error(format!("{{{name}}} stands for nothing in `{}`; there are {known}", stage.word()));
                }
                _ => {}
            }
        }
    }
    Ok(())
}

/// That each column is used in some line, or is a remark.
pub(crate) fn columns(table: &Table, lines: &[Given], words: &Words) -> Result<(), TableError> {
    for column in &table.columns {
        let Column::Label(name) = column else { continue };
        let used = |given: &Given| {
            given
                .label(name)
                .is_some_and(|label| label.remark || !label.words[0].is_empty() && uses_label(given, label, words))
        };
        if lines.iter().any(used) {
            continue;
        }
        let stages = Stage::ALL.iter().map(|stage| stage.word);
        let meant = match nearest(name, stages.chain(words.labels())) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("say {{{name}}} where its words belong, or call it `({name})` if it is a remark"),
        };
        return Err(table.error(table.head, format!("no line uses the column `{name}`: {meant}")));
    }
    Ok(())
}
