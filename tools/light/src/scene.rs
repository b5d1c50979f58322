//! What is rendered: triangles, what they are made of, and from where they are seen.
//!
//! OBJ and MTL files as exporters write them are read unedited; what cannot be meant is an error with file and line, what
//! is left out is a warning. Nothing here prints: [`Scene::warnings`] is for the program to show. The same files give
//! the same scene, to the bit, on every machine.

mod camera;
mod error;
mod light;
mod material;
mod mesh;
mod mtl;
mod obj;
mod quad_light;
mod statements;
mod table;
#[cfg(test)]
mod tests;
mod texture;
mod warnings;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::Vec3;

pub use camera::{Camera, CameraChoice, CameraOverrides};
pub use error::{Place, SceneError};
pub use light::AreaLight;
pub use material::{Material, MaterialKind};
pub use mesh::Dropped;
use mesh::Shape;
use obj::{ParsedObj, ReadFile};
pub use quad_light::QuadLight;
use texture::Texture;
use warnings::Warnings;

/// Distance from the origin in sizes of the scene from which single precision is too coarse for the light to be right: at
/// 1e5 the map of a closed furnace is a third too bright, at 1e3 within a per cent.
const FAR: f32 = 1e4;

/// How OBJ and MTL files are understood.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Obey `Ks` and `Ns` as a Phong lobe. Exporters write them on plain paint too, so they are ignored by default.
    pub glossy: bool,
    /// Let glass transmit everything, whatever its `Tf`.
    pub clear_glass: bool,
    /// Accept a scene in which nothing emits light.
    pub allow_dark: bool,
}

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its corner of least coordinates.
    pub min: Vec3,
    /// Its corner of greatest coordinates.
    pub max: Vec3,
}

impl Bounds {
    const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The middle of the box.
    pub fn centre(&self) -> Vec3 {
        ((self.min.as_dvec3() + self.max.as_dvec3()) / 2.0).as_vec3()
    }

    /// The lengths of its sides.
    pub fn size(&self) -> Vec3 {
        self.max - self.min
    }
}

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
    normals: Vec<Vec3>,
}

impl Scene {
    /// Reads OBJ files and the material libraries they name, and merges them into one scene. Materials of one file are
    /// not seen by another.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, a statement that cannot be obeyed (with file and line), a scene without faces or
    /// without light.
    pub fn load(paths: &[PathBuf], options: &LoadOptions) -> Result<Self, SceneError> {
        Self::load_with(paths, options, &|path| std::fs::read(path))
    }

    /// The Cornell box with a mirror and a glass sphere, built into the program. Its camera is [`Camera::embedded`].
    pub fn embedded() -> Self {
        let read = |path: &Path| match path.to_str() {
            Some("cornell.obj") => Ok(include_bytes!("../../../scenes/cornell.obj").to_vec()),
            Some("cornell.mtl") => Ok(include_bytes!("../../../scenes/cornell.mtl").to_vec()),
            _ => Err(std::io::ErrorKind::NotFound.into()),
        };
        let scene = Self::load_with(&["cornell.obj".into()], &LoadOptions::default(), &read);
        scene.expect("the built-in scene is part of the program and covered by its tests")
    }

