//! What every structure of photon maps must pass, whoever wrote it: [`all`], in a test of the crate that adds one.
//!
//! ```no_run
//! # let structures = pm_maps::structures();
//! // With a structure of one's own: pm_maps::structures().with(&MyStructure)
//! pm_maps::trial::all(&structures).unwrap();
//! ```

#[cfg(test)]
mod batches;
mod cases;
mod form;
mod neighbours;
mod reads;
mod waits;

#[cfg(test)]
pub(crate) use batches::batch_finds_what_each_query_finds;
pub use cases::{cases, photons, query_points, random_points};
pub use form::{Form, forms};
pub use neighbours::{hints, neighbours};
pub use reads::{observers, reads};
pub use waits::waits;

use crate::{BuildError, Structure};
use pm_registry::Registry;

/// A map does not do what a map does.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{map}: {what}")]
pub struct Fault {
    /// The map, as it was asked for.
    pub map: String,
    /// What it did, and on what.
    pub what: String,
}

/// What a trial says.
pub type Verdict = Result<(), Fault>;

/// All trials.
///
/// # Errors
/// The first fault that is found.
pub fn all(structures: &Registry<dyn Structure>) -> Verdict {
    [refusals, observers, reads, waits, neighbours, hints].into_iter().try_for_each(|trial| trial(structures))
}

/// Photons whose distances cannot be compared are refused.
///
/// # Errors
/// The first fault that is found.
pub fn refusals(structures: &Registry<dyn Structure>) -> Verdict {
    for form in forms(structures)? {
        for (index, coordinate) in [(7, f32::NAN), (3, 1e19), (0, f32::NEG_INFINITY)] {
            let mut list = photons(random_points(10, |p| p));
            list[index].position[1] = coordinate;
            let refused = form.built(&list, 10).err();
            let expected = Some(BuildError::Coordinate(index));
            form.holds(refused == expected, || format!("a coordinate of {coordinate} is not refused: {refused:?}"))?;
        }
    }
    Ok(())
}
