//! Which of a picture's rays are cast: all, some whole batches, or windows of consecutive rays.

use crate::cli::usage;
use pm_formats::vocabulary::{Part, SampleUnit, meaning, measure};
use pm_formats::{BlockMeta, Header, Number, StageReport};
use pm_light::transport::{GatherRays, Piece, RayCounts, RayPlan};
use pm_orders::{Generative, Span};
use pm_sampling::windows::{StratifiedCells, cell_of};
use std::ops::Range;

/// The options that ask for a sample.
#[derive(clap::Args)]
pub(super) struct SampleArgs {
    /// Cast the rays of N tiles (or scanlines) only, for pm-cachesim to estimate the whole from
    ///
    /// One whole batch in each of N equal parts of the picture, chosen by chance. With --window, N windows of gather rays
    /// instead, one in each of N equal parts of the order of all rays. A window is a batch of the stream and is simulated by
    /// itself, beginning with an empty cache. The queries are those of the whole stream, in its order.
    #[arg(long, value_name = "N", conflicts_with_all = ["base", "irradiance_cache"])]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    only_tiles: Option<u64>,
    /// Consecutive gather rays of each window of --only-tiles, those included that find nothing to ask for
    #[arg(long, value_name = "RAYS", requires = "only_tiles", hide_short_help = true)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    window: Option<u64>,
    /// Rays cast before each --window, to fill the cache; their queries are marked as warm-up and not counted
    #[arg(long, value_name = "RAYS", default_value = "64", requires = "window", hide_short_help = true)]
    warm_up: u64,
    /// Seed of the choice of --only-tiles; the rays themselves go by --seed
    #[arg(long, value_name = "SEED", default_value = "0", requires = "only_tiles", hide_short_help = true)]
    sample_seed: u64,
}

/// What is cast.
pub(super) enum Sample {
    /// Everything.
    All,
    /// Batches with these numbers, in order.
    Batches { chosen: Vec<u64>, of: u64 },
    /// Rays with these numbers in the order of all.
    Windows { plan: RayPlan, measured: Vec<Range<u64>>, length: u64, warm_up: u64 },
}

/// Rays that are cast together: those of a span of pixels, or some of them.
#[derive(Clone)]
pub(super) struct Job {
    pub(super) meta: BlockMeta,
    pub(super) span: Span,
    /// Which of them, counted from the first of the span; `None` is all, with the light that needs no ray.
    pub(super) rays: Option<Range<u64>>,
}

impl SampleArgs {
    /// Chooses the sample. To know where windows are, the eye rays of the picture are cast, and counted in `counts`.
    ///
    /// # Errors
    /// If more is wanted than there is.
    pub(super) fn choose(
        &self,
        order: &dyn Generative,
        size: [u32; 2],
        rays: &GatherRays<'_>,
        threads: usize,
        counts: &mut RayCounts,
    ) -> anyhow::Result<Sample> {
        let Some(n) = self.only_tiles else { return Ok(Sample::All) };
        let Some(length) = self.window else {
            let of = order.batch_count(size);
            let choice = StratifiedCells::new(of, n, self.sample_seed).ok_or_else(|| {
                usage(format!("--only-tiles {n}: the picture has {of} batches (tiles or scanlines): give at most {of}"))
            })?;
            return Ok(Sample::Batches { chosen: choice.cells().collect(), of });
        };
        let plan = RayPlan::new(rays, order, threads, counts);
        let cells = plan.rays().div_ceil(length);
        let choice = StratifiedCells::new(cells, n, self.sample_seed);
        if choice.is_none() && cells > 0 {
            let all = plan.rays();
            return Err(usage(format!(
                "--only-tiles {n}: the order has {all} gather rays, {cells} windows of {length}: give at most {cells}"
            )));
        }
        // Where nothing is seen there are no windows, and an empty stream as without them.
        let measured =
            choice.into_iter().flat_map(StratifiedCells::cells).map(|cell| cell_of(cell, length, plan.rays()));
        Ok(Sample::Windows { measured: measured.collect(), plan, length, warm_up: self.warm_up })
    }
}

