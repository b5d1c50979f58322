//! Casts the rays of a picture and writes where photons are to be gathered.

#[path = "pm-queries/part.rs"]
mod part;

use anyhow::Context as _;
use clap::Parser;
use part::{Job, PartArgs};
use pm_film::film::{Film, Overflow};
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{
    BLOCK_RECORDS, Bounds, Number, Photon, Query, RecordWriter, StageReport, encode_irradiance, encode_weights,
};
use pm_light::transport::{
    CacheOptions, CacheRecords, GatherOptions, GatherRays, Method, RayCounts, Spread, Strata, Visits,
};
use pm_orders::Generative;
use pm_parallel::in_order;
use pm_pictures::{Format, Picture};
use pm_programs::cli::choice;
use pm_programs::cli::{self, Common, Output, OutputArgs, Progress, Typed, Whole, create_output, named};
use pm_programs::setting::{CameraArgs, SceneArgs, header};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Cast eye rays and final-gather rays; write a gather query wherever one ends on a diffuse surface.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    camera: CameraArgs,
    /// Gather rays for each point seen, in a grid of strata
    #[arg(long, value_name = "N", default_value = "100", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    gathers: u32,
    /// Eye rays for each pixel; one goes through its middle, more are spread over it
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    samples: u32,
    /// Ask at the points seen, without gather rays: the picture shows the photon map itself
    #[arg(long)]
    direct_visualisation: bool,
    /// How gather rays are spread over the hemisphere
    #[arg(long, default_value = "cosine", hide_short_help = true, value_parser = choice::<Spread>())]
    sampling: Spread,
    /// Send more gather rays to where these photons come from, and let them weigh less for it: the picture is the same
    /// but for its noise. `-` is standard input
    #[arg(long, value_name = "PHOTONS", hide_short_help = true)]
    guide: Option<PathBuf>,
    /// Gather rays shorter than this, in scene units, are continued by one more bounce; `auto` is 1/100 of the scene's
    /// diagonal
    #[arg(long, value_name = "X|auto", default_value = "0", value_parser = least_distance, hide_short_help = true)]
    min_gather_dist: LeastDistance,
    /// Leave caustics on the points seen to a map of their own, of `pm-photons --caustics` and asked by
    /// `pm-queries --direct-visualisation`: a gather ray that meets a lamp in a mirror or through glass does not count
    #[arg(long, hide_short_help = true)]
    no_caustics: bool,
    /// Order in which the pixels are visited
    #[arg(long, default_value = "scanline")]
    order: Order,
    /// Width and height of a tile in pixels
    #[arg(long, value_name = "PIXELS", default_value = "16", value_parser = clap::value_parser!(u32).range(1..))]
    tile: u32,
    /// Bins of the hemisphere for --order direction-binned, at most as many as --gathers; default: as many
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), hide_short_help = true)]
    bins: Option<u32>,
    /// In which order the gather rays of a point are cast
    #[arg(long, default_value = "raster", hide_short_help = true, value_parser = choice::<Strata>())]
    strata: Strata,
    /// Also write the direct and emitted light as an EXR or PNG picture, before the stream ends
    #[arg(long, value_name = "FILE")]
    base: Option<PathBuf>,
    /// Cache irradiance (Ward): gather only where no record serves with an error below A, such as 0.1; pixels interpolate
    #[arg(long, value_name = "A", value_parser = accuracy, conflicts_with = "direct_visualisation")]
    irradiance_cache: Option<f32>,
    /// Least and greatest distance at which a record of cached irradiance still serves, in pixels
    #[arg(long, value_name = "MIN,MAX", default_value = "3,20", value_parser = spacing, hide_short_help = true)]
    spacing: [f32; 2],
    /// Shadow rays for each point seen, for the direct light
    #[arg(
        long, value_name = "N", default_value = "16", hide_short_help = true,
        value_parser = clap::value_parser!(u32).range(1..=1 << 20)
    )]
    light_samples: u32,
    #[command(flatten)]
    part: PartArgs,
    /// Seed of the random numbers
    #[arg(long, default_value = "0")]
    seed: u64,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Order {
    /// Pixel by pixel, row by row; a row is a batch
    Scanline,
    /// Square tiles, each in scanline order and a batch; what is seen by reflection or refraction comes last in each
    Tiled,
    /// As tiled, with a pass over each tile for every bin of the hemisphere
    DirectionBinned,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-queries --size 512x512 --order tiled --tile 8 -t 2 -o tiled.pmq
  pm-queries --size 512x512 --only-tiles 800 --window 250 | pm-gather | pm-cachesim
  pm-queries room.obj --eye 0,1.6,4 --look-at 0,1,0 --base direct.exr | pm-gather --base direct.exr --image room.exr --no-trace";

/// What is short for a gather ray.
#[derive(Clone, Copy)]
enum LeastDistance {
    /// In scene units.
    Fixed(f32),
    /// A share of the scene's diagonal, [`AUTO_SHARE`].
    Auto,
}

/// Share of the scene's diagonal below which a gather ray is short by itself: about the radius that 100 photons take of
/// half a million in a room.
const AUTO_SHARE: f32 = 0.01;
/// Most gather rays of all samples of a pixel: leaves room for 256 points seen by one eye ray in the sample numbers.
const MOST_GATHERS: u64 = 1 << 24;

/// Gather rays that are cast as one piece of work, at least.
const WORTH_A_JOB: u64 = 2000;
/// Passes over a tile that are one, so that its eye rays are not cast for each of them; and most rays.
const PASSES_A_JOB: u64 = 16;
const MOST_A_JOB: u64 = 1 << 16;

fn least_distance(text: &str) -> Result<LeastDistance, String> {
    match text.parse::<f32>() {
        _ if text == "auto" => Ok(LeastDistance::Auto),
        Ok(x) if x >= 0.0 && x.is_finite() => Ok(LeastDistance::Fixed(x)),
        _ => Err("a distance of 0 or more, or `auto`, is expected".into()),
    }
}

fn main() -> ExitCode {
    cli::main("pm-queries", run)
}

fn accuracy(text: &str) -> Result<f32, String> {
    let error = "an error above 0 and at most 1 is expected, such as 0.1";
    text.parse().ok().filter(|&a: &f32| a > 0.0 && a <= 1.0).ok_or_else(|| error.into())
}

fn spacing(text: &str) -> Result<[f32; 2], String> {
    let parsed = text.split_once(',').and_then(|(min, max)| Some([min.trim().parse().ok()?, max.trim().parse().ok()?]));
    let error = "two distances in pixels are expected, the lesser first and above 0, such as 3,20";
    parsed.filter(|&[min, max]: &[f32; 2]| min > 0.0 && max >= min && max.is_finite()).ok_or_else(|| error.into())
}

/// The queries and the light of a job.
struct Cast {
    queries: Vec<Query>,
    light: Vec<(u32, [i128; 3])>,
    counts: RayCounts,
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    if let Some(base) = &args.base {
        Format::of(base)?;
    }
    if u64::from(args.samples) * u64::from(args.gathers) > MOST_GATHERS {
        return Err(cli::usage(format!("--samples times --gathers is more than {MOST_GATHERS}")));
    }
    if args.guide.is_some() {
        refuse_guide(&args)?;
    }
    let scene = args.scene.load(&args.common)?;
    let camera = args.scene.camera(&scene, &args.camera, &args.common)?;
    let size = camera.size();
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    let order = match args.order {
        Order::Scanline => Generative::Scanline,
        Order::Tiled => Generative::Tiled { tile: args.tile },
        Order::DirectionBinned => {
            // Points seen that are asked at themselves have no hemisphere.
            let strata = if args.direct_visualisation { 1 } else { args.gathers };
            let bins = args.bins.unwrap_or(strata);
            if bins > strata {
                return Err(cli::usage(format!(
                    "--bins {bins} is more than the {strata} strata: give at most {strata}"
                )));
            }
            Generative::DirectionBinned { tile: args.tile, bins }
        }
    };
    let mut header = header(&scene);
    header.image = size;
    let gathers = if args.direct_visualisation { 1 } else { args.gathers };
    header.set_meaning(meaning::ORDER, order);
    if args.direct_visualisation {
        header.set_meaning(meaning::GATHERS, "none: direct visualisation");
    } else {
        header.set_meaning(meaning::GATHERS, args.gathers);
    }
    if let Some(accuracy) = args.irradiance_cache {
        header.set_meaning(meaning::IRRADIANCE_CACHE, accuracy);
    }
    if args.samples > 1 {
        header.set_meaning(meaning::SAMPLES, args.samples);
    }
    let guide = args.guide.as_ref().map(|path| read_guide(path, &header.bounds, &args.common)).transpose()?;
    let mut step = typed.step(Some(args.seed));
    if let (Some(path), Some(guide)) = (&args.guide, &guide) {
        header.set_meaning(meaning::SAMPLING, "guided");
        header.set_meaning(meaning::GUIDE, format!("{} photons, digest {}", guide.tally.records, guide.tally.digest));
        step.inputs.push((path.display().to_string(), guide.header.history.clone()));
    }
    header.history.push(step);

    let options = GatherOptions {
        method: if args.direct_visualisation { Method::DirectVisualisation } else { Method::FinalGather },
        samples: args.samples,
        gathers,
        spread: args.sampling,
        min_gather_dist: match args.min_gather_dist {
            LeastDistance::Fixed(x) => x,
            LeastDistance::Auto => scene.bounds.size().length() * AUTO_SHARE,
        },
        caustics: !args.no_caustics,
        light_samples: args.light_samples,
        seed: args.seed,
        // Records carry the light that their rays meet, picture or not.
        direct: args.base.is_some() || args.irradiance_cache.is_some(),
        strata: args.strata,
    };
    let mut rays = GatherRays::new(&scene, camera, options).with_bins(order.bins());
    if let (Some(path), Some(guide)) = (&args.guide, guide) {
        rays = rays.guided_by(&guide.records);
        if rays.guiding_photons() == 0 {
            let why = if guide.records.is_empty() { "no photons" } else { "only photons straight from the lamps" };
            let path = named(path);
            args.common.remark(format!("{path} holds {why}: nothing guides the gather rays, the cosine spreads them"));
        }
    }
    let mut counts = RayCounts::default();
    let part = args.part.choose(order, size, &rays, args.common.threads(), &mut counts)?;
    part.set_meaning(&mut header);
    let to_do = part.size(order, size);
    let most = if part.unit() == "rays" { 1 } else { u64::from(args.samples) * u64::from(gathers) };
    header.expected_records = Some(to_do * most);

    // First, so that a reader of the stream who leaves at once does not leave without the picture being missed.
    let base = args.base.as_ref().map(|path| create_output(path).map(|file| (path, file))).transpose()?;
    let mut output = RecordWriter::new(args.output.create()?, &header)?;
    let wanted = base.is_some();
    let mut film = Film::new(if wanted { usize::try_from(pixels)? } else { 0 }, light_scale(&scene));
    // The threads only need its unit.
    let unit = Film::new(0, light_scale(&scene));

    let cache = args
        .irradiance_cache
        .map(|accuracy| CacheRecords::decide(&rays, CacheOptions { accuracy, spacing: args.spacing }));
    if let Some(cache) = &cache {
        write_cache(cache, &rays, size, args.common.threads(), &mut output)?;
    }

    let progress = Progress::new(Some(to_do), part.unit(), args.common.quiet);
    let mut jobs = part.jobs(order, size);
    // A span of few rays is not worth a message to a thread and back.
    let rays_a_pixel = u64::from(args.samples) * u64::from(gathers.div_ceil(order.bins()));
    let worth = match order {
        Generative::DirectionBinned { tile, .. } => {
            (PASSES_A_JOB * rays_a_pixel).saturating_mul(u64::from(tile).pow(2)).clamp(WORTH_A_JOB, MOST_A_JOB)
        }
        _ => WORTH_A_JOB,
    };
    let some_jobs = || {
        let (mut some, mut rays) = (vec![], 0);
        while rays < worth {
            let Some(job) = jobs.next() else { break };
            let pixels = u64::from(job.span.columns.end - job.span.columns.start);
            rays += job.rays.as_ref().map_or(pixels * rays_a_pixel, |_| job.size());
            some.push(job);
        }
        anyhow::Ok(Some(some).filter(|some| !some.is_empty()))
    };
    let cast = |visits: &mut Visits<'_>, Job { span, rays: some, .. }: &Job| {
        let mut cast = Cast { queries: vec![], light: vec![], counts: RayCounts::default() };
        let mut too_bright = None;
        let mut left = some.clone();
        for x in span.columns.clone() {
            let pixel = span.row * size[0] + x;
            let light = |radiance: glam::Vec3| {
                if wanted {
                    match unit.quantise(radiance.as_dvec3().into()) {
                        Some(units) => cast.light.push((pixel, units)),
                        None => too_bright = Some(Overflow(pixel)),
                    }
                }
            };
            let (at, query) = ([x, span.row], |query| cast.queries.push(query));
            match &mut left {
                None => visits.pixel(at, span.pass, cache.as_ref(), query, light, &mut cast.counts),
                Some(left) if left.is_empty() => break,
                Some(left) => visits.some_of_pixel(at, span.pass, left, query, &mut cast.counts),
            }
        }
        too_bright.map_or(Ok(cast), Err)
    };
    in_order(
        args.common.threads(),
        some_jobs,
        |jobs: Vec<Job>| {
            let mut visits = rays.visits();
            jobs.into_iter().map(|job| (cast(&mut visits, &job), job)).collect::<Vec<_>>()
        },
        |casts| {
            for (cast, job) in casts {
                let cast = cast?;
                output.write(job.meta, &cast.queries)?;
                for (pixel, units) in cast.light {
                    film.add(pixel, units)?;
                }
                counts += cast.counts;
                progress.add(job.size());
            }
            anyhow::Ok(())
        },
    )?;
    drop(progress);

    if counts.eye > 0 && counts.seen == 0 {
        let eye = if part.is_of_batches() { "what was chosen of the picture" } else { "the camera" };
        args.common.remark(format!("{eye} sees no diffuse surface: there are no queries"));
    }
    // Complete before the end block is: whoever has read that may read the picture.
    if let Some((path, mut file)) = base {
        Picture { size, pixels: film.pixels() }.write(path, &mut file, &cli::software(), &[])?;
        file.commit().with_context(|| path.display().to_string())?;
    }
    let mut report = StageReport::new(typed.program())
        .with(measure::EYE_RAYS, Number::Count(counts.eye))
        .with(measure::GATHER_RAYS, Number::Count(counts.gather))
        .with(measure::GATHER_RAYS_LOST, Number::Count(counts.gather_lost));
    report = part.measure(report);
    if let Some(cache) = &cache {
        report = report.with("irradiance_records", Number::Count(cache.len() as u64));
    }
    if counts.eye_again > 0 {
        report = report.with(measure::EYE_RAYS_AGAIN, Number::Count(counts.eye_again));
    }
    if options.min_gather_dist > 0.0 {
        report = report.with("gather_rays_continued", Number::Count(counts.gather_continued));
    }
    if args.guide.is_some() {
        report = report.with("points_guided", Number::Count(counts.guided));
    }
    output.finish(vec![report])?.commit()
}

