//! The materials of a scene as a table for people.

use super::material::{Material, MaterialKind};
use super::triangles::Scene;

impl Scene {
    /// A line per material, in aligned columns: name, what it is, what share of light it reflects (diffuse + specular;
    /// for glass, what it transmits and its index), what it emits in W/(m² sr), its triangles, and their area in m².
    /// It answers most questions about a scene that looks wrong.
    pub fn material_table(&self) -> String {
        let mut uses = vec![(0usize, 0.0f64); self.materials.len()];
        for i in 0..self.triangle_count() {
            let (triangles, area) = &mut uses[usize::from(self.material_ids[i])];
            *triangles += 1;
            *area += self.area(i);
        }
        let heading = ["material", "kind", "reflects", "emits", "triangles", "area"].map(String::from);
        let rows = self.materials.iter().zip(uses).map(|(material, (triangles, area))| {
            let emits = if material.emits() { colour(material.emission) } else { "-".into() };
            [material.name.clone(), kind(material), reflects(material), emits, triangles.to_string(), metres(area)]
        });
        let rows: Vec<[String; 6]> = std::iter::once(heading).chain(rows).collect();
        let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
        let widths: [usize; 6] = std::array::from_fn(width);
        let mut out = String::new();
        for row in &rows {
            let cells = row.iter().zip(widths).enumerate().map(|(column, (cell, width))| match column {
                4.. => format!("{cell:>width$}"), // numbers
                _ => format!("{cell:width$}"),
            });
            out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
            out.push('\n');
        }
        out
    }
}

fn kind(material: &Material) -> String {
    match material.kind {
        MaterialKind::Diffuse if material.emits() => "light".into(),
        MaterialKind::Glass => format!("glass {}", material.ior),
        MaterialKind::Glossy => format!("glossy {}", material.exponent),
        kind => kind.word().into(),
    }
}

fn reflects(material: &Material) -> String {
    match material.kind {
        MaterialKind::Diffuse => colour(material.diffuse),
        MaterialKind::Glass => format!("transmits {}", colour(material.transmittance)),
        MaterialKind::Mirror | MaterialKind::Glossy if material.diffuse == [0.0; 3] => colour(material.specular),
        MaterialKind::Mirror | MaterialKind::Glossy => {
            format!("{} + {}", colour(material.diffuse), colour(material.specular))
        }
    }
}

/// Plain where that shows four digits, else with an exponent.
fn metres(area: f64) -> String {
    if area == 0.0 || (1e-1..1e7).contains(&area) { format!("{area:.4}") } else { format!("{area:.3e}") }
}

/// One number for grey, three for a colour.
fn colour([r, g, b]: [f32; 3]) -> String {
    if r == g && g == b { r.to_string() } else { format!("{r} {g} {b}") }
}
