//! The path of one gather ray: through mirrors and glass to a surface that spreads light, and a bounce further where it
//! is too short.

use super::direct::{Techniques, direct_light};
use super::gather_options::{AtSpecular, GatherOptions};
use super::lights::Lights;
use super::ray_counts::RayCounts;
use super::reflection::{Reflection, Spread};
use super::roulette::patience;
use super::scatter::{choose, specular, spread_shares};
use super::surface::{Met, SurfacePoint, Surfaces};
use crate::scene::{Material, MaterialKind};
use glam::Vec3;
use pm_random::Random;

/// Paths of gather rays through a scene.
pub(super) struct GatherPaths<'a> {
    pub(super) surfaces: Surfaces<'a>,
    pub(super) lights: Lights,
    options: GatherOptions,
    /// By material: does every ray end there, whole, and is that all?
    ends: Vec<bool>,
}

/// Where a gather ray ends.
pub(super) struct End {
    pub(super) point: SurfacePoint,
    /// Unit vector back along the ray.
    pub(super) view: Vec3,
    /// What is left of the ray's weight.
    pub(super) weight: Vec3,
    /// Did it go by a mirror or through glass?
    pub(super) behind_specular: bool,
    /// Length of the ray, its reflections and refractions included.
    length: f32,
}

/// How lamps count that a gather ray meets.
#[derive(Clone, Copy)]
struct Lamps {
    /// Met at once: shadow rays look for them too.
    direct: Techniques,
    /// Met in a mirror or through glass, where only gather rays find them: do they count?
    behind_specular: bool,
}

/// The random numbers of one gather ray: light at a short end has its own, so that asking for it changes no query.
pub(super) struct PathRandom<L: Fn() -> Random> {
    pub(super) path: Random,
    /// Made when it is asked for, which is seldom.
    pub(super) light_at_short_end: L,
}

impl<'a> GatherPaths<'a> {
    pub(super) fn new(surfaces: Surfaces<'a>, options: GatherOptions) -> Self {
        let lights = Lights::new(surfaces.scene);
        let ends = surfaces.scene.materials.iter().map(|material| ends_every_ray(material, options)).collect();
        Self { surfaces, lights, options, ends }
    }

    /// Casts one gather ray of this weight from a point, and one bounce further if it is too short. A lamp met counts by its
    /// share among the techniques.
    pub(super) fn cast(
        &self,
        from: &SurfacePoint,
        (direction, techniques): (Vec3, Techniques),
        weight: Vec3,
        random: &mut PathRandom<impl Fn() -> Random>,
        light: &mut (impl FnMut(Vec3) + ?Sized),
        counts: &mut RayCounts,
    ) -> Option<End> {
        let first = self.surfaces.hit(from.start(direction), direction)?;
        self.cast_to(from, (direction, techniques), first, weight, random, light, counts)
    }

    /// The same for a ray that is known to meet this surface first.
    #[inline]
    #[expect(clippy::too_many_arguments, reason = "those of cast, and one more")]
    pub(super) fn cast_to(
        &self,
        from: &SurfacePoint,
        (direction, techniques): (Vec3, Techniques),
        first: SurfacePoint,
        weight: Vec3,
        random: &mut PathRandom<impl Fn() -> Random>,
        light: &mut (impl FnMut(Vec3) + ?Sized),
        counts: &mut RayCounts,
    ) -> Option<End> {
        let lamps = Lamps { direct: techniques, behind_specular: self.options.caustics };
        let end = self.follow(from, (first, direction), weight, lamps, light, (&mut random.path, counts))?;
        if end.length >= self.options.min_gather_dist {
            return Some(end);
        }
        counts.gather_continued += 1;
        self.continued(&end, light, random, counts)
    }

    /// Does a gather ray that meets this first end there, with all of its weight, and with nothing else to be done?
    #[inline]
    pub(super) fn ends_at(&self, from: &SurfacePoint, met: &Met) -> bool {
        let nearest = self.options.min_gather_dist;
        self.ends[usize::from(met.material)] && (nearest <= 0.0 || met.position.distance(from.position) >= nearest)
    }