/// Says what a guide does not go together with.
fn refuse_guide(args: &Args) -> anyhow::Result<()> {
    if args.direct_visualisation {
        return Err(cli::usage(
            "--guide guides gather rays, and --direct-visualisation casts none: leave out one of them",
        ));
    }
    if args.irradiance_cache.is_some() {
        return Err(cli::usage(
            "--guide and --irradiance-cache exclude each other: the gradients of cached irradiance need evenly spread rays",
        ));
    }
    if args.sampling == Spread::Uniform {
        return Err(cli::usage("--guide has half of its rays spread by the cosine: leave out --sampling uniform"));
    }
    Ok(())
}

/// Share of the scene's diagonal by which the bounds of a guide's photons may differ from the scene's.
const STRANGE: f32 = 0.1;

/// Reads the photons that guide; remarks if they seem to be of another scene.
fn read_guide(path: &Path, bounds: &Bounds, common: &Common) -> anyhow::Result<Whole<Photon>> {
    let guide = cli::read_whole::<Photon>(path)?;
    let corners = |bounds: &Bounds| [glam::Vec3::from(bounds.min), glam::Vec3::from(bounds.max)];
    let ([min, max], [other_min, other_max]) = (corners(bounds), corners(&guide.header.bounds));
    let far = (max - min).length() * STRANGE;
    if !guide.records.is_empty() && (min.distance(other_min) > far || max.distance(other_max) > far) {
        let path = named(path);
        common.remark(format!("{path} is not of this scene: its bounds differ; what it guides wrongly is noisier"));
    }
    Ok(guide)
}

