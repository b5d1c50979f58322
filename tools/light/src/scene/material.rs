//! What a surface does with light, decided from what an MTL file says.
//!
//! Exporters write far more than they mean: Blender gives every paint `Ks 0.5`, Maya every material `illum 4`, 3ds Max
//! and Blender every material `Ni` 1.5. So the kind hangs on combinations, and no surface reflects more than it gets.

use super::LoadOptions;
use super::error::Place;
use super::texture::Texture;
use super::warnings::Warnings;

/// Radiance above which a light is thought to be a slip.
const BRIGHTEST: f32 = 1e6;
/// Metals of less roughness (`Pr`) are mirrors.
const SMOOTH: f32 = 0.05;
/// What stands in for a colour that is not known.
const GREY: [f32; 3] = [0.5; 3];

/// How a surface scatters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MaterialKind {
    /// Lambert: `diffuse` only.
    Diffuse,
    /// Perfect reflection by `specular`, and `diffuse` for the rest.
    Mirror,
    /// Smooth dielectric: Fresnel reflection and refraction by `ior`, the refracted part times `transmittance`.
    Glass,
    /// Normalised Phong lobe of `specular` and `exponent` around the mirror direction, and `diffuse`.
    Glossy,
}

impl MaterialKind {
    /// The kind in a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse",
            Self::Mirror => "mirror",
            Self::Glass => "glass",
            Self::Glossy => "glossy",
        }
    }
}

/// A surface. Colours are linear red, green, blue; `diffuse + specular` is at most 1 in each channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name in the MTL file.
    pub name: String,
    /// How it scatters.
    pub kind: MaterialKind,
    /// Diffuse reflectance (albedo, 0 to 1).
    pub diffuse: [f32; 3],
    /// Specular reflectance (0 to 1) of a mirror or a glossy lobe; 1 for glass, to be multiplied by Fresnel's; else 0.
    pub specular: [f32; 3],
    /// Phong exponent of a glossy lobe; 0 otherwise.
    pub exponent: f32,
    /// Emitted radiance, W/(m² sr), from the front side; 0 if it is no light.
    pub emission: [f32; 3],
    /// Index of refraction of glass; 1 otherwise.
    pub ior: f32,
    /// Share of the refracted light that passes one surface of glass (0 to 1); 0 otherwise.
    pub transmittance: [f32; 3],
}

impl Material {
    /// A Lambertian surface of the given reflectance.
    pub fn lambert(name: &str, diffuse: [f32; 3]) -> Self {
        Self {
            name: name.to_owned(),
            kind: MaterialKind::Diffuse,
            diffuse,
            specular: [0.0; 3],
            exponent: 0.0,
            emission: [0.0; 3],
            ior: 1.0,
            transmittance: [0.0; 3],
        }
    }

    /// The grey of faces whose material is not known.
    pub(crate) fn unknown() -> Self {
        Self::lambert("(no material)", GREY)
    }

