//! The rectangles of a picture that something is known of.

use crate::{Asked, Derivation, Derived, VerdictError};

/// The rectangles of an experiment's picture that something is known of, as options of pm-view.
pub(crate) const REGIONS: Derivation = Derivation {
    word: "regions",
    help: "The rectangles of the picture of an `experiment` that something is known of, as options of pm-view",
    settings: &["experiment"],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let experiment: String = asked.needed("experiment")?;
    let known = asked.table(0)?.rows().filter(|row| row.text("experiment") == experiment);
    let parts = known.flat_map(|row| row.text("part").split(" - ").map(|part| part.replace(' ', ",")));
    Ok(parts.map(|part| format!("--mean {part}\n")).collect::<String>().into())
}
