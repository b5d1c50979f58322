//! Rounds, interleaved: a neighbour on the machine slows all alike.

use crate::aim::Aim;
use crate::answers::Answers;
use crate::clock::{median, nanoseconds};
use crate::contestants::{Contestant as _, Ours, STRUCTURES};
use crate::libraries::{LIBRARIES, Library};
use crate::peer::Peer;
use crate::streams::{Photons, Queries};
use anyhow::ensure;

/// How one of them fared, the libraries first, of which the first is the yardstick.
pub(crate) struct Fared {
    pub(crate) name: &'static str,
    /// Of all queries, or of building once: the median.
    pub(crate) nanoseconds: f64,
    /// To the yardstick's within a round: the median.
    pub(crate) ratio: f64,
}

/// How long it takes to build each, so often.
pub(crate) fn building(peer: &mut Peer, photons: &Photons, rounds: usize) -> anyhow::Result<Vec<Fared>> {
    let ours = STRUCTURES.iter().map(|structure| structure.0);
    let mut times = Times::of(LIBRARIES.iter().map(|library| library.name).chain(ours));
    for _ in 0..rounds {
        let libraries = (0..LIBRARIES.len()).map(|library| peer.building(library));
        let ours = STRUCTURES.iter().map(|(_, build)| {
            let (built, took) = nanoseconds(|| build(photons))?;
            built.map(|_| took)
        });
        times.round(libraries.chain(ours))?;
    }
    Ok(times.fared())
}

/// How long searches take each, so often; all have to find the same.
pub(crate) fn searching(
    peer: &mut Peer,
    mut ours: Vec<Ours<'_>>,
    queries: &Queries,
    aim: Aim,
    rounds: usize,
) -> anyhow::Result<Vec<Fared>> {
    let truth = Answers::of(&mut ours[0], queries, aim);
    for (library, Library { name, .. }) in LIBRARIES.iter().enumerate() {
        truth.compare(name, &peer.answers(library, aim)?)?;
    }
    for map in &mut ours[1..] {
        ensure!(Answers::of(map, queries, aim).digest == truth.digest, "{}: other photons", map.name);
    }
    let names = ours.iter().map(|map| map.name);
    let mut times = Times::of(LIBRARIES.iter().map(|library| library.name).chain(names));
    for _ in 0..rounds {
        let libraries = (0..LIBRARIES.len()).map(|library| peer.round(library, aim));
        let ours = ours.iter_mut().map(|map| Ok(nanoseconds(|| map.run(queries, aim, None))?.1));
        times.round(libraries.chain(ours))?;
    }
    Ok(times.fared())
}

/// Times of each, round by round.
struct Times(Vec<(&'static str, Vec<f64>)>);

impl Times {
    fn of(names: impl Iterator<Item = &'static str>) -> Self {
        Self(names.map(|name| (name, vec![])).collect())
    }

    /// A round of all of them, one after the other.
    fn round(&mut self, took: impl Iterator<Item = anyhow::Result<f64>>) -> anyhow::Result<()> {
        for ((_, times), took) in self.0.iter_mut().zip(took) {
            times.push(took?);
        }
        Ok(())
    }

    fn fared(self) -> Vec<Fared> {
        let yardstick = self.0[0].1.clone();
        let fared = |(name, mut times): (&'static str, Vec<f64>)| {
            let mut ratios: Vec<f64> = times.iter().zip(&yardstick).map(|(took, theirs)| took / theirs).collect();
            Fared { name, nanoseconds: median(&mut times), ratio: median(&mut ratios) }
        };
        self.0.into_iter().map(fared).collect()
    }
}
