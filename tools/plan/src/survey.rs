//! All parts of the error measured for many recipes, and what the work costs, by pilots on a few pixels.

use crate::answers::{Asking, Map};
use crate::estimate::Estimate;
use crate::law::{Law, Point};
use crate::pixels::stratified;
use crate::rays::{Design, RaySet, cast};
use crate::recipe::MOST_SEEN;
use crate::replicates::{Values, Weights, mean, sum};
use crate::task::{PlanError, Task};
use crate::times::Times;
use crate::traced::Traced;
use pm_gathering::Kernel;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Pixels.
    pub pixels: u32,
    /// Photons of the largest map.
    pub photons: u64,
}

/// Neighbours asked for, of which the first make the picture that bias is measured against.
pub(crate) const KS: [u32; 5] = [5, 10, 20, 40, 80];
/// The neighbours with which the numbers of rays are compared.
const USUAL_K: usize = 1;
/// Sizes of maps: the largest, and each a quarter of the one before.
const LEVELS: u32 = 3;
/// Rays of a pixel in pilots.
pub(crate) const PILOT: Design = Design { samples: 4, gathers: 4, light_samples: 4 };
/// Gather and shadow rays of a point that were measured.
pub(crate) const RAYS: [u32; 3] = [1, 4, 16];

/// What of a photon map's picture the photons and the radius are to blame for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layer {
    /// Variance of rays with [`PILOT`]'s numbers, for each number of neighbours.
    pub(crate) rays: Vec<Estimate>,
    /// Variance of photons times their number, for each number of neighbours.
    pub(crate) photons: Vec<Estimate>,
    /// Bias by k / n.
    pub(crate) bias: Law,
}

/// What was measured.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Light by gather rays.
    pub(crate) soft: Layer,
    /// Caustics in a map of their own.
    pub(crate) caustics: Option<Layer>,
    /// Variance of light that needs no query, for each number of shadow rays.
    pub(crate) light: [Estimate; 3],
    /// Variance of gathered light, for each number of gather rays.
    pub(crate) gathered: [Estimate; 3],
    /// What both vary by together: the eye rays.
    pub(crate) both: Estimate,
    /// Noise falls with this power of the number of eye rays.
    pub(crate) power: f64,
    /// What the work costs.
    pub times: Times,
    /// Photons of the largest map.
    pub(crate) photons: u64,
}

/// Values by map, set of rays, size of the map (ascending) and number of neighbours.
type Grid = Vec<Vec<Vec<Vec<Values>>>>;

/// Two sets of rays, and what maps of several sizes say of them.
struct Asked {
    sets: [RaySet; 2],
    sizes: Vec<u64>,
    grid: Grid,
}

impl Survey {
    /// Measures.
    ///
    /// # Errors
    /// If nothing is seen, or nothing is lit.
    pub fn measure(task: &Task<'_>, effort: Effort) -> Result<Self, PlanError> {
        let pixels = &stratified(task.camera.size(), effort.pixels, task.seed);
        let mut survey = Self { photons: effort.photons, ..Self::default() };
        let soft = Asked::soft(task, pixels, effort, &mut survey.times)?;
        if soft.sets[0].queries.is_empty() && soft.sets[0].light.iter().flatten().all(|&x| x == 0.0) {
            return Err(PlanError::NothingSeen);
        }
        let caustics = if task.caustics > 0 { Some(Asked::caustics(task, pixels, &mut survey.times)?) } else { None };
        let least_biased = |asked: &Asked| {
            let finest = |by_size: &Vec<Vec<Values>>| by_size.last().map(|by_k| by_k[0].clone()).unwrap_or_default();
            mean(asked.grid.iter().flatten().map(finest).collect::<Vec<_>>().iter())
        };
        let mut truth = sum(&mean(soft.sets.iter().map(|set| &set.light)), &least_biased(&soft));
        if let Some(caustics) = &caustics {
            truth = sum(&truth, &least_biased(caustics));
        }
        if truth.iter().flatten().all(|&x| x <= 0.0) {
            return Err(PlanError::Dark);
        }
        let weights = Weights::of(&truth);
        survey.soft = soft.layer(&weights, &KS);
        survey.caustics = caustics.map(|asked| asked.layer(&weights, &[Times::CAUSTICS_K]));
        survey.compare_rays(task, pixels, &weights)?;
        Ok(survey)
    }

