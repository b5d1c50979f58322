//! Blocks into searches.

use super::access::{Access, AccessKind, TraceSink};
use super::archive;
use super::batch::Batch;
use super::bits::BitReader;
use super::groups::nodes_of;
use super::heap_walk::{self, Visits};
use super::in_turns::InTurns;
use super::varint::{take, unzigzag};
use crate::container::{Block, Section};
use crate::digest::Tally;
use crate::region::{Coding, Region, check_regions};

/// Replays the searches of a block; `None` if it does not hold what it says, or of regions that make no sense. What was
/// replayed before the fault was found is then worthless.
pub fn decode_searches(block: &Block, regions: &[Region], sink: &mut dyn TraceSink) -> Option<Tally> {
    if block.section != Section::Records || check_regions(regions).is_err() {
        return None;
    }
    let payload = payload_of(block, regions)?;
    let mut planes = Planes::split(&payload)?;
    let mut tally = Tally::default();
    let (mut pixels, mut scratch) = (vec![], vec![]);
    let mut last_pixel = 0u32;
    let mut in_turns = InTurns::of(regions);
    sink.block(block.meta.batch, block.meta.warm_up);
    let mut batch = Batch::new(sink);
    let mut visits = Visits::new();
    for _ in 0..block.meta.records {
        let before = planes;
        pixels.clear();
        let queries = take(&mut planes.destinations)?;
        // A query costs at least one byte of this plane, so this is no more than is there.
        for _ in 0..queries {
            let delta = unzigzag(take(&mut planes.destinations)?);
            last_pixel = u32::try_from(i64::from(last_pixel).checked_add(delta)?).ok()?;
            pixels.push(last_pixel);
        }
        batch.search(&pixels);
        in_turns.restart();
        decode_accesses(&mut planes, regions, (&mut in_turns, &mut visits), &mut batch)?;
        batch.search_end();

        // The digest is that of the absolute pixels and of the search's own bytes: the same wherever it stands.
        scratch.clear();
        scratch.extend_from_slice(&queries.to_le_bytes());
        pixels.iter().for_each(|pixel| scratch.extend_from_slice(&pixel.to_le_bytes()));
        let used = |before: &[u8], after: &[u8]| before.len() - after.len();
        scratch.extend_from_slice(&before.heads[..used(before.heads, planes.heads)]);
        scratch.extend_from_slice(&before.walks[..used(before.walks, planes.walks)]);
        scratch.extend_from_slice(&before.others[..used(before.others, planes.others)]);
        tally.count(&scratch);
    }
    planes.is_empty().then_some(tally)
}

/// What a block holds, in whichever way it was packed.
pub(super) fn payload_of(block: &Block, regions: &[Region]) -> Option<Vec<u8>> {
    match block.walks() {
        Some(packed) => archive::unpack(packed, block.raw_len(), block.meta.records, regions),
        None => block.decode(),
    }
}

