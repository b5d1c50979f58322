//! What to find out besides the caches' own counts, and what was found.

use super::{Curve, Row};

/// What to find out in the same reading of the trace, besides the rows of the caches. By default nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measures {
    /// Line sizes, in bytes, to find the miss curve of.
    pub curves: Vec<u32>,
}

/// All that a simulation found.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// One row for each cache, in the order they were given.
    pub rows: Vec<Row>,
    /// One curve for each line size, in the order they were given.
    pub curves: Vec<Curve>,
}
