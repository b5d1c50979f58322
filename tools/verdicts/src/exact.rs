//! Experiments in full.

use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;

/// A table of sweeps with nothing cut into windows and nothing thinned.
pub(crate) const EXACT: Derivation = Derivation {
    word: "exact",
    help: "A table of sweeps with nothing cut into windows and nothing thinned",
    settings: &[],
    derive,
};

/// What is about samples stays as it is.
const ABOUT_SAMPLES: [&str; 5] = ["convergence", "failures", "frontier", "sampling", "structures"];

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let table = asked.table(0)?;
    if ABOUT_SAMPLES.contains(&table.stem()) {
        return Ok(table.text().to_owned().into());
    }
    let line = |line: &str| {
        let mut line = line.replace(" || ", " | ");
        for (option, word) in [("--only-tiles", ""), ("--window", ""), ("--warm-up", "{setting}")] {
            line = without(&line, &format!(" {option} "), word);
        }
        for option in ["--every", "--queries", "--batches"] {
            line = without(&line, &format!(" | pm-sample -q {option} "), "{m}");
        }
        let line = line.replace(",sampled,", ",full,").replace(",thinned,", ",full,").replace(",1/64,", ",1,");
        line.replace("--size 90x90", "--size 512x512") + "\n"
    };
    Ok(table.text().lines().map(line).collect::<String>().into())
}

/// A line without an option and its value: a number, or the word of a label, if there may be one.
fn without(line: &str, option: &str, label: &str) -> String {
    let mut rest = line;
    let mut kept = String::new();
    while let Some(at) = rest.find(option) {
        let value = &rest[at + option.len()..];
        let digits = value.len() - value.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let length = if !label.is_empty() && value.starts_with(label) { label.len() } else { digits };
        kept += &rest[..at];
        if length == 0 {
            kept += option;
        }
        rest = &value[length..];
    }
    kept + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::derived;

    #[test]
    fn samples_become_the_whole() {
        let text = "a,b,c,d,e\nx,sampled,--size 90x90 --only-tiles 32 --warm-up {setting} || pm-sample -q --every 5 --window 2 --warm-up 1 | pm-reorder,1/64,\n";
        assert_eq!(
            derived(&EXACT, &[("scripts/sweeps/table1.csv", text)], &[]).unwrap().text,
            "a,b,c,d,e\nx,full,--size 512x512 | pm-reorder,1,\n"
        );
    }
}
