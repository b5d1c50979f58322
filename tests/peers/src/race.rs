//! Rounds, interleaved: a neighbour on the machine slows all alike.

use crate::aim::Aim;
use crate::answers::Answers;
use crate::clock::{median, nanoseconds};
use crate::contestants::{Contestant as _, Map, Ours, STRUCTURES, ours};
use crate::gather;
use crate::libraries::{LIBRARIES, Library};
use crate::peer::Peer;
use crate::streams::{Photons, Queries};
use anyhow::{Context as _, ensure};
use std::io::{Write as _, stdout};

/// What is measured.
pub(crate) struct Bench<'a> {
    pub(crate) rounds: usize,
    /// This program, built for this very machine.
    pub(crate) native: &'a str,
    pub(crate) aims: &'a [Aim],
    pub(crate) queries: &'a [&'a str],
}

impl Bench<'_> {
    /// Prints how all of them fare with a map's photons.
    pub(crate) fn photons(&self, path: &str) -> anyhow::Result<()> {
        let photons = Photons::read(path)?;
        let maps = ours(&photons)?;
        for (number, queries_path) in self.queries.iter().enumerate() {
            let mut peer = Peer::start(self.native, path, queries_path)?;
            let queries = Queries::read(queries_path)?;
            if number == 0 {
                self.building(&mut peer, &photons)?;
            }
            let (count, windows) = (photons.records.len(), queries.points.len());
            writeln!(stdout(), "{count} photons, {queries_path}: {} queries in {windows} windows", queries.len())?;
            let others = LIBRARIES[1..].iter().map(|library| library.name);
            let names = others
                .chain(maps.iter().map(|map| map.name))
                .fold(String::new(), |all, name| format!("{all}  {name:>5}"));
            writeln!(stdout(), "       k  {}, ns{names}", LIBRARIES[0].name)?;
            for &aim in self.aims {
                self.race(&mut peer, maps.iter().map(|map| map.searched_for(aim, &photons)).collect(), &queries, aim)?;
            }
            peer.end()?;
            self.picture(maps.last().context("a map")?, &photons, &queries)?;
        }
        Ok(())
    }

    /// How long it takes to build each.
    fn building(&self, peer: &mut Peer, photons: &Photons) -> anyhow::Result<()> {
        let names: Vec<&str> =
            LIBRARIES[1..].iter().map(|it| it.name).chain(STRUCTURES.iter().map(|it| it.0)).collect();
        let (mut yardstick, mut ratios) = (vec![], vec![vec![]; names.len()]);
        for _ in 0..self.rounds {
            let theirs = peer.building(0)?;
            yardstick.push(theirs);
            for (library, ratios) in (1..LIBRARIES.len()).zip(&mut ratios) {
                ratios.push(peer.building(library)? / theirs);
            }
            for ((_, build), ratios) in STRUCTURES.iter().zip(&mut ratios[LIBRARIES.len() - 1..]) {
                let (built, took) = nanoseconds(|| build(photons))?;
                drop(built?);
                ratios.push(took / theirs);
            }
        }
        let first = format!("{} {:.1} ms", LIBRARIES[0].name, median(&mut yardstick) / 1e6);
        let others = names.iter().zip(&mut ratios).map(|(name, ratios)| format!("  {name} {:.2}", median(ratios)));
        Ok(writeln!(stdout(), "{} photons, built: {first}{}", photons.records.len(), others.collect::<String>())?)
    }

    /// The search alone, and with estimate and film.
    fn picture(&self, map: &Map, photons: &Photons, queries: &Queries) -> anyhow::Result<()> {
        let [alone, picture, ratio] = gather::measure(&*map.map, photons, queries, 100, self.rounds)?;
        Ok(writeln!(
            stdout(),
            "  with a picture, k = 100: {picture:.0} ns, {ratio:.2} of the search alone ({alone:.0})"
        )?)
    }

    /// One search after the other, round by round.
    fn race(&self, peer: &mut Peer, mut ours: Vec<Ours<'_>>, queries: &Queries, aim: Aim) -> anyhow::Result<()> {
        let truth = Answers::of(&mut ours[0], queries, aim);
        for (library, Library { name, .. }) in LIBRARIES.iter().enumerate() {
            truth.compare(name, &peer.answers(library, aim)?)?;
        }
        for map in &mut ours[1..] {
            ensure!(Answers::of(map, queries, aim).digest == truth.digest, "{}: other photons", map.name);
        }
        let others = LIBRARIES.len() - 1;
        let (mut yardstick, mut ratios) = (vec![], vec![vec![]; others + ours.len()]);
        for _ in 0..self.rounds {
            let theirs = peer.round(0, aim)?;
            yardstick.push(theirs);
            for (other, ratios) in ratios[..others].iter_mut().enumerate() {
                ratios.push(peer.round(other + 1, aim)? / theirs);
            }
            for (map, ratios) in ours.iter_mut().zip(&mut ratios[others..]) {
                let ((), took) = nanoseconds(|| map.run(queries, aim, None))?;
                ratios.push(took / theirs);
            }
        }
        write!(stdout(), "{aim:>8}  {:9.0}", median(&mut yardstick) / queries.len() as f64)?;
        let names = LIBRARIES[1..].iter().map(|library| library.name).chain(ours.iter().map(|map| map.name));
        for (name, ratios) in names.zip(&mut ratios) {
            write!(stdout(), "  {:w$.3}", median(ratios), w = name.len().max(5))?;
        }
        Ok(writeln!(stdout())?)
    }
}
