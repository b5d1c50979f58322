//! What an MTL file means: which kind of surface its statements make together.
//!
//! Exporters write far more than they mean: Blender gives every paint `Ks 0.5`, Maya every material `illum 4`, 3ds Max
//! and Blender every material `Ni` 1.5. So the kind hangs on combinations, and no surface reflects more than it gets.

use super::error::FileLine;
use super::material::{GREY, Material, MaterialKind};
use super::options::LoadOptions;
use super::texture::Texture;
use super::warnings::Warnings;

#[cfg(test)]
mod tests;

/// Radiance above which a light is thought to be a slip.
const BRIGHTEST: f32 = 1e6;
/// Metals of less roughness (`Pr`) are mirrors.
const SMOOTH: f32 = 0.05;

/// Decides what an MTL material is; the first fitting case counts.
/// `texture` is the mean colour of its `map_Kd`, or why there is none.
pub(super) fn decide(
    mtl: &tobj::Material,
    options: &LoadOptions,
    texture: Option<Texture>,
    place: &FileLine,
    warnings: &mut Warnings,
) -> Material {
    let mut said = Said::new(mtl);
    let mut remark = Remark { place, name: &mtl.name, warnings };
    match texture {
        Some(Ok(mean)) => {
            // The MTL text multiplies the texture by Kd; Maya writes Kd 0 beside one.
            let factor = said.diffuse.filter(|&kd| max(kd) > 0.0).unwrap_or([1.0; 3]);
            said.diffuse = Some(std::array::from_fn(|c| factor[c] * mean[c]));
            remark.once("map_Kd mean", "has a texture, of which only the mean colour is taken");
        }
        Some(Err(why)) => said.unreadable = Some(why),
        None => {}
    }
    let mut out = said.kind(mtl, options, &mut remark);
    said.lost_glass(&out, &mut remark);
    if remark.limit(&mut out.diffuse, &mut out.specular) {
        remark.say("reflects more light than it gets: Kd and Ks are scaled to 1");
    }
    out
}

/// The MTL statements the decision hangs on, absent ones by their defaults.
struct Said {
    diffuse: Option<[f32; 3]>,
    specular: [f32; 3],
    emission: [f32; 3],
    exponent: f32,
    opacity: f32,
    ior: f32,
    filter: Option<[f32; 3]>,
    illum: Option<u8>,
    metallic: Option<f32>,
    roughness: f32,
    /// Why the texture it has cannot be averaged.
    unreadable: Option<String>,
}

impl Said {
    fn new(mtl: &tobj::Material) -> Self {
        let scalar = |key: &str| mtl.unknown_param.get(key).and_then(|text| text.parse::<f32>().ok());
        let colour = |key: &str| {
            let numbers: Vec<f32> = mtl.unknown_param.get(key)?.split_whitespace().flat_map(str::parse).collect();
            <[f32; 3]>::try_from(numbers).ok()
        };
        Self {
            diffuse: mtl.diffuse,
            specular: mtl.specular.unwrap_or_default(),
            emission: mtl.emissive.unwrap_or_default(),
            exponent: mtl.shininess.unwrap_or(0.0),
            // Where both are given they say the same; some writers get `Tr` the wrong way round, so `d` wins.
            opacity: mtl.dissolve.or(scalar("Tr").map(|tr| 1.0 - tr)).unwrap_or(1.0),
            ior: mtl.optical_density.unwrap_or(1.0),
            filter: colour("Tf"),
            illum: mtl.illumination_model,
            metallic: scalar("Pm"),
            roughness: scalar("Pr").unwrap_or(0.0),
            unreadable: None,
        }
    }

    fn kind(&self, mtl: &tobj::Material, options: &LoadOptions, remark: &mut Remark<'_>) -> Material {
        let dark = Material::lambert(&mtl.name, [0.0; 3]);
        if max(self.emission) > 0.0 {
            if max(self.emission) > BRIGHTEST {
                remark.say("emits more than 1e6 W/(m2 sr): is Ke meant so?");
            }
            if max(self.specular) > 0.0 && !matches!(self.illum, Some(0 | 1)) {
                remark.once("light Ks", "emits: what it mirrors by Ks is left out");
            }
            if self.diffuse.is_none() {
                remark.once("light Kd", "emits and has no Kd: it reflects nothing");
            }
            return Material { diffuse: self.diffuse.unwrap_or_default(), emission: self.emission, ..dark };
        }
        if let Some(transmittance) = self.glass(options, remark) {
            return Material { kind: MaterialKind::Glass, specular: [1.0; 3], ior: self.ior, transmittance, ..dark };
        }
        if self.opacity < 1.0 {
            remark.say("is taken as opaque although d < 1 or Tr > 0; illum 7 with Ni above 1 makes glass");
        }
        if let (Some(3 | 5), None) = (self.illum, self.metallic) {
            if max(self.specular) > 0.0 {
                return self.mirror(dark, remark);
            }
            remark.say("is no mirror although illum says so: Ks is 0 or missing");
        }
        let diffuse = self.diffuse(remark);
        if self.metallic.is_some_and(|pm| pm > 0.5) {
            if self.roughness < SMOOTH {
                return Material { kind: MaterialKind::Mirror, specular: diffuse, ..dark };
            }
            // Phong's exponent for Beckmann's alpha = roughness squared (Walter et al. 2007).
            let alpha = self.roughness.min(1.0) * self.roughness.min(1.0);
            let exponent = (2.0 / (alpha * alpha) - 2.0).max(1.0);
            return Material { kind: MaterialKind::Glossy, specular: diffuse, exponent, ..dark };
        }
        // illum 0 and 1 say "no highlight".
        let highlight = !matches!(self.illum, Some(0 | 1)) && max(self.specular) > 0.0 && self.exponent > 0.0;
        if options.glossy && highlight {
            let (specular, exponent) = (self.specular, self.exponent);
            return Material { kind: MaterialKind::Glossy, diffuse, specular, exponent, ..dark };
        }
        Material { diffuse, ..dark }
    }

