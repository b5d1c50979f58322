//! Is light neither lost nor made on the way of photons?

use super::super::{PathPhoton, PhotonPaths};
use super::scenes::{cuboid, shipped, written};
use crate::scene::Scene;

/// Flux that photons bring to surfaces, and its standard error from batches of paths, as a fraction of what is emitted;
/// per material name and channel.
pub(in crate::transport) fn incident(
    scene: &Scene,
    paths: u64,
    class: impl Fn(&PathPhoton) -> usize,
    classes: usize,
) -> Vec<[(f64, f64); 3]> {
    incident_by(&PhotonPaths::new(scene, 1), scene, paths, class, classes)
}

/// The same, by these paths.
pub(in crate::transport) fn incident_by(
    tracer: &PhotonPaths<'_>,
    scene: &Scene,
    paths: u64,
    class: impl Fn(&PathPhoton) -> usize,
    classes: usize,
) -> Vec<[(f64, f64); 3]> {
    const BATCHES: u64 = 32;
    let emitted = scene.emitted_flux();
    let mut sums = vec![[[0f64; BATCHES as usize]; 3]; classes];
    for path in 0..paths {
        tracer.trace(path, |photon| {
            for channel in 0..3 {
                let share = f64::from(photon.power[channel]) / emitted[channel] * BATCHES as f64 / paths as f64;
                sums[class(&photon)][channel][(path % BATCHES) as usize] += share;
            }
        });
    }
    let statistics = |batches: [f64; BATCHES as usize]| {
        let n = BATCHES as f64;
        let mean = batches.iter().sum::<f64>() / n;
        let variance = batches.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        (mean, (variance / n).sqrt())
    };
    sums.into_iter().map(|channels| channels.map(statistics)).collect()
}

pub(in crate::transport) fn assert_within_errors(found: [(f64, f64); 3], expected: [f64; 3], what: &str) {
    for channel in 0..3 {
        let (mean, error) = found[channel];
        // Four standard errors: one check in 16,000 fails by chance, and the seed is fixed.
        assert!(error < 0.03 * expected[channel].max(0.05), "{what}: error {error}");
        assert!(
            (mean - expected[channel]).abs() < 4.0 * error + 1e-4,
            "{what} {channel}: {mean} +- {error}, {expected:?}"
        );
    }
}

#[test]
fn in_a_furnace_incident_flux_is_a_geometric_series() {
    // All light is caught again: incident / emitted = 1 / (1 - rho), for three reflectances at once. A roulette that does
    // not make up per channel, or a cap on depth, fails in blue, where it takes over 20 bounces.
    let (scene, _) = shipped("furnace.obj");
    let found = incident(&scene, 100_000, |_| 0, 1);
    assert_within_errors(found[0], [1.25, 2.0, 5.0], "furnace");
}

#[test]
fn mirrors_and_glass_in_a_furnace_neither_make_nor_swallow_light() {
    let mtl = "newmtl wall\nKd 0.2 0.5 0.8\nKe 1 1 1\nillum 1\n\
               newmtl glass\nNi 1.5\nTf 1 1 1\nillum 7\nnewmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\n";
    for body in ["glass", "mirror"] {
        let obj = cuboid(1, -1.0, 1.0, "wall", false) + &cuboid(9, -0.4, 0.4, body, true);
        let scene = written(&obj, mtl);
        let found = incident(&scene, 100_000, |_| 0, 1);
        assert_within_errors(found[0], [1.25, 2.0, 5.0], body);
    }
}

