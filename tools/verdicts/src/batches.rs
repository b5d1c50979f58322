//! Means over independent repetitions.

use crate::derivation::fail;
use crate::measured::{CHANNELS, Measured};
use crate::table::csv;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_sweep::significant;

/// Means of rows of the same name over files that hold independent repetitions, and their standard errors.
pub(crate) const BATCHES: Derivation = Derivation {
    word: "batches",
    help: "Means of rows of one name over files of independent repetitions, and their standard errors",
    settings: &[],
    derive,
};

/// What a name was in the repetitions.
struct Repeated {
    name: String,
    values: Vec<[f64; 3]>,
}

impl Repeated {
    fn sum(&self, channel: usize) -> f64 {
        self.values.iter().map(|value| value[channel]).sum()
    }

    fn mean(&self, channel: usize) -> f64 {
        self.sum(channel) / self.values.len() as f64
    }

    /// The standard error of the mean.
    fn error(&self, channel: usize) -> f64 {
        let number = self.values.len() as f64;
        let squares: f64 = self.values.iter().map(|value| value[channel] * value[channel]).sum();
        let sum = self.sum(channel);
        let variance = (squares - sum * sum / number) / (number - 1.0);
        (variance.max(0.0) / number).sqrt()
    }
}

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut all: Vec<Repeated> = vec![];
    for table in asked.tables {
        for Measured { part, value, .. } in crate::measured::read(table.sheet())? {
            let numbers = value.iter().zip(CHANNELS).map(|(value, channel)| {
                let missing = || ReportError::read(format!("{}: {part} has no number in {channel}", table.stem()));
                value.ok_or_else(missing)
            });
            let numbers = numbers.collect::<Result<Vec<f64>, ReportError>>()?;
            let value = [numbers[0], numbers[1], numbers[2]];
            match all.iter_mut().find(|other| other.name == part) {
                Some(known) => known.values.push(value),
                None => all.push(Repeated { name: part, values: vec![value] }),
            }
        }
    }
    if let Some(once) = all.iter().find(|repeated| repeated.values.len() < 2) {
        return fail(format!("{} stands in one file only, which tells no error", once.name));
    }
    let row = |repeated: Repeated| {
        let mean = |channel| significant(repeated.mean(channel), 9);
        let error = |channel| significant(repeated.error(channel), 6);
        [repeated.name.clone(), mean(0), mean(1), mean(2), error(0), error(1), error(2)]
    };
    Ok(csv(["name", "r", "g", "b", "se_r", "se_g", "se_b"], all.into_iter().map(row)).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::derived;

    #[test]
    fn a_mean_has_its_standard_error() {
        let (one, two) = ("name,r,g,b\nfloor,1,2,0\nall,5,5,5\n", "name,r,g,b\nall,5,5,5\nfloor,3,2,0.5\n");
        // Two values that are 2 apart: a spread of the square root of 2, over that again.
        let expected = "name,r,g,b,se_r,se_g,se_b\nfloor,2,2,0.25,1,0,0.25\nall,5,5,5,0,0,0\n";
        assert_eq!(derived(&BATCHES, &[("1.csv", one), ("2.csv", two)], &[]).unwrap().text, expected);
    }

    #[test]
    fn one_repetition_or_no_number_is_none() {
        let error = |text: &str| derived(&BATCHES, &[("out/1.csv", text)], &[]).unwrap_err().to_string();
        assert_eq!(error("name,r,g,b\nfloor,1,2,0\n"), "floor stands in one file only, which tells no error");
        assert_eq!(error("x0,y0,x1,y1,r,g,b\n0,0,4,4,nan,2,0\n"), "1: 0 0 4 4 has no number in r");
    }
}
