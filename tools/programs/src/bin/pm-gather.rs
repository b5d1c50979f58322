//! Answers gather queries from a photon map and writes the memory reads that this takes.

use anyhow::{Context as _, bail, ensure};
use clap::Parser;
use pm_film::film::Film;
use pm_film::irradiance::CachedIrradiance;
use pm_formats::trace::TraceWriter;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{
    Block, BlockReader, End, Header, Number, Photon, Section, StageReport, Step, StreamKind, Tally, decode_irradiance,
    decode_weights,
};
use pm_maps::gather::{
    Answered, Answerer, Edges, EstimateOptions, Estimator, Fault, Kernel, Lookups, Precomputation,
    PrecomputedIrradiance, RadianceEstimate, SearchCounts,
};
use pm_maps::{AnyMap, Building, PhotonMap, Search, StartRadius};
use pm_parallel::in_order;
use pm_pictures::{Picture, PictureFormat};
use pm_programs::cli::choice;
use pm_programs::cli::{
    self, Common, Input, Output, OutputArgs, Progress, Typed, Whole, create_output, named, open_input,
};
use pm_programs::map_args::MapArgs;
use pm_registry::Choice as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

#[path = "pm-gather/gathered.rs"]
mod gathered;
use gathered::Gathered;

/// Answer gather queries from a photon map; write the memory reads as a trace, and the picture on request.
///
/// Each query asks for the k photons nearest to a point. The trace holds which records of the map each search read; the
/// picture is the sum of the radiance estimates and does not depend on the order of the queries by a single bit.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Photons to build the map from
    #[arg(default_value = "map.pmp")]
    photons: PathBuf,
    /// Queries to answer; `-` is standard input
    #[arg(default_value = "-")]
    queries: PathBuf,
    #[command(flatten)]
    structure: MapArgs,
    /// Number of nearest photons to gather
    #[arg(short, default_value = "100", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    k: u32,
    /// Largest distance at which a photon counts, in scene units: part of the answer
    #[arg(long, value_name = "X|inf", default_value = "inf", value_parser = distance)]
    max_dist: f32,
    /// Radius a search starts with: changes the reads, not the answer
    ///
    /// It is doubled until the search finds enough. `auto` is the radius that 99 % of the searches at 1,000 photons need.
    #[arg(long, value_name = "X|inf|auto", default_value = "auto", value_parser = start_radius)]
    start_radius: StartRadius,
    /// Start from what the search before knows: changes the reads, not the answer
    ///
    /// All k photons of the query q' before lie within |q - q'| + r_k(q') of q. The chain begins anew with each block of the
    /// stream, after 4,096 queries at most and at the end of a batch.
    #[arg(long)]
    carry: bool,
    /// Also log the second touch of each inner node of kd, when the search comes back to it for its own photon
    #[arg(long, hide_short_help = true)]
    reread: bool,
    /// How photons become radiance
    #[arg(long, default_value = "unbiased", value_parser = choice::<Estimator>())]
    estimator: Estimator,
    /// Take the irradiance of the nearest of every fourth photon, computed beforehand
    ///
    /// Christensen's method: one photon with a similar normal is searched for instead of k, in a tree of its own, which is
    /// what the trace holds. The searches for k that are made beforehand are counted in the trace's end block. Queries of
    /// glossy surfaces search for k as ever. Some error for far fewer reads; k should be well above 16.
    #[arg(long, conflicts_with_all = ["pad", "report"])]
    precomputed: bool,
    /// One of how many photons holds precomputed irradiance
    #[arg(
        long, value_name = "N", default_value = "4", requires = "precomputed", hide_short_help = true,
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    precomputed_share: u32,
    /// How much a photon counts by its distance
    #[arg(long, default_value = "constant", hide_short_help = true, value_parser = choice::<Kernel>())]
    kernel: Kernel,
    /// What the flux is divided by where the photons' disc reaches beyond an edge of the surface
    #[arg(long, default_value = "cut", hide_short_help = true, value_parser = choice::<Edges>())]
    edges: Edges,
    /// Picture to write, .exr (linear) or .png (preview); may be given more than once
    #[arg(long, value_name = "FILE")]
    image: Vec<PathBuf>,
    /// Take cached irradiance as it is at its record, without the gradients
    #[arg(long, hide_short_help = true)]
    no_gradients: bool,
    /// Stops by which PNG previews are brightened; EXR pictures keep their radiance
    #[arg(long, value_name = "STOPS", default_value = "0", allow_hyphen_values = true, hide_short_help = true)]
    exposure: f32,
    /// EXR picture to add, such as the direct light that `pm-queries --base` wrote; read after the last query
    #[arg(long, value_name = "FILE")]
    base: Option<PathBuf>,
    /// Write no trace: for the picture, or for speed alone
    #[arg(long, conflicts_with = "output")]
    no_trace: bool,
    /// Describe lookups, map and its building in a .csv, .json or text file
    ///
    /// A row of named columns, in text a line for each. Approximate maps are compared with exact answers for 1,000 queries:
    /// light_error_rms and light_bias are differences of what a query adds to its pixel, over its mean, and not of pixels
    /// (`pm-view exact.exr approximate.exr`). `-` is standard output, with --no-trace.
    #[arg(long, value_name = "FILE", hide_short_help = true)]
    report: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    common: Common,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-queries --base direct.exr | pm-gather --base direct.exr --image out.exr --image out.png --no-trace -t 2
  pm-gather map.pmp queries.pmq -k 50 --start-radius inf -o trace.pmt";

