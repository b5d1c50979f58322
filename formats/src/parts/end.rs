//! What the stages of the whole measured, from what those of its parts did.

use super::PartsError;
use super::rules::{OfParts, of_parts};
use crate::container::{End, Number, StageReport};

/// The stages of the whole.
///
/// # Errors
/// [`PartsError::Unfit`] if the parts had different stages, or do not tell alike what is of the whole.
pub(super) fn whole_stages(parts: &[(&str, &End)]) -> Result<Vec<StageReport>, PartsError> {
    let Some(&(first, end)) = parts.first() else { return Ok(vec![]) };
    let programs = |end: &End| end.stages.iter().map(|stage| stage.program.clone()).collect::<Vec<_>>();
    if let Some((name, _)) = parts.iter().find(|(_, other)| programs(other) != programs(end)) {
        return Err(PartsError::Unfit(format!("{first} and {name}: their end blocks speak of different programs")));
    }
    let stage = |at: usize| {
        let stages: Vec<(&str, &StageReport)> = parts.iter().map(|(name, end)| (*name, &end.stages[at])).collect();
        let measures = names(&stages)?.iter().map(|name| measure(name, &stages)).collect::<Result<_, _>>()?;
        Ok(StageReport { program: end.stages[at].program.clone(), measures })
    };
    (0..end.stages.len()).map(stage).collect()
}

/// The names of what was measured: a stage leaves out what never came to pass, so that the longest list has them all.
fn names<'a>(stages: &[(&str, &'a StageReport)]) -> Result<Vec<&'a str>, PartsError> {
    let of = |stage: &'a StageReport| stage.measures.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>();
    let all = stages.iter().map(|(_, stage)| of(stage)).max_by_key(Vec::len).unwrap_or_default();
    for (name, stage) in stages {
        let mut rest = all.iter();
        if let Some(odd) = of(stage).into_iter().find(|measure| !rest.any(|known| known == measure)) {
            return Err(PartsError::Unfit(format!("{name}: the other parts do not tell of `{odd}` where it does")));
        }
    }
    Ok(all)
}

/// What the parts tell of a measure together.
fn measure(name: &str, stages: &[(&str, &StageReport)]) -> Result<(String, Number), PartsError> {
    let told = |stage: &StageReport| stage.measures.iter().find(|(known, _)| known == name).map(|(_, number)| *number);
    let numbers: Vec<Option<Number>> = stages.iter().map(|(_, stage)| told(stage)).collect();
    let unfit = || PartsError::Unfit(format!("the parts do not tell alike of `{name}`"));
    let of_all = stages.iter().map(|(_, stage)| &stage.measures).max_by_key(|measures| measures.len());
    let how = of_parts(name, of_all.map_or(&[], |measures| &measures[..]));
    if how == OfParts::Same {
        let first = numbers[0].ok_or_else(unfit)?;
        let bits = |number: Number| match number {
            Number::Count(n) => (0, n),
            Number::Bytes(n) => (1, n),
            Number::Real(x) => (2, x.to_bits()),
        };
        let alike = numbers.iter().all(|number| number.is_some_and(|number| bits(number) == bits(first)));
        return if alike { Ok((name.to_owned(), first)) } else { Err(unfit()) };
    }
    let add = |a: u64, b: u64| match how {
        OfParts::Greatest => Some(a.max(b)),
        _ => a.checked_add(b),
    };
    let mut sum: Option<Number> = None;
    for number in numbers.into_iter().flatten() {
        let more = match (sum, number) {
            (None, number) => Some(number),
            (Some(Number::Count(a)), Number::Count(b)) => add(a, b).map(Number::Count),
            (Some(Number::Bytes(a)), Number::Bytes(b)) => add(a, b).map(Number::Bytes),
            _ => None,
        };
        sum = Some(more.ok_or_else(unfit)?);
    }
    Ok((name.to_owned(), sum.ok_or_else(unfit)?))
}
