//! The work itself: jobs of pixels, cast on many threads, their queries in order.

use super::base::Exposure;
use super::sample::{Job, Sample};
use pm_film::film::{Overflow, Units};
use pm_formats::Query;
use pm_formats::vocabulary::Part;
use pm_light::transport::{CacheRecords, GatherRays, PixelCaster, RayCounts};
use pm_orders::Generative;
use pm_parallel::in_order;

/// Gather rays that are cast as one piece of work, at least.
const WORTH_A_JOB: u64 = 2000;
/// Passes over a tile that are one, so that its eye rays are not cast for each of them; and most rays.
const PASSES_A_JOB: u64 = 16;
const MOST_A_JOB: u64 = 1 << 16;

/// What is cast, and of what.
pub(super) struct Casting<'a> {
    pub(super) rays: &'a GatherRays<'a>,
    pub(super) cache: Option<&'a CacheRecords>,
    pub(super) sample: &'a Sample,
    /// The part that is made, if not all is.
    pub(super) part: Option<Part>,
    pub(super) order: &'a dyn Generative,
    /// Width and height of the picture.
    pub(super) size: [u32; 2],
    /// Gather rays of all samples of a pixel whose samples each see one point.
    pub(super) gathers_a_pixel: u64,
    /// Where light is wanted that needs no query.
    pub(super) exposure: Option<Exposure>,
}

/// The queries and the light of a job.
pub(super) struct Cast {
    pub(super) queries: Vec<Query>,
    /// Those that wait for the end of the batch.
    pub(super) queued: Vec<Query>,
    /// By pixel, in units of the film.
    pub(super) light: Vec<(u32, Units)>,
    pub(super) counts: RayCounts,
}

impl Casting<'_> {
    /// Casts everything on so many threads and gives it to `done` job by job, in order.
    pub(super) fn run(
        &self,
        threads: usize,
        mut done: impl FnMut(Cast, &Job) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let mut jobs = self.sample.jobs(self.order, self.size, self.part);
        let (rays_a_pixel, worth) = self.worth_a_job();
        in_order(
            threads,
            || anyhow::Ok(some_jobs(&mut jobs, rays_a_pixel, worth)),
            |jobs: Vec<Job>| {
                let mut caster = PixelCaster::new(self.rays, self.cache);
                jobs.into_iter().map(|job| (self.cast(&mut caster, &job), job)).collect::<Vec<_>>()
            },
            |casts| casts.into_iter().try_for_each(|(cast, job)| done(cast?, &job)),
        )
    }

    /// Rays of a pixel at one visit, and rays that are worth a message to a thread and back.
    fn worth_a_job(&self) -> (u64, u64) {
        let bins = u64::from(self.order.bins());
        let rays_a_pixel = self.gathers_a_pixel.div_ceil(bins);
        if bins == 1 {
            return (rays_a_pixel, WORTH_A_JOB);
        }
        let batch = self.order.batches(self.size).next().unwrap_or_default();
        let pixels: u64 = batch.iter().map(|run| run.columns.len() as u64).sum();
        (rays_a_pixel, (PASSES_A_JOB * rays_a_pixel).saturating_mul(pixels).clamp(WORTH_A_JOB, MOST_A_JOB))
    }

    fn cast(&self, caster: &mut PixelCaster<'_>, Job { span, rays: some, .. }: &Job) -> Result<Cast, Overflow> {
        let mut cast = Cast { queries: vec![], queued: vec![], light: vec![], counts: RayCounts::default() };
        let mut too_bright = None;
        let mut left = some.clone();
        for x in span.columns.clone() {
            let pixel = span.row * self.size[0] + x;
            let light = |radiance: glam::Vec3| {
                let Some(exposure) = &self.exposure else { return };
                match exposure.quantise(pixel, radiance) {
                    Ok(units) => cast.light.push((pixel, units)),
                    Err(overflow) => too_bright = Some(overflow),
                }
            };
            let (at, query) = ([x, span.row], |query| cast.queries.push(query));
            match &mut left {
                None => caster.pixel(at, span.pass, query, light, &mut cast.counts),
                Some(left) if left.is_empty() => break,
                Some(left) => caster.some_of_pixel(at, span.pass, left, query, &mut cast.counts),
            }
        }
        cast.queued = caster.take_queued();
        too_bright.map_or(Ok(cast), Err)
    }
}

/// As many jobs as are worth so many rays.
fn some_jobs(jobs: &mut dyn Iterator<Item = Job>, rays_a_pixel: u64, worth: u64) -> Option<Vec<Job>> {
    let (mut some, mut rays) = (vec![], 0);
    while rays < worth {
        let Some(job) = jobs.next() else { break };
        let pixels = u64::from(job.span.columns.end - job.span.columns.start);
        rays += job.rays.as_ref().map_or(pixels * rays_a_pixel, |_| job.size());
        some.push(job);
    }
    Some(some).filter(|some| !some.is_empty())
}
