//! How a plot looks.

/// How a plot looks.
#[derive(Clone, Debug)]
pub struct Look {
    /// What stands above it; may be empty.
    pub title: String,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Are points joined by lines?
    pub lines: bool,
    /// Is the frontier drawn, as steps?
    pub frontier: bool,
    /// Is there a legend beside it?
    pub legend: bool,
}
