//! From the accesses of a trace to line accesses: what the models are run over.

mod accesses;
mod attributes;
mod changes;
mod chunk;
mod place_table;
mod places;
mod space;

pub(crate) use accesses::{AccessBuffer, Accesses, CHUNK};
pub use attributes::Attributes;
pub(crate) use attributes::{Shape, Shapes};
pub use chunk::LineChunk;
pub(crate) use chunk::{Repeats, Resume, SearchStart};
pub(crate) use places::{PAGE_SHIFT, Places};
pub use space::LineSpace;

/// Lines that can be simulated: half of what 32 bits tell apart, so that the times of the LRU stack, one for each line at
/// least, leave room for time to pass.
pub(crate) const MAX_LINES: u64 = 1 << 31;

/// Makes room in a table by slot for as many slots as there are now.
#[inline]
pub(crate) fn grow<T: Clone>(table: &mut Vec<T>, space: &LineSpace, new: T) {
    if (table.len() as u64) < space.slots() {
        table.resize(space.slots() as usize, new);
    }
}

#[cfg(test)]
mod tests;