fn decode_accesses(
    planes: &mut Planes<'_>,
    regions: &[Region],
    (in_turns, visits): (&mut InTurns, &mut Visits),
    batch: &mut Batch<'_>,
) -> Option<()> {
    let mut bits = BitReader::new(planes.walks);
    let mut last = 0i64;
    for _ in 0..take(&mut planes.heads)? {
        let head = take(&mut planes.heads)?;
        let number = u16::try_from(head >> 1).ok()?;
        let region = regions.get(usize::from(number))?;
        let size = region.record_size;
        if region.is_addresses() {
            if head & 1 == 0 {
                return None;
            }
            decode_run(planes, region, batch)?;
            continue;
        }
        if head & 1 == 1 {
            match region.coding {
                Coding::InTurns | Coding::Waiting => {
                    let count = take(&mut planes.heads)?;
                    in_turns.decode(count, &mut planes.others, batch)?;
                }
                Coding::LeavesApart { leaves } => {
                    decode_leaves_apart(
                        (&mut bits, visits),
                        leaves,
                        number,
                        [size, regions.get(usize::from(number) + 1)?.record_size],
                        batch,
                    )?;
                }
                Coding::HeapWalk { nodes, reread } => {
                    if reread {
                        let read = |node| Access::read(number, u64::from(node - 1) * u64::from(size), size);
                        heap_walk::decode_rereading(&mut bits, nodes, |node| batch.access(read(node)))?;
                    } else {
                        heap_walk::decode(&mut bits, nodes, visits, &mut |visits| batch.records(number, size, visits))?;
                    }
                }
                Coding::Records | Coding::Addresses => return None,
            }
            continue;
        }
        for _ in 0..take(&mut planes.heads)? {
            let token = take(&mut planes.others)?;
            let access = if token & 1 == 0 {
                last = last.checked_add(unzigzag(token >> 1))?;
                Access::read(number, u64::try_from(last).ok()?.checked_mul(u64::from(size))?, size)
            } else {
                last = last.checked_add(unzigzag(take(&mut planes.others)?))?;
                let kind = kind(token >> 1)?;
                let len = u32::try_from(take(&mut planes.others)?).ok()?;
                Access { kind, region: number, len, offset: u64::try_from(last).ok()? }
            };
            if !region.holds(access.offset, access.len) {
                return None;
            }
            batch.access(access);
        }
    }
    bits.align();
    planes.walks = planes.walks.get(bits.bytes_read()..)?;
    Some(())
}

/// A walk of a tree whose inner nodes are the records of a region and whose leaves are those of the next.
fn decode_leaves_apart(
    (bits, visits): (&mut BitReader<'_>, &mut Visits),
    leaves: u32,
    inner: u16,
    sizes: [u32; 2],
    batch: &mut Batch<'_>,
) -> Option<()> {
    heap_walk::decode(bits, nodes_of(leaves), visits, &mut |visits| {
        for node in visits.iter().map(|visit| visit + 1) {
            let is_leaf = node >= leaves;
            let (record, size) = if is_leaf { (node - leaves, sizes[1]) } else { (node - 1, sizes[0]) };
            batch.access(Access::read(inner + u16::from(is_leaf), u64::from(record) * u64::from(size), size));
        }
    })
}

/// Accesses of one kind and length anywhere among all addresses.
fn decode_run(planes: &mut Planes<'_>, region: &Region, batch: &mut Batch<'_>) -> Option<()> {
    let count = usize::try_from(take(&mut planes.heads)?).ok()?;
    let kind = kind(take(&mut planes.heads)?)?;
    let len = u32::try_from(take(&mut planes.heads)?).ok()?;
    let (addresses, rest) = planes.others.split_at_checked(count.checked_mul(8)?)?;
    planes.others = rest;
    for address in addresses.chunks_exact(8) {
        let offset = u64::from_le_bytes(address.try_into().expect("eight bytes"));
        if !region.holds(offset, len) {
            return None;
        }
        batch.access(Access { kind, region: 0, len, offset });
    }
    Some(())
}

fn kind(number: u64) -> Option<AccessKind> {
    match number {
        0 => Some(AccessKind::Read),
        1 => Some(AccessKind::Write),
        2 => Some(AccessKind::ReadModifyWrite),
        _ => None,
    }
}

/// The four planes of a block's payload, as far as they are not yet read.
#[derive(Clone, Copy)]
struct Planes<'a> {
    heads: &'a [u8],
    destinations: &'a [u8],
    walks: &'a [u8],
    others: &'a [u8],
}

impl<'a> Planes<'a> {
    fn split(payload: &'a [u8]) -> Option<Self> {
        let (lens, rest) = payload.split_at_checked(12)?;
        let len = |i: usize| u32::from_le_bytes(lens[4 * i..4 * i + 4].try_into().expect("four bytes")) as usize;
        let (heads, rest) = rest.split_at_checked(len(0))?;
        let (destinations, rest) = rest.split_at_checked(len(1))?;
        let (walks, others) = rest.split_at_checked(len(2))?;
        Some(Self { heads, destinations, walks, others })
    }

    const fn is_empty(&self) -> bool {
        self.heads.is_empty() && self.destinations.is_empty() && self.walks.is_empty() && self.others.is_empty()
    }
}
