//! `pm-gather`: answers gather queries from a photon map and writes the memory reads that this takes.

mod answering;
mod args;
mod building;
mod description;
mod photons;
mod pictures;
mod queries;
mod scenes;
mod stage;

use crate::cli::{Outcome, Output, Program, Typed, create_output, named, refuse_part, room_for, usage};
use answering::{Asked, answer_all};
use anyhow::Context as _;
use args::Args;
use building::Building;
use description::Description;
use photons::Photons;
pub(crate) use pictures::FILM_BYTES;
use pictures::Films;
use pm_film::film::Film;
use pm_formats::trace::{Coding, TraceWriter};
use pm_formats::vocabulary::meaning;
use pm_formats::{Header, Photon, Step};
use pm_gathering::{
    Answerer, EstimateOptions, FOOTPRINT, Footprint, HeldIrradiance, IrradianceCells, Lookups, PhotonRadii,
    Precomputation, PrecomputedIrradiance, RadianceEstimate,
};
use pm_maps::{AnyMap, BuildError, Search, Setting, StartRadius, Structure};
use pm_registry::Registry;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// The program, as a process, with these structures of photon maps.
#[must_use]
pub fn main(structures: &Registry<dyn Structure>) -> ExitCode {
    program(structures).main(gather)
}

/// A run of the program with these structures and arguments.
pub fn run<T: Into<OsString>>(structures: &Registry<dyn Structure>, arguments: impl IntoIterator<Item = T>) -> Outcome {
    program(structures).run(arguments, gather)
}

fn program(structures: &Registry<dyn Structure>) -> Program<Args> {
    let (command, read) = args::command(structures);
    Program::new("pm-gather", command, read)
}

/// Bytes of a photon in the larger maps, while they are built.
const MAP_BYTES: u64 = 160;

fn gather(args: Args, typed: &Typed) -> anyhow::Result<()> {
    args.check()?;
    let Args { first, rest, .. } = &args;
    let photons = Photons::read(&first.photons)?;
    args.check_photons(photons.records.len())?;
    let mut blocks = queries::open(&args)?;
    let query_header = blocks.header().clone();
    if !rest.anyway {
        scenes::compare(&args, &photons.header, &query_header)?;
    }
    let (map, building) = build(&args, &photons)?;
    let map = &*map;
    if rest.carry && map.batch().is_some() {
        let word = args.map.entry.word();
        return Err(usage(format!("--carry: `{word}` answers batches of queries, which carry nothing; leave it out")));
    }
    if rest.carry && map.group() > 1 {
        return Err(usage("--carry: groups carry what is known from one to the next by themselves; leave it out"));
    }
    if rest.waits {
        check_waits(&args, map)?;
    }
    let search = search(&args, map, &photons.records);
    let mut header = trace_header(&args, typed, map, &photons, &query_header);

    // First, so that a reader of the trace who leaves at once does not leave without the pictures being missed.
    let images: Vec<(&PathBuf, Output)> =
        rest.image.iter().map(|path| Ok((path, create_output(path)?))).collect::<anyhow::Result<_>>()?;
    let report = rest.report.as_ref().map(|path| create_output(path)).transpose()?;
    let estimate = (args.holds() || report.is_some() || !images.is_empty()).then(|| {
        let (paths, options) = (photons.emitted_paths, options(&args, &photons));
        RadianceEstimate::new(&photons.records, &query_header.materials, paths, options).in_order(map.order())
    });
    let precomputed = match &estimate {
        Some(estimate) if args.holds() => {
            let how = Precomputation {
                map,
                search,
                reread: rest.reread,
                photons: &photons.records,
                estimate,
                share: rest.precomputed_share,
                materials: &query_header.materials,
            };
            Some(precompute(&how, &args, &query_header, &mut header)?)
        }
        _ => None,
    };
    let mut trace = match args.trace {
        true => Some(TraceWriter::new(rest.output.create()?, &header)?),
        false => None,
    };
    let name = named(&first.queries);
    let (cache, block, beside) = queries::read_cache(&mut blocks, !rest.no_gradients).with_context(|| name.clone())?;
    if !cache.is_empty() && !images.is_empty() {
        refuse_part(&name, &query_header, "pixels take irradiance that other parts gather")?;
    }
    let scale = estimate.as_ref().map_or(1.0, |estimate| estimate.scale(&query_header.bounds));
    let mut films = Films::new(!images.is_empty(), &query_header, &cache, scale)?;
    // The threads only need the films' unit.
    let unit = Film::new(0, scale);
    let answerer = Answerer {
        search,
        carry: args.carry(),
        group: map.group(),
        describe: report.is_some().then(|| (args.line(), &header.regions[..])),
        map,
        header: &query_header,
        reread: rest.reread,
        regions: trace.is_some().then_some(&header.regions[..]),
        cache: &cache,
        precomputed: precomputed.as_deref(),
        estimate: estimate.as_ref().filter(|_| !images.is_empty()).map(|estimate| (estimate, &unit)),
    };
    let asked = Asked { name, blocks, first: block, beside };
    let mut done = answer_all(&answerer, asked, &rest.common, &mut films, trace.as_mut())?;
    done.remark(&rest.common);

    let picture = films.develop(query_header.image, &cache, rest.base.is_some())?;
    pictures::write(&args, picture, images, &pictures::origin(&args, &photons, &query_header, done.tally))?;
    if let (Some(output), Some(estimate)) = (report, &estimate) {
        let lookups = done.lookups.take().unwrap_or_else(|| Lookups::new(args.line(), &header.regions, None));
        let description =
            Description { args: &args, map, building, photons: &photons.records, search, header: &header, done: &done };
        description.write(estimate, lookups, output)?;
    }
    if let Some(trace) = trace {
        let mut stages = done.end.stages.clone();
        // As it has been since there are sites: a trace without them says nothing of gathering in its end block.
        stages.extend(precomputed.iter().map(|sites| stage::stage(typed, &photons, map, &search, &done, &**sites)));
        trace.finish(stages)?.commit()?;
    }
    Ok(())
}

