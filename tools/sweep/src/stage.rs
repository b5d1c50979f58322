//! The columns that say what runs.

pm_registry::choices! {
    /// A column of a table that says what runs; every other column is a label.
    #[derive(Debug, PartialOrd, Ord, Hash)]
    pub enum Stage {
        /// The point's name; without it, its labels joined by dots
        Point = "point",
        /// What pm-photons and pm-queries render: an OBJ file, and options of both
        Scene = "scene",
        /// Options of pm-photons
        Photons = "photons",
        /// Options of pm-queries, and a pipe that its queries go through
        Queries = "queries",
        /// What queries go through before they are gathered, such as `pm-reorder hilbert --per batch`
        Stream = "stream",
        /// Options of pm-gather
        Gather = "gather",
        /// Options of pm-cachesim
        Cache = "cache",
        /// What prints the rows instead of the pipe of pm-gather and pm-cachesim
        Command = "command",
        /// Further files that must be there first
        Needs = "needs",
    }
}

/// The file of photons, in a cell.
pub(crate) const PHOTONS: &str = "photons";
/// The file of queries, in a cell.
pub(crate) const QUERIES: &str = "queries";
/// The target's name without `.csv`, in a command.
pub(crate) const OUT: &str = "out";

impl Stage {
    /// Files, beside labels, that a cell of this column may have in braces.
    pub(crate) const fn files(self) -> &'static [&'static str] {
        match self {
            Self::Queries | Self::Stream => &[PHOTONS],
            Self::Gather | Self::Cache => &[PHOTONS, QUERIES],
            Self::Command => &[PHOTONS, QUERIES, OUT],
            Self::Point | Self::Scene | Self::Photons | Self::Needs => &[],
        }
    }

    /// Whether its text stands in a command that a shell reads.
    pub(crate) const fn is_run(self) -> bool {
        !matches!(self, Self::Point | Self::Needs)
    }
}
