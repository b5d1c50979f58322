//! Column by column: the one file of a generative order.

use pm_formats::vocabulary::OrderLabel;
use pm_orders::{Generative, GenerativeOrder, PixelRun};
use pm_registry::{Domain, Parameter, ParameterError, Registered as _, Values, registered};

registered! {
    /// Column by column, some at a time; these are a batch
    pub struct Columns = "columns" with [WIDE];
}

const WIDE: Parameter = Parameter::new("wide", Domain::count(1, 99), "columns of a batch").or("1");

struct Strips(u32);

impl GenerativeOrder for Columns {
    fn make(&self, values: &Values, _: u32) -> Result<Box<dyn Generative>, ParameterError> {
        Ok(Box::new(Strips(values.count(WIDE.name))))
    }
}

impl Generative for Strips {
    fn label(&self) -> OrderLabel {
        OrderLabel::new(Columns.word())
    }

    fn batches(&self, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Vec<PixelRun>> + '_> {
        let columns = (0..width).step_by(self.0 as usize).map(move |x| x..(x + self.0).min(width));
        let runs = move |columns: std::ops::Range<u32>| {
            columns.flat_map(|x| (0..height).map(move |row| PixelRun { row, columns: x..x + 1 })).collect()
        };
        Box::new(columns.map(runs))
    }
}
