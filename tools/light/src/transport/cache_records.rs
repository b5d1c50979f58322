//! Irradiance caching: which points get a record, and what every pixel takes of them, decided before any search.
//!
//! Records are placed in a fixed order of the pixels (a grid that is refined from every 16th pixel to all), so that they
//! do not depend on the order in which queries are generated.

use super::eye::VisiblePoint;
use super::gather_rays::GatherRays;
use super::query::query_at;
use super::ray_counts::RayCounts;
use super::record_rays::RecordRays;
use super::scatter::spread_shares;
use super::surface::SurfacePoint;
use crate::scene::{Camera, Material};
use glam::Vec3;
use pm_film::irradiance::{Site, Sites};
use pm_formats::{IrradianceRay, IrradianceRecord, PixelWeight, Query};

/// How irradiance is cached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CacheOptions {
    /// Allowed error a: smaller is denser.
    pub accuracy: f32,
    /// Least and greatest distance at which a record still serves, in pixels.
    pub spacing: [f32; 2],
}

/// The records of a picture, and which pixel asked for each.
pub struct CacheRecords {
    sites: Sites,
    /// By record, where it was placed.
    origins: Vec<Origin>,
    /// Record ids in ascending order of their pixels.
    by_pixel: Vec<u32>,
}

/// The point seen that a record was placed at.
struct Origin {
    pixel: u32,
    point: SurfacePoint,
    behind_specular: bool,
}

/// Distance between pixels of the first pass over the picture, which is halved until it is 1.
const FIRST_STRIDE: u32 = 16;

impl CacheRecords {
    /// Decides the records of a picture.
    #[must_use]
    pub fn decide(rays: &GatherRays<'_>, options: CacheOptions) -> Self {
        let [width, height] = rays.size();
        let mut records = Self { sites: Sites::new(options.accuracy), origins: vec![], by_pixel: vec![] };
        let mut stride = FIRST_STRIDE;
        while stride >= 1 {
            for y in (0..height).step_by(stride as usize) {
                for x in (0..width).step_by(stride as usize) {
                    records.visit(rays, options, x, y);
                }
            }
            stride /= 2;
        }
        // A record placed late lowers the radii of others, which then may no longer serve all they did: until none is
        // missed. Each round adds records, and a point with a record of its own is always served.
        let all = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        while all().filter(|&(x, y)| records.visit(rays, options, x, y)).count() > 0 {}
        records.by_pixel = (0..).take(records.origins.len()).collect();
        records.by_pixel.sort_by_key(|&id| records.origins[id as usize].pixel);
        records
    }

    /// Places records for the points seen in a pixel that none serves; true if there were any.
    fn visit(&mut self, rays: &GatherRays<'_>, options: CacheOptions, x: u32, y: u32) -> bool {
        let mut placed = false;
        let pixel = y * rays.size()[0] + x;
        for visible in cacheable(rays, x, y) {
            let VisiblePoint { point, distance, behind_specular, .. } = visible;
            let (position, normal) = (point.position, point.facing);
            if self.sites.serves(position, normal) {
                continue;
            }
            let spacing = distance * pixel_angle(rays.camera());
            let [least, greatest] = options.spacing.map(|pixels| pixels * spacing / options.accuracy);
            let of_record = RecordRays { rays, point: &point, id: self.origins.len() as u32 };
            let gathers = rays.options.gathers;
            let inverse: f64 = (0..gathers).map(|stratum| 1.0 / f64::from(of_record.length(stratum))).sum();
            let mean = (f64::from(gathers) / inverse) as f32;
            self.sites.add(Site { position, normal, radius: mean.clamp(least, greatest), least });
            self.origins.push(Origin { pixel, point, behind_specular });
            placed = true;
        }
        placed
    }