    /// Measures what other numbers of rays do, and what they cost.
    fn compare_rays(&mut self, task: &Task<'_>, pixels: &[[u32; 2]], weights: &Weights) -> Result<(), PlanError> {
        let mut traced = Traced::new(task.scene, task.seed_of(2, 0), false);
        let map = Map::build(traced.first(self.photons).ok_or(PlanError::Dark)?, KS[USUAL_K])?;
        let asking = Asking { materials: task.materials, kernel: Kernel::Constant };
        let pilot = |design: Design| {
            let start = (task.clock)();
            let sets = [0, 1]
                .map(|r| cast(task.scene, task.camera, pixels, design.soft(task.seed_of(1, r), task.caustics > 0)));
            let seconds = (task.clock)() - start;
            let gathered = [0, 1].map(|r: usize| map.values(asking, &sets[r], &KS[USUAL_K..=USUAL_K]).remove(0));
            (sets.map(|set| set.light), gathered, seconds / (2 * pixels.len() as u32 * design.samples) as f64)
        };
        let variance = |two: &[Values; 2]| weights.variance(&two[0], &two[1]);
        let mut seconds = [0.0; 3];
        for (at, (gathers, light_samples)) in [(0, 2), (1, 1), (2, 0)].into_iter().enumerate() {
            let design = Design { gathers: RAYS[gathers], light_samples: RAYS[light_samples], samples: PILOT.samples };
            let (light, gathered, took) = pilot(design);
            self.light[light_samples] = variance(&light);
            self.gathered[gathers] = variance(&gathered);
            seconds[at] = took;
            if gathers == light_samples {
                self.both = weights.product([&light[0], &light[1]], [&gathered[0], &gathered[1]]).scaled(0.5);
            }
        }
        self.times.share_out(seconds);
        let (light, gathered, _) = pilot(Design { samples: 4 * PILOT.samples, ..PILOT });
        let total = variance(&[0, 1].map(|r: usize| sum(&light[r], &gathered[r]))).value;
        let before = self.light[1].value + self.gathered[1].value + 2.0 * self.both.value;
        self.power = (libm::log(before / total) / libm::log(4.0)).clamp(0.9, 1.5);
        if self.power.is_nan() {
            self.power = 1.0;
        }
        Ok(())
    }
}

impl Asked {
    fn soft(task: &Task<'_>, pixels: &[[u32; 2]], effort: Effort, times: &mut Times) -> Result<Self, PlanError> {
        let options = |r| PILOT.soft(task.seed_of(1, r), task.caustics > 0);
        let sets = [0, 1].map(|r| cast(task.scene, task.camera, pixels, options(r)));
        let asking = Asking { materials: task.materials, kernel: Kernel::Constant };
        let mut traced = [0, 1].map(|m| Traced::new(task.scene, task.seed_of(2, m), false));
        for traced in &mut traced {
            traced.first(effort.photons).ok_or(PlanError::Dark)?;
        }
        let asked = Self::ask(sets, asking, &mut traced, effort.photons, LEVELS, &KS)?;
        // What takes how long is measured where nothing else is done: the way it will be done.
        times.photon = timed_tracing(task, effort.photons, false)?;
        times.of = effort.photons;
        let queries = asked.sets[0].queries.len().max(1) as f64;
        let mut time_of = |n: u64, k: u32| -> Result<f64, PlanError> {
            let map = Map::build(traced[0].first(n).ok_or(PlanError::Dark)?, k)?;
            let start = (task.clock)();
            map.values(asking, &asked.sets[0], &[k]);
            Ok(((task.clock)() - start) / queries)
        };
        times.searches = KS.iter().map(|&k| Ok((k, time_of(effort.photons, k)?))).collect::<Result<_, PlanError>>()?;
        let smaller = time_of(asked.sizes[0], KS[USUAL_K])?;
        let ratio = smaller / times.searches[USUAL_K].1.max(1e-12);
        let apart = libm::log(effort.photons as f64 / asked.sizes[0] as f64);
        times.growth = if apart > 0.0 { ((1.0 - ratio) / apart).clamp(0.0, 0.3) } else { 0.0 };
        Ok(asked)
    }

