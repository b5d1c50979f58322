//! How fast are the searches of pm beside those of the best library there is? Ratios within one run, rounds interleaved.
//!
//! `make bench` runs it. All must find the same: k-th distances of kiddo, and ids as well of ours; else it fails.

mod answers;
mod clock;
mod contestants;
mod gather;
mod peer;
mod streams;

use answers::Answers;
use anyhow::{Context as _, ensure};
use clock::{median, nanoseconds};
use contestants::{Contestant as _, Ours, ours};
use peer::Peer;
use std::io::{Write as _, stdout};
use streams::{Photons, Queries};

const USAGE: &str = "pm-peers ROUNDS NATIVE K,K,... PHOTONS.pmp... QUERIES.pmq...";

fn main() -> anyhow::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match &words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["serve", photons, queries] => peer::serve(photons, queries),
        [rounds, native, ks, streams @ ..] => {
            let ks: Vec<usize> = ks.split(',').map(str::parse).collect::<Result<_, _>>()?;
            let (photons, queries): (Vec<&str>, Vec<&str>) = streams.iter().partition(|path| path.ends_with(".pmp"));
            let bench = Bench { rounds: rounds.parse()?, native, ks: &ks, queries: &queries };
            photons.into_iter().try_for_each(|path| bench.photons(path))
        }
        _ => anyhow::bail!(USAGE),
    }
}

struct Bench<'a> {
    rounds: usize,
    /// This program, built for this very machine.
    native: &'a str,
    ks: &'a [usize],
    queries: &'a [&'a str],
}

impl Bench<'_> {
    fn photons(&self, path: &str) -> anyhow::Result<()> {
        let photons = Photons::read(path)?;
        let maps = ours(&photons)?;
        for queries_path in self.queries {
            let mut peer = Peer::start(self.native, path, queries_path)?;
            let queries = Queries::read(queries_path)?;
            let (count, windows) = (photons.records.len(), queries.points.len());
            writeln!(stdout(), "{count} photons, {queries_path}: {} queries in {windows} windows", queries.len())?;
            let names = maps.iter().map(|map| map.name).fold(String::new(), |names, name| format!("{names}  {name}"));
            writeln!(stdout(), "    k  kiddo, ns{names}")?;
            for &k in self.ks {
                self.race(&mut peer, maps.iter().map(|map| map.searched_for(k, &photons)).collect(), &queries, k)?;
            }
            peer.end()?;
            let wide = &*maps.last().context("a map")?.map;
            let [alone, picture] = gather::measure(wide, &photons, &queries, 100, self.rounds)?;
            let ratio = picture / alone;
            writeln!(stdout(), "  100  with a picture {picture:.0} ns, {ratio:.2} of the search alone ({alone:.0})")?;
        }
        Ok(())
    }

    /// Interleaved rounds: a neighbour on the machine slows all alike.
    fn race(&self, peer: &mut Peer, mut ours: Vec<Ours<'_>>, queries: &Queries, k: usize) -> anyhow::Result<()> {
        let truth = Answers::of(&mut ours[0], queries, k);
        truth.compare("kiddo", &peer.answers(k)?)?;
        for map in &mut ours[1..] {
            ensure!(Answers::of(map, queries, k).digest == truth.digest, "{}: other photons", map.name);
        }
        let (mut yardstick, mut ratios) = (vec![], vec![vec![]; ours.len()]);
        for _ in 0..self.rounds {
            let theirs = peer.round(k)?;
            yardstick.push(theirs);
            for (map, ratios) in ours.iter_mut().zip(&mut ratios) {
                let ((), took) = nanoseconds(|| map.run(queries, k, None))?;
                ratios.push(took / theirs);
            }
        }
        write!(stdout(), "  {k:3}  {:9.0}", median(&mut yardstick) / queries.len() as f64)?;
        for (map, ratios) in ours.iter().zip(&mut ratios) {
            write!(stdout(), "  {:w$.3}", median(ratios), w = map.name.len())?;
        }
        Ok(writeln!(stdout())?)
    }
}
