//! The bars at the top of a page: a few numbers, side by side on a logarithmic scale.

use super::written::evaluate;
use crate::ReportError;
use crate::expression::Evaluator;
use minijinja::{Value, context};
use serde::Deserialize;

/// A few numbers that tell the story of a page in ten seconds.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bars {
    /// What they measure.
    pub title: String,
    /// The numbers, from top to bottom.
    pub bar: Vec<Bar>,
}

/// A number.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bar {
    /// What it is of.
    pub label: String,
    /// The number above zero, as in a text but without braces.
    pub value: String,
    /// What stands for it; with expressions in braces, as a text has them.
    pub text: String,
}

/// Part of the width that the shortest bar has.
const SHORTEST: f64 = 0.06;

/// What the template needs: each bar with its share of the width.
///
/// # Errors
/// If a value is no number above zero.
pub(super) fn bars(
    bars: &Bars,
    evaluator: &Evaluator,
    plain: impl Fn(&str) -> Result<String, ReportError>,
) -> Result<Value, ReportError> {
    let mut numbers = vec![];
    for bar in &bars.bar {
        let text = evaluate(&bar.value, evaluator)?.text;
        let number = text.parse().ok().filter(|&number: &f64| number > 0.0);
        numbers
            .push(number.ok_or_else(|| ReportError::asked(format!("a bar of `{text}`: a number above 0 is needed")))?);
    }
    let logarithms = || numbers.iter().map(|number: &f64| number.log10());
    let (least, most) = (logarithms().fold(f64::INFINITY, f64::min), logarithms().fold(f64::NEG_INFINITY, f64::max));
    let mut rows = vec![];
    for (bar, logarithm) in bars.bar.iter().zip(logarithms()) {
        let share = if most > least { (logarithm - least) / (most - least) } else { 1.0 };
        let percent = format!("{:.1}", 100.0 * (SHORTEST + (1.0 - SHORTEST) * share));
        rows.push(context! { label => plain(&bar.label)?, text => plain(&bar.text)?, percent });
    }
    Ok(context! { title => plain(&bars.title)?, rows })
}

#[cfg(test)]
mod tests {
    use super::super::Description;
    use crate::sheet::Sheets;

    fn page(bars: &str) -> Result<String, crate::ReportError> {
        let toml = format!("title = 'T'\n[bars]\ntitle = 'Bytes'\n{bars}\n[[section]]\nheading = 'H'\n");
        Description::parse(&toml)?.html(&Sheets::default(), "test")
    }

    #[test]
    fn bars_are_as_long_as_their_logarithms() {
        let html = page("bar = [{label='a',value='1',text='one'},{label='b',value='100',text='{{ 100 | .1f }}'},{label='c',value='10',text='ten'}]").unwrap();
        for found in ["width:6.0%", "width:100.0%", "width:53.0%", ">100.0<", "Bytes"] {
            assert!(html.contains(found), "{found}: {html}");
        }
        assert!(html.find("class=\"bars\"").unwrap() < html.find("<section").unwrap());
    }

    #[test]
    fn what_has_no_logarithm_is_refused() {
        for value in ["0", "-1", "'x'"] {
            let error = page(&format!("bar = [{{label='a',value=\"{value}\",text='x'}}]")).unwrap_err();
            assert!(error.to_string().contains("a number above 0"), "{error}");
        }
    }
}