    fn caustics(task: &Task<'_>, pixels: &[[u32; 2]], times: &mut Times) -> Result<Self, PlanError> {
        // Of a point's light all caustics come by one map: one eye ray in a pilot would tell, more are as in a picture.
        let options = |r| Design::seen(PILOT.samples, task.seed_of(3, r));
        let start = (task.clock)();
        let sets = [0, 1].map(|r| cast(task.scene, task.camera, pixels, options(r)));
        let cast_in = (task.clock)() - start;
        let start = (task.clock)();
        let mut traced = [0, 1].map(|m| Traced::new(task.scene, task.seed_of(4, m), true));
        times.aiming = ((task.clock)() - start) / 2.0;
        let most = task.caustics.min(MOST_CAUSTICS);
        times.caustic = timed_tracing(task, most, true)?;
        let asking = Asking { materials: task.materials, kernel: Kernel::Cone };
        let asked = Self::ask(sets, asking, &mut traced, most, LEVELS, &[Times::CAUSTICS_K])?;
        let points = (2 * pixels.len() as u32 * PILOT.samples) as f64;
        let map = Map::build(traced[0].first(most).ok_or(PlanError::Dark)?, Times::CAUSTICS_K)?;
        let start = (task.clock)();
        map.values(asking, &asked.sets[0], &[Times::CAUSTICS_K]);
        let searched = (task.clock)() - start;
        times.seen = (cast_in + 2.0 * searched) / points;
        Ok(asked)
    }

    fn ask(
        sets: [RaySet; 2],
        asking: Asking<'_>,
        traced: &mut [Traced<'_>; 2],
        most: u64,
        levels: u32,
        ks: &[u32],
    ) -> Result<Self, PlanError> {
        let least = u64::from(ks[ks.len() - 1]) * 4;
        let sizes: Vec<u64> =
            (0..levels).rev().map(|level| most >> (2 * level)).filter(|&n| n >= least.min(most)).collect();
        let mut grid = vec![];
        for traced in traced {
            let mut by_set = vec![vec![], vec![]];
            for &n in &sizes {
                let map = Map::build(traced.first(n).ok_or(PlanError::Dark)?, ks[ks.len() - 1])?;
                (0..2).for_each(|r| by_set[r].push(map.values(asking, &sets[r], ks)));
            }
            grid.push(by_set);
        }
        Ok(Self { sets, sizes, grid })
    }

    /// What the photons and the radius are to blame for.
    fn layer(&self, weights: &Weights, ks: &[u32]) -> Layer {
        let at = |m: usize, r: usize, level: usize, k: usize| &self.grid[m][r][level][k];
        let finest = self.sizes.len() - 1;
        let least = f64::from(ks[0]) / self.sizes[finest] as f64;
        let mut layer = Layer::default();
        let mut points = vec![];
        for (k, &neighbours) in ks.iter().enumerate() {
            let (mut rays, mut photons) = (vec![], vec![]);
            for (level, &n) in self.sizes.iter().enumerate() {
                rays.extend((0..2).map(|m| weights.variance(at(m, 0, level, k), at(m, 1, level, k))));
                let maps = |r: usize| [at(0, r, level, k), at(1, r, level, k)];
                photons.push(weights.product(maps(0), maps(1)).scaled(0.5 * n as f64));
                let off = |m: usize, r: usize| [at(m, r, level, k), at(m, r, finest, 0)];
                let squares = [weights.product(off(0, 0), off(1, 1)), weights.product(off(0, 1), off(1, 0))];
                points.push(Point { x: f64::from(neighbours) / n as f64, square: Estimate::average(&squares) });
            }
            layer.rays.push(Estimate::average(&rays));
            layer.photons.push(Estimate::average(&photons));
        }
        layer.bias = Law::fit(&points, least);
        layer
    }
}

/// Photons of caustics that are traced in a survey at most.
const MOST_CAUSTICS: u64 = 200_000;

/// Seconds of processor time that a photon takes to be traced and put into a map.
fn timed_tracing(task: &Task<'_>, n: u64, caustics: bool) -> Result<f64, PlanError> {
    let mut traced = Traced::new(task.scene, task.seed_of(5, 0), caustics);
    let n = n.min(50_000);
    let start = (task.clock)();
    let photons = traced.first(n).ok_or(PlanError::Dark)?;
    Map::build(photons, KS[0])?;
    Ok(((task.clock)() - start) / n as f64)
}

/// How many eye rays ask for caustics, relative to the pilot.
pub(crate) fn seen_by(samples: u32) -> f64 {
    f64::from(PILOT.samples) / f64::from(samples.min(MOST_SEEN))
}
