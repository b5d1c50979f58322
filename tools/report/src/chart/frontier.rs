//! Which points no other point beats.

use super::{Plot, Point, Series};

impl Plot {
    /// The frontier: the points of all series for which no other is at most as far right and at most as high, as one
    /// series from left to right.
    #[must_use]
    pub fn frontier(&self) -> Series {
        let mut points: Vec<Point> = self.series.iter().flat_map(|series| series.points.iter().copied()).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut lowest = f64::INFINITY;
        points.retain(|point| {
            let better = point.y < lowest;
            lowest = lowest.min(point.y);
            better
        });
        Series { name: "frontier".to_owned(), points }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Scale};
    use super::*;

    #[test]
    fn the_frontier_is_what_nothing_beats() {
        let points =
            |points: &[(f64, f64)]| points.iter().map(|&(x, y)| Point { x, y, error: None }).collect::<Vec<_>>();
        let axis = Axis::fit("n", Scale::Auto, vec![], [1.0].into_iter()).expect("an axis");
        let all = [(1.0, 9.0), (2.0, 9.0), (3.0, 4.0), (3.0, 5.0), (4.0, 6.0), (5.0, 1.0)];
        let plot = Plot {
            x: axis.clone(),
            y: axis,
            series: vec![
                Series { name: "a".into(), points: points(&all[..3]) },
                Series { name: "b".into(), points: points(&all[3..]) },
            ],
            reference: vec![],
        };
        // By brute force: nobody else is as good on both axes.
        let beaten = |p: (f64, f64)| all.iter().any(|&q| q != p && q.0 <= p.0 && q.1 <= p.1);
        let expected: Vec<_> = all.into_iter().filter(|&p| !beaten(p)).collect();
        assert_eq!(plot.frontier().points, points(&expected));
    }
}
