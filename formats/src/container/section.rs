//! What blocks hold, and what they say of it.

/// What a block's payload is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Section {
    /// Records of the stream's kind.
    Records = 0,
    /// Beside the queries: where irradiance is cached.
    IrradianceRecords = 1,
    /// Beside the queries: which cached irradiance each pixel takes.
    PixelWeights = 2,
    /// The end of the stream.
    End = 255,
}

impl Section {
    /// The section with this number, if there is one.
    pub(super) const fn from_number(number: u8) -> Option<Self> {
        match number {
            0 => Some(Self::Records),
            1 => Some(Self::IrradianceRecords),
            2 => Some(Self::PixelWeights),
            255 => Some(Self::End),
            _ => None,
        }
    }
}

/// What a block says of its records.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BlockMeta {
    /// The batch (tile, scanline, sample window) that all its records belong to.
    pub batch: u64,
    /// Simulated, but not counted.
    pub warm_up: bool,
    /// Number of records.
    pub records: u32,
}
