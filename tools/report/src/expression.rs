//! Numbers of sheets, and what is reckoned with them: `row('out/all.csv', order='scanline').fetches / 1000`.
//!
//! The language is minijinja's, which is Python's for what is needed here: numbers, names, `+ - * /`, brackets, comparisons.
//! `row(FILE, COLUMN=VALUE, ...)` is the row of a sheet that has these values, and `.COLUMN` behind it what stands there.
//! Where several rows fit they have to say the same. An [`Evaluator`] keeps count of the places that a value came from.

mod asked;
mod place;
mod row;

use crate::ReportError;
use crate::sheet::{Sheets, number};
use minijinja::value::{Kwargs, Object, ValueKind};
use minijinja::{Environment, ErrorKind, UndefinedBehavior, Value};
use std::collections::BTreeMap;
use std::error::Error as _;
use std::sync::Arc;

pub use asked::names_asked;
pub use place::Place;
use place::Places;
use row::{Row, conditions};

/// A name that stands for an expression, and where that was said.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The expression; names in it are not known.
    pub text: String,
    /// The line of the description.
    pub line: Option<usize>,
}

/// Names for expressions.
pub type Names = BTreeMap<String, Definition>;

/// A value, and how it came.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The number, if it is one.
    pub number: Option<f64>,
    /// As it is written: the field of the only place, else the number with all its digits.
    pub text: String,
    /// Where it is from: the expression, its names replaced by what they stand for.
    pub source: String,
    /// The places that were looked up, in the order in which they were needed.
    pub places: Vec<Place>,
}

/// Evaluates expressions over sheets.
#[derive(Debug)]
pub struct Evaluator {
    environment: Arc<Environment<'static>>,
    names: Arc<Names>,
    places: Places,
}

/// The function of every evaluator.
const ROW: &str = "row";

impl Evaluator {
    /// Expressions over these sheets, that know these names.
    #[must_use]
    pub fn new(sheets: &Sheets, names: Names) -> Self {
        let mut environment = Environment::new();
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        let evaluator = Self { environment: Arc::new(environment), names: Arc::new(names), places: Places::default() };
        evaluator.with_rows(ROW, sheets, str::to_owned)
    }

    /// The same, with a function `word` that is as `row`, but says where the file of a name is.
    #[must_use]
    pub fn with_rows(mut self, word: &'static str, sheets: &Sheets, file: fn(&str) -> String) -> Self {
        let (sheets, places) = (sheets.clone(), self.places.clone());
        Arc::make_mut(&mut self.environment).add_function(word, move |name: String, chosen: Kwargs| {
            let row = conditions(&chosen).and_then(|conditions| {
                let sheet = sheets.get(&file(&name)).map_err(inner)?;
                Row::choose(sheet, format!("{word}({:?}", Value::from(&*name)), &conditions, places.clone())
                    .map_err(inner)
            });
            row.map(Value::from_object)
        });
        self
    }

    /// Evaluates an expression.
    ///
    /// # Errors
    /// If it cannot be read, or a file, row or column is not there, or what is to be reckoned with is not a number.
    pub fn evaluate(&self, text: &str) -> Result<Found, ReportError> {
        self.places.clear();
        let outcome = self.value(text);
        let places = self.places.taken();
        let value = outcome.map_err(|error| outer(&error, &places))?;
        let only = if let [place] = &places[..] { Some(place) } else { None };
        let source = self.source(text);
        let (number, text) = match value.kind() {
            ValueKind::Number => {
                let number = f64::try_from(value).ok().filter(|number| number.is_finite());
                let number = number.ok_or_else(|| ReportError::asked(format!("{source} is not a number")))?;
                // As the file has it, whatever zeros stand behind.
                let field = only.map(Place::field).filter(|field| self::number(field) == Some(number));
                (Some(number), field.map_or_else(|| number.to_string(), str::to_owned))
            }
            ValueKind::String | ValueKind::Bool => (None, value.to_string()),
            _ => {
                return Err(ReportError::asked(format!(
                    "{source} is no number; a column, such as .fetches, is to follow"
                )));
            }
        };
        Ok(Found { number, text, source, places })
    }

    fn value(&self, text: &str) -> Result<Value, minijinja::Error> {
        let expression = self.environment.compile_expression(text)?;
        let functions = |name: &str| self.environment.globals().any(|(global, _)| global == name);
        let unknown = |name: &&String| !self.names.contains_key(*name) && !functions(name);
        if let Some(name) = expression.undeclared_variables(false).iter().filter(unknown).min() {
            return Err(inner(ReportError::asked(format!(
                "`{name}` is neither a name of [numbers] nor a place such as row('FILE', COLUMN='VALUE').COLUMN"
            ))));
        }
        expression.eval(Value::from_object(Known { names: self.names.clone(), environment: self.environment.clone() }))
    }

    /// The expression with what its names stand for; a word behind a dot is a column, and one in quotes no name.
    fn source(&self, text: &str) -> String {
        let in_word = |c: char| c.is_alphanumeric() || c == '_';
        let (mut source, mut quote) = (String::new(), None);
        for piece in text.trim().split_inclusive(|c| !in_word(c)) {
            let word = piece.trim_end_matches(|c| !in_word(c));
            let definition = self.names.get(word).filter(|_| quote.is_none() && !source.ends_with('.'));
            let meaning = definition.map(|definition| definition.text.trim());
            match meaning {
                Some(sum) if [" + ", " - ", " * ", " / "].iter().any(|sign| sum.contains(sign)) => {
                    source.push_str(&format!("({sum})"));
                }
                _ => source.push_str(meaning.unwrap_or(word)),
            }
            source.push_str(&piece[word.len()..]);
            for mark in piece.chars().filter(|&c| c == '"' || c == '\'') {
                quote = if quote == Some(mark) { None } else { quote.or(Some(mark)) };
            }
        }
        source
    }
}

/// The names of an expression, each evaluated when it is needed.
#[derive(Debug)]
struct Known {
    names: Arc<Names>,
    environment: Arc<Environment<'static>>,
}

impl Object for Known {
    fn get_value(self: &Arc<Self>, key: &Value) -> Option<Value> {
        let definition = self.names.get(key.as_str()?)?;
        let value = self.environment.compile_expression(&definition.text).and_then(|named| named.eval(()));
        Some(value.unwrap_or_else(|error| inner(outer(&error, &[]).at_line(definition.line)).into()))
    }
}

/// An error of ours on its way through the library.
fn inner(error: ReportError) -> minijinja::Error {
    minijinja::Error::new(ErrorKind::InvalidOperation, error.to_string()).with_source(error)
}

/// An error of the library's as ours; the one that was ours before, if it was.
fn outer(error: &minijinja::Error, places: &[Place]) -> ReportError {
    let mut cause = error.source();
    while let Some(found) = cause {
        if let Some(ours) = found.downcast_ref::<ReportError>() {
            return ours.clone();
        }
        cause = found.source();
    }
    let what = error.detail().map_or_else(|| error.kind().to_string(), str::to_owned);
    ReportError::asked(match (error.kind(), places.iter().find(|place| number(place.field()).is_none())) {
        (ErrorKind::SyntaxError, _) => format!(
            "{what}; a place such as row('FILE', COLUMN='VALUE').COLUMN, a name or a number is expected, with + - * / between"
        ),
        (_, Some(word)) => not_a_number(word),
        _ => what,
    })
}

/// What is said of a word that is to be a number.
pub(crate) fn not_a_number(place: &Place) -> String {
    format!("{place} is `{}`, which is not a number", place.field())
}

#[cfg(test)]
mod tests;