fn main() -> ExitCode {
    cli::main("pm-gather", run)
}

fn distance(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(x) if x >= 0.0 => Ok(x),
        _ => Err("a distance of 0 or more, or `inf`, is expected".into()),
    }
}

fn start_radius(text: &str) -> Result<StartRadius, String> {
    match text {
        "auto" => Ok(StartRadius::Auto),
        "inf" => Ok(StartRadius::Unbounded),
        _ => match text.parse::<f32>() {
            Ok(x) if x > 0.0 => Ok(StartRadius::Fixed(x)),
            _ => Err("a radius above 0, `inf` or `auto` is expected".into()),
        },
    }
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    for image in &args.image {
        cli::picture_format(image)?;
    }
    if args.photons == Path::new("-") && args.queries == Path::new("-") {
        return Err(cli::usage(
            "photons and queries cannot both come from standard input; name a file for one of them",
        ));
    }
    if !args.exposure.is_finite() {
        return Err(cli::usage("--exposure: a finite number of stops is expected"));
    }
    if let Some(problem) = args.structure.options().problem() {
        return Err(cli::usage(problem));
    }
    let standard = |path: &Option<PathBuf>| path.as_deref().is_some_and(|path| path == Path::new("-"));
    if standard(&args.report) && !args.no_trace && (args.output.output.is_none() || standard(&args.output.output)) {
        return Err(cli::usage(
            "--report - and the trace cannot share standard output; name a file or give --no-trace",
        ));
    }
    if args.base.is_some() && args.image.is_empty() {
        return Err(cli::usage("--base is added to a picture: ask for one with --image"));
    }
    let photons = PhotonInput::read(&args.photons)?;
    let queries = open_input(&args.queries)?.expect_kind(StreamKind::Queries).with_context(|| named(&args.queries))?;
    if let Some(sample) = queries.header().meaning(meaning::SAMPLE).filter(|_| !args.image.is_empty()) {
        let name = named(&args.queries);
        return Err(cli::usage(format!(
            "--image: {name} is a sample ({sample}), and a part of the queries gives no picture: leave out --image"
        )));
    }
    if photons.header.bounds != queries.header().bounds {
        args.common.remark("the photons and the queries are not of the same scene: their bounds differ");
    }
    let build = || args.structure.options().build(&photons.photons, args.k as usize);
    let built = match args.report {
        Some(_) => Building::measure(build).map(|(map, building)| (map, Some(building))),
        None => build().map(|map| (map, None)),
    };
    let (map, building) = built.with_context(|| named(&args.photons))?;
    gather(&args, typed, (&map, building), &photons, queries)
}