    /// The transmittance, if this is glass.
    fn glass(&self, options: &LoadOptions, remark: &mut Remark<'_>) -> Option<[f32; 3]> {
        let refracts = self.ior > 1.01 && matches!(self.illum, Some(4 | 6 | 7 | 9));
        let filters = self.filter.is_some_and(|tf| tf.iter().any(|&x| x < 1.0));
        if !(refracts && (matches!(self.illum, Some(6 | 7)) || self.opacity < 1.0 || filters)) {
            return None;
        }
        let mut tint = if options.clear_glass { [1.0; 3] } else { self.filter.unwrap_or([1.0; 3]) };
        if remark.limit(&mut tint, &mut [0.0; 3]) {
            remark.say("lets through more light than it gets: Tf is scaled to 1");
        }
        if max(tint) < 0.5 {
            remark.say(&format!(
                "transmits only {} % at each surface (Tf); the clear-glass option makes it 100",
                max(tint) * 100.0
            ));
        }
        Some(tint)
    }

    /// Says what looks like glass that an exporter made something else of.
    fn lost_glass(&self, out: &Material, remark: &mut Remark<'_>) {
        if self.ior <= 1.01 || out.kind == MaterialKind::Glass || out.emits() {
            return;
        }
        let filters = self.filter.is_some_and(|tf| tf.iter().any(|&x| x < 1.0));
        let is_black = out.kind != MaterialKind::Mirror && max(out.diffuse) <= 0.0;
        let sign = if filters {
            "Tf below 1"
        } else if is_black {
            "a black Kd"
        } else {
            return;
        };
        let (ior, kind) = (self.ior, out.kind.word());
        remark.say(&format!("has Ni {ior} and {sign} like glass, but is {kind}: illum 7 makes glass of it"));
    }

    fn mirror(&self, dark: Material, remark: &mut Remark<'_>) -> Material {
        let mirror = Material { kind: MaterialKind::Mirror, ..dark };
        let diffuse = self.diffuse.unwrap_or_default();
        let specular = self.specular;
        // Blender's metal: its tint is in Kd, and Ks is the untouched default.
        if self.illum == Some(3) && specular == GREY && max(diffuse) > 0.5 {
            return Material { specular: diffuse, ..mirror };
        }
        if (0..3).all(|c| diffuse[c] + specular[c] <= 1.0) {
            return Material { diffuse, specular, ..mirror };
        }
        remark.say("is a mirror with Kd + Ks above 1; Kd is ignored");
        Material { specular, ..mirror }
    }

    /// The diffuse colour, where textures and missing statements make it a guess.
    fn diffuse(&self, remark: &mut Remark<'_>) -> [f32; 3] {
        match (self.diffuse, &self.unreadable) {
            // Maya writes Kd 0 beside a texture.
            (Some([0.0, 0.0, 0.0]) | None, Some(why)) => {
                let what = format!("has a texture that is ignored ({why}), and no Kd: grey 0.5 takes its place");
                remark.once("map_Kd black", &what);
                GREY
            }
            (Some(diffuse), Some(why)) => {
                remark.once("map_Kd", &format!("has a texture that is ignored ({why}): Kd alone counts"));
                diffuse
            }
            (Some(diffuse), None) => diffuse,
            (None, None) => {
                remark.once("no Kd", "has no Kd: grey 0.5 takes its place");
                GREY
            }
        }
    }
}

/// Says things about one material.
struct Remark<'a> {
    place: &'a FileLine,
    name: &'a str,
    warnings: &'a mut Warnings,
}

impl Remark<'_> {
    fn say(&mut self, what: &str) {
        self.warnings.say(format!("{}: material {:?} {what}", self.place, self.name));
    }

    fn once(&mut self, key: &str, what: &str) {
        self.warnings.once(key, || format!("{}: material {:?} {what}", self.place, self.name));
    }

    /// Scales two colours by one factor so that no channel of their sum exceeds 1; true if it was needed.
    fn limit(&self, a: &mut [f32; 3], b: &mut [f32; 3]) -> bool {
        let most = max([a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
        if most <= 1.0 {
            return false;
        }
        for c in 0..3 {
            a[c] = (a[c] / most).min(1.0);
            b[c] = (b[c] / most).min(1.0 - a[c]);
        }
        true
    }
}

fn max(rgb: [f32; 3]) -> f32 {
    rgb[0].max(rgb[1]).max(rgb[2])
}
