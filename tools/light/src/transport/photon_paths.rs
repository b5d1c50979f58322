//! Photons: paths from the lights, by Russian roulette.
//!
//! Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, chapter 5. Photons carry flux; at each diffuse hit one
//! is stored, the first hit included, and then the path goes on with a probability equal to the largest reflectance.

use super::aim::{Aim, Focused};
use super::lights::Lights;
use super::purpose::Purpose;
use super::reflection::Reflection;
use super::roulette::{patience, survive};
use super::sampling::cosine_direction;
use super::scatter::{specular, spread_shares, spreads};
use super::surface::Surfaces;
use glam::Vec3;
use pm_formats::Photon;
use pm_random::Random;
use std::sync::Arc;

/// A photon as a path stores it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPhoton {
    /// Where.
    pub position: Vec3,
    /// Flux in watts times the number of emitted paths.
    pub power: Vec3,
    /// Unit vector towards where it came from.
    pub towards_source: Vec3,
    /// Unit normal of the surface, on the side it came from.
    pub normal: Vec3,
    /// Did it come from the light by mirrors and glass alone, and by one of them at least?
    pub caustic: bool,
}

/// Paths of photons through a scene.
pub struct PhotonPaths<'a> {
    surfaces: Surfaces<'a>,
    lights: Arc<Lights>,
    seed: u64,
    /// Where lamps shine, if only caustics are wanted.
    aim: Option<Arc<Aim>>,
}

/// How a path begins.
struct Start {
    lamp: usize,
    normal: Vec3,
    origin: Vec3,
    direction: Vec3,
    /// Flux in watts times the number of emitted paths.
    power: Vec3,
}

/// Paths that show where lamps must shine for caustics.
const PILOT: u64 = 1 << 17;

impl<'a> PhotonPaths<'a> {
    /// Paths through a scene, which may have been made ready for rays before; a different set for each seed.
    #[must_use]
    pub fn new(scene: impl Into<Surfaces<'a>>, seed: u64) -> Self {
        let surfaces = scene.into();
        Self { lights: Arc::new(Lights::new(surfaces.scene)), surfaces, seed, aim: None }
    }

    /// The same, of caustics alone: lamps shine mostly to where mirrors and glass are, and with as much less power for it. A
    /// pilot with random numbers of its own shows where that is.
    #[must_use]
    pub fn of_caustics(scene: impl Into<Surfaces<'a>>, seed: u64) -> Self {
        let paths = Self::new(scene, seed);
        let mut found = vec![];
        for path in 0..if paths.lights.is_empty() { 0 } else { PILOT } {
            let random = &mut Random::new(&[seed, Purpose::AimingPath as u64, path]);
            let start = paths.start(random);
            let (lamp, normal, direction) = (start.lamp, start.normal, start.direction);
            let mut power = 0.0;
            paths.follow(start, random, true, |photon| power += photon.power.element_sum());
            if power > 0.0 {
                found.push(Focused { lamp, normal, direction, power });
            }
        }
        let aim = Aim::new(paths.lights.shares(), &found);
        Self { aim: Some(Arc::new(aim)), ..paths }
    }

    /// Others of the same kind, by another seed. Those of caustics are aimed as these are: how well that is done says how noisy
    /// they are, not what they say on average.
    #[must_use]
    pub fn with_seed(&self, seed: u64) -> Self {
        let Self { surfaces, lights, aim, .. } = self;
        Self { surfaces: surfaces.clone(), lights: Arc::clone(lights), seed, aim: aim.clone() }
    }

    /// Follows path number `path` and gives each photon it stores to `store`, in order.
    pub fn trace(&self, path: u64, store: impl FnMut(PathPhoton)) {
        let random = &mut Random::new(&[self.seed, Purpose::PhotonPath as u64, path]);
        if !self.lights.is_empty() {
            self.follow(self.start(random), random, self.aim.is_some(), store);
        }
    }

