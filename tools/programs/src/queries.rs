//! `pm-queries`: casts the rays of a picture and writes where photons are to be gathered.

mod args;
mod base;
mod cache;
mod cast;
mod guide;
mod sample;

use crate::cli::{Chooser, Program, Progress, Typed, usage};
use crate::setting;
use args::Args;
use base::{Base, Exposure};
use cast::Casting;
use clap::error::{ContextKind, ContextValue};
use clap::{Arg, CommandFactory, FromArgMatches};
use guide::GuidePhotons;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{BlockMeta, Header, Number, StageReport};
use pm_light::scene::Scene;
use pm_light::transport::{AtSpecular, CacheOptions, CacheRecords, GatherRays, RayCounts};
use pm_orders::{Generative, GenerativeOrder};
use pm_registry::{Choice as _, Chosen, Registry};
use sample::Sample;

/// What was asked: options, and an order in which the pixels are visited.
pub struct Asked {
    args: Args,
    order: Chosen<dyn GenerativeOrder>,
}

/// The program, with these generative orders to choose from.
#[must_use]
pub fn program(orders: &Registry<dyn GenerativeOrder>) -> Program<Asked> {
    let order = Arg::new("order").long("order").value_name("ORDER").help("Order in which the pixels are visited");
    let chooser = Chooser::option(orders, order);
    let command = chooser.add_parameters(chooser.add_word(Args::command()));
    let program = Program::new("pm-queries", command, move |matches| {
        Ok(Asked { args: Args::from_arg_matches(matches)?, order: chooser.read(matches)? })
    });
    program.advising(deferred_order)
}

/// Who asks for an order that queries are put into afterwards is told by which program.
fn deferred_order(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidValue) else { return None };
    let order = pm_orders::orders().find(word).ok()?.word();
    Some(format!("queries are put into the order {order} afterwards: pm-queries | pm-reorder {order}"))
}

/// Does what was asked.
///
/// # Errors
/// If it was asked wrongly, the scene cannot be loaded, or an output cannot be written.
pub fn run(Asked { args, order }: Asked, typed: &Typed) -> anyhow::Result<()> {
    args.check()?;
    let order = &*order.entry.make(&order.values, args.gathers()).map_err(|error| usage(error.to_string()))?;
    let scene = args.scene.load(&args.common)?;
    let camera = args.scene.camera(&scene, &args.camera, &args.common)?;
    let size = camera.size();
    let threads = args.common.threads();

    let mut header = header(&args, &scene, size, order);
    let mut step = typed.step(Some(args.seed));
    let guide = args.guide.as_ref().map(|path| GuidePhotons::read(path, &header.bounds, &args.common)).transpose()?;
    let mut rays = GatherRays::new(&scene, camera, args.options(&scene.bounds)).with_bins(order.bins());
    if let Some(guide) = &guide {
        rays = guide.guide(rays, &args.common);
        guide.describe(rays.are_guided(), &mut header, &mut step);
    }
    header.history.push(step);

    let mut counts = RayCounts::default();
    let sample = args.sample.choose(order, size, &rays, threads, &mut counts)?;
    sample.set_meaning(&mut header);
    let to_do = sample.size(order, size, None);
    let gathers_a_pixel = u64::from(args.samples) * u64::from(args.gathers());
    // Of the whole, also in a part: its parts have one header.
    header.expected_records = Some(to_do * if sample.is_of_rays() { 1 } else { gathers_a_pixel });

    // First, so that a reader of the stream who leaves at once does not leave without the picture being missed.
    let mut base = args.base.as_ref().map(|path| Base::create(path, size, &scene, args.part)).transpose()?;
    let mut output = args.output.begin(&header)?;
    if let Some(guide) = guide.filter(|_| !rays.are_guided()) {
        guide.remark_too_few(&rays, &args.common);
    }
    let options = |accuracy| CacheOptions { accuracy, spacing: args.spacing };
    let cache = args.irradiance_cache.map(|accuracy| CacheRecords::decide(&rays, options(accuracy)));
    if let Some(cache) = &cache {
        cache::write_cache(cache, &rays, size, threads, &mut output)?;
    }

    let to_do = args.part.map_or(to_do, |part| sample.size(order, size, Some(part)));
    let progress = Progress::new(Some(to_do), sample.unit(), args.common.quiet);
    let exposure = base.is_some().then(|| Exposure::new(&scene));
    let casting = Casting {
        rays: &rays,
        cache: cache.as_ref(),
        sample: &sample,
        part: args.part,
        order,
        size,
        gathers_a_pixel,
        exposure,
    };
    // Queries that come last in their batch, and what the batch is.
    let mut queue = (BlockMeta::default(), vec![]);
    casting.run(threads, |cast, job| {
        if queue.0.batch != job.meta.batch && !queue.1.is_empty() {
            output.write(queue.0, &std::mem::take(&mut queue.1))?;
        }
        output.write(job.meta, &cast.queries)?;
        queue.0 = job.meta;
        queue.1.extend(cast.queued);
        base.as_mut().map_or(Ok(()), |base| base.add(cast.light))?;
        counts += cast.counts;
        progress.add(job.size());
        Ok(())
    })?;
    if !queue.1.is_empty() {
        output.write(queue.0, &queue.1)?;
    }
    drop(progress);

    // Other parts may see some.
    if counts.eye > 0 && counts.seen == 0 && args.part.is_none() {
        let eye = if sample.is_of_batches() { "what was chosen of the picture" } else { "the camera" };
        args.common.remark(format!("{eye} sees no diffuse surface: there are no queries"));
    }
    // Complete before the end block is: whoever has read that may read the picture.
    base.map_or(Ok(()), Base::finish)?;
    let report = report(&args, &scene, &sample, cache.as_ref(), counts, StageReport::new(typed.program()));
    output.finish(vec![report])?.commit()
}

