//! What is printed: ratios for people, or how costs grow as a table for charts.

use crate::aim::Aim;
use crate::contestants::{Map, grown, ours};
use crate::gather;
use crate::peer::Peer;
use crate::race::{Fared, building, searching};
use crate::streams::{Photons, Queries};
use anyhow::Context as _;
use std::io::{Write as _, stdout};

/// What is measured.
pub(crate) struct Bench<'a> {
    pub(crate) rounds: usize,
    /// This program, built for this very machine.
    pub(crate) native: &'a str,
    pub(crate) aims: &'a [Aim],
    pub(crate) photons: &'a [&'a str],
    pub(crate) queries: &'a [&'a str],
}

impl Bench<'_> {
    /// Prints how all of them fare, as shares of the first one's time.
    pub(crate) fn ratios(&self) -> anyhow::Result<()> {
        let Self { rounds, aims, .. } = *self;
        self.for_each(ours, |Race { peer, photons, maps, path, queries, built }| {
            if let Some(built) = built {
                writeln!(stdout(), "{} photons, built: {}", photons.records.len(), of_building(&built))?;
            }
            let (count, windows) = (photons.records.len(), queries.points.len());
            writeln!(stdout(), "{count} photons, {path}: {} queries in {windows} windows", queries.len())?;
            for (number, &aim) in aims.iter().enumerate() {
                let maps = maps.iter().map(|map| map.searched_for(aim, photons)).collect();
                let fared = searching(peer, maps, queries, aim, rounds)?;
                if number == 0 {
                    let names = fared[1..].iter().map(|one| format!("  {:>5}", one.name));
                    writeln!(stdout(), "       k  {}, ns{}", fared[0].name, names.collect::<String>())?;
                }
                let ratios = fared[1..].iter().map(|one| format!("  {:w$.3}", one.ratio, w = one.name.len().max(5)));
                let first = fared[0].nanoseconds / queries.len() as f64;
                writeln!(stdout(), "{aim:>8}  {first:9.0}{}", ratios.collect::<String>())?;
            }
            let map = maps.last().context("a map")?;
            let [alone, picture, ratio] = gather::measure(&*map.map, photons, queries, 100, rounds)?;
            writeln!(stdout(), "  a picture, k = 100: {picture:.0} ns, {ratio:.2} of the search alone ({alone:.0})")?;
            Ok(())
        })
    }

    /// Prints a row for each of the few that charts of growth show.
    pub(crate) fn growth(&self) -> anyhow::Result<()> {
        let Self { rounds, aims, .. } = *self;
        writeln!(stdout(), "photons,queries,order,k,who,nanoseconds,ratio")?;
        self.for_each(grown, |Race { peer, photons, maps, queries, built, .. }| {
            let count = photons.records.len();
            for Fared { name, nanoseconds, ratio } in built.into_iter().flatten() {
                writeln!(stdout(), "{count},,building,,{name},{:.3},{ratio:.4}", nanoseconds / count as f64)?;
            }
            for &aim in aims {
                let maps = maps.iter().map(|map| map.searched_for(aim, photons)).collect();
                for Fared { name, nanoseconds, ratio } in searching(peer, maps, queries, aim, rounds)? {
                    let each = nanoseconds / queries.len() as f64;
                    let Queries { of, order, .. } = queries;
                    writeln!(stdout(), "{count},{of},{order},{aim},{name},{each:.1},{ratio:.4}")?;
                }
            }
            Ok(())
        })
    }

    /// Each stream of queries with each photon map, which is built for the first of them.
    fn for_each(
        &self,
        maps: fn(&Photons) -> anyhow::Result<Vec<Map>>,
        mut race: impl FnMut(Race<'_>) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        for photons_path in self.photons {
            let photons = Photons::read(photons_path)?;
            let maps = maps(&photons)?;
            for (number, path) in self.queries.iter().enumerate() {
                let peer = &mut Peer::start(self.native, photons_path, path)?;
                let queries = &Queries::read(path)?;
                let built = if number == 0 { Some(building(peer, &photons, self.rounds)?) } else { None };
                race(Race { peer, photons: &photons, maps: &maps, path, queries, built })?;
                peer.end()?;
            }
        }
        Ok(())
    }
}

/// Those who search for some queries among some photons.
struct Race<'a> {
    peer: &'a mut Peer,
    photons: &'a Photons,
    maps: &'a [Map],
    path: &'a str,
    queries: &'a Queries,
    /// How long building took, if that has not been told.
    built: Option<Vec<Fared>>,
}

fn of_building(fared: &[Fared]) -> String {
    let first = format!("{} {:.1} ms", fared[0].name, fared[0].nanoseconds / 1e6);
    fared[1..].iter().fold(first, |line, one| format!("{line}  {} {:.2}", one.name, one.ratio))
}
