//! A scene: triangles with materials.

use super::bounds::Bounds;
use super::material::Material;
use super::mesh::{Dropped, cross};
use glam::Vec3;

/// Triangles with materials. Lengths are in the unit of the files, taken as metres.
///
/// Every triangle has an area, and is wound so that its geometric normal agrees with the normals of its corners if it
/// has them: for a light that is the side which emits, for glass the outside.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Points, some of them more than once (with different normals).
    pub positions: Vec<Vec3>,
    /// The three corners of every triangle, as indices into `positions`; counter-clockwise seen from the front.
    pub indices: Vec<[u32; 3]>,
    /// The material of every triangle, as an index into `materials`.
    pub material_ids: Vec<u16>,
    /// The materials that at least one triangle has.
    pub materials: Vec<Material>,
    /// The smallest box around all triangles.
    pub bounds: Bounds,
    /// What was read otherwise than written, a line each, for the program to show.
    pub warnings: Vec<String>,
    /// Triangles left out.
    pub dropped: Dropped,
    /// Beside `positions`: unit normals, or zero where there is none.
    pub(super) normals: Vec<Vec3>,
}

impl Scene {
    /// How many triangles there are.
    pub fn triangle_count(&self) -> usize {
        self.indices.len()
    }

    /// The corners of a triangle, counter-clockwise seen from its front.
    ///
    /// # Panics
    ///
    /// If there is no such triangle; so do the methods below.
    pub fn triangle(&self, i: usize) -> [Vec3; 3] {
        self.indices[i].map(|v| self.positions[v as usize])
    }

    /// The unit normal of a triangle's plane, on its front side.
    pub fn geometric_normal(&self, i: usize) -> Vec3 {
        cross(self.triangle(i)).normalize().as_vec3()
    }

    /// The area of a triangle, m².
    pub fn area(&self, i: usize) -> f64 {
        cross(self.triangle(i)).length() / 2.0
    }

    /// What a triangle is made of.
    pub fn material_of(&self, i: usize) -> &Material {
        &self.materials[usize::from(self.material_ids[i])]
    }

    /// Unit normals at the corners of a triangle, to be interpolated for shading; `None` if it is flat.
    pub fn corner_normals(&self, i: usize) -> Option<[Vec3; 3]> {
        let normals = self.indices[i].map(|v| self.normals[v as usize]);
        (!normals.contains(&Vec3::ZERO)).then_some(normals)
    }
}
