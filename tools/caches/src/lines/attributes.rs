//! What an access is besides where it lies: its region, its kind, its length.

use pm_formats::trace::{Access, AccessKind};

/// What an access is besides its bytes: its region and its kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Attributes(u32);

impl Attributes {
    #[inline]
    fn new(region: u16, kind: AccessKind) -> Self {
        Self(u32::from(region) << 2 | kind as u32)
    }

    /// The region accessed.
    #[inline]
    #[must_use]
    pub fn region(self) -> usize {
        (self.0 >> 2) as usize
    }

    /// Whether the access is a write or a read-modify-write: the line turns dirty.
    #[inline]
    #[must_use]
    pub fn writes(self) -> bool {
        self.0 & 3 != AccessKind::Read as u32
    }

    pub(crate) fn kind(self) -> AccessKind {
        match self.0 & 3 {
            0 => AccessKind::Read,
            1 => AccessKind::Write,
            _ => AccessKind::ReadModifyWrite,
        }
    }
}

/// An access but for its offset: attributes and length. Most blocks of most traces have only one shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shape(u64);

impl Shape {
    /// The shape of an access.
    #[inline]
    pub(crate) fn new(access: &Access) -> Self {
        Self(u64::from(Attributes::new(access.region, access.kind).0) << 32 | u64::from(access.len))
    }

    /// Region and kind.
    #[inline]
    pub(crate) fn attributes(self) -> Attributes {
        Attributes((self.0 >> 32) as u32)
    }

    /// Length in bytes.
    #[inline]
    pub(crate) fn len(self) -> u32 {
        self.0 as u32
    }

    /// The same with another length.
    pub(super) fn of_len(self, len: u32) -> Self {
        Self(self.0 >> 32 << 32 | u64::from(len))
    }
}

/// The shapes of some accesses. Most stretches of most traces have only one.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shapes<'a> {
    /// That of all.
    Alike(Shape),
    /// That of each.
    Each(&'a [Shape]),
}

impl Shapes<'_> {
    /// That of the access at an index.
    #[inline]
    pub(crate) fn at(self, index: usize) -> Shape {
        match self {
            Self::Alike(shape) => shape,
            Self::Each(shapes) => shapes[index],
        }
    }

    /// Whether any of them writes.
    pub(super) fn write(self) -> bool {
        match self {
            Self::Alike(shape) => shape.attributes().writes(),
            Self::Each(shapes) => shapes.iter().fold(false, |any, shape| any | shape.attributes().writes()),
        }
    }
}
