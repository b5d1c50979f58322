//! What is seen through a pixel: eye rays, followed through mirrors and glass to points to gather for.

use super::purpose::Purpose;
use super::roulette::patience;
use super::sampling::grid;
use super::scatter::{choose, specular, spreads};
use super::surface::{SurfacePoint, Surfaces};
use crate::scene::Camera;
use glam::Vec3;
use pm_random::Random;

/// A point seen, with what share of its radiance the pixel gets.
pub(super) struct VisiblePoint {
    pub(super) point: SurfacePoint,
    /// Unit vector back to the viewer.
    pub(super) view: Vec3,
    pub(super) share: Vec3,
    pub(super) behind_specular: bool,
    /// Length of the way from the eye, in scene units.
    pub(super) distance: f32,
    /// Number within the pixel: those of one eye ray differ by multiples of the number of eye rays.
    pub(super) number: u32,
}

/// Eye rays of a picture.
pub(super) struct Eye {
    pub(super) camera: Camera,
    pub(super) seed: u64,
    /// Eye rays in each pixel.
    pub(super) samples: u32,
}

/// Times that an eye ray is split at glass; after that one of its ways is chosen at random.
const SPLITS: u32 = 2;

impl Eye {
    /// The points seen in a pixel, in order; what they and other surfaces on the way emit goes to `light`.
    /// Returns the number of rays.
    pub(super) fn see(
        &self,
        surfaces: &Surfaces<'_>,
        x: u32,
        y: u32,
        points: &mut Vec<VisiblePoint>,
        light: &mut impl FnMut(Vec3),
    ) -> u64 {
        (0..self.samples).map(|sample| self.see_sample(surfaces, x, y, sample, points, light)).sum()
    }

    /// Where in a pixel an eye ray goes: its middle if it is the only one, else a random point of the sample's own cell of
    /// a grid.
    fn place(&self, pixel: u32, sample: u32) -> (f64, f64) {
        if self.samples == 1 {
            return (0.5, 0.5);
        }
        let (rows, columns) = grid(self.samples);
        let key = [self.seed, Purpose::PixelSample as u64, u64::from(pixel), u64::from(sample)];
        let random = &mut Random::new(&key);
        let mut within = |cell: u32, cells: u32| (f64::from(cell) + f64::from(random.unit())) / f64::from(cells);
        (within(sample % columns, columns), within(sample / columns, rows))
    }

    fn see_sample(
        &self,
        surfaces: &Surfaces<'_>,
        x: u32,
        y: u32,
        sample: u32,
        points: &mut Vec<VisiblePoint>,
        light: &mut impl FnMut(Vec3),
    ) -> u64 {
        let pixel = y * self.camera.size()[0] + x;
        let (dx, dy) = self.place(pixel, sample);
        let (eye, direction) = self.camera.ray(f64::from(x) + dx, f64::from(y) + dy);
        // One number for pixel and sample: the key is as long whatever the number of samples.
        let whole = u64::from(pixel) | u64::from(sample) << 32;
        let random = &mut Random::new(&[self.seed, Purpose::EyePath as u64, whole]);
        let (mut number, mut count) = (sample, 0);
        // Rays yet to be followed: origin, direction, share, splits left, specular hits and length so far.
        let mut rays = vec![(eye, direction, Vec3::ONE / self.samples as f32, SPLITS, 0u32, 0f32)];
        while let Some((origin, direction, share, splits, hits, length)) = rays.pop() {
            count += 1;
            let Some(point) = surfaces.hit(origin, direction) else { continue };
            let distance = length + origin.distance(point.position);
            let material = surfaces.material(&point);
            if material.emits() && point.facing == point.front {
                light(share * Vec3::from(material.emission));
            }
            if spreads(material) {
                points.push(VisiblePoint {
                    point,
                    view: -direction,
                    share,
                    behind_specular: hits > 0,
                    distance,
                    number,
                });
                // However many there are, no other sample has them.
                number += self.samples;
            }
            let Some(patient) = patience(hits, random) else { continue };
            let ways = specular(material, &point, direction);
            let mut follow = |direction: Vec3, share: Vec3, splits: u32| {
                if share.max_element() > 0.0 {
                    rays.push((point.start(direction), direction, share * patient, splits, hits + 1, distance));
                }
            };
            match ways {
                [Some(reflected), Some(refracted)] if splits > 0 => {
                    // Pushed last, followed first: what is seen through glass comes before what it reflects.
                    follow(reflected.direction, share * reflected.share, splits - 1);
                    follow(refracted.direction, share * refracted.share, splits - 1);
                }
                _ => {
                    if let Some((way, weight)) = choose(ways, random) {
                        follow(way.direction, share * way.share * weight, splits);
                    }
                }
            }
        }
        count
    }
}
