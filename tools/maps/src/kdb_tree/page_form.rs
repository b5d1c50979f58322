//! What region pages hold, and how much of it fits a page.

/// Bytes that every page spends on its level, its number of entries, and which child or photon is the first.
pub(super) const HEADER: u32 = 8;

pm_registry::choices! {
    /// What a region page says of its children.
    #[derive(Debug, Default)]
    pub enum PageForm {
        /// The planes between them: 5 bytes each, one fewer than children, who lie one after another
        #[default]
        Compact = "compact",
        /// The bounds of each, as Robinson has it: 28 bytes with its number
        Boxes = "boxes",
    }
}

impl PageForm {
    /// The most children that a page of `line` bytes describes; a page of fewer than two is of no use.
    #[must_use]
    pub const fn fan_out(self, line: u32) -> u32 {
        let room = line.saturating_sub(HEADER);
        match self {
            Self::Compact => room / 5 + 1,
            Self::Boxes => room / 28,
        }
    }

    /// Bytes of the smallest line that holds a photon, as a block, and two children, as a page.
    #[must_use]
    pub const fn least_line(self) -> u32 {
        HEADER
            + match self {
                Self::Compact => size_of::<pm_formats::Photon>() as u32,
                Self::Boxes => 2 * 28,
            }
    }
}
