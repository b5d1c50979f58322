//! The rectangles of a picture that something is known of.

use crate::{Asked, Derivation, Derived, accuracy};
use pm_report::ReportError;

/// The rectangles of an experiment's picture that something is known of, as options of pm-view.
pub(crate) const REGIONS: Derivation = Derivation {
    word: "regions",
    help: "The rectangles of the picture of an `experiment` that something is known of, as options of pm-view",
    settings: &["experiment"],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let experiment: String = asked.needed("experiment")?;
    let rectangles = accuracy::rectangles(asked.table(0)?, &experiment)?;
    Ok(rectangles.iter().map(|rectangle| format!("--mean {rectangle}\n")).collect::<String>().into())
}
