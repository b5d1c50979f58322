//! Which files an expression needs, without reading any.

use super::outer;
use crate::ReportError;
use minijinja::value::{Kwargs, Object};
use minijinja::{Environment, Value};
use std::sync::{Arc, Mutex, PoisonError};

/// A row that has every column, and the same in all.
#[derive(Debug)]
struct AnyRow;

impl Object for AnyRow {
    fn get_value(self: &Arc<Self>, _: &Value) -> Option<Value> {
        Some(Value::from(1))
    }
}

/// The names that an expression asks the function `word` for, in the order in which it needs them.
///
/// # Errors
/// If it cannot be read.
pub fn names_asked(text: &str, word: &'static str) -> Result<Vec<String>, ReportError> {
    let names = Arc::new(Mutex::new(vec![]));
    let noted = Arc::clone(&names);
    let mut environment = Environment::new();
    environment.add_function(word, move |name: String, _: Kwargs| {
        noted.lock().unwrap_or_else(PoisonError::into_inner).push(name);
        Value::from_object(AnyRow)
    });
    let outcome = environment.compile_expression(text).and_then(|expression| expression.eval(()));
    outcome.map_err(|error| outer(&error, &[]))?;
    let names = std::mem::take(&mut *names.lock().unwrap_or_else(PoisonError::into_inner));
    Ok(names)
}
