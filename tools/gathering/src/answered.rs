//! What a block of queries became, or why it became nothing.

use super::Lookups;
use pm_film::film::{Overflow, Units};
use pm_formats::{Block, Number, StageReport, Tally};
use std::ops::AddAssign;

/// What a block of queries became.
pub struct Answered {
    /// The block of the trace that belongs to it, with number and digest of its searches.
    pub trace: Option<(Block, Tally)>,
    /// Number and digest of the queries.
    pub tally: Tally,
    /// What is to be added to which pixel.
    pub contributions: Vec<(u32, Units)>,
    /// What is to be added to which sum of the cached irradiance.
    pub cached: Vec<(u32, Units)>,
    /// What was done.
    pub counts: SearchCounts,
    /// What the lookups were like, if that is wanted.
    pub lookups: Option<Lookups>,
}

/// What searches did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SearchCounts {
    /// Records read.
    pub accesses: u64,
    /// Attempts made, at least one for each search.
    pub attempts: u64,
    /// Searches that found fewer than k photons.
    pub short: u64,
    /// Estimates that could not be made because the photons' disc has no area.
    pub no_area: u64,
    /// Queries of whose surface no site of precomputed irradiance knew, so that they searched.
    pub no_site: u64,
}

impl SearchCounts {
    /// Adds so many searches that were made beforehand to a stage's report.
    pub(super) fn report_build(&self, stage: StageReport, searches: u64) -> StageReport {
        stage
            .with("build_searches", Number::Count(searches))
            .with("build_attempts", Number::Count(self.attempts))
            .with("build_accesses", Number::Count(self.accesses))
            .with("build_searches_without_area", Number::Count(self.no_area))
    }
}

impl AddAssign for SearchCounts {
    fn add_assign(&mut self, other: Self) {
        self.accesses += other.accesses;
        self.attempts += other.attempts;
        self.short += other.short;
        self.no_area += other.no_area;
        self.no_site += other.no_site;
    }
}

/// Why a block could not be answered.
#[derive(Debug)]
pub enum Fault {
    /// It does not hold usable queries.
    Damaged(&'static str),
    /// A pixel's light does not fit the film.
    TooBright(Overflow),
    /// Its trace cannot be written.
    Format(pm_formats::Error),
}