    /// One bounce further: direct light at the end of a ray that was too short goes to `light`, and what comes there
    /// from elsewhere is asked for where one ray from there ends.
    ///
    /// Near a corner a ray may end within the photons' disc of where it began, and then what it finds is blotched like
    /// the map itself: Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 8.5 (who traces on there).
    fn continued(
        &self,
        end: &End,
        light: &mut (impl FnMut(Vec3) + ?Sized),
        random: &mut PathRandom<impl Fn() -> Random>,
        counts: &mut RayCounts,
    ) -> Option<End> {
        let PathRandom { path: random, light_at_short_end } = random;
        let reflection = Reflection::new(self.surfaces.material(&end.point), end.point.facing, end.view);
        let techniques = Techniques { shadow: 1, gather: u32::from(!reflection.has_lobe()) };
        if self.options.direct {
            let Self { surfaces, lights, .. } = self;
            let random = &mut light_at_short_end();
            light(end.weight * direct_light(surfaces, lights, &end.point, &reflection, techniques, random));
        }
        let (u, v) = (random.unit(), random.unit());
        let (direction, weight) = reflection.sample(Spread::Cosine, None, u, v, random)?;
        let lamps = Lamps { direct: techniques, behind_specular: true };
        let first = self.surfaces.hit(end.point.start(direction), direction)?;
        let further =
            self.follow(&end.point, (first, direction), end.weight * weight, lamps, light, (random, counts))?;
        Some(End { behind_specular: end.behind_specular || further.behind_specular, ..further })
    }

    /// Follows a gather ray from the first surface met, through mirrors and glass, to the surface where it ends, one that
    /// spreads light.
    #[inline]
    fn follow(
        &self,
        start: &SurfacePoint,
        (point, direction): (SurfacePoint, Vec3),
        weight: Vec3,
        lamps: Lamps,
        light: &mut (impl FnMut(Vec3) + ?Sized),
        (random, counts): (&mut Random, &mut RayCounts),
    ) -> Option<End> {
        if self.ends[usize::from(point.material)] {
            // As below, without a look at the number that decides.
            random.skip();
            let length = point.position.distance(start.position);
            return Some(End { point, view: -direction, weight, behind_specular: false, length });
        }
        self.follow_from(start, (point, direction), weight, lamps, light, (random, counts))
    }

    /// The same where it may go on.
    fn follow_from(
        &self,
        start: &SurfacePoint,
        (first, mut direction): (SurfacePoint, Vec3),
        mut weight: Vec3,
        lamps: Lamps,
        light: &mut (impl FnMut(Vec3) + ?Sized),
        (random, counts): (&mut Random, &mut RayCounts),
    ) -> Option<End> {
        let (mut from, mut length) = (*start, 0.0);
        let mut point = first;
        for hits in 0.. {
            length += point.position.distance(from.position);
            let material = self.surfaces.material(&point);
            if self.options.direct && material.emits() && point.facing == point.front {
                let share = if hits == 0 {
                    let density = self.lights.density(start.position, &point);
                    lamps.direct.share_of_gather_ray(direction.dot(start.facing), density)
                } else {
                    f32::from(lamps.behind_specular)
                };
                light(weight * Vec3::from(material.emission) * share);
            }
            let (diffuse, lobe) = spread_shares(material);
            let spread = diffuse.max_element() + lobe.max_element();
            let ways = specular(material, &point, direction);
            let specular_share: f32 = ways.iter().flatten().map(|way| way.share.max_element()).sum();
            let behind_specular = hits > 0;
            if self.options.at_specular == AtSpecular::Gather && specular_share > 0.0 {
                return Some(End { point, view: -direction, weight, behind_specular, length });
            }
            // A surface that is both is one or the other for this ray.
            let total = spread + specular_share;
            if total <= 0.0 {
                return None;
            }
            if random.unit() * total < spread {
                return Some(End {
                    point,
                    view: -direction,
                    weight: weight * (total / spread),
                    behind_specular,
                    length,
                });
            }
            if self.options.at_specular == AtSpecular::Stop {
                return None;
            }
            let (way, chosen) = choose(ways, random)?;
            let patient = patience(hits, random)?;
            weight *= way.share * (chosen * patient * (total / specular_share));
            from = point;
            direction = way.direction;
            counts.gather_further += 1;
            point = self.surfaces.hit(from.start(direction), direction)?;
        }
        None
    }
}

/// Does every ray that meets such a surface end there, with all of its weight, and with no light seen?
fn ends_every_ray(material: &Material, options: GatherOptions) -> bool {
    let (diffuse, lobe) = spread_shares(material);
    let passes_on = matches!(material.kind, MaterialKind::Mirror | MaterialKind::Glass);
    // What is next to nothing might not be chosen, by rounding.
    let spreads = diffuse.max_element() + lobe.max_element() >= f32::MIN_POSITIVE;
    spreads && !passes_on && !(options.direct && material.emits())
}
