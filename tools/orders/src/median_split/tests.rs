//! Do cells hold as many photons as they may, whatever the photons are like?

use super::*;
use pm_random::Random;

fn counts(positions: &[[f32; 3]], most: usize) -> Vec<usize> {
    let tree = MedianSplit::new(positions.to_vec(), most);
    let mut counts = vec![0; tree.cells() as usize];
    positions.iter().for_each(|&position| counts[tree.cell(position) as usize] += 1);
    counts
}

#[test]
fn cells_hold_at_most_what_they_may_and_little_less_than_half_of_it() {
    let mut random = Random::new(&[1]);
    let positions: Vec<_> = (0..5000).map(|_| [random.unit(), random.unit() * 0.1, random.unit()]).collect();
    for most in [1, 2, 64, 1000, 5000] {
        let counts = counts(&positions, most);
        assert!(counts.iter().all(|&n| n <= most && 2 * n + 1 >= most.min(2)), "{most}: {counts:?}");
        assert_eq!(counts.iter().sum::<usize>(), 5000);
        assert!(counts.len() >= 5000 / most && counts.len() <= (2 * 5000usize).div_ceil(most), "{}", counts.len());
    }
}

#[test]
fn photons_at_one_place_or_on_a_face_end_the_splitting() {
    assert_eq!(counts(&[], 64), [0]);
    assert_eq!(counts(&[[1.0; 3]; 500], 64), [500]);
    let mut on_a_face = vec![[0.0, 0.5, 0.5]; 300];
    on_a_face.extend((0..200u16).map(|i| [f32::from(i) + 1.0, 0.5, 0.5]));
    let counts = counts(&on_a_face, 64);
    assert_eq!(counts[0], 300);
    assert!(counts[1..].iter().all(|&n| n <= 64 && n > 0), "{counts:?}");
}

#[test]
fn extremes_have_a_cell() {
    let tree = MedianSplit::new(vec![[f32::MIN; 3], [f32::MAX; 3], [0.0; 3], [1e-42; 3]], 1);
    for point in [[f32::MIN; 3], [f32::MAX; 3], [0.0; 3], [-0.0; 3]] {
        assert!(tree.cell(point) < tree.cells());
    }
}
