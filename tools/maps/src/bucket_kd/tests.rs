//! Are splits never below their left side, and leaves full?

use super::*;

#[test]
fn a_split_is_never_below_its_left_side_and_hardly_above() {
    for low in [0.0, -0.0, 1.0, -1.0, 1e18, -1e18, 1e-40, -1e-40, 0.1, -0.3, f32::MIN_POSITIVE] {
        for axis in 0..3 {
            let split = Split::new(axis, low, 7.0);
            assert_eq!(split.axis(), axis);
            assert!(split.low() >= low && split.low() - low <= low.abs() * 4e-7 + 1e-44, "{low} {}", split.low());
        }
    }
}

#[test]
fn every_leaf_is_full_but_one() {
    for n in [0, 1, 5, 6, 7, 36, 37, 1000] {
        let positions = (0..n).map(|i: u16| [f32::from(i * 7 % 11), f32::from(i), 0.0]);
        let photons: Vec<_> =
            positions.map(|p| Photon::new(p, [1.0; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap()).collect();
        let tree = BucketKdTree::build(&photons, Layout::Heap, 128).unwrap();
        let counts: Vec<_> = (0..tree.leaves.len()).map(|leaf| tree.leaves.count(leaf)).collect();
        assert_eq!(counts.iter().sum::<usize>(), photons.len());
        assert!(counts.iter().filter(|&&count| count < 6).count() <= 1, "{counts:?}");
    }
}
