//! Triangles in the making, and the texts of OBJ, MTL and camera file that they become.

use glam::{DVec3, Vec3};
use std::fmt::Write as _;

/// A scene in the making: faces in groups, each of one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Lines about the scene, without the `#`, for the heads of its files.
    pub about: Vec<String>,
    /// The MTL file without its head.
    pub materials: String,
    /// The camera file without its head.
    pub camera: String,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    groups: Vec<Group>,
}

/// Faces of one material.
#[derive(Debug, Clone, PartialEq)]
struct Group {
    name: String,
    material: &'static str,
    faces: Vec<Face>,
}

/// Three corners, counter-clockwise from the front, and their normals if the surface is smooth.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Face {
    corners: [u32; 3],
    normals: Option<[u32; 3]>,
}

impl Model {
    /// A scene without faces.
    pub(super) fn new(materials: &str, camera: &str) -> Self {
        Self {
            about: vec![],
            materials: materials.into(),
            camera: camera.into(),
            positions: vec![],
            normals: vec![],
            groups: vec![],
        }
    }

    /// Begins a group: faces are of this material until the next.
    pub(super) fn group(&mut self, name: &str, material: &'static str) {
        self.groups.push(Group { name: name.into(), material, faces: vec![] });
    }

    /// Adds a point and gives its number.
    pub(super) fn point(&mut self, p: DVec3) -> u32 {
        self.positions.push(p.as_vec3() + Vec3::ZERO); // no -0, which would be written as such
        self.positions.len() as u32 - 1
    }

    /// Adds a unit normal and gives its number.
    pub(super) fn normal(&mut self, n: DVec3) -> u32 {
        self.normals.push(n.normalize().as_vec3() + Vec3::ZERO);
        self.normals.len() as u32 - 1
    }

    /// Adds a flat triangle by the numbers of its corners; one with two corners in the same place is left out.
    pub(super) fn triangle(&mut self, corners: [u32; 3]) {
        self.push(Face { corners, normals: None });
    }

    /// Adds a triangle that is shaded smoothly.
    pub(super) fn smooth_triangle(&mut self, corners: [u32; 3], normals: [u32; 3]) {
        self.push(Face { corners, normals: Some(normals) });
    }

    /// Adds a flat quadrangle.
    pub(super) fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangle([a, b, c]);
        self.triangle([a, c, d]);
    }

    fn push(&mut self, face: Face) {
        let [a, b, c] = face.corners.map(|i| self.positions[i as usize]);
        if a != b && b != c && c != a {
            self.groups.last_mut().expect("a group is begun before its faces").faces.push(face);
        }
    }

    /// How many triangles there are.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.groups.iter().map(|group| group.faces.len()).sum()
    }

    /// Sum of the areas of all triangles of a material, or of all, m².
    #[must_use]
    pub fn area(&self, material: Option<&str>) -> f64 {
        let groups = self.groups.iter().filter(|group| material.is_none_or(|wanted| wanted == group.material));
        let area = |face: &Face| {
            let [a, b, c] = face.corners.map(|i| self.positions[i as usize].as_dvec3());
            (b - a).cross(c - a).length() / 2.0
        };
        groups.flat_map(|group| &group.faces).map(area).sum()
    }

    /// The OBJ file of a scene of this name.
    #[must_use]
    pub fn obj(&self, name: &str) -> String {
        let mut text = self.head(name);
        let _ = writeln!(text, "mtllib {name}.mtl");
        for p in &self.positions {
            let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
        }
        for n in &self.normals {
            let _ = writeln!(text, "vn {} {} {}", n.x, n.y, n.z);
        }
        for group in &self.groups {
            let _ = write!(text, "o {}\nusemtl {}\n", group.name, group.material);
            for Face { corners, normals } in &group.faces {
                let [a, b, c] = corners.map(|i| i + 1);
                let _ = match normals.map(|normals| normals.map(|i| i + 1)) {
                    Some([na, nb, nc]) => writeln!(text, "f {a}//{na} {b}//{nb} {c}//{nc}"),
                    None => writeln!(text, "f {a} {b} {c}"),
                };
            }
        }
        text
    }

    /// The MTL file of a scene of this name.
    #[must_use]
    pub fn mtl(&self, name: &str) -> String {
        self.head(name) + "\n" + &self.materials
    }

    /// The camera file of a scene of this name.
    #[must_use]
    pub fn camera(&self, name: &str) -> String {
        self.head(name) + &self.camera
    }

    fn head(&self, name: &str) -> String {
        let mut head = format!("# {name}, {} triangles. Made by pm-scene; do not edit.\n", self.triangle_count());
        for line in &self.about {
            let _ = writeln!(head, "# {line}");
        }
        head
    }
}
