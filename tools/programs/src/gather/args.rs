//! What `pm-gather` may be asked.

use crate::cli::{Chooser, Common, OutputArgs, choice, named, picture_format, usage};
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args as _, Command, FromArgMatches as _};
use pm_formats::Header;
use pm_formats::vocabulary::meaning;
use pm_gathering::{Edges, Estimator, IrradianceStructure, Kernel, irradiance_structures};
use pm_maps::{LINE, StartRadius, Structure, fastest};
use pm_registry::{Chosen, Registry};
use std::io::{self, IsTerminal as _};
use std::path::{Path, PathBuf};

/// What was asked.
pub(super) struct Args {
    pub(super) map: Chosen<dyn Structure>,
    /// Was it left to us, and nobody asks what it reads?
    pub(super) hurry: bool,
    /// Is a trace to be written?
    pub(super) trace: bool,
    /// Was the number of photons of a search typed?
    k_is_typed: bool,
    /// Was it typed how many photons hold irradiance?
    share_is_typed: bool,
    /// Was it typed which of the photons found are summed?
    estimator_is_typed: bool,
    pub(super) first: First,
    pub(super) rest: Rest,
}

/// What stands before the structures and their parameters.
#[derive(clap::Args)]
pub(super) struct First {
    /// Photons to build the map from
    #[arg(default_value = "map.pmp")]
    pub(super) photons: PathBuf,
    /// Queries to answer; `-` is standard input
    #[arg(default_value = "-")]
    pub(super) queries: PathBuf,
}

/// What stands behind them.
#[derive(clap::Args)]
pub(super) struct Rest {
    /// Number of nearest photons to gather
    #[arg(short, default_value = "100", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub(super) k: u32,
    /// Largest distance at which a photon counts, in scene units: part of the answer
    #[arg(long, value_name = "X|inf", default_value = "inf", value_parser = distance)]
    pub(super) max_dist: f32,
    /// Radius a search starts with: changes the reads, not the answer
    ///
    /// It is doubled until the search finds enough. `auto` is the radius that 99 % of the searches at 1,000 photons need.
    #[arg(long, value_name = "X|inf|auto", default_value = "auto", value_parser = start_radius)]
    pub(super) start_radius: StartRadius,
    /// Start from what the search before knows: changes the reads, not the answer
    ///
    /// All k photons of the query q' before lie within |q - q'| + r_k(q') of q. The chain begins anew with each block of the
    /// stream, after 4,096 queries at most and at the end of a batch. `--map auto` does so where no trace is written.
    #[arg(long)]
    pub(super) carry: bool,
    /// Also log the second touch of each inner node of kd, when the search comes back to it for its own photon
    #[arg(long, hide_short_help = true)]
    pub(super) reread: bool,
    /// Each read of the trace says which reads of its search it waits for: pm-cachesim then tells chains of misses
    ///
    /// Where a child lies is known when its parent is there, where a hash bucket does from the query alone. Such a trace is some
    /// times larger; what it says of the memory is the same.
    #[arg(long, hide_short_help = true, conflicts_with_all = ["reread", "precomputed", "carry", "no_trace"])]
    pub(super) waits: bool,
    /// How photons become radiance
    #[arg(long, default_value = "unbiased", value_parser = choice::<Estimator>())]
    pub(super) estimator: Estimator,
    /// Take the irradiance of the nearest of every fourth photon, computed beforehand
    ///
    /// Christensen's method: one photon with a similar normal is searched for instead of k, in a tree of its own, which is
    /// what the trace holds. The searches for k that are made beforehand are counted in the trace's end block. Queries of
    /// glossy surfaces search for k as ever. Some error for far fewer reads; k should be well above 16.
    #[arg(long, conflicts_with = "report")]
    pub(super) precomputed: bool,
    /// One of how many photons holds precomputed irradiance, with --precomputed, --map brick and --map cell-cache
    #[arg(
        long, value_name = "N", default_value = "4", hide_short_help = true,
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    pub(super) precomputed_share: u32,
    /// Each photon has the radius of its own k nearest, and a query takes those that have it within theirs
    ///
    /// Singh and Faloutsos' method: radii are searched for beforehand, once for each photon, which the trace's end block counts. A
    /// query goes down a hierarchy of boxes once, without a heap; the trace holds that. Another estimate, of the same
    /// flux: darker at edges. Queries that no photon reaches search for k as ever.
    #[arg(long, conflicts_with_all = ["report", "precomputed", "waits", "carry"], hide_short_help = true)]
    pub(super) photon_radii: bool,
    /// How much a photon counts by its distance [default: constant; cone where all photons are of caustics]
    #[arg(long, hide_short_help = true, value_parser = choice::<Kernel>())]
    kernel: Option<Kernel>,
    /// What the flux is divided by where the photons' disc reaches beyond an edge of the surface
    #[arg(long, default_value = "cut", hide_short_help = true, value_parser = choice::<Edges>())]
    pub(super) edges: Edges,
    /// Picture to write, .exr (linear) or .png (preview); may be given more than once
    #[arg(long, value_name = "FILE")]
    pub(super) image: Vec<PathBuf>,
    /// Take cached irradiance as it is at its record, without the gradients
    #[arg(long, hide_short_help = true)]
    pub(super) no_gradients: bool,
    /// Stops by which PNG previews are brightened; EXR pictures keep their radiance
    #[arg(long, value_name = "STOPS", default_value = "0", allow_hyphen_values = true, hide_short_help = true)]
    pub(super) exposure: f32,
    /// EXR picture to add, such as the direct light that `pm-queries --base` wrote; read after the last query
    #[arg(long, value_name = "FILE")]
    pub(super) base: Option<PathBuf>,
    /// Take photons of another scene than that of the queries
    #[arg(long, hide_short_help = true)]
    pub(super) anyway: bool,
    /// Write no trace: for the picture, or for speed alone
    ///
    /// Nor is one written where a picture is asked for and standard output is a terminal.
    #[arg(long, conflicts_with = "output")]
    pub(super) no_trace: bool,
    /// Describe lookups, map and its building in a .csv, .json or text file
    ///
    /// A row of named columns, in text a line for each. Approximate maps are compared with exact answers for 1,000 queries:
    /// light_error_rms and light_bias are differences of what a query adds to its pixel, over its mean, and not of pixels
    /// (`pm-view exact.exr approximate.exr`). `-` is standard output, with --no-trace.
    #[arg(long, value_name = "FILE", hide_short_help = true)]
    pub(super) report: Option<PathBuf>,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    #[command(flatten)]
    pub(super) common: Common,
}