impl Sample {
    /// What is cast, in order: all of it, or what is of a part.
    pub(super) fn jobs<'a>(
        &'a self,
        order: &'a dyn Generative,
        size: [u32; 2],
        part: Option<Part>,
    ) -> Box<dyn Iterator<Item = Job> + 'a> {
        let all = self.all_jobs(order, size);
        match part {
            None => all,
            Some(part) => Box::new(all.filter(move |job| part.has(job.meta.batch))),
        }
    }

    fn all_jobs<'a>(&'a self, order: &'a dyn Generative, size: [u32; 2]) -> Box<dyn Iterator<Item = Job> + 'a> {
        let batch = |batch, warm_up| BlockMeta { batch, warm_up, records: 0 };
        match self {
            Self::All => {
                Box::new(order.spans(size).map(move |span| Job { meta: batch(span.batch, false), span, rays: None }))
            }
            Self::Batches { chosen, .. } => Box::new(order.spans(size).filter_map(move |span| {
                let window = chosen.binary_search(&span.batch).ok()? as u64;
                Some(Job { meta: batch(window, false), span, rays: None })
            })),
            Self::Windows { plan, measured, .. } => {
                let jobs = move |window, rays, warm_up| {
                    let job = move |Piece { span, rays }| Job { meta: batch(window, warm_up), span, rays: Some(rays) };
                    plan.pieces(rays).map(job)
                };
                Box::new((0..).zip(measured).flat_map(move |(window, rays)| {
                    jobs(window, self.warm_up(rays), true).chain(jobs(window, rays.clone(), false))
                }))
            }
        }
    }

    /// The rays before a window that only fill the cache.
    fn warm_up(&self, window: &Range<u64>) -> Range<u64> {
        match self {
            Self::Windows { warm_up, .. } => window.start.saturating_sub(*warm_up)..window.start,
            _ => 0..0,
        }
    }

    /// Number of pixels, or else of rays, that [`Job::size`] counts.
    pub(super) fn size(&self, order: &dyn Generative, size: [u32; 2], part: Option<Part>) -> u64 {
        match self {
            _ if part.is_some() => self.jobs(order, size, part).map(|job| job.size()).sum(),
            Self::All => u64::from(size[0]) * u64::from(size[1]),
            Self::Batches { .. } => self.jobs(order, size, None).map(|job| job.size()).sum(),
            Self::Windows { measured, .. } => measured.iter().map(|rays| rays.end - self.warm_up(rays).start).sum(),
        }
    }

    /// What [`Self::size`] counts.
    pub(super) const fn unit(&self) -> &'static str {
        if self.is_of_rays() { "rays" } else { "pixels" }
    }

    /// Are single rays counted, not pixels?
    pub(super) const fn is_of_rays(&self) -> bool {
        matches!(self, Self::Windows { .. })
    }

    /// Are whole batches left out?
    pub(super) const fn is_of_batches(&self) -> bool {
        matches!(self, Self::Batches { .. })
    }

    /// Says in a header what of the whole its stream holds, where that is not all.
    pub(super) fn set_meaning(&self, header: &mut Header) {
        let (sample, of, windows, share) = match self {
            Self::All => return,
            Self::Batches { chosen, of } => {
                let n = chosen.len();
                (format!("{n} of {of} batches"), SampleUnit::Batches, n, n as f64 / *of as f64)
            }
            Self::Windows { plan, measured, length, warm_up } => {
                let (n, rays) = (measured.len(), measured.iter().map(|rays| rays.end - rays.start).sum::<u64>());
                let share = if plan.rays() == 0 { 1.0 } else { rays as f64 / plan.rays() as f64 };
                (format!("{n} windows of {length} rays after {warm_up}"), SampleUnit::Rays, n, share)
            }
        };
        header.set_meaning(meaning::SAMPLE, sample);
        header.set_meaning(meaning::SAMPLE_OF, of);
        header.set_meaning(meaning::SAMPLE_WINDOWS, windows);
        header.set_meaning(meaning::SAMPLE_SHARE, share);
    }

    /// Adds to the end block what the header does not say.
    pub(super) fn measure(&self, report: StageReport) -> StageReport {
        match self {
            Self::All => report,
            Self::Batches { chosen, of } => report
                .with(measure::BATCHES_GIVEN, Number::Count(*of))
                .with(measure::BATCHES_KEPT, Number::Count(chosen.len() as u64)),
            Self::Windows { plan, measured, .. } => {
                report.with(measure::GATHER_RAYS_OF_ALL, Number::Count(plan.rays())).with(
                    measure::GATHER_RAYS_MEASURED,
                    Number::Count(measured.iter().map(|rays| rays.end - rays.start).sum()),
                )
            }
        }
    }
}

impl Job {
    /// Pixels that are visited for the first time, or else the number of rays.
    pub(super) fn size(&self) -> u64 {
        match &self.rays {
            Some(rays) => rays.end - rays.start,
            None if self.span.pass.is_first() => u64::from(self.span.columns.end - self.span.columns.start),
            None => 0,
        }
    }
}