/// A photon stream read as a whole.
struct PhotonInput {
    header: Header,
    photons: Vec<Photon>,
    emitted_paths: u64,
    tally: Tally,
}

impl PhotonInput {
    fn read(path: &Path) -> anyhow::Result<Self> {
        let Whole { header, records: photons, end, tally } = cli::read_whole::<Photon>(path)?;
        let Some(Number::Count(emitted_paths)) = end.measure(measure::EMITTED_PATHS) else {
            let name = named(path);
            bail!("{name}: the end block does not say how many paths were emitted; was it made by pm-photons?");
        };
        Ok(Self { header, photons, emitted_paths, tally })
    }
}

fn gather(
    args: &Args,
    typed: &Typed,
    (map, building): (&AnyMap, Option<Building>),
    photons: &PhotonInput,
    mut queries: BlockReader<Input>,
) -> anyhow::Result<()> {
    let k = args.k as usize;
    if args.carry && !map.is_exact() {
        args.common.remark("--carry: an approximate map reads the same wherever it starts");
    }
    let search = match args.start_radius {
        _ if !map.is_exact() => Search::new(k, args.max_dist),
        StartRadius::Unbounded => Search::new(k, args.max_dist),
        StartRadius::Auto => Search::new(k, args.max_dist).fit_start(map, &photons.photons),
        StartRadius::Fixed(start) => Search { start: start.min(args.max_dist), ..Search::new(k, args.max_dist) },
    };
    let query_header = queries.header().clone();
    let mut header = query_header.clone();
    header.regions = map.regions(args.reread);
    header.set_meaning(meaning::MAP, args.structure.map.word());
    header.set_meaning(meaning::K, args.k);
    let inputs = vec![(args.photons.display().to_string(), photons.header.history.clone())];
    header.history.push(Step { inputs, ..typed.step_from(&args.queries, None) });

    // First, so that a reader of the trace who leaves at once does not leave without the pictures being missed.
    let images: Vec<(&PathBuf, Output)> =
        args.image.iter().map(|path| Ok((path, create_output(path)?))).collect::<anyhow::Result<_>>()?;
    let report = args.report.as_ref().map(|path| create_output(path)).transpose()?;
    let estimate = RadianceEstimate::new(
        &photons.photons,
        &query_header.materials,
        photons.emitted_paths,
        EstimateOptions {
            k,
            max_dist: args.max_dist,
            estimator: args.estimator,
            kernel: args.kernel,
            edges: args.edges,
        },
    );
    let precomputed = args
        .precomputed
        .then(|| {
            let how = Precomputation {
                map,
                search,
                reread: args.reread,
                photons: &photons.photons,
                estimate: &estimate,
                share: args.precomputed_share,
                materials: &query_header.materials,
            };
            let mut sites = PrecomputedIrradiance::new(&how, args.common.threads())?;
            header.regions = sites.lay_out(std::mem::take(&mut header.regions));
            header.set_meaning(meaning::PRECOMPUTED, &sites);
            anyhow::Ok(sites)
        })
        .transpose()?;
    let mut trace = match args.no_trace {
        true => None,
        false => Some(TraceWriter::new(args.output.create()?, &header)?),
    };
    let name = named(&args.queries);
    let (cache, first, beside) = read_cache(&mut queries, !args.no_gradients).with_context(|| name.clone())?;
    let scale = estimate.scale(&query_header.bounds);
    let wanted = !images.is_empty();
    let mut film = Film::new(if wanted { usize::try_from(query_header.pixels())? } else { 0 }, scale);
    let mut sums = Film::new(if wanted { cache.sums() } else { 0 }, scale);
    // The threads only need the films' unit.
    let unit = Film::new(0, scale);
    let answerer = Answerer {
        search,
        carry: args.carry,
        describe: report.is_some().then_some((args.structure.line, &header.regions[..])),
        map,
        header: &query_header,
        reread: args.reread,
        regions: trace.is_some().then_some(&header.regions[..]),
        cache: &cache,
        precomputed: precomputed.as_ref(),
        estimate: wanted.then_some((&estimate, &unit)),
    };

    let queries = std::cell::RefCell::new(queries);
    let progress = Progress::new(query_header.expected_records, "queries", args.common.quiet);
    let (mut tally, mut counts, mut first) = (beside, SearchCounts::default(), first);
    let mut lookups: Option<Lookups> = None;
    let start = Instant::now();
    in_order(
        args.common.threads(),
        || match first.take() {
            Some(block) => Ok(Some(block)),
            None => queries.borrow_mut().next_block().with_context(|| name.clone()),
        },
        |block| answerer.answer(&block),
        |answered: Result<Answered, Fault>| {
            let answered = answered.map_err(|fault| match fault {
                Fault::Damaged(what) => anyhow::Error::from(queries.borrow().damaged(what)).context(name.clone()),
                Fault::TooBright(overflow) => overflow.into(),
                Fault::Format(error) => error.into(),
            })?;
            if let (Some(trace), Some((block, tally))) = (&mut trace, &answered.trace) {
                trace.write(block, *tally)?;
            }
            for (pixel, units) in answered.contributions {
                film.add(pixel, units)?;
            }
            for (sum, units) in answered.cached {
                sums.add(sum, units)?;
            }
            progress.add(answered.tally.records);
            tally += answered.tally;
            counts += answered.counts;
            match (&mut lookups, answered.lookups) {
                (Some(lookups), Some(more)) => *lookups += more,
                (none, more) => *none = more,
            }
            Ok(())
        },
    )?;
    drop(progress);
    let seconds = start.elapsed().as_secs_f64();
    let queries = queries.into_inner();
    let end = queries.end(tally).context(name)?;

    if counts.no_area > 0 {
        args.common.remark(format!(
            "{} of {} queries have all their photons at one point: nothing was added for them (a larger k helps)",
            counts.no_area, tally.records
        ));
    }
    // The backs of lamps and the like are no news.
    if counts.no_site > tally.records / 10 {
        args.common.remark(format!(
            "{} of {} queries have no precomputed irradiance of a similar normal near: nothing was added for them",
            counts.no_site, tally.records
        ));
    }
    let mut picture = Picture { size: query_header.image, pixels: film.pixels() };
    if wanted && !cache.is_empty() {
        // Like the base picture, which holds the light that comes without a search to all other points.
        if args.base.is_some() {
            cache.add_lights(&mut sums)?;
        }
        cache.interpolate(&sums, &mut picture.pixels);
    }
    write_images(args, picture, images, &origin(args, photons, &query_header, tally))?;
    if let Some(output) = report {
        let lookups = lookups.unwrap_or_else(|| Lookups::new(args.structure.line, &header.regions, None));
        let gathered =
            Gathered { args, map, building, photons: &photons.photons, search, header: &header, counts, seconds };
        gathered.write(&estimate, lookups, output)?;
    }
    if let Some(trace) = trace {
        let mut stages = stages(typed, end, photons, (&search, &map.measures()), counts, tally);
        if let (Some(sites), Some(stage)) = (&precomputed, stages.pop()) {
            let stage = stage.with("lookups_without_site", Number::Count(counts.no_site));
            stages.push(sites.report(stage));
        }
        trace.finish(stages)?.commit()?;
    }
    Ok(())
}

