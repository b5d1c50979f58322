//! Scenes that a rule makes rather than a hand: too large to keep, the same bytes whenever they are made.
//!
//! Each is a function of how finely it is cut, and takes its random numbers from a fixed seed. Transcendental functions
//! are those of `libm`, so that the files are the same on every machine.

mod columns;
mod fractal;
mod gap;
mod grid;
mod model;
mod recipe;
mod sphere;
mod sunlit;

pub use model::Model;
pub use recipe::Recipe;

use columns::Columns;
use fractal::Fractal;
use gap::Gap;
use pm_registry::Registry;
use sphere::Sphere;
use sunlit::Sunlit;

/// All scenes that can be made.
#[must_use]
pub fn recipes() -> Registry<dyn Recipe> {
    Registry::new("scene", &[&Fractal, &Columns, &Sphere, &Gap, &Sunlit])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Is there neither less than asked for, nor much more? (Catches a guess that starts above what is needed; some parts
    /// of the hall grow in steps.)
    #[test]
    fn number_of_triangles_is_nearly_what_was_asked() {
        for recipe in recipes().iter() {
            for asked in [20_000, 50_000] {
                let made = recipe.make(asked).triangle_count();
                assert!(made >= asked && made < asked + asked / 3, "{}: {made} for {asked}", recipe.word());
            }
        }
    }
}
