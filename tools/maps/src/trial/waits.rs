//! Do maps that tell what their reads wait for tell what can be?

use super::{Verdict, forms, photons, random_points};
use crate::{Nearest, SearchReads, Structure, WaitingReads};
use pm_formats::trace::Waits;
use pm_registry::Registry;
use std::collections::BTreeMap;

/// How far searches look.
const RADIUS: f32 = 0.03;

/// Reads are the same where what they wait for is remembered; there is a level above each; and a record that waits for one other
/// always waits for the same.
///
/// # Errors
/// The first fault that is found.
pub fn waits(structures: &Registry<dyn Structure>) -> Verdict {
    let photons = photons(random_points(3000, |[x, y, _]| [x, 0.0, y]));
    for form in forms(structures)? {
        let map = form.build(&photons, 50)?;
        if !map.tells_waits() {
            continue;
        }
        // The record that each record waits for.
        let mut parents = BTreeMap::new();
        for photon in photons.iter().step_by(100) {
            let (mut reads, mut waits) = (SearchReads::default(), vec![]);
            let mut eyes = WaitingReads::new(&mut reads, &mut waits);
            map.nearest_seen(photon.position, &mut Nearest::new(50, RADIUS), &mut eyes);
            let waiting = records(&reads);
            reads.clear();
            map.nearest_read(photon.position, &mut Nearest::new(50, RADIUS), &mut reads);
            let plain = records(&reads);
            form.holds(waiting == plain, || "reads otherwise where what reads wait for is remembered".to_owned())?;
            form.holds(waits.len() == plain.len(), || format!("{} of {} reads tell", waits.len(), plain.len()))?;
            let mut last = vec![];
            for (&record, waits) in plain.iter().zip(&waits) {
                let level = usize::from(waits.level());
                form.holds(level <= last.len(), || format!("{record:?} waits for a level that has no reads"))?;
                if level > 0 && !waits.is_for_all() {
                    let parent = *parents.entry(record).or_insert(last[level - 1]);
                    form.holds(parent == last[level - 1], || {
                        format!("{record:?} waits for {parent:?} here and for {:?} there", last[level - 1])
                    })?;
                }
                form.holds(*waits != Waits::ALL_BEFORE, || "one attempt is taken for two".to_owned())?;
                last.truncate(level);
                last.push(record);
            }
        }
    }
    Ok(())
}

/// Region and record of each read of a search.
fn records(reads: &SearchReads) -> Vec<(u16, u32)> {
    reads.runs().flat_map(|(region, records)| records.iter().map(move |&record| (region, record))).collect()
}
