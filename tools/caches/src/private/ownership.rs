//! Which lines more than one element touches.

use pm_formats::trace::{Access, Region};

use crate::SpanRule;
use crate::lines::{LineSpace, Shape};

/// Of each line, who touched it.
pub(super) struct Ownership {
    space: LineSpace,
    /// By slot: 0 if nobody, one more than the number of the element if it alone, [`SHARED`] if more than one.
    owners: Vec<u32>,
    shared: u64,
}

/// More than one has touched it.
const SHARED: u32 = u32::MAX;

impl Ownership {
    /// Of lines of this size.
    pub(super) fn new(regions: &[Region], line_bytes: u32, span: SpanRule) -> Self {
        let space = LineSpace::new(regions, line_bytes).with_span(span);
        Self { owners: vec![0; space.slots() as usize], space, shared: 0 }
    }

    /// An access of an element.
    pub(super) fn touch(&mut self, element: usize, access: &Access, counted: bool) {
        if !counted {
            return;
        }
        let (first, last) = self.space.ends(access.offset, Shape::new(access));
        for owner in &mut self.owners[first as usize..=last as usize] {
            let own = element as u32 + 1;
            match *owner {
                0 => *owner = own,
                other if other == own || other == SHARED => {}
                _ => {
                    *owner = SHARED;
                    self.shared += 1;
                }
            }
        }
    }

    /// Lines that more than one element touched, and therefore fetched.
    pub(super) const fn shared(&self) -> u64 {
        self.shared
    }
}
