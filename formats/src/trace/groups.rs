//! Which regions are coded together: a tree with its leaves, or those that are read in turns.

use crate::region::{Coding, Region};

/// What a region is coded with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    /// By itself.
    Alone,
    /// It holds the inner nodes or the leaves of a tree whose inner nodes are in region `inner`.
    Tree { inner: u16, leaves: u32 },
    /// With all others that are read in turns, as number `rank` among them.
    Turns { rank: u16 },
}

impl Group {
    /// Are reads of the one and the other coded together?
    pub(super) fn is_with(self, other: Self) -> bool {
        match (self, other) {
            (Self::Tree { inner, .. }, Self::Tree { inner: others, .. }) => inner == others,
            (Self::Turns { .. }, Self::Turns { .. }) => true,
            _ => false,
        }
    }

    /// The group of each region.
    pub(super) fn of(regions: &[Region]) -> Vec<Self> {
        let mut groups = vec![Self::Alone; regions.len()];
        let mut rank = 0;
        for (at, region) in regions.iter().enumerate() {
            match region.coding {
                Coding::LeavesApart { leaves } => {
                    let inner = u16::try_from(at).expect("a trace has at most 65,535 regions");
                    groups[at] = Self::Tree { inner, leaves };
                    if let Some(leaves_of_it) = groups.get_mut(at + 1) {
                        *leaves_of_it = Self::Tree { inner, leaves };
                    }
                }
                Coding::InTurns | Coding::Waiting => {
                    groups[at] = Self::Turns { rank };
                    rank += 1;
                }
                _ => {}
            }
        }
        groups
    }
}

/// Number of nodes of a tree of so many leaves.
pub(super) const fn nodes_of(leaves: u32) -> u32 {
    leaves + leaves.saturating_sub(1)
}

#[cfg(test)]
mod tests;
