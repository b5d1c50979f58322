//! Polygons of a file, cut into triangles.

use glam::{DVec3, Vec3};

#[cfg(test)]
mod tests;

/// Starting corners tried for a fan: bounds the work on polygons of very many corners.
const STARTS: usize = 64;
/// Share of a polygon's area that may be lost or lie outside where it is cut.
const PRECISION: f64 = 1e-6;

/// How a polygon is cut.
#[derive(Debug, PartialEq)]
pub(super) struct Cut {
    /// Corners of the triangles, as indices into the polygon's corners; wound like the polygon.
    pub(super) triangles: Vec<[usize; 3]>,
    /// Do they cover the polygon and nothing else? Not so where its outline crosses itself.
    pub(super) is_whole: bool,
}

/// Cuts a polygon of three corners or more, flat or nearly so. A hole may be joined to the outline by a bridge, that is by an
/// edge that is gone along twice.
///
/// As a fan from the first corner that will do, which all corners of a convex polygon do; for a quadrangle with a dent, the
/// dent. Else by ears: Held, *FIST: Fast Industrial-Strength Triangulation of Polygons*, Algorithmica 30, 2001, which is
/// what the library follows. A comb of 64,000 corners takes 6 ms and a star as many 1.4 s; only for what is wound around
/// itself a thousand times is the time still quadratic (a spiral of 62,000 corners: 16 s).
pub(super) fn cut(corners: &[Vec3]) -> Cut {
    let n = corners.len();
    if n == 3 {
        return Cut { triangles: vec![[0, 1, 2]], is_whole: true };
    }
    let origin = corners[0].as_dvec3();
    let points: Vec<DVec3> = corners.iter().map(|p| p.as_dvec3() - origin).collect();
    // Newell's sum: twice the area of the polygon, along its normal, whatever its shape.
    let normal: DVec3 = (0..n).map(|i| points[i].cross(points[(i + 1) % n])).sum();
    match fan_start(&points, normal) {
        Some(start) => {
            let triangles = (1..n - 1).map(|i| [start, (start + i) % n, (start + i + 1) % n]).collect();
            Cut { triangles, is_whole: true }
        }
        None => ears(&points, normal),
    }
}

/// The corner from which a polygon can be cut as a fan; `None` if the first few corners will not do.
fn fan_start(points: &[DVec3], normal: DVec3) -> Option<usize> {
    let n = points.len();
    let slack = -PRECISION * normal.length_squared();
    let fans = |start: &usize| {
        let mut outside = 0.0;
        (1..n - 1).all(|i| {
            let [a, b, c] = [points[*start], points[(start + i) % n], points[(start + i + 1) % n]];
            outside += (b - a).cross(c - a).dot(normal).min(0.0);
            outside >= slack
        })
    };
    (0..n.min(STARTS)).find(fans)
}

/// Cuts off one ear after the other, in the plane of two axes along which the polygon is seen largest: so no coordinate is
/// rounded, and areas all shrink alike.
fn ears(points: &[DVec3], normal: DVec3) -> Cut {
    let size = normal.abs();
    let (u, v) = if size.x >= size.y && size.x >= size.z {
        (1, 2)
    } else if size.y >= size.z {
        (2, 0)
    } else {
        (0, 1)
    };
    let flat: Vec<[f64; 2]> = points.iter().map(|p| [p[u], p[v]]).collect();
    let mut ends: Vec<usize> = vec![];
    earcut::Earcut::new().earcut_slice(&flat, &[], &mut ends);
    let mut triangles: Vec<[usize; 3]> = ends.chunks_exact(3).map(|ends| [ends[0], ends[1], ends[2]]).collect();
    let twice_area = |[a, b, c]: [usize; 3]| {
        let ([ax, ay], [bx, by], [cx, cy]) = (flat[a], flat[b], flat[c]);
        (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    };
    let whole = normal[3 - u - v];
    let mut covered = 0.0;
    for triangle in &mut triangles {
        let area = twice_area(*triangle);
        covered += area.abs();
        if area * whole < 0.0 {
            triangle.swap(1, 2);
        }
    }
    Cut { triangles, is_whole: (covered - whole.abs()).abs() <= PRECISION * whole.abs() }
}
