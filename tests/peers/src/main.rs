//! How fast are the searches of pm beside those of the libraries that others use? Ratios within one run, rounds interleaved.
//!
//! `make bench` runs it, and `make bench-growth`. All must find the same: k-th distances of the libraries, and ids as well of ours; else it fails.

mod aim;
mod answers;
mod clock;
mod contestants;
mod gather;
mod libraries;
mod peer;
mod race;
mod streams;
mod tables;

use tables::Bench;

const USAGE: &str = "pm-peers ratios|growth ROUNDS NATIVE K,K@DISTANCE,... PHOTONS.pmp... QUERIES.pmq...";

fn main() -> anyhow::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match &words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["serve", photons, queries] => peer::serve(photons, queries),
        [what @ ("ratios" | "growth"), rounds, native, aims, streams @ ..] => {
            let aims = aims.split(',').map(str::parse).collect::<Result<Vec<_>, _>>()?;
            let (photons, queries): (Vec<&str>, Vec<&str>) = streams.iter().partition(|path| path.ends_with(".pmp"));
            let bench = Bench { rounds: rounds.parse()?, native, aims: &aims, photons: &photons, queries: &queries };
            if *what == "ratios" { bench.ratios() } else { bench.growth() }
        }
        _ => anyhow::bail!(USAGE),
    }
}
