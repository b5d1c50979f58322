//! Do searches read what is there, and the same whoever watches?

use super::{Verdict, cases, forms, photons, query_points, random_points};
use crate::{AnyMap, Nearest, SearchReads, Structure};
use pm_registry::Registry;

/// What is read lies in the regions of the map; every region is read by some search, and every photon found was looked at.
///
/// # Errors
/// The first fault that is found.
pub fn reads(structures: &Registry<dyn Structure>) -> Verdict {
    let photons = photons(random_points(3000, |[x, y, _]| [x, 0.0, y]));
    for form in forms(structures)? {
        let map = form.build(&photons, 50)?;
        let regions = map.regions(false);
        let mut read = vec![0; regions.len()];
        for photon in photons.iter().step_by(300) {
            let (mut found, mut reads) = (Nearest::new(50, f32::INFINITY), SearchReads::default());
            map.nearest_read(photon.position, &mut found, &mut reads);
            for (region, records) in reads.runs() {
                let Some(known) = regions.get(usize::from(region)) else {
                    return form.holds(false, || format!("reads region {region}, which is not there"));
                };
                // Packed or padded, there are not more records than these.
                let most = known.size / u64::from(known.record_size);
                let beyond = records.iter().find(|&&record| u64::from(record) >= most);
                form.holds(beyond.is_none(), || format!("reads record {beyond:?} of {} of {most}", known.name))?;
                read[usize::from(region)] += records.len();
            }
            let (seen, got) = (reads.photons_examined(), found.len() as u64);
            form.holds(seen >= got, || format!("finds {got} photons and looks at {seen}"))?;
        }
        let idle = regions.iter().zip(&read).find(|(_, reads)| **reads == 0);
        form.holds(idle.is_none(), || format!("never reads {}", idle.map_or("", |(region, _)| &region.name)))?;
    }
    Ok(())
}

/// Whoever watches a search, it finds the same, and reads the same; so does another map of the same photons.
///
/// # Errors
/// The first fault that is found.
pub fn observers(structures: &Registry<dyn Structure>) -> Verdict {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        for form in forms(structures)? {
            let (map, again) = (form.build(&photons, 10)?, form.build(&photons, 10)?);
            for &point in query_points(&positions).iter().step_by(5) {
                let told = |what: &str| format!("{name}, {point:?}: {what}");
                let watch = |how: &dyn Fn(&mut Nearest)| {
                    let mut found = Nearest::new(10, f32::INFINITY);
                    how(&mut found);
                    found.sorted()
                };
                let count = std::cell::Cell::new(0);
                let remembered = |map: &dyn AnyMap| {
                    let (mut found, mut reads) = (Nearest::new(10, f32::INFINITY), SearchReads::default());
                    map.nearest_read(point, &mut found, &mut reads);
                    let runs: Vec<(u16, Vec<u32>)> =
                        reads.runs().map(|(region, records)| (region, records.to_vec())).collect();
                    (found.sorted(), runs)
                };
                let (found, runs) = remembered(&*map);
                let blind = watch(&|found| map.nearest_blind(point, found));
                let counted = watch(&|found| {
                    let mut reads = 0u64;
                    map.nearest_seen(point, found, &mut reads);
                    count.set(reads);
                });
                form.holds(found == blind && found == counted, || told("finds other photons when it is watched"))?;
                let reads: usize = runs.iter().map(|(_, records)| records.len()).sum();
                form.holds(reads as u64 == count.get(), || told("reads otherwise for another observer"))?;
                form.holds((found, runs) == remembered(&*again), || told("does not do the same twice"))?;
            }
        }
    }
    Ok(())
}
