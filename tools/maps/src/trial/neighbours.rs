//! Are the photons found those that looking at every photon finds, or at least photons?

use super::{Form, Verdict, cases, forms, photons, query_points};
use crate::geometry::distance_squared;
use crate::{Blind, BruteForce, Carry, Nearest, Search, Structure};
use pm_formats::Photon;
use pm_registry::Registry;
use std::collections::BTreeSet;

/// Exact maps find the neighbours that brute force finds; others find photons that are there, within the bound, each once
/// and at its distance.
///
/// # Errors
/// The first fault that is found.
pub fn neighbours(structures: &Registry<dyn Structure>) -> Verdict {
    let forms = forms(structures)?;
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        let oracle = BruteForce::build(&photons).expect("photons that can be compared");
        let points = query_points(&positions);
        for form in &forms {
            let map = form.build(&photons, 10)?;
            form.holds(map.len() == photons.len(), || format!("{name}: holds {} photons", map.len()))?;
            let exact = map.is_exact();
            form.holds(exact || !form.chosen.entry.is_exact(), || format!("{name}: a map that is not exact"))?;
            for k in [1, 10, 100, photons.len().max(1), photons.len() + 1] {
                let (mut found, mut expected) = (Nearest::new(k, 0.0), Nearest::new(k, 0.0));
                for max_dist in [0.0, 1e-7, 0.05, f32::INFINITY] {
                    for &point in points.iter().step_by(if k > 100 { 7 } else { 2 }) {
                        let asked = || format!("{name}, k {k}, max {max_dist}, {point:?}");
                        Search::new(k, max_dist).run(&*map, point, &mut found, &mut Blind);
                        if exact {
                            Search::new(k, max_dist).run(&oracle, point, &mut expected, &mut Blind);
                            let same = found.sorted() == expected.sorted();
                            form.holds(same, || format!("{}: other neighbours than brute force", asked()))?;
                        } else {
                            let (radius, some) = (max_dist * max_dist, found.sorted());
                            are_photons(form, &photons, point, (k, radius), &some, asked)?;
                        }
                    }
                }
            }
        }
    }
    Ok(())
}

/// Not more than k photons that are there, within the bound, each once and at its distance.
fn are_photons(
    form: &Form,
    photons: &[Photon],
    point: [f32; 3],
    (k, bound): (usize, f32),
    found: &[(f32, u32)],
    asked: impl Fn() -> String,
) -> Verdict {
    let ids: BTreeSet<u32> = found.iter().map(|&(_, id)| id).collect();
    form.holds(found.len() <= k && ids.len() == found.len(), || format!("{}: finds a photon twice", asked()))?;
    let right = |&(distance, id): &(f32, u32)| {
        let photon = photons.get(id as usize);
        photon.is_some_and(|photon| distance == distance_squared(point, photon.position)) && distance <= bound
    };
    form.holds(found.iter().all(right), || format!("{}: finds what is not there", asked()))
}

/// Where a search starts, and what it knows of the one before, change no neighbour of an exact map, and what is known
/// is enough.
///
/// # Errors
/// The first fault that is found.
pub fn hints(structures: &Registry<dyn Structure>) -> Verdict {
    let forms = forms(structures)?;
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        for form in &forms {
            let map = form.build(&photons, 20)?;
            if !map.is_exact() {
                continue;
            }
            let (mut found, mut expected) = (Nearest::new(20, 0.0), Nearest::new(20, 0.0));
            for max_dist in [0.03, f32::INFINITY] {
                let plain = Search::new(20, max_dist);
                let small = |start| Search { start, ..plain };
                for search in [plain, plain.fit_start(&*map, &photons), small(1e-9), small(0.01)] {
                    let mut carry = Carry::default();
                    for point in query_points(&positions) {
                        plain.run(&*map, point, &mut expected, &mut Blind);
                        search.run(&*map, point, &mut found, &mut Blind);
                        let told = |how: &str| format!("{name}, {search:?}, {point:?}: other neighbours {how}");
                        form.holds(found.sorted() == expected.sorted(), || told("from another start"))?;
                        let attempts = carry.run(&search, &*map, point, &mut found, &mut Blind);
                        form.holds(found.sorted() == expected.sorted(), || told("after another search"))?;
                        // Only a hint below what is known can be too small.
                        form.holds(attempts == 1 || search != plain, || told("at first"))?;
                    }
                }
            }
        }
    }
    Ok(())
}
