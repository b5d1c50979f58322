//! What `pm-queries` is asked.

use super::sample::SampleArgs;
use crate::cli::{self, Common, OutputArgs, choice};
use crate::setting::{CameraArgs, SceneArgs};
use clap::Parser;
use pm_formats::vocabulary::Part;
use pm_light::scene::Bounds;
use pm_light::transport::{AtSpecular, GatherOptions, Method, Spread, Strata};
use std::path::PathBuf;

/// Cast eye rays and final-gather rays; write a gather query wherever one ends on a diffuse surface.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(flatten)]
    pub(super) scene: SceneArgs,
    #[command(flatten)]
    pub(super) camera: CameraArgs,
    /// Gather rays for each point seen, in a grid of strata
    #[arg(long, value_name = "N", default_value = "100", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    gathers: u32,
    /// Eye rays for each pixel; one goes through its middle, more are spread over it
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    pub(super) samples: u32,
    /// Ask at the points seen, without gather rays: the picture shows the photon map itself
    #[arg(long)]
    pub(super) direct_visualisation: bool,
    /// How gather rays are spread over the hemisphere
    #[arg(long, default_value = "cosine", hide_short_help = true, value_parser = choice::<Spread>())]
    sampling: Spread,
    /// Send more gather rays to where these photons come from, and let them weigh less for it: the picture is the same
    /// but for its noise. `-` is standard input
    #[arg(long, value_name = "PHOTONS", hide_short_help = true)]
    pub(super) guide: Option<PathBuf>,
    /// Gather rays shorter than this, in scene units, are continued by one more bounce; `auto` is 1/100 of the scene's
    /// diagonal
    #[arg(long, value_name = "X|auto", default_value = "0", value_parser = least_distance, hide_short_help = true)]
    min_gather_dist: LeastDistance,
    /// Leave caustics on the points seen to a map of their own, of `pm-photons --caustics` and asked by
    /// `pm-queries --direct-visualisation`: a gather ray that meets a lamp in a mirror or through glass does not count
    #[arg(long, hide_short_help = true)]
    no_caustics: bool,
    /// What a gather ray does at a mirror or glass
    #[arg(long, default_value = "go-on", hide_short_help = true, value_parser = choice::<AtSpecular>())]
    pub(super) at_specular: AtSpecular,
    /// Queries of gather rays that went by a mirror or through glass come last in their batch, after those of eye rays that did
    #[arg(long, hide_short_help = true, conflicts_with_all = ["window", "direct_visualisation"])]
    pub(super) queue_specular: bool,
    /// In which order the gather rays of a point are cast
    #[arg(long, default_value = "raster", hide_short_help = true, value_parser = choice::<Strata>())]
    strata: Strata,
    /// Also write the direct and emitted light as an EXR or PNG picture, before the stream ends
    #[arg(long, value_name = "FILE")]
    pub(super) base: Option<PathBuf>,
    /// Cache irradiance (Ward): gather only where no record serves with an error below A, such as 0.1; pixels interpolate
    #[arg(long, value_name = "A", value_parser = accuracy, conflicts_with = "direct_visualisation")]
    pub(super) irradiance_cache: Option<f32>,
    /// Least and greatest distance at which a record of cached irradiance still serves, in pixels
    #[arg(long, value_name = "MIN,MAX", default_value = "3,20", value_parser = spacing, hide_short_help = true)]
    pub(super) spacing: [f32; 2],
    /// Shadow rays for each point seen, for the direct light
    #[arg(
        long, value_name = "N", default_value = "16", hide_short_help = true,
        value_parser = clap::value_parser!(u32).range(1..=1 << 20)
    )]
    light_samples: u32,
    #[command(flatten)]
    pub(super) sample: SampleArgs,
    /// Cast the rays of one of N parts, such as 2/8, for `pm-view --merge` to put together; each machine may make another
    ///
    /// Batches (tiles, scanlines) are dealt out like cards. Order a part by `pm-reorder --per batch`. Its --base picture is
    /// black where the others' are not, and `pm-view --merge` adds them up. Cached irradiance stands whole in each part.
    #[arg(long, value_name = "I/N", hide_short_help = true)]
    pub(super) part: Option<Part>,
    /// Seed of the random numbers
    #[arg(long, default_value = "0")]
    pub(super) seed: u64,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    #[command(flatten)]
    pub(super) common: Common,
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

fn least_distance(text: &str) -> Result<LeastDistance, String> {
    match text.parse::<f32>() {
        _ if text == "auto" => Ok(LeastDistance::Auto),
        Ok(x) if x >= 0.0 && x.is_finite() => Ok(LeastDistance::Fixed(x)),
        _ => Err("a distance of 0 or more, or `auto`, is expected".into()),
    }
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

impl Args {
    /// Refuses what can be seen to be asked wrongly before anything is read.
    pub(super) fn check(&self) -> anyhow::Result<()> {
        if let Some(base) = &self.base {
            cli::check_part_of_picture(base, self.part)?;
        }
        if u64::from(self.samples) * u64::from(self.gathers) > MOST_GATHERS {
            return Err(cli::usage(format!("--samples times --gathers is more than {MOST_GATHERS}")));
        }
        if self.at_specular != AtSpecular::GoOn && self.direct_visualisation {
            return Err(cli::usage(
                "--at-specular: --direct-visualisation casts no gather rays: leave out one of them",
            ));
        }
        if self.at_specular != AtSpecular::GoOn && self.queue_specular {
            let all = "no gather ray goes on behind a mirror or glass that could wait: leave out one of them";
            return Err(cli::usage(format!("--queue-specular, --at-specular: {all}")));
        }
        let Some(conflict) = self.guide.as_ref().and_then(|_| self.guide_conflict()) else { return Ok(()) };
        Err(cli::usage(conflict))
    }

    /// What a guide does not go together with.
    fn guide_conflict(&self) -> Option<&'static str> {
        if self.direct_visualisation {
            return Some("--guide guides gather rays, and --direct-visualisation casts none: leave out one of them");
        }
        if self.irradiance_cache.is_some() {
            return Some(
                "--guide and --irradiance-cache exclude each other: the gradients of cached irradiance need evenly spread \
                 rays",
            );
        }
        if self.sampling == Spread::Uniform {
            return Some("--guide has half of its rays spread by the cosine: leave out --sampling uniform");
        }
        None
    }

    /// Gather rays of each point seen; points that are asked at themselves have no hemisphere, and count as one.
    pub(super) const fn gathers(&self) -> u32 {
        if self.direct_visualisation { 1 } else { self.gathers }
    }

    /// How queries are made in a scene of these bounds.
    pub(super) fn options(&self, bounds: &Bounds) -> GatherOptions {
        GatherOptions {
            method: if self.direct_visualisation { Method::DirectVisualisation } else { Method::FinalGather },
            samples: self.samples,
            gathers: self.gathers(),
            spread: self.sampling,
            min_gather_dist: match self.min_gather_dist {
                LeastDistance::Fixed(x) => x,
                LeastDistance::Auto => bounds.size().length() * AUTO_SHARE,
            },
            caustics: !self.no_caustics,
            light_samples: self.light_samples,
            seed: self.seed,
            // Records carry the light that their rays meet, picture or not.
            direct: self.base.is_some() || self.irradiance_cache.is_some(),
            strata: self.strata,
            at_specular: self.at_specular,
            queue_specular: self.queue_specular,
        }
    }
}
