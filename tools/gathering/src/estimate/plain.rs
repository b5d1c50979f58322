//! The usual case, without detours: all photons lie on the query's own surface and count alike.
//!
//! Their powers are mantissas of 8 bits times powers of two, which add up exactly, in any order, as integers.

use super::super::lobe;
use super::shorts::{Short, Sum};
use super::{Edges, Kernel, RadianceEstimate, Rim, on_same_surface};
use pm_formats::Material;
use pm_maps::Nearest;
use std::f64::consts::PI;

impl RadianceEstimate<'_> {
    /// Sum of BRDF x power and the area lit, if all photons lie on the query's surface and count alike.
    #[inline]
    pub(super) fn plain(&self, rim: &Rim, normal: [f32; 3], material: u16, found: &Nearest) -> Option<([f64; 3], f64)> {
        let unit = self.short_unit?;
        let diffuse = self.diffuse[usize::from(material)]?;
        if !self.placed.knows(found) {
            return None;
        }
        let sums = self.sum_of_short(normal, found)?;
        let sums = sums.without(rim.place.and_then(|place| self.placed.short(place)));
        let reflected = [0, 1, 2].map(|channel| sums[channel] as f64 * unit * diffuse[channel]);
        Some((reflected, rim.radius_squared * Kernel::Constant.disc()))
    }

    /// Powers of the photons found, if all lie on the surface with this normal.
    #[inline]
    fn sum_of_short(&self, normal: [f32; 3], found: &Nearest) -> Option<Sum> {
        let is_same = |photon: Short| on_same_surface(self.placed.normal(u32::from(photon.normal())), normal);
        let Some((_, place)) = found.farthest_place() else { return Some(Sum::new(&Short::default())) };
        let one = self.placed.short(place)?;
        let mut all = Sum::new(&one);
        found.for_places(|places| self.placed.add(places, &mut all));
        // Photons of a plane have one normal.
        let same = if all.is_plane() {
            is_same(one)
        } else {
            found.places().all(|(_, place)| self.placed.short(place).is_some_and(is_same))
        };
        same.then_some(all)
    }

    /// The BRDF of a surface that is not glossy.
    pub(super) fn diffuse_of(material: &Material) -> Option<[f64; 3]> {
        (!lobe::is_glossy(material)).then(|| material.diffuse.map(|share| f64::from(share) / PI))
    }

    /// The unit in which powers add up as integers, if all photons of a surface count alike.
    pub(super) fn unit_of_short(&self) -> Option<f64> {
        let alike = self.options.kernel == Kernel::Constant && self.options.edges != Edges::Sloped;
        self.placed.unit().filter(|_| alike && self.exact_sums)
    }
}
