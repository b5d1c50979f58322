//! Where each gather ray of a picture stands in an order: known from the eye rays alone, so that windows of rays can be
//! cast without the rest.
//!
//! Rays that will be lost have their places like all others, as only casting them tells. The eye rays are all cast, one
//! for each hemisphere of gather rays: so the length of the order is known exactly, and every ray can have the same chance.

use super::gather_rays::GatherRays;
use super::ray_counts::RayCounts;
use pm_orders::{Generative, Pass, Span};
use pm_parallel::in_order;
use std::convert::Infallible;
use std::ops::Range;

/// Pixels of a row whose points seen are counted together.
const STRETCH: u32 = 16;
/// Spans of pixels whose eye rays are one piece of work.
const SPANS_A_JOB: usize = 32;

/// The points seen of an image, counted in the order of their pixels.
pub struct RayPlan {
    passes: Vec<PlannedPass>,
    /// Gather rays of each point seen, of all passes together.
    rays_a_point: u64,
    batches: Vec<Batch>,
    rays: u64,
}

/// A pass over a batch.
struct PlannedPass {
    pass: Pass,
    /// Gather rays of each of its points.
    rays_a_point: u64,
    /// Gather rays of the passes before it: of each point seen directly, of each behind specular surfaces.
    before: [u64; 2],
}

/// A row or tile.
struct Batch {
    /// Rays before it.
    first: u64,
    stretches: Vec<Stretch>,
    /// Points seen directly, and of those behind specular surfaces.
    points: [u64; 2],
}

/// Some pixels of a row, and the points seen in the batch before them.
struct Stretch {
    row: u32,
    columns: Range<u32>,
    before: [u64; 2],
}

/// Rays that belong together: those of a span of pixels with these numbers, counted from the first of the span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The pixels and which of their rays are counted.
    pub span: Span,
    /// The rays that are wanted.
    pub rays: Range<u64>,
}

/// The points seen in each stretch of a span of pixels.
struct Seen {
    span: Span,
    points: Vec<[u64; 2]>,
    counts: RayCounts,
}

impl RayPlan {
    /// Casts the eye rays of an image that is visited in `order`, on so many threads, and counts them in `counts`.
    #[must_use]
    pub fn new(rays: &GatherRays<'_>, order: &dyn Generative, threads: usize, counts: &mut RayCounts) -> Self {
        let bins: Vec<u64> = rays.strata.bin_sizes().collect();
        let mut before = [0; 2];
        let plan = |pass: Pass| {
            let planned = PlannedPass { pass, rays_a_point: bins[pass.bin as usize], before };
            for (rays, behind_specular) in before.iter_mut().zip([false, true]) {
                *rays += if pass.points.include(behind_specular) { planned.rays_a_point } else { 0 };
            }
            planned
        };
        let passes = order.passes().into_iter().map(plan).collect();
        let mut plan = Self { passes, rays_a_point: bins.iter().sum(), batches: vec![], rays: 0 };
        let mut spans = order.spans(rays.size()).filter(|span| span.pass.is_first());
        let some = || Ok(Some(spans.by_ref().take(SPANS_A_JOB).collect()).filter(|some: &Vec<_>| !some.is_empty()));
        let look = |spans: Vec<Span>| spans.into_iter().map(|span| look(rays, span)).collect();
        let add = |seen: Vec<Seen>| {
            seen.into_iter().for_each(|seen| plan.add(seen, counts));
            Ok::<_, Infallible>(())
        };
        let Ok(()) = in_order(threads, some, look, add);
        plan
    }

    fn add(&mut self, seen: Seen, counts: &mut RayCounts) {
        let Seen { span, points, counts: cast } = seen;
        *counts += cast;
        if span.batch == self.batches.len() as u64 {
            self.batches.push(Batch { first: self.rays, stretches: vec![], points: [0; 2] });
        }
        let batch = self.batches.last_mut().expect("batches count up from 0");
        for (columns, [direct, behind]) in stretches(&span).zip(points) {
            batch.stretches.push(Stretch { row: span.row, columns, before: batch.points });
            batch.points = [batch.points[0] + direct, batch.points[1] + behind];
            self.rays += (direct + behind) * self.rays_a_point;
        }
    }

    /// Gather rays of the whole image; with direct visualisation, the points seen.
    #[must_use]
    pub const fn rays(&self) -> u64 {
        self.rays
    }

    /// The rays with these numbers in the order of all, piece by piece.
    pub fn pieces(&self, wanted: Range<u64>) -> impl Iterator<Item = Piece> {
        let first = self.batches.partition_point(|batch| batch.first <= wanted.start).saturating_sub(1);
        let end = wanted.end.min(self.rays);
        let batches = (first..self.batches.len()).take_while(move |&batch| self.batches[batch].first < end);
        batches.flat_map(move |batch| {
            let wanted = wanted.start..end;
            self.passes.iter().flat_map(move |planned| self.pieces_of_pass(batch, planned, &wanted))
        })
    }

    fn pieces_of_pass<'a>(
        &'a self,
        number: usize,
        planned: &'a PlannedPass,
        wanted: &Range<u64>,
    ) -> impl Iterator<Item = Piece> + use<'a> {
        let batch = &self.batches[number];
        let &PlannedPass { pass, rays_a_point, before } = planned;
        let points = move |[direct, behind]: [u64; 2]| {
            let of = |points: u64, behind_specular| if pass.points.include(behind_specular) { points } else { 0 };
            of(direct, false) + of(behind, true)
        };
        // The rays of a batch are ordered by pass, then by point.
        let first = batch.first + batch.points[0] * before[0] + batch.points[1] * before[1];
        let place = move |point: u64| first + point * rays_a_point;
        let Range { start, end } = *wanted;
        let first_stretch = batch.stretches.partition_point(|stretch| place(points(stretch.before)) <= start);
        let stretches = first_stretch.saturating_sub(1)..batch.stretches.len();
        let placed = stretches.map(move |at| {
            let stretch = &batch.stretches[at];
            let next = batch.stretches.get(at + 1).map_or(batch.points, |next| next.before);
            (stretch, place(points(stretch.before))..place(points(next)))
        });
        placed.take_while(move |(_, rays)| rays.start < end).filter_map(move |(stretch, rays)| {
            let wanted = start.max(rays.start)..end.min(rays.end);
            (wanted.start < wanted.end).then(|| Piece {
                span: Span { batch: number as u64, row: stretch.row, columns: stretch.columns.clone(), pass },
                rays: wanted.start - rays.start..wanted.end - rays.start,
            })
        })
    }
}

fn look(rays: &GatherRays<'_>, span: Span) -> Seen {
    let mut counts = RayCounts::default();
    let points = stretches(&span).map(|columns| {
        columns.fold([0; 2], |sum, x| {
            let mut points = vec![];
            let eye_rays = rays.see([x, span.row], &mut points, &mut |_| {});
            counts.eye += eye_rays;
            counts.seen += points.len() as u64;
            let behind = points.iter().filter(|visible| visible.behind_specular).count();
            let [direct, behind] = [points.len() - behind, behind].map(|points| points as u64);
            [sum[0] + direct, sum[1] + behind]
        })
    });
    let points = points.collect();
    Seen { span, points, counts }
}

/// The columns of a span, some at a time.
fn stretches(span: &Span) -> impl Iterator<Item = Range<u32>> + use<> {
    let Range { start, end } = span.columns;
    (start..end).step_by(STRETCH as usize).map(move |x| x..x.saturating_add(STRETCH).min(end))
}
