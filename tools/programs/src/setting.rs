//! What `pm-photons` and `pm-queries` share: which scene, and how a stream's header speaks of it.

use crate::cli::{Common, claims, usage};
use pm_formats::vocabulary::meaning;
use pm_formats::{Bounds, Header, MAX_PIXELS, Material};
use pm_light::scene::{Camera, CameraOverrides, FileSystem, LoadOptions, QuadLight, Scene};
use std::path::PathBuf;

/// Which scene.
#[derive(clap::Args, Clone, Debug)]
pub struct SceneArgs {
    /// OBJ files, merged into one scene [default: the built-in Cornell box]
    pub scene: Vec<PathBuf>,
    /// Let glass transmit everything, whatever its Tf says
    #[arg(long)]
    pub clear_glass: bool,
    /// Take Ks and Ns for a glossy lobe; exporters write them on plain paint too
    #[arg(long)]
    pub glossy: bool,
    /// Refuse a scene that names what is not there, such as a material library or a normal
    #[arg(long, hide_short_help = true)]
    pub strict: bool,
    /// Add a parallelogram of light: corner, two edges from it, radiance; it shines towards u x v; may be repeated
    #[arg(long, value_name = "X,Y,Z,UX,UY,UZ,VX,VY,VZ,R,G,B", allow_hyphen_values = true, hide_short_help = true)]
    pub quad_light: Vec<QuadLight>,
    /// Print the scene's materials on standard error
    #[arg(short, long)]
    pub verbose: bool,
}

/// From where it is seen, where that differs from the camera file.
#[derive(clap::Args, Clone, Debug)]
pub struct CameraArgs {
    /// Width and height of the image in pixels
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Where the eye is
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub eye: Option<[f64; 3]>,
    /// The point in the middle of the image
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub look_at: Option<[f64; 3]>,
    /// The direction that is up in the image
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub up: Option<[f64; 3]>,
    /// Vertical field of view in degrees
    #[arg(long, value_name = "DEG")]
    pub vfov: Option<f64>,
}

/// Reads a size such as `512x512`.
///
/// # Errors
/// If it is none.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    parsed.filter(|&[w, h]: &[u32; 2]| w > 0 && h > 0 && u64::from(w) * u64::from(h) <= MAX_PIXELS).ok_or_else(|| {
        match text.parse::<u32>() {
            Ok(side) if side > 0 => format!("width and height are expected, such as {side}x{side}"),
            _ => "a size such as 512x512 is expected, of at most 2^28 pixels".into(),
        }
    })
}

fn vector(text: &str) -> Result<[f64; 3], String> {
    let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let vector = parts.ok().and_then(|parts| <[f64; 3]>::try_from(parts).ok());
    vector
        .filter(|v| v.iter().all(|x| x.is_finite()))
        .ok_or_else(|| "three numbers such as 0,1.5,-2 are expected".into())
}

impl SceneArgs {
    /// Loads the scene and says what there is to say about it.
    ///
    /// # Errors
    /// If it cannot be loaded.
    pub fn load(&self, common: &Common) -> anyhow::Result<Scene> {
        let mut scene = if self.scene.is_empty() {
            Scene::embedded()
        } else {
            let allow_dark = !self.quad_light.is_empty();
            let options =
                LoadOptions { clear_glass: self.clear_glass, glossy: self.glossy, allow_dark, strict: self.strict };
            self.scene.iter().try_for_each(|file| claims::read(file))?;
            Scene::load(&self.scene, &options, &FileSystem)?
        };
        for light in &self.quad_light {
            scene.add_quad_light("--quad-light", light)?;
        }
        scene.warnings.iter().for_each(|warning| common.remark(warning));
        if self.verbose {
            scene.material_table().lines().for_each(|line| common.remark(line));
        }
        Ok(scene)
    }

    /// The camera of the scene: its own, with what the options say instead.
    ///
    /// # Errors
    /// If it cannot be read or makes no sense.
    pub fn camera(&self, scene: &Scene, args: &CameraArgs, common: &Common) -> anyhow::Result<Camera> {
        let overrides =
            CameraOverrides { eye: args.eye, look_at: args.look_at, up: args.up, vfov: args.vfov, size: args.size };
        let choice = if self.scene.is_empty() {
            Camera::embedded(&overrides)?
        } else {
            Camera::find(&self.scene, scene, &overrides, &FileSystem)?
        };
        choice.warnings.iter().for_each(|warning| common.remark(warning));
        if choice.camera.sees_only_backs(scene) {
            common.remark("the camera sees only the backs of surfaces: a black picture means that it is inside a wall");
        }
        if choice.fitted || self.verbose {
            common.remark(&choice.note);
        }
        let [width, height] = choice.camera.size();
        if u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(usage(format!("{width}x{height} pixels are more than 2^28")));
        }
        Ok(choice.camera)
    }
}

/// A header that speaks of this scene.
#[must_use]
pub fn header(scene: &Scene) -> Header {
    let material = |material: &pm_light::scene::Material| {
        let glossy = material.kind == pm_light::scene::MaterialKind::Glossy;
        Material {
            name: material.name.clone(),
            diffuse: material.diffuse,
            specular: if glossy { material.specular } else { [0.0; 3] },
            exponent: if glossy { material.exponent } else { 0.0 },
        }
    };
    let mut header = Header {
        bounds: Bounds { min: scene.bounds.min.into(), max: scene.bounds.max.into() },
        materials: scene.materials.iter().map(material).collect(),
        ..Header::empty()
    };
    header.set_meaning(meaning::SCENE, scene.digest());
    header
}
