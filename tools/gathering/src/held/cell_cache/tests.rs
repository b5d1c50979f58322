//! Does the table find the cell that looking at all samples finds?

use super::*;
use crate::held::tests::{are_alike, places, samples_by_name};

#[test]
fn the_cell_is_that_of_looking_at_all_samples() {
    let mut found = 0;
    for (name, samples) in samples_by_name() {
        let (cache, cube) = (CellCache::build(&samples), Cube::around(&samples));
        for place in places(&samples) {
            let level = |halvings: u32| {
                let cell = |point| above(cube.finest(point), halvings);
                let inside = |sample: &&Sample| {
                    cell(sample.position) == cell(place.point) && facing(sample.normal) == facing(place.normal)
                };
                let cube = Cell { centre: cube.centre(cell(place.point), halvings), width: cube.width(halvings) };
                let samples: Vec<_> = samples.iter().filter(inside).collect();
                Voxel::of(&samples, cube, 1).at(place.point, place.normal, cube)
            };
            let last = cache.finest;
            let wanted = (0..=last).find(|&it| cube.width(it) <= f64::from(place.footprint)).unwrap_or(last);
            let expected = (wanted..=last).chain((0..wanted).rev()).find_map(level);
            let irradiance = cache.find(&place, 0, &mut SearchReads::default());
            assert!(are_alike(irradiance, expected), "{name}, {place:?}: {irradiance:?} for {expected:?}");
            found += u32::from(irradiance.is_some());
        }
    }
    assert!(found > 500, "{found}");
}

#[test]
fn a_lookup_reads_about_one_entry() {
    let (_, samples) = samples_by_name().into_iter().find(|(name, _)| *name == "floor").unwrap();
    let cache = CellCache::build(&samples);
    assert!(cache.table.len() >= 2 * cache.cells && cache.finest >= 3, "{} {}", cache.cells, cache.finest);
    let (mut reads, mut lookups) = (SearchReads::default(), 0);
    for sample in &samples {
        let place = Place { point: sample.position, normal: sample.normal, footprint: 0.1 };
        lookups += usize::from(cache.find(&place, 0, &mut reads).is_some());
    }
    // Half full, with linear probing: 1.5 entries for a key that is there (Knuth, volume 3, 6.4).
    assert!(
        lookups > samples.len() / 2 && reads.len() < 2 * samples.len(),
        "{lookups} of {}: {}",
        samples.len(),
        reads.len()
    );
}

#[test]
fn both_sides_of_a_sheet_are_told_apart() {
    // As a brick's voxels are not.
    let side = |y: f32, light: f64| {
        (0..256u16).map(move |i| Sample {
            position: [f32::from(i % 16), 0.0, f32::from(i / 16)],
            normal: [0.0, y, 0.0],
            irradiance: [light; 3],
            reach: 100.0,
        })
    };
    let samples: Vec<_> = side(1.0, 1.0).chain(side(-1.0, 5.0)).collect();
    let cache = CellCache::build(&samples);
    for (y, light) in [(1.0, 1.0), (-1.0, 5.0)] {
        let place = Place { point: [7.0, 0.0, 7.0], normal: [0.0, y, 0.0], footprint: 16.0 };
        let found = cache.find(&place, 0, &mut SearchReads::default()).expect("there are samples");
        assert!((found[0] / light - 1.0).abs() < 0.01, "{found:?}");
    }
}
