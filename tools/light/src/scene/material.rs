//! What a surface does with light.

/// What stands in for a colour that is not known.
pub(super) const GREY: [f32; 3] = [0.5; 3];

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
}
