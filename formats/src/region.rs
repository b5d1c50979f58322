//! Regions of the traced memory.

use serde::{Deserialize, Serialize};

/// How the accesses of a region are coded in a trace; says nothing about what they mean.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Coding {
    /// Each access by its own offset and length (deltas, variable-length integers).
    Records,
    /// The region is an array of `nodes` records in which record `i - 1` is node `i` of an implicit binary tree with
    /// children `2i` and `2i + 1`; depth-first walks of it are coded as decision bits (two per inner node visited).
    HeapWalk {
        /// Number of nodes; node 1 is the root.
        nodes: u32,
        /// Each inner node is read a second time when all that is visited below it has been.
        reread: bool,
    },
    /// The region is all of a 64-bit address space, of which nobody knows beforehand what is touched: traces of other
    /// programs. Offsets are addresses; blocks are those of the 4 KiB pages that turn out to be touched.
    Addresses,
    /// This region and the next hold an implicit binary tree of `leaves` leaves: nodes 1 to `leaves - 1`, with children `2i`
    /// and `2i + 1`, are the records of this one, the nodes from `leaves` on those of the next. Depth-first walks of it are
    /// coded as those of [`HeapWalk`](Self::HeapWalk).
    LeavesApart {
        /// Number of leaves; there is one node less above them.
        leaves: u32,
    },
    /// Whole records of all regions of this coding, at most [`MAX_IN_TURNS`], are read in turns: of each its region, and how
    /// far it is from the one read last of that region.
    InTurns,
    /// The same, and each read says which reads of its search it [waits](crate::trace::Waits) for. A trace has regions of
    /// this coding or of that one.
    Waiting,
}

/// One region of the traced memory. No two regions of a trace share a 4 KiB page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Region {
    /// What lives there, such as `photons` or `split planes`.
    pub name: String,
    /// First byte address; a multiple of 4096.
    pub base: u64,
    /// Size in bytes.
    pub size: u64,
    /// Bytes of one record of the region.
    pub record_size: u32,
    /// How accesses to the region are coded in the stream.
    pub coding: Coding,
}

impl Region {
    /// All addresses of 64 bits, of a trace whose memory nobody has laid out: the only region of its trace.
    #[must_use]
    pub fn addresses(name: impl Into<String>) -> Self {
        Self { name: name.into(), base: 0, size: u64::MAX, record_size: 1, coding: Coding::Addresses }
    }

    /// Whether it is all addresses, wherever they lie.
    #[must_use]
    pub fn is_addresses(&self) -> bool {
        self.coding == Coding::Addresses
    }

    /// Whether whole records of it are read in turns with those of other regions.
    pub(crate) fn is_in_turns(&self) -> bool {
        matches!(self.coding, Coding::InTurns | Coding::Waiting)
    }

    /// Whether it has room for so many records, of at least a byte each.
    fn has_room(&self, records: u32) -> bool {
        self.record_size > 0 && u64::from(records) * u64::from(self.record_size) <= self.size
    }

    /// Whether `len` bytes at `offset`, no more than [`MAX_ACCESS`], lie within it; a record of no bytes lies at its offset.
    #[inline]
    #[must_use]
    pub fn holds(&self, offset: u64, len: u32) -> bool {
        match self.coding {
            _ if len > MAX_ACCESS => false,
            Coding::Addresses => offset.checked_add(u64::from(len.max(1) - 1)).is_some(),
            _ => offset.checked_add(u64::from(len)).is_some_and(|end| end <= self.size),
        }
    }
}

/// Longest access, and longest record, in bytes: whoever reads a damaged length meets longer ones soon, and each byte costs time.
pub const MAX_ACCESS: u32 = 1 << 24;

/// Most regions of a trace that are coded in turns: what is known of each is forgotten with each search.
pub const MAX_IN_TURNS: usize = 64;

/// Granularity at which regions are kept apart in the traced address space.
pub const REGION_ALIGNMENT: u64 = 4096;

/// Lays regions out one after another in one address space, each on its own pages.
#[must_use]
pub fn lay_out(regions: impl IntoIterator<Item = (String, u64, u32, Coding)>) -> Vec<Region> {
    // The first page stays empty, so that address 0 is never a valid record.
    let mut base = REGION_ALIGNMENT;
    regions
        .into_iter()
        .map(|(name, size, record_size, coding)| {
            let region = Region { name, base, size, record_size, coding };
            base += size.next_multiple_of(REGION_ALIGNMENT).max(REGION_ALIGNMENT);
            region
        })
        .collect()
}

/// Most nodes of a tree.
pub(crate) const MAX_NODES: u32 = (1 << 31) - 1;

/// Regions must lie apart, each on pages of its own, and be as large as their coding needs.
pub(crate) fn check_regions(regions: &[Region]) -> std::result::Result<(), &'static str> {
    if regions.len() > usize::from(u16::MAX) {
        return Err("a trace of more than 65,535 regions");
    }
    if let Some(addresses) = regions.iter().find(|region| region.is_addresses()) {
        return match regions.len() == 1 && *addresses == Region::addresses(addresses.name.clone()) {
            true => Ok(()),
            false => Err("a region of all addresses is not all there is"),
        };
    }
    let mut spans = vec![];
    for region in regions {
        let end = region.base.checked_add(region.size).filter(|&end| end < 1 << 62);
        let end = end.ok_or("a region ends beyond the address space")?;
        if region.record_size > MAX_ACCESS {
            return Err("a region has records of more than 2^24 bytes");
        }
        if !region.base.is_multiple_of(REGION_ALIGNMENT) {
            return Err("a region does not begin on a page");
        }
        check_nodes(region)?;
        spans.push((region.base, end.next_multiple_of(REGION_ALIGNMENT)));
    }
    check_groups(regions)?;
    spans.sort_unstable();
    if spans.windows(2).any(|pair| pair[0].1 > pair[1].0) {
        return Err("two regions share a page");
    }
    Ok(())
}

/// A tree lies in its region.
fn check_nodes(region: &Region) -> std::result::Result<(), &'static str> {
    let Coding::HeapWalk { nodes, .. } = region.coding else { return Ok(()) };
    match nodes <= MAX_NODES && region.has_room(nodes) {
        true => Ok(()),
        false => Err("a region is smaller than its nodes"),
    }
}

/// Regions that are coded together have what it takes.
fn check_groups(regions: &[Region]) -> std::result::Result<(), &'static str> {
    for (at, region) in regions.iter().enumerate() {
        let Coding::LeavesApart { leaves } = region.coding else { continue };
        let below = regions.get(at + 1).filter(|next| next.coding == Coding::Records);
        let below = below.ok_or("a tree has no region of leaves behind it")?;
        if leaves > MAX_NODES / 2 || !region.has_room(leaves.saturating_sub(1)) || !below.has_room(leaves) {
            return Err("a region is smaller than its nodes");
        }
    }
    let mut in_turns = regions.iter().filter(|region| region.is_in_turns());
    if in_turns.clone().any(|region| Some(&region.coding) != in_turns.clone().next().map(|first| &first.coding)) {
        return Err("of the regions that are coded in turns some say what reads wait for and some do not");
    }
    if in_turns.clone().count() > MAX_IN_TURNS {
        return Err("more than 64 regions are coded in turns");
    }
    match in_turns.all(|region| region.record_size > 0) {
        true => Ok(()),
        false => Err("a region that is coded in turns has records of no bytes"),
    }
}