/// Irradiance records to a block: their rays make them large.
const RECORDS_A_BLOCK: usize = 32;

/// Writes the records of cached irradiance and what each pixel takes of them, ahead of all queries.
fn write_cache(
    cache: &CacheRecords,
    rays: &GatherRays<'_>,
    [width, height]: [u32; 2],
    threads: usize,
    output: &mut RecordWriter<Query, Output>,
) -> anyhow::Result<()> {
    let mut firsts = (0..cache.len()).step_by(RECORDS_A_BLOCK);
    in_order(
        threads,
        || anyhow::Ok(firsts.next()),
        |first| {
            let ids = first..(first + RECORDS_A_BLOCK).min(cache.len());
            let records: Vec<_> = ids.map(|id| cache.record(rays, id as u32)).collect();
            encode_irradiance(&records)
        },
        |encoded| {
            let (block, tally) = encoded?;
            Ok(output.write_beside(&block, tally)?)
        },
    )?;
    let mut rows = 0..height;
    in_order(
        threads,
        || anyhow::Ok(rows.next()),
        |y| {
            let mut weights = vec![];
            (0..width).for_each(|x| cache.weights(rays, x, y, |weight| weights.push(weight)));
            weights.chunks(BLOCK_RECORDS).map(encode_weights).collect::<Vec<_>>()
        },
        |encoded| {
            for encoded in encoded {
                let (block, tally) = encoded?;
                output.write_beside(&block, tally)?;
            }
            Ok(())
        },
    )
}

/// Radiance that the lights' flux suggests for a scene of this size.
fn light_scale(scene: &pm_light::scene::Scene) -> f64 {
    let flux = scene.emitted_flux().into_iter().fold(0.0, f64::max);
    flux / scene.bounds.size().as_dvec3().length_squared()
}
