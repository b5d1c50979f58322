//! Do all structures of held irradiance give the light that is there, and read what they have?

use super::*;
use pm_maps::SearchReads;
use pm_random::Random;

const UP: [f32; 3] = [0.0, 1.0, 0.0];

/// A position and the normal there.
type Site = ([f32; 3], [f32; 3]);

/// Samples by name, with irradiance of their own each.
pub(super) fn samples_by_name() -> Vec<(&'static str, Vec<Sample>)> {
    let mut random = Random::new(&[21]);
    let mut of = |n: usize, reach: f32, at: fn([f32; 3]) -> Site| -> Vec<Sample> {
        let mut one = || {
            let (position, normal) = at([(); 3].map(|()| random.unit()));
            let light = f64::from(1.0 + random.unit());
            Sample { position, normal, irradiance: [2.0 * light, light, light], reach }
        };
        (0..n).map(|_| one()).collect()
    };
    vec![
        ("none", vec![]),
        ("one", of(1, 1.0, |_| ([0.5; 3], UP))),
        ("at one point", of(500, 1.0, |_| ([0.5; 3], UP))),
        ("floor", of(4000, 1.0, |[x, _, z]| ([x, 0.25, z], UP))),
        ("floor that reaches less", of(2000, 0.08, |[x, _, z]| ([x, 0.25, z], UP))),
        ("corner", of(3000, 0.3, |[x, y, z]| if y < 0.5 { ([x, 0.0, z], UP) } else { ([0.0, x, z], [1.0, 0.0, 0.0]) })),
        ("sheet", of(2000, 0.5, |[x, y, z]| ([x, 0.5, z], if y < 0.5 { UP } else { [0.0, -1.0, 0.0] }))),
        ("fog", of(1000, 0.5, |p| (p, UP))),
        ("a million away", of(1000, 1.0, |[x, _, z]| ([x + 1e6, 0.0, z - 1e6], UP))),
    ]
}

/// The same irradiance, but for RGBE's rounding, which may go by other random numbers; or none, both.
pub(super) fn are_alike(one: Option<[f64; 3]>, other: Option<[f64; 3]>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => (0..3).all(|i| (one[i] - other[i]).abs() <= other[0] / 64.0),
        (one, other) => one == other,
    }
}

/// Where to look: at samples, beside them and elsewhere, with narrow and wide footprints.
pub(super) fn places(samples: &[Sample]) -> Vec<Place> {
    let at = samples.iter().step_by((samples.len() / 25).max(1));
    let near = at.flat_map(|&Sample { position: [x, y, z], normal, .. }| {
        [([x, y, z], normal), ([x + 0.02, y, z - 0.01], normal), ([x, y + 0.01, z], [0.0, 0.6, 0.8])]
    });
    let elsewhere = [([0.5; 3], UP), ([1e9, -1e9, 0.0], UP)];
    let all = near.chain(elsewhere);
    all.flat_map(|(point, normal)| [0.0, 0.03, 0.13, 9.0].map(|footprint| Place { point, normal, footprint })).collect()
}

#[test]
fn every_structure_reads_what_it_has_and_the_same_twice() {
    for structure in irradiance_structures().iter() {
        for (name, samples) in samples_by_name() {
            let (cells, again) = (structure.hold(&samples), structure.hold(&samples));
            let regions = cells.regions();
            for place in places(&samples) {
                let look = |cells: &dyn CellMap| {
                    let mut reads = SearchReads::default();
                    let found = cells.find(&place, 2, &mut reads);
                    (found, reads.runs().map(|(region, records)| (region, records.to_vec())).collect::<Vec<_>>())
                };
                let (found, runs) = look(&*cells);
                assert_eq!((found, runs.clone()), look(&*again), "{} {name}", structure.word());
                assert!(!runs.is_empty(), "{} {name}: nothing comes from nothing", structure.word());
                for (region, records) in runs {
                    let (_, bytes, size, _) = &regions[usize::from(region) - 2];
                    assert!(records.iter().all(|&record| u64::from(record) < bytes / u64::from(*size)), "{name}");
                }
            }
        }
    }
}

#[test]
fn every_structure_finds_the_mean_of_what_its_footprint_covers() {
    // Irradiance 1 + x, in stripes of one sample to each equal share of the light: so samples lie denser on the right.
    let samples: Vec<_> = (0..128 * 128u16)
        .map(|i| {
            let share = (f64::from(i / 128) + 0.5) / 128.0;
            // Of the light between 0 and x, x + x^2/2, there are 3/2 in all.
            let x = (1.0 + 3.0 * share).sqrt() - 1.0;
            let position = [x as f32, 0.3, (f32::from(i % 128) + 0.5) / 128.0];
            Sample { position, normal: UP, irradiance: [1.0 + x; 3], reach: 2.0 }
        })
        .collect();
    for structure in irradiance_structures().iter() {
        let cells = structure.hold(&samples);
        for footprint in [0.02f32, 0.06, 0.13, 0.26] {
            let (mut sum, mut worst) = (0.0, 0.0f64);
            for i in 0..1000u16 {
                let x = (f32::from(i) + 0.5) / 1000.0;
                let place = Place { point: [x, 0.3, 0.37], normal: UP, footprint };
                let [found, ..] = cells.find(&place, 0, &mut SearchReads::default()).expect("a floor without edges");
                sum += found / 1000.0;
                worst = worst.max((found - 1.0 - f64::from(x)).abs());
            }
            let told = format!("{}, footprint {footprint}: {sum} {worst}", structure.word());
            // Cells tile the floor, so their means add up to its mean; and none is off by more than half its width, with RGBE's step.
            assert!((sum - 1.5).abs() < 0.01, "{told}");
            assert!(worst < f64::from(footprint) / 2.0 + 0.03, "{told}");
        }
        let place = |normal, y| Place { point: [0.5, y, 0.5], normal, footprint: 0.1 };
        let nothing = |place| assert_eq!(cells.find(&place, 0, &mut SearchReads::default()), None, "{place:?}");
        nothing(place([1.0, 0.0, 0.0], 0.3));
        nothing(place([0.0, -1.0, 0.0], 0.3));
        nothing(place(UP, 0.8));
    }
}

#[test]
fn the_documentation_lists_every_structure() {
    let (readme, table) = (include_str!("../../README.md"), irradiance_structures().table());
    assert!(readme.contains(&table), "tools/gathering/README.md should hold:\n{table}");
}
