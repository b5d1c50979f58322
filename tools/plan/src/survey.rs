//! All parts of the error measured for many recipes, and what the work costs, by pilots on a few pixels.

use crate::answers::{Asking, Map};
use crate::estimate::Estimate;
use crate::law::{Law, Point};
use crate::lots::{OfLot, PhotonNoise};
use crate::pixels::Pixels;
use crate::preview::Preview;
use crate::rays::{Design, RaySet, cast};
use crate::recipe::{DESIGNS, MOST_SEEN, nth_design};
use crate::replicates::{Values, Weights, mean, sum};
use crate::task::{Caustics, PlanError, Task};
use crate::times::Times;
use crate::traced::{Photons, Traced};
use crate::traffic::Traffic;
use pm_gathering::Kernel;
use pm_light::transport::PhotonPaths;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Pixels.
    pub pixels: u32,
    /// Photons of the largest map.
    pub photons: u64,
}

impl Effort {
    /// Half of it, which takes about a third of the time.
    pub(crate) const fn halved(self) -> Self {
        Self { pixels: self.pixels.div_ceil(2), photons: self.photons.div_ceil(2) }
    }
}

/// Neighbours asked for, of which the first make the picture that bias is measured against.
pub(crate) const KS: [u32; 5] = [5, 10, 20, 40, 80];
/// The neighbours with which the numbers of rays are compared.
const USUAL_K: usize = 1;
/// Maps that the photons of a trace are dealt out to.
pub(crate) const LOTS: usize = 8;
/// Rays of a pixel in pilots.
pub(crate) const PILOT: Design = Design { samples: 4, gathers: 4, light_samples: 4 };

/// What of a photon map's picture the photons and the radius are to blame for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layer {
    /// Variance of rays with [`PILOT`]'s numbers, for each number of neighbours.
    pub(crate) rays: Vec<Estimate>,
    /// Variance of photons times their number, for each number of neighbours.
    pub(crate) photons: Vec<Estimate>,
    /// Its relative variance from map to map, for each number of neighbours.
    pub(crate) lumps: Vec<f64>,
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
    /// Variance of rays with as many eye rays as [`PILOT`], for each of [`DESIGNS`].
    pub(crate) rays: [Estimate; DESIGNS.len()],
    /// How much of it is of edges within pixels, and falls with the power 1.5 of the number of eye rays.
    pub(crate) edges: f64,
    /// What the work costs.
    pub times: Times,
    /// The same in bytes, where these are what is to be saved.
    pub traffic: Option<Traffic>,
    /// Share of the picture's pixels that was looked at.
    pub(crate) share: f64,
}

/// What one map says: values by set of rays and number of neighbours.
type BySet = [Vec<Values>; 2];

/// Two sets of rays, and what maps say of them: those of all photons of two traces, and of lots of them.
struct Asked {
    sets: [RaySet; 2],
    /// Photons of a lot, and of a whole trace.
    sizes: [u64; 2],
    /// By trace and lot.
    lots: Vec<Vec<BySet>>,
    /// By trace.
    whole: Vec<BySet>,
}

impl Survey {
    /// Measures.
    ///
    /// # Errors
    /// If nothing is seen, or nothing is lit.
    pub(crate) fn measure(task: &Task<'_>, preview: &Preview, effort: Effort) -> Result<Self, PlanError> {
        let pixels = &Pixels::choose(preview, effort.pixels, task.seed);
        let share = pixels.len() as f64 / task.pixels();
        let mut survey = Self { share, ..Self::default() };
        let mut traced = [0, 1].map(|m| Traced::new(PhotonPaths::new(task.surfaces.clone(), task.seed_of(2, m))));
        let (soft, map) = Asked::soft(task, pixels, effort, &mut traced, &mut survey.times)?;
        if soft.sets[0].queries.is_empty() && soft.sets[0].light.iter().flatten().all(|&x| x == 0.0) {
            return Err(PlanError::NothingSeen);
        }
        let of_caustics = |light| Asked::caustics(task, light, pixels, effort, &mut survey.times);
        let caustics = task.caustics.as_ref().map(of_caustics).transpose()?;
        let least_biased = |asked: &Asked| mean(asked.whole.iter().flatten().map(|by_k| &by_k[0]));
        let mut truth = sum(&mean(soft.sets.iter().map(|set| &set.light)), &least_biased(&soft));
        if let Some(caustics) = &caustics {
            truth = sum(&truth, &least_biased(caustics));
        }
        if truth.iter().flatten().all(|&x| x <= 0.0) {
            return Err(PlanError::Dark);
        }
        let weights = Weights::of(&truth).times(&pixels.stand_for);
        survey.soft = soft.layer(&weights, &KS);
        survey.caustics = caustics.map(|asked| asked.layer(&weights, &[Times::CAUSTICS_K]));
        survey.compare_rays(task, pixels, &map.for_others(&[KS[USUAL_K]]), &weights);
        Ok(survey)
    }