    fn load_with(paths: &[PathBuf], options: &LoadOptions, read: ReadFile<'_>) -> Result<Self, SceneError> {
        let mut warnings = Warnings::default();
        let mut builder = Builder { files: names(paths), ..Builder::default() };
        for path in paths {
            let parsed = obj::parse(path, read, &mut warnings)?;
            builder.add(path, &parsed, options, read, &mut warnings)?;
        }
        let lights = embree_lights(paths, read, &mut warnings)?;
        let allow_dark = options.allow_dark || !lights.is_empty();
        let mut scene = builder.finish(&LoadOptions { allow_dark, ..*options }, warnings)?;
        for (place, light) in &lights {
            scene.add_quad_light(&place.to_string(), light)?;
        }
        Ok(scene)
    }

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
        mesh::cross(self.triangle(i)).normalize().as_vec3()
    }

    /// The area of a triangle, m².
    pub fn area(&self, i: usize) -> f64 {
        mesh::cross(self.triangle(i)).length() / 2.0
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

/// The area lights of Embree's `NAME.ecs` beside each OBJ that has one.
fn embree_lights(
    paths: &[PathBuf],
    read: ReadFile<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<(Place, QuadLight)>, SceneError> {
    let mut all = vec![];
    for path in paths.iter().map(|path| path.with_extension("ecs")) {
        let Ok(bytes) = read(&path) else { continue };
        let (lights, warning) = camera::ecs::lights(&String::from_utf8_lossy(&bytes), &path.display().to_string())?;
        all.extend(lights);
        warning.into_iter().for_each(|warning| warnings.say(warning));
    }
    Ok(all)
}

fn names(paths: &[PathBuf]) -> String {
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    if names.is_empty() { "no OBJ file given".into() } else { names.join(", ") }
}

/// A scene in the making.
#[derive(Default)]
struct Builder {
    files: String,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    indices: Vec<[u32; 3]>,
    material_ids: Vec<u16>,
    materials: Vec<Material>,
    dropped: Dropped,
    turned: usize,
    read: usize,
    /// Mean colours of the textures met, or why there is none.
    textures: HashMap<PathBuf, Texture>,
}

impl Builder {
    fn add(
        &mut self,
        path: &Path,
        obj: &ParsedObj,
        options: &LoadOptions,
        read: ReadFile<'_>,
        warnings: &mut Warnings,
    ) -> Result<(), SceneError> {
        let mut numbers: HashMap<Option<usize>, u16> = HashMap::new();
        let mut lines = obj.face_lines.iter();
        for model in obj.models.iter().filter(|model| !model.mesh.indices.is_empty()) {
            let id = model.mesh.material_id;
            let number = match numbers.get(&id) {
                Some(&number) => number,
                None => {
                    let number = self.material(path, obj, id, options, read, warnings)?;
                    numbers.insert(id, number);
                    number
                }
            };
            self.mesh(path, &model.mesh, number, &mut lines, warnings)?;
        }
        Ok(())
    }

    fn material(
        &mut self,
        path: &Path,
        obj: &ParsedObj,
        id: Option<usize>,
        options: &LoadOptions,
        read: ReadFile<'_>,
        warnings: &mut Warnings,
    ) -> Result<u16, SceneError> {
        let number = u16::try_from(self.materials.len()).map_err(|_| self.too_many("more than 65536 materials"))?;
        self.materials.push(match id {
            Some(id) => {
                let mtl = &obj.materials[id];
                let place = &obj.places[&mtl.name];
                let texture = mtl
                    .diffuse_texture
                    .as_ref()
                    .map(|statement| texture::mean_colour(&place.file, statement, read, &mut self.textures));
                Material::decide(mtl, options, texture, place, warnings)
            }
            None => {
                warnings.say(format!("{}: faces without a known material are grey 0.5", path.display()));
                Material::unknown()
            }
        });
        Ok(number)
    }

    fn mesh(
        &mut self,
        path: &Path,
        mesh: &tobj::Mesh,
        material: u16,
        lines: &mut std::slice::Iter<'_, u32>,
        warnings: &mut Warnings,
    ) -> Result<(), SceneError> {
        let first = u32::try_from(self.positions.len()).map_err(|_| self.too_many("more than 2^32 vertices"))?;
        self.positions.extend(mesh.positions.chunks_exact(3).map(Vec3::from_slice));
        if u32::try_from(self.positions.len()).is_err() {
            return Err(self.too_many("more than 2^32 vertices"));
        }
        let unit = |n: &[f32]| Vec3::from_slice(n).as_dvec3().normalize_or_zero().as_vec3();
        self.normals.extend(mesh.normals.chunks_exact(3).map(unit));
        self.normals.resize(self.positions.len(), Vec3::ZERO);

        let triangles = mesh.indices.len() / 3;
        let arities = if mesh.face_arities.is_empty() { &vec![3; triangles] } else { &mesh.face_arities };
        let mut rest = &mesh.indices[..];
        for &arity in arities {
            let (face, after) = rest.split_at(arity as usize);
            rest = after;
            let line = lines.next().copied().unwrap_or(0);
            let corners: Vec<u32> = face.iter().map(|&v| first + v).collect();
            let start = self.fan(&corners).unwrap_or_else(|| {
                let place = Place::new(path, line);
                warnings.once("concave", || {
                    format!("{place}: a concave polygon is cut wrongly; triangulate it before export")
                });
                0
            });
            let at = |i: usize| corners[(start + i) % corners.len()];
            for i in 1..corners.len() - 1 {
                self.triangle([at(0), at(i), at(i + 1)], material);
            }
        }
        Ok(())
    }

    fn fan(&self, corners: &[u32]) -> Option<usize> {
        if corners.len() == 3 {
            return Some(0);
        }
        let points: Vec<Vec3> = corners.iter().map(|&v| self.positions[v as usize]).collect();
        mesh::fan_start(&points)
    }

    fn triangle(&mut self, [a, b, c]: [u32; 3], material: u16) {
        self.read += 1;
        let corners = [a, b, c].map(|v| self.positions[v as usize]);
        match mesh::shape(corners) {
            Shape::RepeatedCorner => self.dropped.repeated_corner += 1,
            Shape::ZeroArea => self.dropped.zero_area += 1,
            Shape::Sound => {
                let turn = mesh::wound_against(corners, [a, b, c].map(|v| self.normals[v as usize]));
                self.turned += usize::from(turn);
                self.indices.push(if turn { [a, c, b] } else { [a, b, c] });
                self.material_ids.push(material);
            }
        }
    }

    fn finish(mut self, options: &LoadOptions, mut warnings: Warnings) -> Result<Scene, SceneError> {
        let (files, dropped, read, turned) = (self.files.clone(), self.dropped, self.read, self.turned);
        if self.indices.is_empty() {
            return Err(SceneError::NoFaces { files });
        }
        if u32::try_from(self.indices.len()).is_err() {
            return Err(self.too_many("more than 2^32 triangles"));
        }
        if dropped.total() > 0 {
            warnings.say(format!("{files}: {} of {read} triangles have no area and are left out", dropped.total()));
        }
        if turned > 0 {
            warnings.say(format!("{files}: {turned} triangles are wound against their vn; vn tells their front"));
        }
        let lost = self.keep_used_materials();
        let mut bounds = Bounds::EMPTY;
        for p in self.indices.iter().flatten().map(|&v| self.positions[v as usize]) {
            bounds = Bounds { min: bounds.min.min(p), max: bounds.max.max(p) };
        }
        let farthest = bounds.min.abs().max(bounds.max.abs()).max_element();
        let size = bounds.size().max_element();
        if farthest > FAR * size {
            return Err(SceneError::TooFar { files, farthest, size });
        }
        let scene = Scene {
            positions: self.positions,
            indices: self.indices,
            material_ids: self.material_ids,
            materials: self.materials,
            bounds,
            warnings: warnings.into_lines(),
            dropped,
            normals: self.normals,
        };
        if !options.allow_dark && !scene.materials.iter().any(Material::emits) {
            return Err(SceneError::NoLight { files, lost });
        }
        Ok(scene)
    }

    /// Forgets materials all of whose triangles were dropped: a light without area is no light. Says so of lights.
    fn keep_used_materials(&mut self) -> String {
        let mut used = vec![false; self.materials.len()];
        self.material_ids.iter().for_each(|&id| used[usize::from(id)] = true);
        let mut next = 0u16;
        let renumbered: Vec<u16> = used
            .iter()
            .map(|&used| {
                let number = next;
                next = next.saturating_add(u16::from(used));
                number
            })
            .collect();
        self.material_ids.iter_mut().for_each(|id| *id = renumbered[usize::from(*id)]);
        let lost = (self.materials.iter().zip(&used)).find(|(material, used)| material.emits() && !**used);
        let lost = lost.map_or(String::new(), |(light, _)| {
            format!(" (all triangles of material {:?}, which would, have no area)", light.name)
        });
        let mut keep = used.iter();
        self.materials.retain(|_| keep.next() == Some(&true));
        lost
    }

    fn too_many(&self, what: &str) -> SceneError {
        SceneError::TooMany { files: self.files.clone(), what: format!("{what}; split the scene") }
    }
}
