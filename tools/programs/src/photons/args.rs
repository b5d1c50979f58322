//! What `pm-photons` is asked.

use crate::cli::{Common, OutputArgs};
use crate::setting::SceneArgs;
use clap::Parser;
use pm_formats::vocabulary::Part;

/// Trace photons from the lights and store them at diffuse surfaces.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    pub(super) scene: SceneArgs,
    /// Photons to store: whole paths are traced until there are at least so many
    #[arg(short = 'n', long, value_name = "PHOTONS", default_value = "100000")]
    pub(super) number: u64,
    /// Store caustics only: photons that came from a light by mirrors and glass alone; goes with `pm-queries --no-caustics`
    ///
    /// Half of the paths are aimed at where a pilot found mirrors and glass, and carry as much less power. `pm-gather` weighs
    /// such photons by a cone unless told otherwise.
    #[arg(long)]
    pub(super) caustics: bool,
    /// Trace one of N parts, such as 2/8, for `pm-view --merge` to put together; each machine may make another
    ///
    /// Paths are dealt out, 4,096 at a time. No part knows the numbers of its photons, by which powers are rounded, so that it
    /// holds them unrounded; and it traces a little more than its share, since the others' photons are not known.
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
  pm-photons -o map.pmp
  pm-photons scenes/cornell-diffuse.obj -n 450000 -t 2 -o map.pmp
  pm-photons | pm-view --records=10";