fn stages(
    typed: &Typed,
    end: &End,
    photons: &PhotonInput,
    (search, measures): (&Search, &[(&str, Number)]),
    counts: SearchCounts,
    tally: Tally,
) -> Vec<StageReport> {
    let mut stages = end.stages.clone();
    stages.push(
        measures.iter().fold(
            StageReport::new(typed.program())
                .with("photons", Number::Count(photons.photons.len() as u64))
                .with("queries", Number::Count(tally.records))
                .with("accesses", Number::Count(counts.accesses))
                .with("attempts", Number::Count(counts.attempts))
                .with("start_radius", Number::Real(f64::from(search.start)))
                .with("short_lookups", Number::Count(counts.short))
                .with("lookups_without_area", Number::Count(counts.no_area)),
            |stage, &(name, number)| stage.with(name, number),
        ),
    );
    stages
}

/// Reads what stands before the first query: cached irradiance, if there is any. Also returns the first block of
/// queries, and what was read for the digest.
fn read_cache(
    queries: &mut BlockReader<Input>,
    gradients: bool,
) -> pm_formats::Result<(CachedIrradiance, Option<Block>, Tally)> {
    let (mut records, mut weights, mut tally) = (vec![], vec![], Tally::default());
    let first = loop {
        let Some(block) = queries.next_block()? else { break None };
        let read = match block.section {
            Section::Records => break Some(block),
            Section::IrradianceRecords => decode_irradiance(&block).map(|(more, tally)| {
                records.extend(more);
                tally
            }),
            _ => decode_weights(&block).map(|(more, tally)| {
                weights.extend(more);
                tally
            }),
        };
        tally += read.ok_or_else(|| queries.damaged("a block beside the queries does not hold what it says"))?;
    };
    let cache = CachedIrradiance::new(records, weights, queries.header().pixels(), gradients);
    let cache = cache.ok_or_else(|| queries.damaged("a pixel takes irradiance that is not cached"))?;
    Ok((cache, first, tally))
}

