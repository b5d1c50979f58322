//! Columns of the results: what each is called, whether the table shows it, and its value.

mod of_caches;
mod of_curves;
mod totals;

pub(super) use of_caches::of_caches;
pub(super) use of_curves::of_curves;

use pm_report::{Column, Format, Table, Value};

/// Significant digits of ratios in the table.
const DIGITS: u8 = 5;

/// A column of results of type `T`.
struct Of<T> {
    column: Column,
    in_table: bool,
    /// What the table calls it, if not by its name.
    head: Option<&'static str>,
    value: Box<dyn Fn(&T) -> Value>,
}

/// Columns in order.
struct Columns<T>(Vec<Of<T>>);

impl<T> Columns<T> {
    /// None yet.
    const fn new() -> Self {
        Self(vec![])
    }

    /// Whether there is one of these names.
    fn has_any(&self, names: &[String]) -> bool {
        self.0.iter().any(|of| names.contains(&of.column.name))
    }

    fn text(mut self, name: &str, in_table: bool, value: impl Fn(&T) -> String + 'static) -> Self {
        let value = Box::new(move |of: &T| Value::Text(value(of)));
        self.0.push(Of { column: Column::text(name), in_table, head: None, value });
        self
    }

    fn number(mut self, name: &str, in_table: bool, value: impl Fn(&T) -> Value + 'static) -> Self {
        self.0.push(Of { column: Column::number(name), in_table, head: None, value: Box::new(value) });
        self
    }

    fn count(self, name: &str, in_table: bool, value: impl Fn(&T) -> u64 + 'static) -> Self {
        self.number(name, in_table, move |of| Value::Int(value(of)))
    }

    /// A count that there may not be, not in the table.
    fn count_perhaps(self, name: &str, value: impl Fn(&T) -> Option<u64> + 'static) -> Self {
        self.number(name, false, move |of| perhaps(value(of)))
    }

    fn ratio(self, name: &str, in_table: bool, value: impl Fn(&T) -> f64 + 'static) -> Self {
        self.number(name, in_table, move |of| Value::Float(value(of), DIGITS))
    }

    /// The table has the last column too.
    fn in_table(mut self) -> Self {
        if let Some(last) = self.0.last_mut() {
            last.in_table = true;
        }
        self
    }

    /// The last column has another name in the table.
    fn headed(mut self, head: &'static str) -> Self {
        if let Some(last) = self.0.last_mut() {
            last.head = Some(head);
        }
        self
    }

    /// The table of these results, with the columns that the format shows.
    fn table(self, format: Format, results: &[T]) -> Table {
        let shown: Vec<Of<T>> = self.0.into_iter().filter(|of| of.in_table || format != Format::Table).collect();
        let head = |of: &Of<T>| match of.head {
            Some(name) if format == Format::Table => Column { name: name.to_owned(), ..of.column.clone() },
            _ => of.column.clone(),
        };
        let mut table = Table::new(shown.iter().map(head).collect());
        for result in results {
            table.push(shown.iter().map(|of| (of.value)(result)).collect());
        }
        table
    }
}

/// A count that there may not be.
fn perhaps(count: Option<u64>) -> Value {
    count.map_or(Value::Float(f64::NAN, DIGITS), Value::Int)
}