#[test]
fn a_tinted_mirror_takes_its_share() {
    // A closed box, half of whose walls are a mirror that keeps 90 %, the rest black-ish: compared with a closed form for
    // the infinite corridor of two facing plates would need the plates to be infinite; instead the balance is checked:
    // what arrives at diffuse walls minus what they send back, plus what mirrors swallow, is what was emitted.
    let mtl = "newmtl wall\nKd 0.5 0.5 0.5\nKe 1 1 1\nillum 1\nnewmtl mirror\nKd 0 0 0\nKs 0.5 0.5 0.5\nillum 3\n";
    let obj = cuboid(1, -1.0, 1.0, "wall", false) + &cuboid(9, -0.5, 0.5, "mirror", true);
    let scene = written(&obj, mtl);
    let found = incident(&scene, 100_000, |_| 0, 1);
    // Radiosity of two grey bodies, one inside the other: F = A1 / A2 = 1/4 of the walls' light meets the inner cube and
    // half of that comes back. Incident = emitted + rho incident of which 1 - F / 2 arrives: x = 0.875 (1 + 0.5 x).
    let expected = 0.875 / (1.0 - 0.5 * 0.875);
    let (mean, error) = found[0][0];
    // The inner cube is flat-sided: light is not quite evenly spread, but the room is convex and its walls alike.
    assert!((mean / expected - 1.0).abs() < 0.02 + 4.0 * error, "{mean} +- {error}, {expected}");
}

#[test]
fn fluxes_of_the_diffuse_box_are_those_of_an_independent_particle_tracer() {
    // Incident flux / emitted flux, 16 x 2^20 photons of a particle tracer that shares no code with this project.
    let expected = [
        ("floor", [0.134_921 + 0.084_703_6, 0.134_919 + 0.076_523_4, 0.134_919 + 0.049_068_3]),
        ("back", [0.171_928 + 0.132_842, 0.171_926 + 0.120_507, 0.171_926 + 0.079_515_2]),
        ("left", [0.172_627 + 0.129_979, 0.172_625 + 0.108_18, 0.172_625 + 0.083_870_4]),
        ("right", [0.191_432 + 0.142_343, 0.191_43 + 0.130_524, 0.191_43 + 0.102_102]),
        ("ceiling", [0.171_79, 0.150_899, 0.115_646]),
    ];
    let (scene, _) = shipped("cornell-diffuse.obj");
    let wall = |photon: &PathPhoton| {
        let p = photon.position;
        let on = [p.y == 0.0, p.z == -0.5, p.x == -0.5, p.x == 0.5, p.y == 1.0];
        on.iter().position(|&on| on).unwrap_or(5)
    };
    let found = incident(&scene, 400_000, wall, 6);
    for ((name, expected), found) in expected.into_iter().zip(found) {
        assert_within_errors(found, expected, name);
    }
}

#[test]
fn packing_keeps_the_sum_of_powers() {
    let (scene, _) = shipped("cornell-diffuse.obj");
    let paths = PhotonPaths::new(&scene, 3);
    let (mut exact, mut packed, mut id) = ([0f64; 3], [0f64; 3], 0);
    for path in 0..50_000 {
        paths.trace(path, |photon| {
            let power = paths.pack(id, &photon).unwrap().power();
            for channel in 0..3 {
                exact[channel] += f64::from(photon.power[channel]);
                packed[channel] += power[channel];
            }
            id += 1;
        });
    }
    for channel in 0..3 {
        // Each rounding is off by at most 1/128; their mean by 1/128 / sqrt(12 n).
        assert!((packed[channel] / exact[channel] - 1.0).abs() < 2e-4, "{packed:?} {exact:?}");
    }
}

#[test]
fn caustics_are_what_came_by_mirrors_and_glass_alone() {
    let (scene, _) = shipped("cornell.obj");
    let paths = PhotonPaths::new(&scene, 1);
    let (mut caustic, mut all) = (0, 0);
    for path in 0..20_000 {
        let mut first = true;
        paths.trace(path, |photon| {
            // A path has one caustic photon at most, and it is the first that is stored.
            assert!(!photon.caustic || first);
            first = false;
            caustic += u32::from(photon.caustic);
            all += 1;
        });
    }
    assert!(caustic > 500 && caustic * 5 < all, "{caustic} of {all}");
    let (diffuse, _) = shipped("cornell-diffuse.obj");
    let paths = PhotonPaths::new(&diffuse, 1);
    (0..2000).for_each(|path| paths.trace(path, |photon| assert!(!photon.caustic)));
}