const ABOUT: &str =
    "Answer gather queries from a photon map; write the memory reads as a trace, and the picture on request";
const MORE: &str = "\
Each query asks for the k photons nearest to a point. The trace holds which records of the map each search read; the picture \
is the sum of the radiance estimates and does not depend on the order of the queries by a single bit.";

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-queries --base direct.exr | pm-gather --base direct.exr --image out.exr --image out.png --no-trace -t 2
  pm-gather map.pmp queries.pmq -k 50 --start-radius inf -o trace.pmt";

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

/// The command line with these structures, and how it is understood.
pub(super) fn command(
    structures: &Registry<dyn Structure>,
) -> (Command, impl FnOnce(&ArgMatches) -> Result<Args, clap::Error> + use<>) {
    // Beside the photon maps, what holds irradiance instead.
    let structures = &irradiance_structures().iter().fold(structures.clone(), |all, held| all.with(held));
    let map = Arg::new("map").long("map").value_name("MAP").help("Structure of the photon map");
    let maps =
        Chooser::automatic(structures, map, "the paper's where reads are told of, else the fastest, and --carry");
    let usual = structures.iter().next().expect("there is a structure");
    let command = maps.add_parameters(maps.add_word(First::augment_args(Command::new("pm-gather"))));
    let command = Rest::augment_args(command);
    let command = command.about(ABOUT).long_about(format!("{ABOUT}.\n\n{MORE}")).after_help(EXAMPLES);
    let read = move |matches: &ArgMatches| {
        let (first, rest) = (First::from_arg_matches(matches)?, Rest::from_arg_matches(matches)?);
        let trace = rest.writes_trace();
        let unseen = !trace && rest.report.is_none() && !rest.reread;
        let of: &[&dyn Structure] = if unseen { &[fastest(), usual] } else { &[usual] };
        let (map, hurry) = (maps.read_or_choose(matches, of)?, unseen && maps.is_left(matches));
        let is_typed = |name: &str| matches.value_source(name) == Some(ValueSource::CommandLine);
        let [k_is_typed, share_is_typed, estimator_is_typed] = ["k", "precomputed_share", "estimator"].map(is_typed);
        Ok(Args { map, hurry, trace, k_is_typed, share_is_typed, estimator_is_typed, first, rest })
    };
    (command, read)
}

impl Rest {
    /// Is a trace to be written?
    fn writes_trace(&self) -> bool {
        // Who types for a picture and sees a terminal wants no trace there, and would be told so.
        let nowhere = self.output.output.is_none() && !self.image.is_empty() && io::stdout().is_terminal();
        !self.no_trace && !nowhere
    }
}

