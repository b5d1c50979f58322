//! Texts and tables made of tables: a template of minijinja's, and CSV files.
//!
//! A template knows the tables as `tables`, by number or by the name of their file (`tables["full"]`), and what was set. A
//! table is its rows; `.find(COLUMN=VALUE)` is the first row with these values, if there is one, `.name` what it is called.
//! Of a row, `.COLUMN` is a whole number, a number or a word, and `.csv("COLUMN", ...)` are fields as the file has them.
//! `require(CONDITION, WHY)` notes what is not as it has to be.

mod rows;

use crate::ReportError;
use crate::expression::outer;
use crate::sheet::Sheet;
use minijinja::syntax::SyntaxConfig;
use minijinja::{Environment, UndefinedBehavior, Value};
use rows::Tables;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// What came of a template.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rendered {
    /// The text.
    pub text: String,
    /// What is not as the template says it has to be.
    pub failures: Vec<String>,
}

/// Renders a template with these tables, and settings by their names.
///
/// # Errors
/// If it cannot be read, or asks for what is not there: with its line.
pub fn render(
    template: &str,
    tables: Vec<Arc<Sheet>>,
    settings: &BTreeMap<String, String>,
) -> Result<Rendered, ReportError> {
    let mut environment = Environment::new();
    let syntax = SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).keep_trailing_newline(true).build();
    environment.set_syntax(syntax.map_err(|error| outer(&error, &[]))?);
    environment.set_undefined_behavior(UndefinedBehavior::SemiStrict);
    let failures = Arc::new(Mutex::new(vec![]));
    let noted = Arc::clone(&failures);
    environment.add_function("require", move |condition: Value, why: String| {
        if !condition.is_true() {
            noted.lock().unwrap_or_else(PoisonError::into_inner).push(why);
        }
        ""
    });
    let mut context: BTreeMap<&str, Value> =
        settings.iter().map(|(name, value)| (&**name, Value::from(&**value))).collect();
    context.insert("tables", Value::from_object(Tables(tables)));
    let rendered = environment.template_from_str(template).and_then(|template| template.render(Value::from(context)));
    let text = rendered.map_err(|error| outer(&error, &[]).at_line(error.line()))?;
    let failures = std::mem::take(&mut *failures.lock().unwrap_or_else(PoisonError::into_inner));
    Ok(Rendered { text, failures })
}

#[cfg(test)]
mod tests;
