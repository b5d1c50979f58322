//! Do queries of sparser light come later, as they came within an octave?

use super::*;
use bytemuck::Zeroable as _;

#[test]
fn an_octave_is_twice_as_long() {
    let one = octave([1.0, 0.0, 0.0]);
    for (side, more) in [(0.25, -2), (0.5, -1), (0.99, -1), (1.0, 0), (1.99, 0), (2.0, 1), (1e3, 9), (1024.0, 10)] {
        assert_eq!(i32::from(octave([0.0, side, 0.0])) - i32::from(one), more, "{side}");
    }
    // The diagonal of a box of 1.2 each way is 2.08.
    assert_eq!(octave([1.2; 3]), one + 1);
    assert_eq!([octave([0.0; 3]), octave([f32::MIN_POSITIVE; 3])], [0, one - 126]);
    assert!(octave([f32::MAX; 3]) > octave([f32::MAX / 4.0; 3]) && octave([f32::INFINITY, 0.0, 0.0]) == 255);
}

#[test]
fn the_part_of_a_query_grows_with_the_distance_of_the_kth_photon() {
    // Along a line, three stretches of 64 photons each 1, 1/8 and 1/64 apart: what is near the eighth photon is told by brute force.
    let mut photons = vec![];
    let mut x = 0.0;
    for apart in [1.0, 0.125, 1.0 / 64.0] {
        for _ in 0..64 {
            photons.push([x, 0.0, 0.0]);
            x += apart;
        }
    }
    let octaves = Octaves::new(photons.clone(), 8);
    let query = |x: f32| Query { position: [x, 0.0, 0.0], ..Query::zeroed() };
    for at in [[10, 80, 150], [40, 100, 170], [20, 90, 180]] {
        let told = at.map(|at: usize| {
            let x = photons[at][0] + 0.001;
            let mut distances: Vec<f32> = photons.iter().map(|photon| (photon[0] - x).abs()).collect();
            distances.sort_by(f32::total_cmp);
            (octaves.part(&query(x)), distances[7])
        });
        // Eight times as far is three octaves, of which there are three in all.
        assert!(told[0].0 > told[1].0 && told[1].0 > told[2].0, "{told:?}");
        assert!(told[0].1 > 6.0 * told[1].1 && told[1].1 > 6.0 * told[2].1, "{told:?}");
    }
    assert!((3..=5).contains(&octaves.parts()), "{}", octaves.parts());
}
