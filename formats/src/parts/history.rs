//! The history of the whole: that of its parts, without the word that makes a part, read as one pipe.

use super::PartsError;
use crate::history::{Step, as_commands};
use crate::vocabulary::Part;

/// The option by which parts are made.
const OPTION: &str = "--part";

/// The steps that one machine would have made. Where parts were kept in files of different names on their way, it would
/// have been a pipe.
///
/// # Errors
/// [`PartsError::Unfit`] if they were not made in the same way.
pub(super) fn whole_history(parts: &[(&str, &[Step])]) -> Result<Vec<Step>, PartsError> {
    let Some(&(first, steps)) = parts.first() else { return Ok(vec![]) };
    let differ = |name: &str, a: &Step, b: &Step| {
        let command = |step: &Step| as_commands(&[Step { inputs: vec![], ..step.clone() }]).trim_end().to_owned();
        let (mut one, mut other) = (command(a), command(b));
        if one == other && a.version != b.version {
            (one, other) = (format!("{one} (version {})", a.version), format!("{other} (version {})", b.version));
        }
        let why = if one == other { format!("`{one}` read other streams") } else { format!("`{one}` and `{other}`") };
        Err(PartsError::Unfit(format!("{first} and {name} were not made in the same way: {why}")))
    };
    let mut whole = vec![];
    for at in 0..parts.iter().map(|(_, steps)| steps.len()).max().unwrap_or(0) {
        let mut of_all: Vec<Step> = vec![];
        for &(name, other) in parts {
            let (Some(_), Some(step)) = (steps.get(at), other.get(at)) else {
                return Err(PartsError::Unfit(format!("{first} and {name} went through different programs")));
            };
            of_all.push(if at == 0 { without_part(step) } else { step.clone() });
        }
        if of_all.iter().any(|step| step.input != of_all[0].input) {
            of_all = of_all.iter().map(piped).collect();
        }
        if let Some((odd, step)) = of_all.iter().enumerate().find(|(_, step)| **step != of_all[0]) {
            return differ(parts[odd].0, &of_all[0], step);
        }
        whole.extend(of_all.into_iter().next());
    }
    Ok(whole)
}

/// The step of the whole.
fn without_part(step: &Step) -> Step {
    let mut arguments = vec![];
    let mut words = step.arguments.iter();
    while let Some(word) = words.next() {
        if word == "--" {
            arguments.push(word.clone());
            arguments.extend(words.cloned());
            break;
        }
        let joined = word.strip_prefix(OPTION).and_then(|rest| rest.strip_prefix('='));
        let is_part = |text: &str| text.parse::<Part>().is_ok();
        match joined {
            Some(value) if is_part(value) => {}
            None if word == OPTION && words.as_slice().first().is_some_and(|value| is_part(value)) => {
                words.next();
            }
            _ => arguments.push(word.clone()),
        }
    }
    Step { arguments, ..step.clone() }
}

/// The step as if its stream had come by a pipe.
fn piped(step: &Step) -> Step {
    let mut arguments = step.arguments.clone();
    if let Some(name) = &step.input
        && let Some(at) = arguments.iter().rposition(|word| word == name)
    {
        arguments.remove(at);
    }
    Step { arguments, input: None, ..step.clone() }
}