    /// Measures what other numbers of rays do, and what they cost.
    fn compare_rays(&mut self, task: &Task<'_>, pixels: &Pixels, map: &Map<'_>, weights: &Weights) {
        let pilot = |design: Design| {
            let start = (task.clock)();
            let sets = [0, 1].map(|r| {
                cast(&task.surfaces, task.camera, &pixels.at, design.soft(task.seed_of(1, r), task.caustics.is_some()))
            });
            let seconds = (task.clock)() - start;
            let [a, b] = sets.map(|set| sum(&set.light, &map.values(&set).remove(0)));
            (weights.variance(&a, &b), seconds / (2 * pixels.len() as u32 * design.samples) as f64)
        };
        for (design, [gathers, light_samples]) in DESIGNS.into_iter().enumerate() {
            let (variance, seconds) = pilot(Design { samples: PILOT.samples, gathers, light_samples });
            self.rays[design] = variance;
            self.times.rays[design] = seconds;
        }
        // Of S eye rays, each in a cell of its own: noise falls by S, what they see of edges by the power 1.5 of it.
        let (more, _) = pilot(Design { samples: 4 * PILOT.samples, ..PILOT });
        let few = self.rays[nth_design(PILOT.gathers, PILOT.light_samples)].value;
        self.edges = if few > 0.0 { (2.0 * (1.0 - 4.0 * more.value / few)).clamp(0.0, 0.95) * few } else { 0.0 };
    }
}

