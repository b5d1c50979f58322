//! The rays of a picture, pixel by pixel and pass by pass.

use super::cache_records::{CacheRecords, may_be_cached};
use super::eye::VisiblePoint;
use super::gather_options::Method;
use super::gather_rays::{Batch, GatherRays};
use super::query::query_at;
use super::ray_counts::RayCounts;
use glam::Vec3;
use pm_formats::Query;
use pm_orders::{Pass, VisiblePoints};
use std::collections::HashMap;
use std::ops::Range;

/// Casts the rays of pixels, pass after pass. What is seen through a pixel is remembered, since an order with a pass for each
/// bin of the hemisphere comes to it a hundred times; the memory grows with the pixels visited.
pub struct PixelCaster<'a> {
    rays: &'a GatherRays<'a>,
    cache: Option<&'a CacheRecords>,
    /// By pixel: the points seen, and the number of eye rays that found them.
    seen: HashMap<u32, (Vec<VisiblePoint>, u64)>,
    /// What is seen through a pixel that no other pass comes to: room that is used again.
    once: Vec<VisiblePoint>,
    /// The gather rays of a point.
    batch: Batch,
    /// The queries of a visit.
    found: Vec<Query>,
    /// Queries that wait for the end of their batch.
    queued: Vec<Query>,
}

/// What of a pixel is cast at a visit: a pass, and of its rays those with these numbers.
struct Wanted<'r> {
    pass: Pass,
    rays: &'r mut Range<u64>,
}

/// Which of the next `n` rays lie in `rays`, whose numbers are then counted from behind these.
fn take(rays: &mut Range<u64>, n: usize) -> Range<usize> {
    let within = |at: u64| at.min(n as u64) as usize;
    let taken = within(rays.start)..within(rays.end);
    let less = |at: u64| at.saturating_sub(n as u64);
    *rays = less(rays.start)..less(rays.end);
    taken
}

impl<'a> PixelCaster<'a> {
    /// Nothing has been seen yet. With cached irradiance the points that it serves are not gathered for; the records that
    /// were placed at a pixel are.
    #[must_use]
    pub fn new(rays: &'a GatherRays<'a>, cache: Option<&'a CacheRecords>) -> Self {
        Self { rays, cache, seen: HashMap::new(), once: vec![], batch: Batch::default(), found: vec![], queued: vec![] }
    }

    /// The queries since the last time that are to wait, in order: of gather rays that went by a mirror or through glass, if
    /// they are [queued](super::GatherOptions::queue_specular).
    pub fn take_queued(&mut self) -> Vec<Query> {
        std::mem::take(&mut self.queued)
    }

    /// Casts the rays of one pixel: gives its queries to `query`, strata in raster order (elevation outer, azimuth inner),
    /// and light that needs no query (what is emitted or, with final gather, comes straight from the lights) to `light`.
    ///
    /// A query's sample number is `(point * samples + sample) * gathers + stratum`.
    ///
    /// `pass` tells which of the rays are wanted now; light that needs no gather ray comes with a pixel's first bin.
    pub fn pixel(
        &mut self,
        at: [u32; 2],
        pass: impl Into<Pass>,
        query: impl FnMut(Query),
        mut light: impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let mut all = 0..u64::MAX;
        self.visit(at, Wanted { pass: pass.into(), rays: &mut all }, self.cache, &mut light, counts);
        self.found.drain(..).for_each(query);
    }

    /// Casts some of the gather rays of one pixel and pass: those with numbers in `rays`, counted from the first that
    /// [`pixel`](Self::pixel) would cast. Then takes their number off both ends of `rays`, which so goes on at the pixel
    /// that comes next. No light is asked for, and no cached irradiance.
    ///
    /// The eye rays are counted as cast again: it takes all of them to know the numbers.
    pub fn some_of_pixel(
        &mut self,
        at: [u32; 2],
        pass: Pass,
        rays: &mut Range<u64>,
        query: impl FnMut(Query),
        counts: &mut RayCounts,
    ) {
        let mut now = RayCounts::default();
        self.visit(at, Wanted { pass, rays }, None, &mut |_| {}, &mut now);
        self.found.drain(..).for_each(query);
        *counts += RayCounts { eye: 0, eye_again: now.eye + now.eye_again, seen: 0, ..now };
    }

    fn visit(
        &mut self,
        [x, y]: [u32; 2],
        wanted: Wanted<'_>,
        cache: Option<&CacheRecords>,
        light: &mut dyn FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let Self { rays: cast, seen, once, batch, found: asked, queued, .. } = self;
        let queues = cast.options.queue_specular;
        let mut query = |one: Query, behind_specular: bool| match queues && behind_specular {
            true => queued.push(one),
            false => asked.push(one),
        };
        let pixel = y * cast.size()[0] + x;
        let Wanted { pass: Pass { points, bin }, rays } = wanted;
        // Light seen by eye belongs to the first of the passes that visit every pixel.
        let first_pass = wanted.pass.is_first();
        let mut eye_light = |radiance: Vec3| {
            if first_pass {
                light(radiance);
            }
        };
        let (found, eye_rays) = if points == VisiblePoints::All && cast.strata.bins() == 1 {
            once.clear();
            let eye_rays = cast.see([x, y], once, &mut eye_light);
            (&*once, eye_rays)
        } else {
            if first_pass {
                // Light is to be told even if a pixel should be begun twice.
                seen.remove(&pixel);
            }
            let (found, eye_rays) = seen.entry(pixel).or_insert_with(|| {
                let mut points = vec![];
                let eye_rays = cast.see([x, y], &mut points, &mut eye_light);
                (points, eye_rays)
            });
            (&*found, *eye_rays)
        };
        *(if first_pass { &mut counts.eye } else { &mut counts.eye_again }) += eye_rays;
        for visible in found.iter().filter(|visible| points.include(visible.behind_specular)) {
            counts.seen += u64::from(bin == 0);
            match cast.options.method {
                Method::FinalGather => {
                    let cached = cache.is_some() && may_be_cached(cast.material(visible));
                    if bin == 0 {
                        cast.direct_light(pixel, visible, !cached, light);
                    }
                    if cached {
                        continue;
                    }
                    let wanted = take(rays, cast.strata.of_bin(bin).len());
                    if !wanted.is_empty() {
                        let strata = cast.strata_of(pixel, visible, bin);
                        cast.gather(pixel, visible, &strata[wanted], &mut query, light, (batch, counts));
                    }
                }
                Method::DirectVisualisation => {
                    if bin == 0 && !take(rays, 1).is_empty() {
                        // Eye rays wait by their pass.
                        query(query_at(&visible.point, visible.view, pixel, visible.number, visible.share), false);
                    }
                }
            }
        }
        if let Some(cache) = cache {
            for (record, _) in cache.of_pixel(pixel).filter(|&(_, behind_specular)| points.include(behind_specular)) {
                cache.gather(cast, record, cast.strata.of_bin(bin), &mut query, counts);
            }
        }
    }
}
