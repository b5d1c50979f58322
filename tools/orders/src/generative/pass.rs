//! What of a pixel's gather rays is cast at one visit.

/// Which of a pixel's points seen are gathered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VisiblePoints {
    /// All, in the order in which they are found.
    All,
    /// Only those seen directly.
    Direct,
    /// Only those seen in mirrors and through glass.
    BehindSpecular,
}

impl VisiblePoints {
    /// Is a point among them that is seen in mirrors or through glass, or else one that is seen directly?
    #[must_use]
    pub const fn include(self, behind_specular: bool) -> bool {
        match self {
            Self::All => true,
            Self::Direct => !behind_specular,
            Self::BehindSpecular => behind_specular,
        }
    }
}

/// What of a pixel's gather rays is cast at one visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// From which points seen.
    pub points: VisiblePoints,
    /// Into which bin of the hemisphere, counted from 0.
    pub bin: u32,
}

impl Pass {
    /// A pass for each of these points and bins, bin by bin of the points that come first.
    #[must_use]
    pub fn every_ray(points: &[VisiblePoints], bins: u32) -> Vec<Self> {
        points.iter().flat_map(|&points| (0..bins).map(move |bin| Self { points, bin })).collect()
    }

    /// Is it a pixel's first visit?
    #[must_use]
    pub fn is_first(self) -> bool {
        self.points != VisiblePoints::BehindSpecular && self.bin == 0
    }
}

/// All directions, where there are no bins.
impl From<VisiblePoints> for Pass {
    fn from(points: VisiblePoints) -> Self {
        Self { points, bin: 0 }
    }
}
