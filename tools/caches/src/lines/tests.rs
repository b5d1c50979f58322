//! Are records cut where lines end, and lines numbered without gaps?

use pm_formats::trace::{Access, AccessKind, Coding, Region, lay_out};

use super::*;

fn region(base: u64, size: u64) -> Region {
    Region { name: String::new(), base, size, record_size: 1, coding: Coding::Records }
}

/// Slots, each with whether it is written, and the number of line accesses.
fn split(space: &LineSpace, accesses: &[(u64, u32, AccessKind)], repeats: Repeats) -> (Vec<(u32, bool)>, u64) {
    let mut records = AccessBuffer::new(CHUNK);
    for &(offset, len, kind) in accesses {
        assert!(records.push(&Access { kind, region: 0, len, offset }));
    }
    let (mut chunk, mut cursor) = (LineChunk::new(repeats), Resume::default());
    let (mut slots, mut number) = (Vec::new(), 0);
    while chunk.split(space, &records.waiting(), &[], &mut cursor) {
        slots.extend(chunk.slots().iter().enumerate().map(|(i, &slot)| (slot, chunk.attributes(i).writes())));
        number += chunk.accesses();
    }
    (slots, number)
}

fn reads(space: &LineSpace, accesses: &[(u64, u32)]) -> (Vec<u32>, u64) {
    let accesses: Vec<_> = accesses.iter().map(|&(offset, len)| (offset, len, AccessKind::Read)).collect();
    let (slots, number) = split(space, &accesses, Repeats::LeftOut);
    (slots.into_iter().map(|(slot, _)| slot).collect(), number)
}

#[test]
fn gaps_between_regions_cost_no_slots() {
    let regions = [region(1 << 60, 4096), region(0, 100), region(u64::MAX - 4095, 4096), region(8192, 0)];
    let space = LineSpace::new(&regions, 128);
    assert_eq!(space.slots(), 32 + 1 + 32);
    let ends = |r: usize, offset, len| space.regions[r].ends(7, offset, len);
    assert_eq!((ends(1, 0, 100), ends(0, 0, 4096), ends(2, 4095, 1)), ((0, 0), (1, 32), (64, 64)));
    assert_eq!((space.line(1, 0), space.line(0, 1), space.line(2, 64)), (0, 1 << 53, u64::MAX >> 7));
}

#[test]
fn a_line_shared_by_regions_is_one_slot() {
    let regions = [region(4096, 4096), region(8192, 10), region(12288, 10_000)];
    let space = LineSpace::new(&regions, 16384);
    assert_eq!(space.slots(), 2);
    let ends = |r: usize, offset, len| space.regions[r].ends(14, offset, len);
    assert_eq!((ends(0, 0, 1), ends(1, 9, 1), ends(2, 0, 10_000)), ((0, 0), (0, 0), (0, 1)));
}

#[test]
fn records_are_split_where_lines_end() {
    let space = LineSpace::new(&[region(0, 1 << 20)], 16);
    assert_eq!(reads(&space, &[(0, 16), (16, 16), (31, 1)]), (vec![0, 1], 3), "the last repeats the one before");
    assert_eq!(reads(&space, &[(0, 16), (16, 17)]), (vec![0, 1, 2], 3));
    assert_eq!(reads(&space, &[(15, 1), (15, 2)]), (vec![0, 1], 3), "the second begins with a repeat");
    assert_eq!(reads(&space, &[(8, 80), (81, 1), (0, 0)]), (vec![0, 1, 2, 3, 4, 5, 5, 0], 8));
    assert_eq!(reads(&space, &[]), (vec![], 0));
}

#[test]
fn a_read_and_a_write_are_no_repeats_of_one_another() {
    let space = LineSpace::new(&[region(0, 1 << 20)], 16);
    let (read, write) = ((0, 4, AccessKind::Read), (4, 4, AccessKind::Write));
    let expected = vec![(0, false), (0, true), (0, false)];
    assert_eq!(split(&space, &[read, read, write, write, read], Repeats::LeftOut), (expected, 5));
}

