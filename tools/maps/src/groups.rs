//! Neighbouring queries that share one search.

use super::carry::Known;
use super::geometry::distance_squared;
use super::{AnyMap, Ball, Blind, Carry, Nearest, Search, SearchReads, Vicinity};

/// Half the diagonal of the box of a group is at most this share of the k-th distance before it: a wider group makes each of
/// its queries look through more photons than it saves nodes.
const WIDEST: f32 = 0.1;

/// A group begins within this share of the k-th distance of the query before.
const NEAR: f32 = 0.5;

/// Answers the queries of one stretch of a stream, neighbours by one search for all of them.
///
/// Of a group with middle c and spread s (from c to its farthest query) the photons within r_k(c) + 2 s of c are collected: the k
/// nearest of each query are among them. A query at distance d from c has r_k(c) - d <= r_k <= r_k(c) + d, as of a [`Carry`], so
/// that most of them are known to be among its nearest, or not. Where groups are cut depends on the queries and on what was found
/// for the one before; a stretch must be cut where the stream says, never where threads do, or the reads would depend on them.
#[derive(Default)]
pub struct Groups {
    carry: Carry,
    vicinity: Vicinity,
    /// Queries that are yet to be answered from what was collected.
    collected: usize,
    /// Queries of which it is known that they have no group.
    alone: usize,
}

impl Groups {
    /// How many of the next queries one search serves: 1 to `most`, if there are any. What a group takes is read, and remembered in
    /// `reads`, if there are such; a query alone has read nothing yet, unless a group proved too large.
    pub fn begin(
        &mut self,
        (most, points): (usize, &[[f32; 3]]),
        search: &Search,
        map: &dyn AnyMap,
        found: &mut Nearest,
        reads: Option<&mut SearchReads>,
    ) -> usize {
        debug_assert_eq!(self.collected, 0, "all queries of a group are answered");
        if self.alone > 0 {
            self.alone -= 1;
            return points.len().min(1);
        }
        let Some((last, radius)) = self.carry.last() else { return points.len().min(1) };
        // Who is far from the one before knows little, and by its own answer those behind it know more. False for what is no number.
        let is_near = |first: &[f32; 3]| distance_squared(last, *first) <= (NEAR * radius) * (NEAR * radius);
        if !points.first().is_some_and(is_near) {
            return points.len().min(1);
        }
        let (count, centre) = first_group(points, most, WIDEST * radius);
        if count < 2 {
            return count;
        }
        let spread = points[..count].iter().map(|&point| distance_squared(centre, point)).fold(0.0, f32::max).sqrt();
        let sure = Known::beside(distance_squared(last, centre).sqrt(), radius).enough;
        let ball = Ball { centre, k: search.k, spread, enough: sure.min(search.start) };
        let is_collected = match reads {
            Some(reads) => map.surround_read(&ball, &mut self.vicinity, found, reads),
            None => map.surround_blind(&ball, &mut self.vicinity, found),
        };
        if !is_collected {
            self.alone = count - 1;
            return 1;
        }
        self.collected = count;
        count
    }

    /// Finds the photons nearest to the next query. Returns the number of attempts it took.
    pub fn next(
        &mut self,
        point: [f32; 3],
        search: &Search,
        map: &dyn AnyMap,
        found: &mut Nearest,
        reads: Option<&mut SearchReads>,
    ) -> u32 {
        if self.collected == 0 {
            return match reads {
                Some(reads) => self.carry.run(search, map, point, found, reads),
                None => self.carry.run(search, map, point, found, &mut Blind),
            };
        }
        self.collected -= 1;
        map.nearest_of_surrounding(&self.vicinity, point, search.max_dist, found);
        self.carry.follow(point, found);
        1
    }
}

/// How many of the first points lie in a box whose half diagonal is at most `widest`, and its middle.
fn first_group(points: &[[f32; 3]], most: usize, widest: f32) -> (usize, [f32; 3]) {
    let Some(&first) = points.first() else { return (0, [0.0; 3]) };
    let (mut low, mut high, mut count) = (first, first, 1);
    for &point in points.iter().take(most).skip(1) {
        let (below, above) =
            ([0, 1, 2].map(|axis| point[axis].min(low[axis])), [0, 1, 2].map(|axis| point[axis].max(high[axis])));
        // False for what is no number.
        let is_near = distance_squared(below, above) <= 4.0 * widest * widest && point.iter().all(|x| x.is_finite());
        if !is_near {
            break;
        }
        (low, high, count) = (below, above, count + 1);
    }
    (count, [0, 1, 2].map(|axis| low[axis] + (high[axis] - low[axis]) / 2.0))
}

#[cfg(test)]
mod tests;
