//! Where irradiance is cached, and which places serve a point.

use glam::Vec3;
use std::collections::HashMap;

/// A place where irradiance is cached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Where.
    pub position: Vec3,
    /// Unit surface normal.
    pub normal: Vec3,
    /// Harmonic mean distance of what it sees, within `least` and a greatest radius, and lowered where a neighbour sees
    /// something nearer.
    pub radius: f32,
    /// Radius below which it is never lowered.
    pub least: f32,
}

/// Sites by place.
pub struct Sites {
    sites: Vec<Site>,
    /// Cells of side 2^level that a site's valid ball may overlap; the ball fits a cell of its level.
    cells: HashMap<(i32, [i64; 3]), Vec<u32>>,
    levels: Vec<i32>,
    accuracy: f32,
}

/// A point counts as served if some site's error is within this share of the accuracy: the outer rim, where weights fade
/// to zero, only helps along.
const SERVED: f32 = 0.8;
/// How far, in radii, a point may lie behind a site's tangent plane.
const BEHIND: f32 = 0.05;

impl Sites {
    /// No sites yet; `accuracy` is the error a that is allowed, as a share of the irradiance (0.1 to 0.3 is usual).
    #[must_use]
    pub fn new(accuracy: f32) -> Self {
        Self { sites: vec![], cells: HashMap::new(), levels: vec![], accuracy }
    }

    /// The sites, by id.
    #[must_use]
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// Ward's estimate of the error at a point: the split sphere model, distance over radius plus turn of the normal.
    /// Infinite where the point lies behind the site's surface.
    fn error(&self, site: &Site, position: Vec3, normal: Vec3) -> f32 {
        let way = position - site.position;
        if way.dot(normal + site.normal) < -2.0 * BEHIND * site.radius {
            return f32::INFINITY;
        }
        way.length() / site.radius + (1.0 - normal.dot(site.normal)).max(0.0).sqrt()
    }

    /// Calls `visit` with each site whose error at a point is below the accuracy, and its weight
    /// 1 / error - 1 / accuracy, in ascending order of ids. The weight is 0 at the rim.
    pub fn serving(&self, position: Vec3, normal: Vec3, mut visit: impl FnMut(u32, f32)) {
        let mut ids: Vec<u32> = vec![];
        for &level in &self.levels {
            ids.extend(self.cells.get(&(level, cell(position, level))).into_iter().flatten());
        }
        ids.sort_unstable();
        for id in ids {
            let error = self.error(&self.sites[id as usize], position, normal);
            if error < self.accuracy {
                // At the site itself the error is 0 and its irradiance is known: any large weight does.
                visit(id, 1.0 / error.max(1e-4 * self.accuracy) - 1.0 / self.accuracy);
            }
        }
    }

    /// Is there a site near enough for this point?
    #[must_use]
    pub fn serves(&self, position: Vec3, normal: Vec3) -> bool {
        let wanted = 1.0 / (SERVED * self.accuracy) - 1.0 / self.accuracy;
        let mut best = 0f32;
        self.serving(position, normal, |_, weight| best = best.max(weight));
        best >= wanted
    }

    /// Adds a site and returns its id.
    ///
    /// Neighbour clamping (Krivanek, Bouatouch, Pattanaik, Zara: *Making Radiance and Irradiance Caching Practical*, EGSR
    /// 2006): what one site sees near by another cannot see farther off than that plus their distance, so each lowers the
    /// other's radius.
    pub fn add(&mut self, mut site: Site) -> u32 {
        for other in &mut self.sites {
            let distance = other.position.distance(site.position);
            site.radius = site.radius.min(other.radius + distance).max(site.least);
        }
        for other in &mut self.sites {
            let distance = other.position.distance(site.position);
            other.radius = other.radius.min(site.radius + distance).max(other.least);
        }
        let id = u32::try_from(self.sites.len()).expect("fewer sites than pixels");
        // Later lowering leaves it in more cells than needed, never in fewer.
        let reach = self.accuracy * site.radius;
        let level = libm::ceilf(libm::log2f(2.0 * reach.max(f32::MIN_POSITIVE))) as i32;
        let (low, high) = (cell(site.position - reach, level), cell(site.position + reach, level));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    self.cells.entry((level, [x, y, z])).or_default().push(id);
                }
            }
        }
        if let Err(at) = self.levels.binary_search(&level) {
            self.levels.insert(at, level);
        }
        self.sites.push(site);
        id
    }
}

