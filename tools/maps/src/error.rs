//! Why photons cannot be put into a map.

use pm_formats::Photon;
use pm_registry::ParameterError;

/// Why photons cannot be put into a map.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum BuildError {
    /// A coordinate that is not finite, or so large that squared distances overflow.
    #[error("photon {0} lies at a coordinate that is not finite or beyond 1e18; was the scene scaled wrongly?")]
    Coordinate(usize),
    /// Photon ids must fit 30 bits.
    #[error("{0} photons are more than a map can hold (1,073,741,823)")]
    TooMany(usize),
    /// More lines than can be told apart.
    #[error("the map would have more than 4,294,967,295 lines; ask for fewer slots or thresholds")]
    TooLarge,
    /// A line that has no room for what it is to hold.
    #[error("a line of {line} bytes is too small: {least} are needed")]
    Line {
        /// Its bytes.
        line: u32,
        /// The fewest that would do.
        least: u32,
    },
    /// Values that do not go together.
    #[error("{0}")]
    Parameter(#[source] ParameterError),
}

impl BuildError {
    /// A line has room for what needs `least` bytes.
    pub(super) const fn unless_fits(line: u32, least: u32) -> Result<(), Self> {
        if line < least { Err(Self::Line { line, least }) } else { Ok(()) }
    }
}

/// Photons that a map can be built from.
pub(super) fn check(photons: &[Photon]) -> Result<(), BuildError> {
    if photons.len() >= 1 << 30 {
        return Err(BuildError::TooMany(photons.len()));
    }
    // Also false for NaN.
    let usable = |photon: &Photon| photon.position.iter().all(|x| x.abs() <= 1e18);
    photons.iter().position(|photon| !usable(photon)).map_or(Ok(()), |index| Err(BuildError::Coordinate(index)))
}