#[test]
fn records_of_any_length_come_in_chunks_of_bounded_length() {
    let space = LineSpace::new(&[region(0, 1 << 20)], 16);
    let (slots, accesses) = reads(&space, &[(0, 1 << 20), (0, 4), (8, (1 << 20) - 8)]);
    assert_eq!(accesses, (2 << 16) + 1);
    assert!(slots.into_iter().eq((0..1 << 16).chain([0]).chain(0..1 << 16)));
}

#[test]
fn repeats_that_are_kept_are_all_there() {
    let space = LineSpace::new(&[region(0, 1 << 20)], 16);
    let kept = |accesses: &[(u64, u32, AccessKind)]| {
        let (slots, number) = split(&space, accesses, Repeats::Kept);
        assert_eq!(slots.len() as u64, number);
        slots.into_iter().map(|(slot, _)| slot).collect::<Vec<_>>()
    };
    let (read, write, spans) = ((0, 4, AccessKind::Read), (4, 4, AccessKind::Write), (12, 8, AccessKind::Read));
    // Of one shape, of several, and where records span lines.
    assert_eq!(kept(&[read, read, read]), [0, 0, 0]);
    assert_eq!(kept(&[read, read, write, write, read]), [0, 0, 0, 0, 0]);
    assert_eq!(kept(&[spans, spans, (16, 4, AccessKind::Read)]), [0, 1, 0, 1, 1]);
    assert_eq!(kept(&[(0, 64, AccessKind::Read), (48, 4, AccessKind::Read)]), [0, 1, 2, 3, 3]);
}

#[test]
fn only_accesses_within_their_regions_are_let_through() {
    let regions = lay_out([100, 0, 1 << 40].map(|size| (String::new(), size, 1, Coding::Records)));
    let within = |accesses: &[(u16, u64, u32)]| {
        let mut records = AccessBuffer::new(CHUNK);
        accesses.iter().for_each(|&(region, offset, len)| assert!(records.push(&Access::read(region, offset, len))));
        records.waiting().are_within(&regions)
    };
    for good in [(0, 0, 100), (0, 80, 20), (0, 99, 0), (2, (1 << 40) - 4, 4)] {
        assert!(within(&[good]) && within(&[good, good]) && within(&[(0, 0, 1), good]), "{good:?}");
    }
    for bad in
        [(0, 0, 101), (0, 81, 20), (0, 100, 0), (0, 200, 1), (0, u64::MAX, 20), (0, 1 << 63, 1), (0, 0, u32::MAX)]
    {
        assert!(!within(&[bad]) && !within(&[bad, (0, 0, 1)]) && !within(&[(0, 0, bad.2), bad]), "{bad:?}");
    }
    assert!(!within(&[(1, 0, 0)]) && !within(&[(3, 0, 1)]) && within(&[]));
}

#[test]
fn ends_found_many_at_a_time_are_those_found_one_by_one() {
    let limit = u64::from(u32::MAX);
    // Sizes on both sides of what 32 bits hold, bases within lines and at the end of all addresses.
    for size in [1, 4096, limit - 130, limit - 127, limit, 1 << 40] {
        for base in [0, 100, 4096, (1 << 60) + 77, u64::MAX - size] {
            for line in [16, 128, 4096] {
                let space = LineSpace::new(&[region(base, size)], line);
                for len in [0, 1, 20, 300] {
                    let most = size.saturating_sub(u64::from(len));
                    let offsets: Vec<u64> = (0..9).map(|i| most / 8 * i).chain([most]).collect();
                    let mut ends = vec![[0; 2]; offsets.len()];
                    space.regions[0].ends_of(space.shift, &offsets, len, &mut ends);
                    for (&found, &offset) in ends.iter().zip(&offsets) {
                        if offset + u64::from(len.max(1)) <= size {
                            assert_eq!(
                                found,
                                <[u32; 2]>::from(space.regions[0].ends(space.shift, offset, len)),
                                "{base} {size} {line} {len}"
                            );
                        }
                    }
                }
            }
        }
    }
}