/// The cell of side 2^level that a point lies in.
#[expect(clippy::cast_possible_truncation, reason = "cells are no smaller than a few rounding steps")]
fn cell(position: Vec3, level: i32) -> [i64; 3] {
    let side = libm::exp2(f64::from(level));
    position.as_dvec3().to_array().map(|x| (x / side).floor() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    fn site(x: f32, radius: f32) -> Site {
        Site { position: Vec3::new(x, 0.0, 0.0), normal: Vec3::Y, radius, least: 0.01 }
    }

    #[test]
    fn the_grid_finds_what_looking_at_every_site_finds() {
        let mut random = Random::new(&[4]);
        let mut sites = Sites::new(0.2);
        for _ in 0..500 {
            let position = Vec3::new(random.unit(), 0.2 * random.unit(), random.unit()) * 4.0 - Vec3::splat(2.0);
            let normal = Vec3::new(random.unit() - 0.5, 1.0, random.unit() - 0.5).normalize();
            sites.add(Site { position, normal, radius: 0.05 + random.unit() * random.unit() * 3.0, least: 0.05 });
        }
        for _ in 0..2000 {
            let p = Vec3::new(random.unit(), 0.2 * random.unit(), random.unit()) * 4.0 - Vec3::splat(2.0);
            let mut found = vec![];
            sites.serving(p, Vec3::Y, |id, _| found.push(id));
            let all = (0..).zip(sites.sites()).filter(|(_, site)| sites.error(site, p, Vec3::Y) < 0.2);
            assert_eq!(found, all.map(|(id, _)| id).collect::<Vec<u32>>());
        }
    }

    #[test]
    fn weights_fade_to_nothing_at_the_rim() {
        let mut sites = Sites::new(0.1);
        sites.add(site(0.0, 1.0));
        let weight = |x: f32| {
            let mut found = 0.0;
            sites.serving(Vec3::new(x, 0.0, 0.0), Vec3::Y, |_, weight| found = weight);
            found
        };
        assert!(weight(0.0) > 1000.0);
        assert!((weight(0.05) - 10.0).abs() < 1e-3);
        assert!(weight(0.0999) < 0.02 && weight(0.1001) == 0.0);
        // Served up to 0.8 of the way.
        assert!(
            sites.serves(Vec3::new(0.079, 0.0, 0.0), Vec3::Y) && !sites.serves(Vec3::new(0.081, 0.0, 0.0), Vec3::Y)
        );
        // A normal turned by 10 degrees: sqrt(1 - cos 10) = 0.123 is beyond the accuracy at once.
        let turned = Vec3::new(0.1736, 0.9848, 0.0);
        assert!(!sites.serves(Vec3::ZERO, turned));
        // Behind the tangent plane by more than a twentieth of the radius.
        assert!(!sites.serves(Vec3::new(0.0, -0.06, 0.0), Vec3::Y) && sites.serves(Vec3::new(0.0, 0.06, 0.0), Vec3::Y));
    }

    #[test]
    fn neighbours_lower_each_other_but_not_below_their_least() {
        let mut sites = Sites::new(0.1);
        sites.add(site(0.0, 5.0));
        sites.add(site(1.0, 0.2));
        sites.add(site(1.5, 9.0));
        let radii: Vec<f32> = sites.sites().iter().map(|site| site.radius).collect();
        assert_eq!(radii, [1.2, 0.2, 0.7]);
        sites.add(Site { radius: 0.0, ..site(1.0, 0.0) });
        assert_eq!(sites.sites()[3].radius, 0.01);
    }
}