    /// Where a path begins.
    fn start(&self, random: &mut Random) -> Start {
        let (lamp, chance) = match &self.aim {
            None => (self.lights.number_at(random.unit()), None),
            Some(aim) => {
                let (lamp, chance) = aim.choose(random.unit());
                (lamp, Some(chance))
            }
        };
        let light = self.lights.numbered(lamp);
        let power = chance.map_or_else(|| light.path_flux(), |chance| light.flux_over(chance));
        let (origin, normal) = light.point(&self.surfaces, random);
        let (u, v) = (random.unit(), random.unit());
        let (direction, density) = match self.aim.as_ref().and_then(|aim| aim.directions(lamp)) {
            None => (cosine_direction(normal, u, v), 1.0),
            Some(directions) => directions.sample(u, v),
        };
        Start { lamp, normal, origin, direction, power: power / density }
    }

    /// Follows a path; if only caustics are wanted, no further than mirrors and glass lead.
    fn follow(&self, start: Start, random: &mut Random, caustics: bool, mut store: impl FnMut(PathPhoton)) {
        let Start { mut origin, mut direction, mut power, .. } = start;
        let mut specular_hits = 0;
        let mut spread_before = false;
        while let Some(point) = self.surfaces.hit(origin, direction) {
            let material = self.surfaces.material(&point);
            let (diffuse, lobe) = spread_shares(material);
            let caustic = specular_hits > 0 && !spread_before;
            if spreads(material) && (caustic || !caustics) {
                store(PathPhoton {
                    position: point.position,
                    power,
                    towards_source: -direction,
                    normal: point.facing,
                    caustic,
                });
            }
            // One of the ways on is chosen, with a probability equal to the largest channel of what it carries.
            let ways = specular(material, &point, direction);
            let chances = [diffuse.max_element(), lobe.max_element()]
                .into_iter()
                .chain(ways.iter().map(|way| way.map_or(0.0, |way| way.share.max_element())));
            let total: f32 = chances.clone().sum();
            let Some(scale) = survive(total, random) else { return };
            let mut choice = random.unit() * total;
            let chosen = chances.clone().position(|chance| {
                choice -= chance;
                choice < 0.0
            });
            if caustics && chosen.unwrap_or(0) < 2 && (diffuse + lobe).max_element() > 0.0 {
                return;
            }
            // `scale` is 1 / total (capped); the way itself was chosen with chance / total.
            let weight = |chance: f32| scale * total / chance;
            match chosen.unwrap_or(0) {
                0 if diffuse.max_element() > 0.0 => {
                    power *= diffuse * weight(diffuse.max_element());
                    direction = cosine_direction(point.facing, random.unit(), random.unit());
                    (specular_hits, spread_before) = (0, true);
                }
                0 | 1 if lobe.max_element() > 0.0 => {
                    let reflection = Reflection::new(material, point.facing, -direction);
                    // What the lobe sends below the surface is absorbed.
                    let Some((out, share)) = reflection.sample_lobe(random.unit(), random.unit()) else { return };
                    power *= share * weight(lobe.max_element());
                    direction = out;
                    (specular_hits, spread_before) = (0, true);
                }
                way => {
                    // Rounding may have passed over the last way: then it is the last there is.
                    let way = ways[way.saturating_sub(2)].or(ways[0]);
                    let Some(way) = way else { return };
                    let Some(patient) = patience(specular_hits, random) else { return };
                    power *= way.share * (weight(way.share.max_element()) * patient);
                    direction = way.direction;
                    specular_hits += 1;
                }
            }
            origin = point.start(direction);
        }
    }

    /// Packs photon number `id`; the rounding of its power is decided by a hash of seed and id, so that sums over many
    /// photons are exact on average. `None` if its power cannot be packed.
    #[must_use]
    pub fn pack(&self, id: u64, photon: &PathPhoton) -> Option<Photon> {
        Photon::new(
            photon.position.into(),
            photon.power.into(),
            photon_rounding(self.seed, id),
            photon.towards_source.into(),
            photon.normal.into(),
        )
    }
}

/// The thresholds by which the power of photon number `id` of these paths is rounded.
#[must_use]
pub fn photon_rounding(seed: u64, id: u64) -> [f32; 3] {
    let mut random = Random::new(&[seed, Purpose::PhotonRounding as u64, id]);
    [(); 3].map(|()| random.unit())
}
