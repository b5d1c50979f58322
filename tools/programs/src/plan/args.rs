//! What `pm-plan` may be asked.

use crate::cli::{Common, choice};
use crate::setting::{CameraArgs, SceneArgs};
use clap::Parser;
use pm_report::Format;
use pm_size::Bytes;
use std::path::PathBuf;

/// Say how little a picture needs: the cheapest pm-picture of an error that is wanted, its error and time, and what it beats.
///
/// The error is the root of pm-view's relMSE, against the picture without noise and blur: the root of the mean of (b - a)^2 /
/// (a^2 + 0.01). Noise and bias are measured on some pixels of the picture, with two sets of rays and many maps; time by
/// small pictures made here and now, so that what is chosen may differ from run to run. What is chosen is tried with fresh random
/// numbers before it is said. Rare bright pixels that no pilot meets are not planned for.
///
/// With --on-chip, bytes are saved: those that the searches of gather rays fetch from the photon map through a cache of 128-byte
/// lines, row by row, tile by tile, or along a Hilbert curve within tiles whose searches wait on the chip. They are measured on
/// samples of the picture, those for caustics too; pictures themselves are not counted.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    pub(super) scene: SceneArgs,
    #[command(flatten)]
    pub(super) camera: CameraArgs,
    /// The error that is wanted at most, such as 2%
    #[arg(long, value_name = "ERROR", value_parser = error)]
    pub(super) error: f64,
    /// The chance with which it shall hold, and that of all intervals
    #[arg(long, value_name = "CHANCE", default_value = "95%", value_parser = confidence)]
    pub(super) confidence: f64,
    /// Most seconds of processor time that the picture may take
    #[arg(long, value_name = "SECONDS", default_value = "3600", value_parser = seconds)]
    pub(super) seconds: f64,
    /// Save bytes fetched from memory rather than seconds: so much room there is on the chip for a cache and an order's store
    #[arg(long, value_name = "SIZE", value_parser = on_chip)]
    pub(super) on_chip: Option<Bytes>,
    /// What memory can do, such as 35GB/s: what needs more is refused
    #[arg(long, value_name = "RATE", value_parser = bandwidth, requires = "on_chip")]
    pub(super) bandwidth: Option<f64>,
    /// Pictures a second that --bandwidth has to do for
    #[arg(long, value_name = "N", default_value = "1", requires = "bandwidth", value_parser = seconds)]
    pub(super) fps: f64,
    /// Say too how far the picture will look off, by FLIP
    ///
    /// The mean of pm-view's ldr_flip, over small pictures that are held against a better one.
    #[arg(long)]
    pub(super) flip: bool,
    /// Draw what errors cost here
    ///
    /// By the best recipes and by the paper's map of 450,000 photons, with what was tried.
    #[arg(long, value_name = "FILE.svg", value_parser = drawing)]
    pub(super) chart: Option<PathBuf>,
    /// How the plan is written: in words, or as a row of numbers
    #[arg(long, default_value = "table", value_parser = choice::<Format>())]
    pub(super) format: Format,
    /// Plan although the scene has Ks and Ns that nobody asked to take for a glossy lobe
    #[arg(long, conflicts_with = "glossy")]
    pub(super) anyway: bool,
    /// Pixels that are measured
    #[arg(long, value_name = "N", default_value = "400", hide_short_help = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(16..=1 << 20))]
    pub(super) pixels: u32,
    /// Photons of the first pilot's largest map
    #[arg(long, value_name = "N", default_value = "160000", hide_short_help = true)]
    #[arg(value_parser = clap::value_parser!(u64).range(5000..=1 << 24))]
    pub(super) pilot_photons: u64,
    /// Seed of the random numbers of the pilots
    #[arg(long, default_value = "0")]
    pub(super) seed: u64,
    #[command(flatten)]
    pub(super) common: Common,
}

const EXAMPLES: &str = "\
Examples:
  pm-plan --error 2%
  pm-plan --error 5% --flip --chart frontier.svg
  pm-plan --error 5% --on-chip 1M --bandwidth 35GB/s --fps 10
  pm-plan room.obj --eye 0,1.6,4 --look-at 0,1,0 --error 5% --seconds 30";

/// A share of 1 from percent.
fn percent(text: &str, least: f64, most: f64) -> Option<f64> {
    let number: f64 = text.strip_suffix('%')?.parse().ok()?;
    Some(number).filter(|number| (least..=most).contains(number)).map(|number| number / 100.0)
}

fn error(text: &str) -> Result<f64, &'static str> {
    percent(text, 0.01, 100.0).ok_or("percent from 0.01% to 100% are expected, such as 2%")
}

fn confidence(text: &str) -> Result<f64, &'static str> {
    percent(text, 50.0, 99.9).ok_or("percent from 50% to 99.9% are expected, such as 95%")
}

fn drawing(text: &str) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(text);
    let named = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
    named.then_some(path).ok_or("a drawing is expected, such as frontier.svg")
}

fn on_chip(text: &str) -> Result<Bytes, String> {
    let size: Bytes = text.parse().map_err(|error: pm_size::SizeError| error.to_string())?;
    let possible = 4096..=1 << 40;
    Some(size).filter(|size| possible.contains(&size.0)).ok_or_else(|| "a size from 4K to 1T is expected".into())
}

/// Bytes a second, in powers of 1000 as bandwidths are.
fn bandwidth(text: &str) -> Result<f64, &'static str> {
    let units = [("TB/s", 1e12), ("GB/s", 1e9), ("MB/s", 1e6)];
    let number = units.into_iter().find_map(|(unit, factor)| Some((text.strip_suffix(unit)?.trim(), factor)));
    let parsed = number.and_then(|(number, factor)| Some(number.parse::<f64>().ok()? * factor));
    parsed
        .filter(|rate| rate.is_finite() && *rate > 0.0)
        .ok_or("a rate such as 35GB/s is expected, in MB/s, GB/s or TB/s")
}

fn seconds(text: &str) -> Result<f64, &'static str> {
    let parsed = text.parse().ok().filter(|seconds: &f64| seconds.is_finite() && *seconds > 0.0);
    parsed.ok_or("a number above 0 is expected")
}
