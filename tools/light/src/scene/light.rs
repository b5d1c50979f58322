//! The lights of a scene: its emissive triangles, with what they give off.

use super::triangles::Scene;

/// A triangle that emits the same radiance from every point of its front side in every direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaLight {
    /// Index of the triangle.
    pub triangle: u32,
    /// Its area, m².
    pub area: f64,
    /// Emitted radiance, W/(m² sr), red, green, blue.
    pub emission: [f32; 3],
    /// Emitted flux, W: pi x area x radiance.
    pub flux: [f64; 3],
}

impl Scene {
    /// Every light, in the order of the triangles. The front side, which emits, is that of
    /// [`geometric_normal`](Scene::geometric_normal).
    pub fn lights(&self) -> Vec<AreaLight> {
        let emissive = (0..self.triangle_count()).filter(|&i| self.material_of(i).emits());
        let light = |i| {
            let (area, emission) = (self.area(i), self.material_of(i).emission);
            let flux = emission.map(|le| std::f64::consts::PI * area * f64::from(le));
            AreaLight { triangle: i as u32, area, emission, flux }
        };
        emissive.map(light).collect()
    }

    /// The flux all lights emit together, W, red, green, blue.
    pub fn emitted_flux(&self) -> [f64; 3] {
        self.lights().iter().fold([0.0; 3], |sum, light| std::array::from_fn(|c| sum[c] + light.flux[c]))
    }
}
