//! Do triangles cover a polygon and nothing else, whatever its shape and plane?

use super::*;
use pm_random::Random;
use std::f64::consts::PI;
use std::time::{Duration, Instant};

/// Corners of a polygon in the plane, counter-clockwise.
type Outline = Vec<[f64; 2]>;

fn turned(n: usize, radius: impl Fn(usize) -> f64) -> Outline {
    let corner = |i| {
        let (sin, cos) = (2.0 * PI * i as f64 / n as f64).sin_cos();
        [radius(i) * cos, radius(i) * sin]
    };
    (0..n).map(corner).collect()
}

fn star(points: usize) -> Outline {
    turned(2 * points, |i| if i % 2 == 0 { 3.0 } else { 1.0 })
}

fn comb(teeth: usize) -> Outline {
    let tooth = |i: usize| {
        let x = 2.0 * i as f64;
        [[x + 1.0, 1.0], [x + 1.0, 3.0], [x, 3.0], [x, 1.0]]
    };
    let mut outline = vec![[0.0, 0.0], [2.0 * teeth as f64 - 1.0, 0.0]];
    outline.extend((0..teeth).rev().flat_map(tooth));
    outline
}

fn spiral(turns: usize) -> Outline {
    let n = 24 * turns;
    let at = |i: usize, width: f64| {
        let (sin, cos) = (2.0 * PI * i as f64 / 24.0).sin_cos();
        let radius = 1.0 + i as f64 / 24.0 + width;
        [radius * cos, radius * sin]
    };
    (0..n).map(|i| at(i, 0.5)).chain((0..n).rev().map(|i| at(i, 0.0))).collect()
}

/// A square with square holes, each joined to the lower edge by a bridge.
fn frame(holes: usize) -> Outline {
    let mut outline = vec![];
    for i in 0..holes {
        let (x, end) = (4.0 * i as f64 + 1.0, [4.0 * i as f64 + 1.0, 0.0]);
        let hole = [[x, 1.0], [x, 3.0], [x + 2.0, 3.0], [x + 2.0, 1.0], [x, 1.0]];
        outline.push(end);
        outline.extend(hole);
        outline.push(end);
    }
    let width = 4.0 * holes as f64;
    outline.extend([[width, 0.0], [width, 4.0], [0.0, 4.0], [0.0, 0.0]]);
    outline
}

/// A walk around the middle at random distances.
fn ragged(n: usize, seed: u64) -> Outline {
    turned(n, |i| 0.2 + f64::from(Random::new(&[seed, i as u64]).unit()))
}

fn outlines() -> Vec<Outline> {
    let mut all = vec![star(3), star(5), star(40), comb(2), comb(7), comb(60), spiral(1), spiral(9)];
    all.extend([1, 2, 5].map(frame));
    all.extend((0..40).map(|seed| ragged(4 + 3 * seed as usize, seed)));
    all
}

/// The shoelace formula.
fn area(outline: &[[f64; 2]]) -> f64 {
    let n = outline.len();
    let cross = |i: usize| {
        let ([ax, ay], [bx, by]) = (outline[i], outline[(i + 1) % n]);
        ax * by - ay * bx
    };
    (0..n).map(cross).sum::<f64>() / 2.0
}

fn is_inside(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let n = outline.len();
    let crossed = (0..n).filter(|&i| {
        let ([ax, ay], [bx, by]) = (outline[i], outline[(i + 1) % n]);
        (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossed.count() % 2 == 1
}

/// The outline in some plane of space, and what the area there is.
fn placed(outline: &[[f64; 2]], plane: u64) -> Vec<Vec3> {
    let mut random = Random::new(&[plane]);
    let mut within = || 2.0 * f64::from(random.unit()) - 1.0;
    let slanted = DVec3::new(within(), within(), within()).normalize();
    let normal = [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y].get(plane as usize).copied().unwrap_or(slanted);
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    outline.iter().map(|&[x, y]| (u * x + v * y).as_vec3()).collect()
}

#[test]
fn triangles_cover_the_polygon_and_nothing_else() {
    let mut random = Random::new(&[1]);
    for (number, outline) in outlines().into_iter().enumerate() {
        let Cut { triangles, is_whole } = cut(&placed(&outline, 0));
        assert!(is_whole, "outline {number}");
        for _ in 0..500 {
            let mut within = |axis: usize| {
                let all = outline.iter().map(|p| p[axis]);
                let (least, most) = all.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
                least + f64::from(random.unit()) * (most - least)
            };
            let point = [within(0), within(1)];
            let covering = triangles.iter().filter(|ends| is_inside(&ends.map(|i| outline[i]), point)).count();
            assert_eq!(covering, usize::from(is_inside(&outline, point)), "outline {number} at {point:?}");
        }
    }
}

#[test]
fn areas_are_right_in_any_plane_and_normals_are_those_of_the_polygon() {
    for (number, outline) in outlines().into_iter().enumerate() {
        for plane in 0..8 {
            let mut corners = placed(&outline, plane);
            // Wherever the polygon begins, and whichever way round it goes.
            corners.rotate_left(number % outline.len());
            if plane % 2 == 1 {
                corners.reverse();
            }
            let Cut { triangles, is_whole } = cut(&corners);
            let points: Vec<DVec3> = corners.iter().map(|p| p.as_dvec3()).collect();
            let normal: DVec3 = (0..points.len()).map(|i| points[i].cross(points[(i + 1) % points.len()])).sum();
            let mut sum = 0.0;
            for [a, b, c] in triangles.iter().map(|ends| ends.map(|i| points[i])) {
                let cross = (b - a).cross(c - a);
                sum += cross.length() / 2.0;
                assert!(cross.dot(normal) > -1e-6 * normal.length_squared(), "outline {number} in plane {plane}");
            }
            let expected = area(&outline);
            assert!(
                is_whole && (sum / expected - 1.0).abs() < 1e-6,
                "outline {number} in plane {plane}: {sum}, {expected}"
            );
        }
    }
}

#[test]
fn very_many_corners_take_no_time() {
    let begun = Instant::now();
    for outline in [turned(64_000, |_| 1.0), comb(16_000), ragged(16_000, 5), star(8_000), spiral(100)] {
        let corners = placed(&outline, 5);
        let Cut { triangles, is_whole } = cut(&corners);
        assert!(is_whole && triangles.len() <= outline.len() - 2);
    }
    // Seconds would be the square of them.
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
}

fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
    points.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect()
}

#[test]
fn convex_polygons_are_fans_from_their_first_corner_and_dented_quadrangles_are_cut_at_the_dent() {
    assert_eq!(cut(&flat(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]])).triangles, [[0, 1, 2], [0, 2, 3]]);
    for turn in 0..4 {
        let mut corners = flat(&[[1., 1.], [-1., 0.], [1., -1.], [0., 0.]]);
        corners.rotate_left(turn);
        let Cut { triangles, is_whole } = cut(&corners);
        let dent = corners.iter().position(|corner| *corner == Vec3::ZERO).unwrap();
        assert!(is_whole && triangles.iter().all(|ends| ends.contains(&dent)), "turned by {turn}: {triangles:?}");
    }
}

#[test]
fn an_outline_that_crosses_itself_is_known() {
    let pentagram = turned(5, |_| 1.0);
    let pentagram = [0, 2, 4, 1, 3].map(|i| [pentagram[i][0] as f32, pentagram[i][1] as f32]);
    assert!(!cut(&flat(&pentagram)).is_whole);
    assert!(cut(&flat(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.]])).is_whole, "no area is none to lose");
}
