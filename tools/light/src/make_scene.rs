//! Scenes that a rule makes rather than a hand: too large to keep, the same bytes whenever they are made.
//!
//! Each is a function of how finely it is cut, and takes its random numbers from a fixed seed. Transcendental functions
//! are those of `libm`, so that the files are the same on every machine.

mod columns;
mod fractal;
mod grid;
mod model;
mod sphere;

pub use model::Model;

/// A scene that can be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Recipe {
    /// The Cornell box with both spheres; its walls are fractal surfaces.
    Fractal,
    /// A hall with columns, arches, a vault, windows, and a floor that reflects.
    Columns,
    /// An integrating sphere, whose irradiance is known.
    Sphere,
}

impl Recipe {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Fractal, Self::Columns, Self::Sphere];

    /// Its name, which is that of its files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fractal => "fractal",
            Self::Columns => "columns",
            Self::Sphere => "sphere",
        }
    }

    /// Triangles it has unless others are asked for, at least.
    #[must_use]
    pub const fn usual_triangles(self) -> usize {
        match self {
            Self::Fractal => 200_000,
            Self::Columns => 60_000,
            Self::Sphere => 20_000,
        }
    }

    /// Makes the scene of at least `triangles` triangles, as coarse as that allows.
    #[must_use]
    pub fn make(self, triangles: usize) -> Model {
        let build = match self {
            Self::Fractal => fractal::build,
            Self::Columns => columns::build,
            Self::Sphere => sphere::build,
        };
        // Triangles grow as the square of the fineness; start below what is needed, and go up by single steps.
        const PROBE: u32 = 16;
        let probe = build(PROBE).triangle_count() as f64;
        let guess = f64::from(PROBE) * (triangles as f64 / probe).sqrt() * 0.97;
        let mut fineness = (guess as u32).max(1);
        loop {
            let model = build(fineness);
            if model.triangle_count() >= triangles {
                return model;
            }
            fineness += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Is there neither less than asked for, nor much more? (Catches a guess that starts above what is needed; some parts
    /// of the hall grow in steps.)
    #[test]
    fn number_of_triangles_is_nearly_what_was_asked() {
        for recipe in Recipe::ALL {
            for asked in [20_000, 50_000] {
                let made = recipe.make(asked).triangle_count();
                assert!(made >= asked && made < asked + asked / 3, "{}: {made} for {asked}", recipe.name());
            }
        }
    }
}