    /// Whether it is a light.
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&x| x > 0.0)
    }

    /// Decides what an MTL material is; the first fitting case counts.
    /// `texture` is the mean colour of its `map_Kd`, or why there is none.
    pub(crate) fn decide(
        mtl: &tobj::Material,
        options: &LoadOptions,
        texture: Option<Texture>,
        place: &Place,
        warnings: &mut Warnings,
    ) -> Self {
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
        if remark.limit(&mut out.diffuse, &mut out.specular) {
            remark.say("reflects more light than it gets: Kd and Ks are scaled to 1");
        }
        out
    }
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
    place: &'a Place,
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scene::mtl;

    /// What a material of these statements becomes, and what is said about it.
    fn decide_with(options: &LoadOptions, text: &str) -> (Material, Vec<String>) {
        let mut warnings = Warnings::default();
        let clean = mtl::clean(Path::new("m.mtl"), format!("newmtl m\n{text}").as_bytes(), &mut warnings).unwrap();
        let (materials, _) = tobj::load_mtl_buf(&mut clean.text.as_bytes()).unwrap();
        let texture = materials[0].diffuse_texture.as_ref().map(|_| Err("no file".to_owned()));
        let material = Material::decide(&materials[0], options, texture, &clean.places["m"], &mut warnings);
        (material, warnings.into_lines())
    }

    fn decide(text: &str) -> (Material, Vec<String>) {
        decide_with(&LoadOptions::default(), text)
    }

    fn kind(text: &str) -> MaterialKind {
        decide(text).0.kind
    }

    /// Is a material with `Ke` a light that reflects by `Kd`, whatever else it says?
    #[test]
    fn ke_makes_a_light() {
        let (m, said) = decide("Kd .5 .5 .5\nKe 18 14 7\nillum 7\nNi 1.5");
        assert_eq!((m.kind, m.emission, m.diffuse), (MaterialKind::Diffuse, [18.0, 14.0, 7.0], [0.5; 3]));
        assert!(said.is_empty());
        assert_eq!(decide("Ke 1").0.diffuse, [0.0; 3]);
        let (m, said) = decide("Ke 2e6\nKd 2 1 0");
        assert_eq!((m.emission, m.diffuse), ([2e6; 3], [1.0, 0.5, 0.0]));
        assert_eq!(said.len(), 2);
        assert!(!decide("Kd 1\nKe 0 0 0").0.emits());
    }

    /// Is glass what refracts *and* is see-through, and nothing less?
    #[test]
    fn glass_needs_an_index_and_transparency() {
        for glass in [
            "illum 7\nNi 1.5",
            "illum 6\nNi 1.33",
            "illum 4\nNi 1.5\nd 0.2",
            "illum 9\nNi 1.5\nTr 0.8",
            "illum 4\nNi 1.5\nTf .9",
        ] {
            assert_eq!(kind(&format!("Kd 0.1\n{glass}")), MaterialKind::Glass, "{glass}");
        }
        // Maya's plain paint; Blender's and 3ds Max's; Maya's with an index; no refraction; no index.
        for paint in [
            "illum 4\nNi 1.00\nTf 1 1 1",
            "illum 2\nNi 1.45\nd 1",
            "illum 4\nNi 1.5\nTf 1 1 1",
            "illum 7\nNi 1",
            "illum 7",
        ] {
            assert_eq!(kind(&format!("Kd 0.1\n{paint}")), MaterialKind::Diffuse, "{paint}");
        }
        let (m, _) = decide("illum 7\nNi 1.5\nKs .3\nKd .2");
        assert_eq!((m.ior, m.transmittance, m.specular, m.diffuse), (1.5, [1.0; 3], [1.0; 3], [0.0; 3]));
    }

    /// Is a dark filter obeyed and named, and set aside by the clear-glass option?
    #[test]
    fn dark_glass_is_obeyed_and_said() {
        let mcguire = "illum 7\nNi 2.5\nKs 0.3 0.3 0.3\nTf 0.1 0.1 0.1";
        let (m, said) = decide(mcguire);
        assert_eq!(m.transmittance, [0.1; 3]);
        assert!(said[0].contains("transmits only 10 %"), "{said:?}");
        let (m, said) = decide_with(&LoadOptions { clear_glass: true, ..Default::default() }, mcguire);
        assert_eq!((m.transmittance, said.len()), ([1.0; 3], 0));
        assert_eq!(decide("illum 7\nNi 1.5\nTf 2 1 1").0.transmittance, [1.0, 0.5, 0.5]);
    }

    /// Is transparency without refraction opaque, with a word about it?
    #[test]
    fn thin_transparency_is_opaque_with_a_warning() {
        for thin in ["d 0.3", "Tr 0.7", "illum 7\nd 0.3\nNi 1", "illum 2\nNi 1.5\nd 0.3"] {
            let (m, said) = decide(&format!("Kd 0.1\n{thin}"));
            assert_eq!(m.kind, MaterialKind::Diffuse, "{thin}");
            assert!(said.len() == 1 && said[0].contains("opaque"), "{thin}: {said:?}");
        }
        assert!(decide("Kd 0.1\nd 1\nTr 1").1.is_empty(), "d wins over Tr");
    }

    /// Does a mirror reflect `Ks`, keep `Kd` as a rest that fits, and drop one that does not?
    #[test]
    fn mirror_reflects_ks_and_what_fits_of_kd() {
        let (m, said) = decide("illum 5\nKd 0.01\nKs 0.95\nNi 1.5");
        assert_eq!((m.kind, m.specular, m.diffuse), (MaterialKind::Mirror, [0.95; 3], [0.01; 3]));
        assert!(said.is_empty());
        let (m, said) = decide("illum 3\nKd 0.4\nKs 0.8");
        assert_eq!((m.kind, m.specular, m.diffuse, said.len()), (MaterialKind::Mirror, [0.8; 3], [0.0; 3], 1));
        assert_eq!(kind("illum 3\nKd 0.4\nKs 0"), MaterialKind::Diffuse);
    }

    /// Is Blender's metal tinted by `Kd`?
    #[test]
    fn blender_metal_is_tinted_by_kd() {
        let (m, said) = decide("Kd 0.9 0.7 0.3\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 1\nillum 3");
        assert_eq!((m.kind, m.specular, m.diffuse), (MaterialKind::Mirror, [0.9, 0.7, 0.3], [0.0; 3]));
        assert!(said.is_empty());
    }

    /// Do `Pm` and `Pr` make mirrors and rough metals, and half-metals paint?
    #[test]
    fn metallic_exports() {
        let (m, _) = decide("Kd 0.9 0.7 0.3\nPm 1\nPr 0.01\nillum 3\nKs 0.5");
        assert_eq!((m.kind, m.specular, m.diffuse), (MaterialKind::Mirror, [0.9, 0.7, 0.3], [0.0; 3]));
        let (m, _) = decide("Kd 0.9\nPm 1\nPr 0.5");
        assert_eq!((m.kind, m.exponent), (MaterialKind::Glossy, 30.0));
        assert_eq!(kind("Kd 0.9\nPm 0.5\nPr 0.5\nillum 3\nKs .5"), MaterialKind::Diffuse);
    }

    /// Is Blender's default paint Lambert by default, and within 100 % with the glossy option?
    #[test]
    fn highlights_only_on_request_and_never_above_one() {
        let blender = "Kd 0.8 0.4 0.2\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 1\nillum 2";
        let (m, said) = decide(blender);
        assert_eq!((m.kind, m.diffuse, m.specular, said.len()), (MaterialKind::Diffuse, [0.8, 0.4, 0.2], [0.0; 3], 0));
        let glossy = LoadOptions { glossy: true, ..Default::default() };
        let (m, said) = decide_with(&glossy, blender);
        assert_eq!((m.kind, m.exponent, said.len()), (MaterialKind::Glossy, 250.0, 1));
        assert!((0..3).all(|c| m.diffuse[c] + m.specular[c] <= 1.0));
        assert!((m.diffuse[0] + m.specular[0] - 1.0).abs() < 1e-6 && (m.diffuse[0] / m.diffuse[1] - 2.0).abs() < 1e-6);
        assert_eq!(decide_with(&glossy, "Kd .5\nKs .5\nNs 9\nillum 1").0.kind, MaterialKind::Diffuse);
    }

    /// Does a texture fall back on `Kd`, and on grey where Maya wrote 0?
    #[test]
    fn textures_fall_back_on_kd_or_grey() {
        let (m, said) = decide("Kd .2 .3 .4\nmap_Kd -s 1 1 1 c:\\a b.png");
        assert_eq!((m.diffuse, said.len()), ([0.2, 0.3, 0.4], 1));
        assert!(said[0].contains("Kd alone counts"));
        let (m, said) = decide("Kd 0 0 0\nmap_Kd a.png");
        assert_eq!((m.diffuse, said.len()), (GREY, 1));
        assert_eq!(decide("Kd 0 0 0").0.diffuse, [0.0; 3]);
        assert_eq!(decide("Ni 1").0.diffuse, GREY);
    }

    /// Can paint reflect more than it gets?
    #[test]
    fn bright_paint_is_scaled() {
        let (m, said) = decide("Kd 2 1 0.5");
        assert_eq!((m.diffuse, said.len()), ([1.0, 0.5, 0.25], 1));
    }
}
