//! Which points no other point beats.

use super::{Plot, Point, Series};
use std::cmp::Ordering;

/// Of points that are the better the less they have of both, which no other beats: none has at most as much of both and
/// less of one. Equal points do not beat one another.
#[must_use]
pub fn unbeaten(points: &[(f64, f64)]) -> Vec<bool> {
    let order = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
    let mut from_left: Vec<usize> = (0..points.len()).collect();
    from_left.sort_by(|&a, &b| order(&points[a], &points[b]));
    let mut best = vec![false; points.len()];
    // The last that was not beaten: all before it lie higher.
    let mut lowest: Option<&(f64, f64)> = None;
    for at in from_left {
        let point = &points[at];
        best[at] = lowest.is_none_or(|lowest| point.1 < lowest.1 || order(point, lowest) == Ordering::Equal);
        lowest = if best[at] { Some(point) } else { lowest };
    }
    best
}

impl Plot {
    /// The frontier: the points of all series that no other beats, as one series from left to right; of equal points the
    /// first. A part has that of the whole.
    #[must_use]
    pub fn frontier(&self) -> Series {
        let whole = self.whole.as_deref().unwrap_or(self);
        let all: Vec<Point> = whole.series.iter().flat_map(|series| series.points.iter().copied()).collect();
        let places: Vec<(f64, f64)> = all.iter().map(|point| (point.x, point.y)).collect();
        let best = all.into_iter().zip(unbeaten(&places)).filter(|(_, best)| *best);
        let mut points: Vec<Point> = best.map(|(point, _)| point).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        points.dedup_by_key(|point| (point.x, point.y));
        Series { name: "frontier".to_owned(), points }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Scale};
    use super::*;

    const ALL: [(f64, f64); 6] = [(1.0, 9.0), (2.0, 9.0), (3.0, 4.0), (3.0, 5.0), (4.0, 6.0), (5.0, 1.0)];

    #[test]
    fn the_frontier_is_what_nothing_beats() {
        let points =
            |points: &[(f64, f64)]| points.iter().map(|&(x, y)| Point { x, y, error: None }).collect::<Vec<_>>();
        let axis = Axis::fit("n", Scale::Auto, vec![], [1.0].into_iter()).expect("an axis");
        let plot = Plot {
            x: axis.clone(),
            y: axis,
            series: vec![
                Series { name: "a".into(), points: points(&ALL[..3]) },
                Series { name: "b".into(), points: points(&ALL[3..]) },
            ],
            reference: vec![],
            whole: None,
        };
        // By brute force: nobody else is as good on both axes.
        let beaten = |p: (f64, f64)| ALL.iter().any(|&q| q != p && q.0 <= p.0 && q.1 <= p.1);
        let expected: Vec<_> = ALL.into_iter().filter(|&p| !beaten(p)).collect();
        assert_eq!(plot.frontier().points, points(&expected));
    }

    #[test]
    fn equal_points_do_not_beat_one_another() {
        let twice: Vec<(f64, f64)> = ALL.iter().rev().chain(&ALL).copied().collect();
        let beaten = |p: (f64, f64)| twice.iter().any(|&q| q.0 <= p.0 && q.1 <= p.1 && (q.0 < p.0 || q.1 < p.1));
        assert_eq!(unbeaten(&twice), twice.iter().map(|&p| !beaten(p)).collect::<Vec<_>>());
        assert_eq!(unbeaten(&twice).iter().filter(|best| **best).count(), 2 * 3);
    }
}
