//! What tells a scene from another: a digest of its geometry, materials and lights.

use super::{MaterialKind, Scene};
use pm_formats::Digest;
use xxhash_rust::xxh3::Xxh3;

impl Scene {
    /// XXH3-128 of all that light can meet: triangles with their corners' normals, and what they are made of, lamps among
    /// that. Names are not in it, nor how corners are shared: they change no photon.
    #[must_use]
    pub fn digest(&self) -> Digest {
        let mut hash = Xxh3::new();
        let mut floats = |numbers: &[f32]| numbers.iter().for_each(|x| hash.update(&x.to_le_bytes()));
        for material in &self.materials {
            let kind = match material.kind {
                MaterialKind::Diffuse => 0.0,
                MaterialKind::Mirror => 1.0,
                MaterialKind::Glass => 2.0,
                MaterialKind::Glossy => 3.0,
            };
            floats(&[kind, material.exponent, material.ior]);
            [material.diffuse, material.specular, material.emission, material.transmittance]
                .iter()
                .for_each(|it| floats(it));
        }
        for triangle in 0..self.triangle_count() {
            floats(&[f32::from(self.material_ids[triangle])]);
            self.triangle(triangle).iter().for_each(|corner| floats(&corner.to_array()));
            let normals = self.corner_normals(triangle);
            normals.unwrap_or_default().iter().for_each(|normal| floats(&normal.to_array()));
        }
        Digest(hash.digest128())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Material;
    use super::*;

    fn box_scene() -> Scene {
        Scene::embedded()
    }

    /// Does everything that light can meet count, and nothing else?
    #[test]
    fn what_light_meets_is_told_apart() {
        let scene = box_scene();
        assert_eq!(scene.digest(), box_scene().digest());
        let mut renamed = scene.clone();
        renamed.materials[0].name = "paint".into();
        assert_eq!(renamed.digest(), scene.digest());
        let other_material = |change: fn(&mut Material)| {
            let mut other = scene.clone();
            change(&mut other.materials[0]);
            other
        };
        let mut moved = scene.clone();
        moved.positions[0].x += 0.001;
        let mut painted = scene.clone();
        painted.material_ids[0] = (painted.material_ids[0] + 1) % 2;
        for (what, other) in [
            ("a corner", moved),
            ("a triangle's material", painted),
            ("diffuse", other_material(|material| material.diffuse[1] += 0.01)),
            ("emission", other_material(|material| material.emission[2] += 0.01)),
            ("ior", other_material(|material| material.ior += 0.01)),
            ("kind", other_material(|material| material.kind = MaterialKind::Glossy)),
        ] {
            assert_ne!(other.digest(), scene.digest(), "{what}");
        }
    }
}
