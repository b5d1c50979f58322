//! What is chosen among: the numbers of a picture's recipe.

/// The numbers of a recipe, as `pm-picture` takes them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Recipe {
    /// Eye rays for each pixel.
    pub samples: u32,
    /// Gather rays for each point seen.
    pub gathers: u32,
    /// Shadow rays for each point seen.
    pub light_samples: u32,
    /// Photons of the map that gather rays ask.
    pub photons: u64,
    /// Nearest photons that a gather ray asks for.
    pub k: u32,
    /// Photons of the map of caustics; 0: there is none.
    pub caustics: u64,
}

/// Eye rays of a pixel that ask for caustics at most: their map is what blurs them then.
pub const MOST_SEEN: u32 = 16;
/// Nearest photons of caustics that a point seen asks for.
pub const CAUSTICS_K: u32 = 50;
/// Photons of the paper's map (section 4), and how many of them a search is for: of the numbers that are measured the one next to
/// its 100.
pub const PAPERS_MAP: (u64, u32) = (450_000, 80);
/// Gather and shadow rays of a point that are measured, and planned with.
pub(crate) const DESIGNS: [[u32; 2]; 6] = [[1, 1], [1, 4], [4, 1], [4, 4], [16, 4], [16, 16]];
/// Least and most eye rays for each pixel. A single one goes through the pixel's middle, and does not smooth edges.
const SAMPLES: [u32; 2] = [4, 1 << 14];

impl Recipe {
    /// Eye rays of a pixel that ask for caustics.
    pub(crate) fn seen(&self) -> u32 {
        self.samples.min(MOST_SEEN)
    }

    /// Share of all photons that a gather ray asks for.
    #[must_use]
    pub fn share(&self) -> f64 {
        f64::from(self.k) / self.photons as f64
    }

    /// The least number of eye rays that is at least `wanted` and fills a grid of nearly square cells, r x r or r x (r + 1).
    #[must_use]
    pub fn grid(wanted: f64) -> Option<u32> {
        let of_root = |root: u32| [root * root, root * (root + 1)];
        (2..=128).flat_map(of_root).find(|&samples| f64::from(samples) >= wanted && samples <= SAMPLES[1])
    }
}

/// Which of [`DESIGNS`] has these numbers of rays.
pub(crate) fn nth_design(gathers: u32, light_samples: u32) -> usize {
    DESIGNS.iter().position(|&known| known == [gathers, light_samples]).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_fill_a_grid() {
        let found = [0.0, 4.0, 4.1, 7.0, 12.5, 64.0, 64.5, 16_384.0].map(Recipe::grid);
        assert_eq!(found, [4, 4, 6, 9, 16, 64, 72, 16_384].map(Some));
        assert_eq!(Recipe::grid(16_385.0), None);
    }
}
