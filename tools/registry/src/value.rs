//! What can be said to a parameter.

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Said or not.
    Flag(bool),
    /// A whole number.
    Count(u64),
    /// Above 0 and at most 1.
    Share(f64),
    /// In scene units.
    Length(f32),
    /// The word that is listed, whichever was understood.
    Word(&'static str),
    /// The name of a file, or `-`.
    File(String),
}
