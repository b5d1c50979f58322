//! `pm-sweep row`: what a point printed is its row, if it is whole.

use anyhow::Context as _;
use pm_sweep::progress::Place;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct Args {
    /// What was printed
    printed: PathBuf,
    /// The file that it becomes
    output: PathBuf,
    /// The exit code of what printed it; but for 0 there is no row
    #[arg(long, value_name = "CODE", default_value_t = 0)]
    code: i32,
    /// What was said on standard error meanwhile: it is said again, and kept where there is no row
    #[arg(long, value_name = "FILE")]
    said: Option<PathBuf>,
    /// Which row this is of how many, such as 3/12
    #[arg(long, value_name = "N/M", requires = "since")]
    place: Option<Place>,
    /// When the first was begun, in seconds since 1970
    #[arg(long, value_name = "SECONDS", requires = "place")]
    since: Option<u64>,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let (printed, output) = (args.printed.display().to_string(), args.output.display().to_string());
    // Where nothing was launched, nothing was said.
    let said = args.said.as_ref().and_then(|said| fs::read(said).ok()).unwrap_or_default();
    let bytes = fs::read(&args.printed).with_context(|| printed)?;
    pm_sweep::believed(&output, &bytes, args.code, &String::from_utf8_lossy(&said)).inspect_err(|_| {
        // All of it is beside where the row would be; here it is in the order in which rows fail.
        let _ = std::io::stderr().write_all(&said);
    })?;
    std::io::stderr().write_all(&said)?;
    fs::rename(&args.printed, &args.output).with_context(|| output.clone())?;
    if let Some(said) = args.said.as_ref().filter(|said| said.exists()) {
        fs::remove_file(said).with_context(|| said.display().to_string())?;
    }
    if let (Some(place), Some(since)) = (&args.place, args.since) {
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |time| time.as_secs());
        writeln!(std::io::stderr(), "{output}: {}", place.told(now.saturating_sub(since)))?;
    }
    Ok(())
}
