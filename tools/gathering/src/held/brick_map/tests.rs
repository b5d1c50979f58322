//! Does the octree find the voxel that looking at all samples finds?

use super::*;
use crate::held::tests::{are_alike, places, samples_by_name};

/// The samples of the cube that holds a point after so many halvings.
fn within<'a>(samples: &'a [Sample], cube: &Cube, point: [f32; 3], halvings: u32) -> Vec<&'a Sample> {
    let cell = |point| above(cube.finest(point), halvings);
    samples.iter().filter(|sample| cell(sample.position) == cell(point)).collect()
}

#[test]
fn the_voxel_is_that_of_looking_at_all_samples() {
    let mut found = 0;
    for (name, samples) in samples_by_name() {
        let (map, cube) = (BrickMap::build(&samples), Cube::around(&samples));
        for place in places(&samples) {
            // The levels that there are at this point, and the widest that is narrow enough.
            let is_there = |depth: u32| depth == 0 || within(&samples, &cube, place.point, depth).len() > 64;
            let levels = (0..=DEEPEST).take_while(|&depth| is_there(depth)).count() as u32;
            let wanted =
                (0..levels).find(|&depth| cube.width(depth + 3) <= f64::from(place.footprint)).unwrap_or(levels - 1);
            let expected = (wanted..levels).chain((0..wanted).rev()).find_map(|depth| {
                let halvings = depth + 3;
                let centre = cube.centre(above(cube.finest(place.point), halvings), halvings);
                let cell = Cell { centre, width: cube.width(halvings) };
                Voxel::of(&within(&samples, &cube, place.point, halvings), cell, 1).at(place.point, place.normal, cell)
            });
            let irradiance = map.find(&place, 3, &mut SearchReads::default());
            assert!(are_alike(irradiance, expected), "{name}, {place:?}: {irradiance:?} for {expected:?}");
            found += u32::from(irradiance.is_some());
        }
    }
    assert!(found > 500, "{found}");
}

#[test]
fn a_wide_footprint_reads_the_root_and_a_narrow_one_a_node_a_level() {
    let (_, samples) = samples_by_name().into_iter().find(|(name, _)| *name == "floor").unwrap();
    let map = BrickMap::build(&samples);
    assert!(map.levels >= 3, "{}", map.levels);
    let reads = |at: usize, footprint| {
        let place = Place { point: samples[at].position, normal: samples[at].normal, footprint };
        let mut reads = SearchReads::default();
        assert!(map.find(&place, 0, &mut reads).is_some());
        let of = |region| reads.runs().filter(|run| run.0 == region).map(|run| run.1.len()).sum::<usize>();
        (of(0), of(1))
    };
    assert_eq!(reads(5, 1.0), (1, 1));
    let narrow: Vec<_> = (0..samples.len()).map(|at| reads(at, 0.0)).collect();
    assert!(narrow.iter().all(|&(_, voxels)| voxels == 1));
    assert_eq!(narrow.iter().map(|&(nodes, _)| nodes).max(), Some(map.levels as usize));
}
