//! Which walks each search of a block has.

use super::memory::MOST_NODES;
use crate::region::{Coding, Region};
use crate::trace::groups::nodes_of;
use crate::trace::varint::take;

/// The tree that is walked, and how often by each search.
pub(super) struct Walks {
    /// Nodes of the tree.
    pub(super) nodes: u32,
    /// Walks of each search.
    pub(super) of_search: Vec<u32>,
}

/// Is there a tree among these regions whose walks can be coded by those before?
pub(in crate::trace) fn has_tree(regions: &[Region]) -> bool {
    regions.iter().any(|region| nodes(region).is_some())
}

/// Nodes of a tree whose walks can be coded so.
fn nodes(region: &Region) -> Option<u32> {
    let nodes = match region.coding {
        Coding::HeapWalk { nodes, .. } => nodes,
        Coding::LeavesApart { leaves } => nodes_of(leaves),
        _ => return None,
    };
    (1..=MOST_NODES).contains(&nodes).then_some(nodes)
}

impl Walks {
    /// Of so many searches with these heads; `None` if they are not what these say, or walk no tree or more than one.
    pub(super) fn of(mut heads: &[u8], searches: u32, regions: &[Region]) -> Option<Self> {
        let mut tree = None;
        let mut of_search = vec![];
        for _ in 0..searches {
            let mut walks = 0;
            for _ in 0..take(&mut heads)? {
                let head = take(&mut heads)?;
                let number = usize::try_from(head >> 1).ok()?;
                let coding = &regions.get(number)?.coding;
                match (head & 1, coding) {
                    (1, Coding::HeapWalk { .. } | Coding::LeavesApart { .. }) => {
                        if *tree.get_or_insert(number) != number {
                            return None;
                        }
                        walks += 1;
                    }
                    (1, Coding::Records | Coding::Addresses) | (_, Coding::Addresses) => return None,
                    _ => drop(take(&mut heads)?),
                }
            }
            of_search.push(walks);
        }
        Some(Self { nodes: nodes(&regions[tree?])?, of_search })
    }
}
