//! Lights that are in no OBJ file: parallelograms of even radiance.

use super::error::SceneError;
use super::material::Material;
use super::mesh::{Shape, shape};
use super::triangles::Scene;
use glam::DVec3;
use std::str::FromStr;

/// A parallelogram that emits the same radiance everywhere on its front, the side of u x v.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadLight {
    /// One corner, m.
    pub corner: [f64; 3],
    /// The edge from there to the second corner, m.
    pub u: [f64; 3],
    /// The edge from there to the last corner, m.
    pub v: [f64; 3],
    /// Emitted radiance, W/(m² sr), red, green, blue.
    pub radiance: [f64; 3],
}

impl FromStr for QuadLight {
    type Err = String;

    /// Reads twelve numbers, split by commas: corner, u, v, radiance.
    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        let numbers = parts.ok().and_then(|parts| <[f64; 12]>::try_from(parts).ok());
        let [x, y, z, ux, uy, uz, vx, vy, vz, r, g, b] = numbers.ok_or_else(|| {
            "twelve numbers are expected: a corner, two edges from it and a radiance, such as 0,3,0,1,0,0,0,0,1,9,9,9"
                .to_owned()
        })?;
        let light = Self { corner: [x, y, z], u: [ux, uy, uz], v: [vx, vy, vz], radiance: [r, g, b] };
        light.check().map(|()| light)
    }
}

impl QuadLight {
    /// Whether it has a place, an area and something to emit.
    fn check(&self) -> Result<(), String> {
        let Self { corner, u, v, radiance } = self;
        if ![corner, u, v, radiance].into_iter().flatten().all(|x| x.abs() <= 1e18) {
            return Err("a light of finite numbers up to 1e18 is expected".into());
        }
        if radiance.iter().any(|&x| x < 0.0) || radiance.iter().all(|&x| x == 0.0) {
            return Err("a radiance of 0 or more in each channel, and not 0 in all, is expected".into());
        }
        let (u, v) = (DVec3::from(*u), DVec3::from(*v));
        if u.cross(v).length() <= 1e-8 * u.length_squared().max(v.length_squared()) {
            return Err("the light has no area: its two edges are parallel, or one has no length".into());
        }
        Ok(())
    }
}

impl Scene {
    /// Adds a light, as two triangles of a material of its own that reflects nothing; `whence` tells whose it is.
    ///
    /// # Errors
    ///
    /// [`SceneError::Light`] if it has no area, nothing to emit, or too many materials before it.
    pub fn add_quad_light(&mut self, whence: &str, light: &QuadLight) -> Result<(), SceneError> {
        let fault = |what: String| SceneError::Light { whence: whence.to_owned(), what };
        light.check().map_err(fault)?;
        let material = u16::try_from(self.materials.len()).map_err(|_| fault("more than 65536 materials".into()))?;
        let first = u32::try_from(self.positions.len() + 4).map_err(|_| fault("more than 2^32 vertices".into()))? - 4;
        let [a, u, v] = [light.corner, light.u, light.v].map(DVec3::from);
        for p in [a, a + u, a + u + v, a + v].map(|p| p.as_vec3()) {
            self.positions.push(p);
            self.bounds.min = self.bounds.min.min(p);
            self.bounds.max = self.bounds.max.max(p);
        }
        self.normals.resize(self.positions.len(), glam::Vec3::ZERO);
        for triangle in [[0, 1, 2], [0, 2, 3]] {
            let triangle = triangle.map(|i| first + i);
            if shape(triangle.map(|i| self.positions[i as usize])) != Shape::Sound {
                return Err(fault("so small that single precision gives it no area where it is".into()));
            }
            self.indices.push(triangle);
            self.material_ids.push(material);
        }
        let number = 1 + self.materials.iter().filter(|material| material.name.starts_with("quad-light")).count();
        let emission = light.radiance.map(|x| x as f32);
        self.materials.push(Material { emission, ..Material::lambert(&format!("quad-light {number}"), [0.0; 3]) });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Does a light shine where u x v points, with the flux of its area, and does the scene grow to hold it? (Catches a
    /// turned winding, a lost factor and bounds that cut the light off.)
    #[test]
    fn light_is_part_of_the_scene() {
        let mut scene = Scene::embedded();
        let before = scene.emitted_flux();
        scene.add_quad_light("test", &"1,4,0, 0,0,2, 3,0,0, 1,2,0".parse().unwrap()).unwrap();
        let lights = scene.lights();
        assert_eq!(lights.len(), 4);
        for light in &lights[2..] {
            assert_eq!(scene.geometric_normal(light.triangle as usize), Vec3::Y);
            assert_eq!((light.area, light.emission), (3.0, [1.0, 2.0, 0.0]));
        }
        let flux = scene.emitted_flux();
        let pi = std::f64::consts::PI;
        assert!((flux[1] - before[1] - 12.0 * pi).abs() < 1e-9 && (flux[2] - before[2]).abs() < 1e-9);
        assert_eq!(scene.bounds.max, Vec3::new(4.0, 4.0, 2.0));
        assert_eq!(scene.corner_normals(scene.triangle_count() - 1), None);
    }

    /// Is what cannot shine refused, each for its own reason?
    #[test]
    fn dark_and_flat_lights_are_refused() {
        let said = |text: &str| text.parse::<QuadLight>().unwrap_err();
        assert!(said("1,2,3").starts_with("twelve numbers"));
        assert!(said("0,0,0,1,0,0,0,1,0,1,1,x").starts_with("twelve numbers"));
        assert!(said("0,0,0,1,0,0,2,0,0,1,1,1").contains("no area"));
        assert!(said("0,0,0,1,0,0,0,0,0,1,1,1").contains("no area"));
        assert!(said("0,0,0,1,0,0,0,1,0,0,0,0").contains("radiance"));
        assert!(said("0,0,0,1,0,0,0,1,0,1,-1,0").contains("radiance"));
        assert!(said("0,0,0,inf,0,0,0,1,0,1,1,1").contains("finite"));
        let mut scene = Scene::embedded();
        let far = "1e9,0,0,1e-3,0,0,0,1e-3,0,1,1,1".parse().unwrap();
        assert!(scene.add_quad_light("test", &far).unwrap_err().to_string().contains("single precision"));
    }
}