    /// Number of records.
    #[must_use]
    pub fn len(&self) -> usize {
        self.origins.len()
    }

    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.origins.is_empty()
    }

    /// Records that a pixel asked for, in ascending order; whether they are seen through mirrors or glass.
    pub fn of_pixel(&self, pixel: u32) -> impl Iterator<Item = (u32, bool)> {
        let from = self.by_pixel.partition_point(|&id| self.origins[id as usize].pixel < pixel);
        let records = self.by_pixel[from..].iter().map(|&id| (id, &self.origins[id as usize]));
        records.take_while(move |(_, origin)| origin.pixel == pixel).map(|(id, origin)| (id, origin.behind_specular))
    }

    /// A record as the stream carries it.
    #[must_use]
    pub fn record(&self, rays: &GatherRays<'_>, id: u32) -> IrradianceRecord {
        let site = &self.sites.sites()[id as usize];
        let Origin { pixel, point, .. } = &self.origins[id as usize];
        let of_record = RecordRays { rays, point, id };
        let ray = |stratum: u32| {
            let mut light = Vec3::ZERO;
            let _ = of_record.cast(stratum, &mut |radiance| light += radiance, &mut RayCounts::default());
            IrradianceRay { length: of_record.length(stratum), light: light.into() }
        };
        IrradianceRecord {
            pixel: *pixel,
            position: site.position.into(),
            normal: site.normal.into(),
            radius: site.radius,
            strata: rays.strata.shape().into(),
            rays: (0..rays.options.gathers).map(ray).collect(),
        }
    }

    /// Casts gather rays of a record, those of the strata given, and gives its queries to `query`, each with whether its ray
    /// went by a mirror or through glass.
    pub fn gather(
        &self,
        rays: &GatherRays<'_>,
        id: u32,
        strata: &[u32],
        mut query: impl FnMut(Query, bool),
        counts: &mut RayCounts,
    ) {
        let of_record = RecordRays { rays, point: &self.origins[id as usize].point, id };
        for &stratum in strata {
            counts.gather += 1;
            match of_record.cast(stratum, &mut |_| {}, counts) {
                Some(end) => {
                    let at = query_at(&end.point, end.view, id, stratum, end.weight);
                    query(Query { flags: Query::FOR_RECORD, ..at }, end.behind_specular);
                }
                None => counts.gather_lost += 1,
            }
        }
    }

    /// What a pixel takes of the records.
    pub fn weights(&self, rays: &GatherRays<'_>, x: u32, y: u32, mut weight: impl FnMut(PixelWeight)) {
        let pixel = y * rays.size()[0] + x;
        for visible in cacheable(rays, x, y) {
            let (position, normal) = (visible.point.position, visible.point.facing);
            let mut serving = vec![];
            self.sites.serving(position, normal, |id, weight| serving.push((id, weight)));
            let total: f32 = serving.iter().map(|&(_, weight)| weight).sum();
            // Reflected radiance is irradiance times reflectance over pi.
            let (reflectance, _) = spread_shares(rays.material(&visible));
            let share = visible.share * reflectance / std::f32::consts::PI;
            for (record, own) in serving {
                let site = &self.sites.sites()[record as usize];
                weight(PixelWeight {
                    pixel,
                    record,
                    weight: (share * (own / total)).into(),
                    displacement: (position - site.position).into(),
                    normal_change: site.normal.cross(normal).into(),
                });
            }
        }
    }
}

/// Can a surface's reflected light be told from its irradiance alone? Not where it has a glossy lobe.
pub(super) fn may_be_cached(material: &Material) -> bool {
    let (diffuse, lobe) = spread_shares(material);
    diffuse.max_element() > 0.0 && lobe.max_element() <= 0.0
}

/// The points seen in a pixel whose irradiance may be cached, in order.
fn cacheable(rays: &GatherRays<'_>, x: u32, y: u32) -> impl Iterator<Item = VisiblePoint> {
    let mut points = vec![];
    rays.see([x, y], &mut points, &mut |_| {});
    points.into_iter().filter(|visible| may_be_cached(rays.material(visible)))
}

/// Angle between the middles of neighbouring pixels, in radians.
fn pixel_angle(camera: &Camera) -> f32 {
    (2.0 * libm::tan(camera.vfov().to_radians() / 2.0) / f64::from(camera.size()[1])) as f32
}
