//! Formats of pictures.

/// A format that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// OpenEXR, linear, 32-bit float.
    Exr,
    /// PNG, 8 bits, sRGB.
    Png,
}

impl PictureFormat {
    /// The format that the ending of a file name stands for, whether it is written large or small.
    #[must_use]
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending.to_lowercase().as_str() {
            "exr" => Some(Self::Exr),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_endings_stand_for_nothing() {
        assert_eq!(PictureFormat::of_ending("jpg"), None);
        assert_eq!(PictureFormat::of_ending(""), None);
        assert_eq!(PictureFormat::of_ending("EXR"), Some(PictureFormat::Exr));
        assert_eq!(PictureFormat::of_ending("png"), Some(PictureFormat::Png));
    }
}
