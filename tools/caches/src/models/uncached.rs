//! No cache: only the distinct lines are left to count.

use super::{CacheModel, LineCounts};
use crate::{
    lines::{LineChunk, LineSpace, grow},
    misses::Misses,
};

/// Counts lines touched for the first time. Fetches are counted by the record, outside of the model.
pub(crate) struct Uncached {
    touched: Vec<bool>,
    compulsory: u64,
}

impl Uncached {
    pub(crate) fn new(space: &LineSpace) -> Self {
        Self { touched: vec![false; space.slots() as usize], compulsory: 0 }
    }
}

impl CacheModel for Uncached {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, _: &mut Misses) {
        grow(&mut self.touched, space, false);
        let mut first = 0;
        for &slot in chunk.slots() {
            first += u64::from(!std::mem::replace(&mut self.touched[slot as usize], true));
        }
        if counted {
            self.compulsory += first;
        }
    }

    fn finish(self: Box<Self>) -> Vec<LineCounts> {
        vec![LineCounts { compulsory: self.compulsory, ..LineCounts::default() }]
    }

    fn repeats_matter(&self) -> bool {
        false
    }
}
