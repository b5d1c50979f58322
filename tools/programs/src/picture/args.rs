//! What `pm-picture` may be asked.

use crate::cli::{Common, entry};
use crate::setting::{CameraArgs, SceneArgs};
use clap::Parser;
use pm_maps::{Structure, structures};
use std::path::PathBuf;

/// Make a picture: photons, gather rays, direct light, and caustics in a map of their own; print the pipes that do it.
///
/// The other programs do the work, so whatever is printed may be typed, and changed. Most of what is wrong with a picture at
/// equal time is seen at edges and in textures of light, not in single gather rays: so there are many eye rays for each pixel,
/// and few gather rays and photons for each of them.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    pub(super) scene: SceneArgs,
    #[command(flatten)]
    pub(super) camera: CameraArgs,
    /// Picture to write, .exr (linear) or .png (preview); may be given more than once
    #[arg(long, value_name = "FILE", required = true)]
    pub(super) image: Vec<PathBuf>,
    /// Stops by which PNG previews are brightened
    #[arg(long, value_name = "STOPS", default_value = "0", allow_hyphen_values = true)]
    pub(super) exposure: f32,
    /// Eye rays for each pixel
    #[arg(long, value_name = "N", default_value = "64", value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    pub(super) samples: u32,
    /// Gather rays for each point seen
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub(super) gathers: u32,
    /// Shadow rays for each point seen
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub(super) light_samples: u32,
    /// Photons of the map that gather rays ask
    #[arg(short = 'n', long, value_name = "PHOTONS", default_value = "1000000")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) photons: u64,
    /// Nearest photons that a gather ray asks for
    #[arg(short, default_value = "10", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub(super) k: u32,
    /// Photons of the map of caustics, where the scene has mirrors or glass; 0: caustics are left to chance
    #[arg(long, value_name = "PHOTONS", default_value = "200000")]
    pub(super) caustics: u64,
    /// Nearest photons of caustics that are asked for at each point seen [default: 50]
    #[arg(long, value_name = "K", hide_short_help = true, value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub(super) caustics_k: Option<u32>,
    /// Structure of the photon maps, where pm-gather is not to choose
    #[arg(long, value_name = "MAP", hide_short_help = true, value_parser = entry(&structures()))]
    pub(super) map: Option<&'static dyn Structure>,
    /// Send more gather rays to where photons come from: for light that comes through gaps or off small bright spots
    #[arg(long)]
    pub(super) guide: bool,
    /// Further options of the pm-queries that casts gather rays, such as `--irradiance-cache 0.1`
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true, hide_short_help = true, value_parser = words)]
    pub(super) queries: Option<Words>,
    /// Further options of the pm-gather that answers them, such as `--precomputed`
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true, hide_short_help = true, value_parser = words)]
    pub(super) gather: Option<Words>,
    /// Folder in which photons, direct light and the picture without caustics are kept
    #[arg(long, value_name = "FOLDER")]
    pub(super) keep: Option<PathBuf>,
    /// Print the pipes, and run none of them
    #[arg(long)]
    pub(super) dry_run: bool,
    /// Seed of the random numbers
    #[arg(long, default_value = "0")]
    pub(super) seed: u64,
    #[command(flatten)]
    pub(super) common: Common,
}

const EXAMPLES: &str = "\
Examples:
  pm-picture --image cornell.exr --image cornell.png -t 2
  pm-picture room.obj --eye 0,1.6,4 --look-at 0,1,0 --image room.exr --keep streams
  pm-picture room.obj --image room.exr --samples 256 --dry-run";

/// Options of another program, taken apart as a shell does.
#[derive(Clone)]
pub(super) struct Words(pub(super) Vec<String>);

fn words(text: &str) -> Result<Words, &'static str> {
    shlex::split(text).map(Words).ok_or("a quote is not closed")
}

impl Args {
    /// How the scene is loaded here: without a word.
    pub(super) const fn hushed(&self) -> Common {
        Common { quiet: true, ..self.common }
    }
}