/// The map that was asked for, and what building it took, if that is to be told.
fn build(args: &Args, photons: &Photons) -> anyhow::Result<(Box<dyn AnyMap>, Option<Building>)> {
    room_for(photons.records.len() as u64 * MAP_BYTES, "a map of these photons")
        .with_context(|| named(&args.first.photons))?;
    let build = || args.map.entry.build(Setting { values: &args.map.values, photons: &photons.records, k: args.k() });
    let built = match args.rest.report {
        Some(_) => Building::measure(build).map(|(map, building)| (map, Some(building))),
        None => build().map(|map| (map, None)),
    };
    let (map, building) = match built {
        // The photons are not to blame.
        Err(BuildError::Parameter(error)) => return Err(error.into()),
        built => built.with_context(|| named(&args.first.photons))?,
    };
    if map.padding().is_some() && args.holds() {
        let option = if args.rest.photon_radii { "--photon-radii" } else { "--precomputed" };
        return Err(usage(format!(
            "{option}: a trace of it holds packed records; leave out what pads those of the map"
        )));
    }
    Ok((map, building))
}

/// Can the reads of this map say what they wait for?
fn check_waits(args: &Args, map: &dyn AnyMap) -> anyhow::Result<()> {
    let word = args.map.entry.word();
    if !map.tells_waits() {
        return Err(usage(format!(
            "--waits: searches of `{word}` do not tell what their reads wait for; take another --map"
        )));
    }
    match map.padding() {
        Some(_) => Err(usage("--waits: a trace of it holds packed records; leave out what pads them")),
        None => Ok(()),
    }
}

/// How photons are searched for.
fn search(args: &Args, map: &dyn AnyMap, photons: &[Photon]) -> Search {
    let plain = Search::new(args.k(), args.rest.max_dist);
    if args.rest.carry && !map.is_exact() {
        args.rest.common.remark("--carry: an approximate map reads the same wherever it starts");
    }
    match args.rest.start_radius {
        _ if !map.is_exact() => plain,
        StartRadius::Unbounded => plain,
        StartRadius::Auto => plain.fit_start(map, photons),
        StartRadius::Fixed(start) => Search { start: start.min(args.rest.max_dist), ..plain },
    }
}

/// What becomes of the photons found.
fn options(args: &Args, photons: &Photons) -> EstimateOptions {
    let rest = &args.rest;
    EstimateOptions {
        k: args.k(),
        max_dist: rest.max_dist,
        estimator: rest.estimator,
        kernel: args.kernel(&photons.header),
        edges: rest.edges,
    }
}

/// The header of the trace, written or not.
fn trace_header(args: &Args, typed: &Typed, map: &dyn AnyMap, photons: &Photons, queries: &Header) -> Header {
    let mut header = queries.clone();
    header.regions = map.regions(args.rest.reread);
    if args.rest.waits {
        header.regions.iter_mut().for_each(|region| region.coding = Coding::Waiting);
    }
    header.set_meaning(meaning::MAP, args.map.entry.word());
    header.set_meaning(meaning::K, args.rest.k);
    let inputs = vec![(args.first.photons.display().to_string(), photons.header.history.clone())];
    header.history.push(Step { inputs, ..typed.step_from(&args.first.queries, None) });
    header
}

/// What is computed beforehand: irradiance, or radii of photons. Its structure gets regions of the trace.
fn precompute<'a>(
    how: &Precomputation<'a>,
    args: &Args,
    queries: &Header,
    header: &mut Header,
) -> anyhow::Result<Box<dyn HeldIrradiance + 'a>> {
    let threads = args.rest.common.threads();
    let mut held: Box<dyn HeldIrradiance> = match args.structure_held() {
        Some(structure) => {
            let given = args.map.values.length_if_any(FOOTPRINT.name).map(Footprint::Fixed);
            let footprint = given.unwrap_or_else(|| Footprint::of_rays(queries));
            Box::new(IrradianceCells::new(how, structure, footprint, threads)?)
        }
        None if args.rest.photon_radii => Box::new(PhotonRadii::new(how, threads)?),
        None => Box::new(PrecomputedIrradiance::new(how, threads)?),
    };
    header.regions = held.lay_out(std::mem::take(&mut header.regions));
    header.set_meaning(meaning::PRECOMPUTED, &held);
    Ok(held)
}
