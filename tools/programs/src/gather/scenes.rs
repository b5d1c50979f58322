//! Are photons and queries of one scene?

use super::args::Args;
use crate::cli::{named, usage};
use pm_formats::Header;
use pm_formats::vocabulary::meaning;

/// Refuses photons of another scene than that of the queries, as far as both say what scene they are of. What was imported does
/// not say; of streams of the first version only the bounds are known.
///
/// # Errors
/// If they are of two scenes.
pub(super) fn compare(args: &Args, photons: &Header, queries: &Header) -> anyhow::Result<()> {
    let (first, rest) = (&args.first, &args.rest);
    match (photons.meaning(meaning::SCENE), queries.meaning(meaning::SCENE)) {
        (Some(one), Some(other)) if one != other => Err(usage(format!(
            "{} and {}: of two scenes, whose geometry, materials or lights differ; make both from the same files and options, \
             or give --anyway",
            named(&first.photons),
            named(&first.queries)
        ))),
        (Some(_), Some(_)) => Ok(()),
        _ => {
            let imported = |header: &Header| header.history.first().is_some_and(|step| step.program == "pm-view");
            if photons.bounds != queries.bounds && !imported(photons) && !imported(queries) {
                rest.common.remark("the photons and the queries are not of the same scene: their bounds differ");
            }
            Ok(())
        }
    }
}