/// What a picture says of itself. Nothing that differs between two orders of the same work, so no history of the queries
/// but their number and digest: equal pictures are equal files.
fn origin(args: &Args, photons: &PhotonInput, queries: &Header, tally: Tally) -> Vec<(&'static str, String)> {
    let told = |Tally { records, digest }| format!("{records}, digest {digest}");
    let mut attributes = vec![
        ("photonmap.k", args.k.to_string()),
        ("photonmap.estimator", format!("{:?}", args.estimator)),
        ("photonmap.kernel", format!("{:?}", args.kernel)),
        ("photonmap.edges", format!("{:?}", args.edges)),
        ("photonmap.photons", told(photons.tally)),
        ("photonmap.queries", told(tally)),
    ];
    if args.precomputed {
        attributes.push(("photonmap.precomputed", format!("at 1 of {} photons", args.precomputed_share)));
    }
    attributes.extend(queries.meaning(meaning::GATHERS).map(|gathers| ("photonmap.gathers", gathers.to_owned())));
    let commands = pm_formats::as_commands(&photons.header.history);
    attributes.extend(commands.lines().map(|command| ("photonmap.history", command.to_owned())));
    attributes
}

fn write_images(
    args: &Args,
    mut picture: Picture,
    images: Vec<(&PathBuf, Output)>,
    attributes: &[(&str, String)],
) -> anyhow::Result<()> {
    if images.is_empty() {
        return Ok(());
    }
    if let Some(base) = &args.base {
        picture.add(&cli::read_picture(base)?).with_context(|| base.display().to_string())?;
    }
    let finite = |pixel: &[f32; 3]| pixel.iter().all(|x| x.is_finite());
    let odd = picture.pixels.iter().filter(|pixel| !finite(pixel)).count();
    ensure!(odd == 0, "{odd} pixels are not finite; is the base image damaged?");
    let preview = picture.exposed(args.exposure);
    for (path, mut output) in images {
        let picture = if cli::picture_format(path)? == PictureFormat::Png { &preview } else { &picture };
        if cli::picture_format(path)? == PictureFormat::Png && picture.clipped() > 0.0 {
            args.common.remark(format!("{}: {:.1} % of the pixels clipped", path.display(), picture.clipped() * 100.0));
        }
        cli::write_picture(picture, path, &mut output, attributes)?;
        output.commit()?;
    }
    Ok(())
}