/// What the header says of the picture and its rays.
fn header(args: &Args, scene: &Scene, size: [u32; 2], order: &dyn Generative) -> Header {
    let mut header = setting::header(scene);
    header.image = size;
    header.set_meaning(meaning::ORDER, order.label());
    if args.direct_visualisation {
        header.set_meaning(meaning::GATHERS, "none: direct visualisation");
    } else {
        header.set_meaning(meaning::GATHERS, args.gathers());
    }
    if let Some(accuracy) = args.irradiance_cache {
        header.set_meaning(meaning::IRRADIANCE_CACHE, accuracy);
    }
    if args.samples > 1 {
        header.set_meaning(meaning::SAMPLES, args.samples);
    }
    if args.at_specular != AtSpecular::GoOn {
        header.set_meaning(meaning::AT_SPECULAR, args.at_specular.word());
    }
    if args.queue_specular {
        header.set_meaning(meaning::QUEUED, "gather rays behind mirrors and glass, to the end of each batch");
    }
    if let Some(part) = args.part {
        header.set_meaning(meaning::PART, part);
    }
    header
}

/// What the end block says of the work.
fn report(
    args: &Args,
    scene: &Scene,
    sample: &Sample,
    cache: Option<&CacheRecords>,
    counts: RayCounts,
    report: StageReport,
) -> StageReport {
    let mut report = report
        .with(measure::EYE_RAYS, Number::Count(counts.eye))
        .with(measure::GATHER_RAYS, Number::Count(counts.gather))
        .with(measure::GATHER_RAYS_LOST, Number::Count(counts.gather_lost));
    report = sample.measure(report);
    if let Some(cache) = cache {
        report = report.with("irradiance_records", Number::Count(cache.len() as u64));
    }
    if counts.eye_again > 0 {
        report = report.with(measure::EYE_RAYS_AGAIN, Number::Count(counts.eye_again));
    }
    if args.options(&scene.bounds).min_gather_dist > 0.0 {
        report = report.with(measure::GATHER_RAYS_CONTINUED, Number::Count(counts.gather_continued));
    }
    if args.guide.is_some() {
        report = report.with(measure::POINTS_GUIDED, Number::Count(counts.guided));
    }
    report
}
