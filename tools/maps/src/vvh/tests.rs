//! Is the best split the best of all?

use super::heuristic::widened_volume;
use super::*;
use std::f64::consts::PI;

#[test]
fn the_widened_volume_is_that_of_the_parallel_body() {
    let point = ([1.0; 3], [1.0; 3]);
    assert!((widened_volume(&point, 2.0) - 4.0 / 3.0 * PI * 8.0).abs() < 1e-12, "a ball");
    let stick = ([0.0; 3], [3.0, 0.0, 0.0]);
    assert!((widened_volume(&stick, 1.0) - (3.0 * PI + 4.0 / 3.0 * PI)).abs() < 1e-12, "a cylinder with two caps");
    assert!((widened_volume(&([0.0; 3], [2.0, 3.0, 4.0]), 0.0) - 24.0).abs() < 1e-12, "the box itself");
}

#[test]
fn the_best_split_is_the_best_of_all() {
    // Two clusters on a flat cell: every split tried by hand, with its exact counts.
    let mut points: Vec<Point> = (0..40u16)
        .map(|i| {
            let at = f32::from(i % 20) * 0.01 + if i < 20 { 0.0 } else { 0.7 };
            Point { position: [at, f32::from(i * 7 % 40) * 0.02, 0.0], id: u32::from(i) }
        })
        .collect();
    let cell = extent(points.iter().map(|point| point.position));
    let radius = 0.05;
    let work = |axis: usize, plane: f32| {
        let (mut left, mut right) = (cell, cell);
        left.1[axis] = plane;
        right.0[axis] = plane;
        (left, right)
    };
    let mut least = f64::INFINITY;
    for axis in 0..2 {
        for point in &points {
            let plane = point.position[axis];
            let (left, right) = work(axis, plane);
            for inclusive in [false, true] {
                let is_left = |p: &&Point| p.position[axis] < plane || inclusive && p.position[axis] <= plane;
                let n = points.iter().filter(is_left).count();
                if n > 0 && n < points.len() {
                    let cost = n as f64 * widened_volume(&left, radius)
                        + (points.len() - n) as f64 * widened_volume(&right, radius);
                    least = least.min(cost);
                }
            }
        }
    }
    let (axis, left, plane) = best_split(&mut points, &cell, radius).unwrap();
    let (left_cell, right_cell) = work(axis, plane);
    let cost = left as f64 * widened_volume(&left_cell, radius)
        + (points.len() - left) as f64 * widened_volume(&right_cell, radius);
    assert!((cost - least).abs() < 1e-12 * least, "{cost} {least}");
    assert!(points[..left].iter().all(|p| p.position[axis] <= plane));
    assert!(points[left..].iter().all(|p| p.position[axis] >= plane));
}