impl Args {
    /// Does a search start from what the one before it knows?
    pub(super) const fn carry(&self) -> bool {
        self.rest.carry || self.hurry
    }

    /// The structure of held irradiance that was asked for instead of a photon map.
    pub(super) fn structure_held(&self) -> Option<&'static dyn IrradianceStructure> {
        irradiance_structures().find(self.map.entry.word()).ok()
    }

    /// Is irradiance, or a radius for each photon, computed beforehand?
    pub(super) fn holds(&self) -> bool {
        self.rest.precomputed || self.rest.photon_radii || self.structure_held().is_some()
    }

    /// Bytes of a line, in which reads are described.
    pub(super) fn line(&self) -> u32 {
        self.map.values.count(LINE.name)
    }

    /// Number of photons of a search.
    pub(super) const fn k(&self) -> usize {
        self.rest.k as usize
    }

    /// Refuses to look for more photons than there are.
    pub(super) fn check_photons(&self, photons: usize) -> anyhow::Result<()> {
        if self.k_is_typed && photons > 0 && self.k() > photons {
            let name = named(&self.first.photons);
            return Err(usage(format!("-k {}: {name} has {photons} photons; give at most {photons}", self.rest.k)));
        }
        Ok(())
    }

    /// How much a photon of this stream counts by its distance. Caustics have sharp edges, which a cone blurs less.
    pub(super) fn kernel(&self, photons: &Header) -> Kernel {
        let caustics = photons.meaning(meaning::PHOTONS) == Some(meaning::CAUSTICS);
        self.rest.kernel.unwrap_or(if caustics { Kernel::Cone } else { Kernel::Constant })
    }

    /// Refuses what does not go together with irradiance that is held beforehand, or nothing without it.
    fn check_held(&self) -> anyhow::Result<()> {
        let word = self.map.entry.word();
        match self.structure_held() {
            Some(_) if self.rest.precomputed => {
                Err(usage(format!("--precomputed: --map {word} holds irradiance itself; leave out one of them")))
            }
            Some(_) if self.rest.report.is_some() => {
                Err(usage(format!("--report describes searches for photons; --map {word} looks irradiance up")))
            }
            Some(_) if self.rest.waits => Err(usage(format!(
                "--waits: lookups in `{word}` do not tell what their reads wait for; take another --map"
            ))),
            None if self.share_is_typed && !self.rest.precomputed => {
                Err(usage("--precomputed-share: give --precomputed, or a --map that holds irradiance"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses what does not go together with radii of photons.
    fn check_radii(&self) -> anyhow::Result<()> {
        let rest = &self.rest;
        let refusal = match self.structure_held() {
            _ if !rest.photon_radii => return Ok(()),
            Some(_) => format!("--map {} holds irradiance itself; leave out one of them", self.map.entry.word()),
            None if self.estimator_is_typed => {
                "all photons that reach a query are summed; leave --estimator out".into()
            }
            None if rest.edges == Edges::Sloped => {
                "photons weigh by their own discs; give --edges cut or ignored".into()
            }
            None if rest.k < 2 => "a photon is the first of its own k; give -k 2 or more".into(),
            None => return Ok(()),
        };
        Err(usage(format!("--photon-radii: {refusal}")))
    }

    /// Is there anything that cannot be done, whatever the files hold?
    pub(super) fn check(&self) -> anyhow::Result<()> {
        let Self { first, rest, .. } = self;
        for image in &rest.image {
            picture_format(image)?;
        }
        if first.photons == Path::new("-") && first.queries == Path::new("-") {
            return Err(usage("photons and queries cannot both come from standard input; name a file for one of them"));
        }
        if !rest.exposure.is_finite() {
            return Err(usage("--exposure: a finite number of stops is expected"));
        }
        self.check_held()?;
        self.check_radii()?;
        let standard = |path: &Option<PathBuf>| path.as_deref().is_some_and(|path| path == Path::new("-"));
        let output = &rest.output.output;
        if standard(&rest.report) && self.trace && (output.is_none() || standard(output)) {
            return Err(usage("--report - and the trace cannot share standard output; name a file or give --no-trace"));
        }
        if rest.waits && !self.trace {
            return Err(usage("--waits is said in the trace, and none is written here: name a file for it with -o"));
        }
        if rest.base.is_some() && rest.image.is_empty() {
            return Err(usage("--base is added to a picture: ask for one with --image"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
