//! Row by row: the paper's naive order.

use super::order::{Generative, GenerativeOrder, PixelRun};
use pm_formats::vocabulary::OrderLabel;
use pm_registry::{ParameterError, Registered as _, Values, registered};

registered! {
    /// Pixel by pixel, row by row; a row is a batch
    pub struct Scanline = "scanline";
}

impl GenerativeOrder for Scanline {
    fn make(&self, _: &Values, _: u32) -> Result<Box<dyn Generative>, ParameterError> {
        Ok(Box::new(*self))
    }
}

impl Generative for Scanline {
    fn label(&self) -> OrderLabel {
        OrderLabel::new(self.word())
    }

    fn batches(&self, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Vec<PixelRun>> + '_> {
        Box::new((0..height).map(move |row| vec![PixelRun { row, columns: 0..width }]))
    }

    fn batch_count(&self, [_, height]: [u32; 2]) -> u64 {
        height.into()
    }
}
