//! Kernels: how much a photon counts by its distance, and what they add up to over a piece of the disc.

use std::f64::consts::PI;

pm_registry::choices! {
    /// How much a photon counts by its distance from the query; each is normalised over the photons' disc.
    #[derive(Debug)]
    pub enum Kernel {
        /// All photons alike
        Constant = "constant",
        /// 1 - d/r: sharper edges of caustics
        Cone = "cone",
        /// 1 - (d/r)^2: smoother than the constant
        Epanechnikov = "epanechnikov",
    }
}

impl Kernel {
    /// Weight of a photon at `s` radii from the query, 0 to 1.
    ///
    /// The cone is that of Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2.1, with k = 1;
    /// Epanechnikov's is his "Silverman" one without the square: Silverman, *Density Estimation for Statistics and Data
    /// Analysis*, 1986, section 4.2. Times 3/(pi r^2) and 2/(pi r^2) they are densities.
    #[inline]
    pub(super) fn weight(self, s: f64) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Cone => (1.0 - s).max(0.0),
            Self::Epanechnikov => (1.0 - s * s).max(0.0),
        }
    }

    /// Integral of the weight over the disc of radius 1.
    pub(super) const fn disc(self) -> f64 {
        2.0 * PI * self.spoke()
    }

    /// Integral of `weight(s) s ds` from the middle to the rim: what a sector adds for each radian.
    pub(super) const fn spoke(self) -> f64 {
        match self {
            Self::Constant => 1.0 / 2.0,
            Self::Cone => 1.0 / 6.0,
            Self::Epanechnikov => 1.0 / 4.0,
        }
    }

    /// Integrals of `weight(s) s^(1 + n) ds` from the middle to `r`, for n = 0, 1, 2.
    pub(super) fn radial_moments(self, r: f64) -> [f64; 3] {
        let square = r * r;
        let [two, three, four] = [square / 2.0, square * r / 3.0, square * square / 4.0];
        let [five, six] = [square * square * r / 5.0, square * square * square / 6.0];
        match self {
            Self::Constant => [two, three, four],
            Self::Cone => [two - three, three - four, four - five],
            Self::Epanechnikov => [two - four, three - five, four - six],
        }
    }

    /// Integral of the weight over the right-angled triangle from the middle along a perpendicular of length `d`, up to
    /// an angle whose tangent is `tangent` (negative for the other side): the antiderivative of
    /// `weight(s) s ds` up to `d / cos`, over the angle.
    pub(super) fn triangle(self, d: f64, tangent: f64) -> f64 {
        let t = tangent;
        // Integrals of 1/cos^2, 1/cos^3 and 1/cos^4.
        let second = d * d / 2.0 * t;
        match self {
            Self::Constant => second,
            Self::Cone => second - d * d * d / 6.0 * (t * (1.0 + t * t).sqrt() + libm::asinh(t)),
            Self::Epanechnikov => second - d * d * d * d / 4.0 * (t + t * t * t / 3.0),
        }
    }
}
