//! Does a voxel hold the mean over its surface, and know what it does not know?

use super::*;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const CELL: Cell = Cell { centre: [0.5, 0.5, 0.5], width: 1.0 };

fn sample(position: [f32; 3], normal: [f32; 3], irradiance: f64) -> Sample {
    Sample { position, normal, irradiance: [irradiance, 2.0 * irradiance, irradiance / 2.0], reach: 10.0 }
}

fn voxel(samples: &[Sample]) -> Voxel {
    Voxel::of(&samples.iter().collect::<Vec<_>>(), CELL, 7)
}

#[test]
fn the_mean_is_that_over_the_area_however_dense_samples_lie() {
    // Photons of one power where irradiance is 0.1 + x: as dense as there is light, so an equal share of it to each. The mean over
    // the area is 0.6, that over samples 0.74.
    let samples: Vec<_> = (0..1000u16)
        .map(|i| {
            let light = (f64::from(i / 10) + 0.5) / 100.0 * 0.6;
            let x = (0.01 + 2.0 * light).sqrt() - 0.1;
            let position = [x as f32, 0.5, (f32::from(i % 10) + 0.5) / 10.0];
            Sample { irradiance: [0.1 + x; 3], ..sample(position, UP, 1.0) }
        })
        .collect();
    let found = voxel(&samples).at([0.5; 3], UP, CELL).unwrap();
    // RGBE has steps of 1/154 here.
    assert!(found.iter().all(|channel| (channel / 0.6 - 1.0).abs() < 0.015), "{found:?}");
}

#[test]
fn samples_that_do_not_agree_are_no_voxel() {
    let floor = sample([0.3, 0.4, 0.3], UP, 1.0);
    assert!(voxel(&[floor]).is_known() && !voxel(&[]).is_known());
    let other = |change: fn(&mut Sample)| {
        let mut sample = sample([0.6, 0.4, 0.6], UP, 1.0);
        change(&mut sample);
        voxel(&[floor, sample]).is_known()
    };
    assert!(other(|_| ()));
    assert!(!other(|sample| sample.normal = [1.0, 0.0, 0.0]), "round a corner");
    assert!(!other(|sample| sample.normal = [0.0, -1.0, 0.0]), "the ceiling below");
    assert!(other(|sample| sample.position[1] = 0.5) && !other(|sample| sample.position[1] = 0.8), "a step");
    // A photon whose neighbours all lie on other surfaces says nothing of what falls there.
    assert!(!voxel(&[sample([0.3, 0.4, 0.3], UP, 0.0)]).is_known());
}

#[test]
fn what_does_not_hang_together_is_not_mixed() {
    // Three bright samples before a wall at x = 0.5, whose reach ends there, and two dark ones behind it.
    let at = |x: f32, z: f32, light: f64| Sample { reach: (x - 0.5).abs(), ..sample([x, 0.5, z], UP, light) };
    let bright = [at(0.1, 0.2, 1.0), at(0.2, 0.5, 1.0), at(0.1, 0.7, 1.0)];
    let voxel = voxel(&[bright[0], at(0.9, 0.5, 0.01), bright[1], at(0.8, 0.6, 0.01), bright[2]]);
    let found = |x: f32| voxel.at([x, 0.5, 0.5], UP, CELL);
    assert!((found(0.2).unwrap()[0] - 1.0).abs() < 0.01);
    assert_eq!([0.51, 0.6, 0.8, 0.9].map(found), [None; 4], "the room behind the wall");
}

#[test]
fn a_voxel_counts_near_its_plane_as_far_as_a_sample_tells() {
    let known = |point: [f32; 3], normal: [f32; 3], reach: f32| {
        let alone = Sample { reach, ..sample([0.55, 0.3, 0.55], UP, 1.0) };
        voxel(&[alone]).at(point, normal, CELL).is_some()
    };
    assert!(known([0.99, 0.3, 0.01], UP, 1.0) && !known([1.01, 0.3, 0.5], UP, 1.0), "no farther than the cell");
    // Whole columns, an eighth wide: the next but one, whose far corner is 0.33 or so away.
    assert!(known([0.8, 0.3, 0.55], UP, 0.36) && !known([0.8, 0.3, 0.55], UP, 0.31));
    assert!(known([0.5, 0.42, 0.5], UP, 1.0) && !known([0.5, 0.44, 0.5], UP, 1.0));
    assert!(known([0.5, 0.18, 0.5], UP, 1.0) && !known([0.5, 0.16, 0.5], UP, 1.0));
    assert!(!known([0.5, 0.3, 0.5], [1.0, 0.0, 0.0], 1.0) && !known([0.5, 0.3, 0.5], [0.0, -1.0, 0.0], 1.0));
    // A slanting plane has longer pieces in its columns.
    let slant = [0.6, 0.8, 0.0];
    let steep = |reach| voxel(&[Sample { reach, ..sample([0.5, 0.5, 0.5], slant, 1.0) }]);
    let at = [0.5 + 0.08, 0.5 - 0.06, 0.5 + 0.05];
    assert!(steep(0.3).at(at, slant, CELL).is_some() && steep(0.15).at(at, slant, CELL).is_none());
}
