//! A scene in the making: what OBJ files hold is merged, and made fit for light.

use super::bounds::Bounds;
use super::error::{FileLine, SceneError};
use super::files::Files;
use super::material::Material;
use super::meaning::decide;
use super::mesh::{self, Dropped, Shape};
use super::obj::ParsedObj;
use super::options::LoadOptions;
use super::polygon::{Cut, cut};
use super::texture::{self, Texture};
use super::triangles::Scene;
use super::warnings::Warnings;
use glam::Vec3;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Distance from the origin in sizes of the scene from which single precision is too coarse for the light to be right: at
/// 1e5 the map of a closed furnace is a third too bright, at 1e3 within a per cent.
const FAR: f32 = 1e4;

/// A scene in the making.
#[derive(Default)]
pub(super) struct Builder {
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
    /// Statements that look as if they made a light, and are not read.
    passed_over: Vec<String>,
}

impl Builder {
    /// Nothing yet, of files of these names.
    pub(super) fn new(files: String) -> Self {
        Self { files, ..Self::default() }
    }

    /// Adds what an OBJ file holds.
    pub(super) fn add(
        &mut self,
        path: &Path,
        obj: &ParsedObj,
        options: &LoadOptions,
        files: &dyn Files,
        warnings: &mut Warnings,
    ) -> Result<(), SceneError> {
        self.passed_over.extend(obj.passed_over.iter().cloned());
        let mut numbers: HashMap<Option<usize>, u16> = HashMap::new();
        let mut lines = obj.face_lines.iter();
        for model in obj.models.iter().filter(|model| !model.mesh.indices.is_empty()) {
            let id = model.mesh.material_id;
            let number = match numbers.get(&id) {
                Some(&number) => number,
                None => {
                    let number = self.material(path, obj, id, options, files, warnings)?;
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
        files: &dyn Files,
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
                    .map(|statement| texture::mean_colour(&place.file, statement, files, &mut self.textures, warnings));
                decide(mtl, options, texture, place, warnings)
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
            let points: Vec<Vec3> = corners.iter().map(|&v| self.positions[v as usize]).collect();
            let Cut { triangles, is_whole } = cut(&points);
            if !is_whole {
                let at_line = FileLine::new(path, line);
                warnings.once("crossing", || {
                    format!("{at_line}: the outline of a polygon crosses itself: it is cut as well as can be")
                });
            }
            triangles.into_iter().for_each(|ends| self.triangle(ends.map(|i| corners[i]), material));
        }
        Ok(())
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

    /// The scene, if there is one and it can be lit.
    pub(super) fn finish(mut self, options: &LoadOptions, mut warnings: Warnings) -> Result<Scene, SceneError> {
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
        let mut lost = self.keep_used_materials();
        self.passed_over.extend(warnings.under("mtllib ").map(str::to_owned));
        if lost.is_empty() && !self.passed_over.is_empty() {
            lost = format!(" (passed over: {})", self.passed_over.join("; "));
        }
        let bounds = Bounds::around(self.indices.iter().flatten().map(|&v| self.positions[v as usize]));
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