impl Asked {
    /// Beside it, the map of all photons of the first trace.
    fn soft<'a>(
        task: &Task<'a>,
        pixels: &Pixels,
        effort: Effort,
        traced: &'a mut [Traced<'_>; 2],
        times: &mut Times,
    ) -> Result<(Self, Map<'a>), PlanError> {
        let options = |r| PILOT.soft(task.seed_of(1, r), task.caustics.is_some());
        let sets = [0, 1].map(|r| cast(&task.surfaces, task.camera, &pixels.at, options(r)));
        let asking = Asking { materials: task.materials, kernel: Kernel::Constant };
        times.photon = timed_tracing(task, &mut traced[0], effort.photons, asking)?;
        times.of = effort.photons;
        let traced = both(traced, effort.photons)?;
        let (asked, map) = Self::ask(sets, asking, traced, effort.photons, &KS)?;
        // What takes how long is measured where nothing else is done: the way it will be done.
        let queries = asked.sets[0].queries.len().max(1) as f64;
        let time_of = |map: &Map<'_>| {
            let start = (task.clock)();
            map.values(&asked.sets[0]);
            ((task.clock)() - start) / queries
        };
        times.searches = KS.iter().map(|&k| (k, time_of(&map.for_others(&[k])))).collect();
        let smaller = traced[0].known(asked.sizes[0]).ok_or(PlanError::Dark)?;
        let smaller = time_of(&Map::build(smaller, asking, &[KS[USUAL_K]])?);
        let ratio = smaller / times.searches[USUAL_K].1.max(1e-12);
        let apart = libm::log(effort.photons as f64 / asked.sizes[0] as f64);
        times.growth = if apart > 0.0 { ((1.0 - ratio) / apart).clamp(0.0, 0.3) } else { 0.0 };
        Ok((asked, map))
    }

    fn caustics(
        task: &Task<'_>,
        light: &Caustics<'_>,
        pixels: &Pixels,
        effort: Effort,
        times: &mut Times,
    ) -> Result<Self, PlanError> {
        // Of a point's light all caustics come by one map: one eye ray in a pilot would tell, more are as in a picture.
        let options = |r| Design::seen(PILOT.samples, task.seed_of(3, r));
        let start = (task.clock)();
        let sets = [0, 1].map(|r| cast(&task.surfaces, task.camera, &pixels.at, options(r)));
        let cast_in = (task.clock)() - start;
        let mut traced = [0, 1].map(|m| Traced::new(light.paths.with_seed(task.seed_of(4, m))));
        times.aiming = light.aiming;
        let most =
            light.most.min(if task.is_large() { MOST_BESIDE } else { MOST_CAUSTICS }).min(effort.photons * 5 / 4);
        let asking = Asking { materials: task.materials, kernel: Kernel::Cone };
        times.caustic = timed_tracing(task, &mut traced[0], most, asking)?;
        let (asked, map) = Self::ask(sets, asking, both(&mut traced, most)?, most, &[Times::CAUSTICS_K])?;
        let points = (2 * pixels.len() as u32 * PILOT.samples) as f64;
        let start = (task.clock)();
        map.values(&asked.sets[0]);
        let searched = (task.clock)() - start;
        times.seen = (cast_in + 2.0 * searched) / points;
        Ok(asked)
    }

    /// Beside it, the map of all photons of the first trace.
    fn ask<'a>(
        sets: [RaySet; 2],
        asking: Asking<'a>,
        traced: &'a [Traced<'_>; 2],
        most: u64,
        ks: &[u32],
    ) -> Result<(Self, Map<'a>), PlanError> {
        let of_sets = |map: &Map<'_>| [0, 1].map(|r: usize| map.values(&sets[r]));
        let build = |photons: Photons<'a>| Map::build(photons, asking, ks);
        let mut lots = vec![];
        let mut of_lot = 0;
        let mut maps = vec![];
        for traced in traced {
            maps.push(build(traced.known(most).ok_or(PlanError::Dark)?)?);
            let dealt = traced.lots(LOTS);
            of_lot += dealt.iter().map(|lot| lot.photons.len() as u64).sum::<u64>();
            lots.push(dealt.into_iter().map(|lot| Ok(of_sets(&build(lot)?))).collect::<Result<_, PlanError>>()?);
        }
        let whole = maps.iter().map(of_sets).collect();
        Ok((Self { sets, sizes: [of_lot / (2 * LOTS as u64), most], lots, whole }, maps.swap_remove(0)))
    }

    /// What the photons and the radius are to blame for.
    fn layer(&self, weights: &Weights, ks: &[u32]) -> Layer {
        let least = f64::from(ks[0]) / self.sizes[1] as f64;
        let mut layer = Layer::default();
        let mut points = vec![];
        let finest = |m: usize, r: usize| &self.whole[m][r][0];
        for (k, &neighbours) in ks.iter().enumerate() {
            let maps = || self.lots.iter().flatten().chain(&self.whole);
            let rays: Vec<Estimate> = maps().map(|[a, b]| weights.variance(&a[k], &b[k])).collect();
            layer.rays.push(Estimate::average(&rays));
            let lots: Vec<OfLot<'_>> = self.lots.iter().flatten().map(|[a, b]| [&a[k], &b[k]]).collect();
            let noise = PhotonNoise::of(weights, &lots);
            layer.photons.push(noise.square.scaled(self.sizes[0] as f64));
            layer.lumps.push(noise.lumps);
            // The mean over lots and the whole map are of the same photons: their noise is the same, blur is what differs.
            let dealt: Vec<[Values; 2]> =
                self.lots.iter().map(|lots| [0, 1].map(|r: usize| mean(lots.iter().map(|lot| &lot[r][k])))).collect();
            let pictures =
                |level: usize, m: usize, r: usize| if level == 0 { &dealt[m][r] } else { &self.whole[m][r][k] };
            for (level, &n) in self.sizes.iter().enumerate() {
                let off = |m: usize, r: usize| [pictures(level, m, r), finest(m, r)];
                let squares = [weights.product(off(0, 0), off(1, 1)), weights.product(off(0, 1), off(1, 0))];
                points.push(Point { x: f64::from(neighbours) / n as f64, square: Estimate::average(&squares) });
            }
        }
        layer.bias = Law::fit(&points, least);
        layer
    }
}

/// Photons of caustics that are traced in a survey at most.
const MOST_CAUSTICS: u64 = 200_000;
/// The same beside a large picture: each takes as long as several others.
const MOST_BESIDE: u64 = 50_000;

/// Both with at least so many photons.
fn both<'a, 'b>(traced: &'a mut [Traced<'b>; 2], most: u64) -> Result<&'a [Traced<'b>; 2], PlanError> {
    for traced in traced.iter_mut() {
        traced.first(most).ok_or(PlanError::Dark)?;
    }
    Ok(traced)
}

/// Photons by which tracing is timed, at most.
const TIMED: u64 = 50_000;

/// Seconds of processor time that a photon takes to be traced and put into a map, by the first of those that are wanted.
fn timed_tracing(task: &Task<'_>, traced: &mut Traced<'_>, wanted: u64, asking: Asking<'_>) -> Result<f64, PlanError> {
    let n = wanted.min(TIMED);
    let start = (task.clock)();
    let photons = traced.first(n).ok_or(PlanError::Dark)?;
    Map::build(photons, asking, &[])?;
    Ok(((task.clock)() - start) / n as f64)
}

/// How many eye rays ask for caustics, relative to the pilot.
pub(crate) fn seen_by(samples: u32) -> f64 {
    f64::from(PILOT.samples) / f64::from(samples.min(MOST_SEEN))
}
