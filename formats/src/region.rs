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
        if let Coding::HeapWalk { nodes, .. } = region.coding {
            let needed = u64::from(nodes) * u64::from(region.record_size);
            if nodes > MAX_NODES || region.record_size == 0 || needed > region.size {
                return Err("a region is smaller than its nodes");
            }
        }
        spans.push((region.base, end.next_multiple_of(REGION_ALIGNMENT)));
    }
    spans.sort_unstable();
    if spans.windows(2).any(|pair| pair[0].1 > pair[1].0) {
        return Err("two regions share a page");
    }
    Ok(())
}
