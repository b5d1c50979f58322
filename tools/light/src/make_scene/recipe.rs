//! What a scene is that can be made.

use super::model::Model;
use pm_registry::{Domain, Parameter, Registered};

/// A scene that can be made; its word is the name of its files.
pub trait Recipe: Registered + Sync {
    /// Makes the scene, cut the finer the larger `fineness` is: triangles grow as its square, roughly.
    fn build(&self, fineness: u32) -> Model;
}

/// How many triangles a scene has at least, an option of every recipe, with how many it has unless others are asked for.
pub(super) const fn at_least(usual: &'static str) -> Parameter {
    Parameter::new("triangles", Domain::count(1000, 20_000_000), "triangles to make at least").or(usual)
}

impl dyn Recipe {
    /// Makes the scene of at least `triangles` triangles, as coarse as that allows.
    #[must_use]
    pub fn make(&self, triangles: usize) -> Model {
        // Triangles grow as the square of the fineness; start below what is needed, and go up by single steps.
        const PROBE: u32 = 16;
        let probe = self.build(PROBE).triangle_count() as f64;
        let guess = f64::from(PROBE) * (triangles as f64 / probe).sqrt() * 0.97;
        let mut fineness = (guess as u32).max(1);
        loop {
            let model = self.build(fineness);
            if model.triangle_count() >= triangles {
                return model;
            }
            fineness += 1;
        }
    }
}
