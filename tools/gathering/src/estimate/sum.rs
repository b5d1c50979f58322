//! Sums over photons, exact or in the order of their ids.

use super::super::disc::Slope;
use super::super::lobe::Lobe;
use super::super::surface::Surface;
use super::{Kernel, RadianceEstimate};
use pm_formats::{Material, Query};
use std::f64::consts::PI;

impl RadianceEstimate<'_> {
    /// Sum over photons of kernel weight x BRDF x power.
    pub(super) fn reflected(
        &self,
        surface: &Surface,
        slope: Option<Slope>,
        query: &Query,
        material: &Material,
        own: &mut [(u32, f32)],
    ) -> [f64; 3] {
        let diffuse = material.diffuse.map(|share| f64::from(share) / PI);
        match Lobe::of(material, query) {
            // Where every photon counts alike the BRDF waits until the powers are summed, exactly.
            None => {
                let sum = self.sum(surface, slope, None, own);
                [0, 1, 2].map(|channel| sum[channel] * diffuse[channel])
            }
            Some(lobe) => self.sum(surface, slope, Some((&lobe, diffuse)), own),
        }
    }

    /// Sum over photons of kernel weight x weight by slope x power, times the BRDF (lobe and diffuse part) if there is one.
    pub(super) fn sum(
        &self,
        surface: &Surface,
        slope: Option<Slope>,
        brdf: Option<(&Lobe, [f64; 3])>,
        own: &mut [(u32, f32)],
    ) -> [f64; 3] {
        let kernel = self.options.kernel;
        let exact = self.exact_sums && kernel == Kernel::Constant && brdf.is_none() && slope.is_none();
        if exact && let Some(sum) = self.placed.sum(own) {
            return sum;
        }
        if !exact {
            // Rounded sums depend on their order: then it is that of the ids, whatever order they were found in.
            own.sort_unstable_by_key(|&(place, _)| self.placed.id(place));
        }
        let mut sum = [0f64; 3];
        for &(place, distance) in &*own {
            let power = self.placed.power(place);
            let weight = match kernel {
                Kernel::Constant => 1.0,
                _ => kernel.weight(f64::from(distance).sqrt() / surface.radius),
            };
            let weight = match slope {
                None => weight,
                Some(slope) => weight * slope.weight(surface.offset(self.placed.spot(place).position)),
            };
            match brdf {
                None => (0..3).for_each(|channel| sum[channel] += weight * power[channel]),
                Some((lobe, diffuse)) => {
                    let glossy = lobe.brdf(self.placed.photon(place).towards_source());
                    for channel in 0..3 {
                        sum[channel] += weight * power[channel] * (diffuse[channel] + glossy[channel]);
                    }
                }
            }
        }
        sum
    }
}
