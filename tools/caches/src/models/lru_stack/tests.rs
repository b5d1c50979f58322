//! Does it make no difference that times run out, and of which lines they are kept?

use pm_formats::trace::{Access, AccessKind};

use std::ops::Range;
use std::sync::Arc;

use super::times::OfPages;
use super::*;
use crate::lines::{AccessBuffer, Resume};

/// Pages of 8 lines: the slots are those of lines without pages.
fn space() -> LineSpace {
    let mut space = LineSpace::of_places(64, 9);
    space.extend(&Arc::new((0..8).collect()));
    space
}

/// Runs pseudo-random accesses to 60 lines, one in five a write, through a stack.
fn run(stack: &mut dyn CacheModel, rounds: Range<u32>) {
    let (space, mut chunk) = (space(), LineChunk::default());
    for round in rounds {
        let mut state = round.wrapping_mul(2_654_435_761);
        let mut records = AccessBuffer::new(40);
        for _ in 0..40 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let line = (state >> 16) % if round % 50 < 25 { 60 } else { 6 };
            let kind = if state >> 29 == 0 { AccessKind::Write } else { AccessKind::Read };
            records.push(&Access { kind, region: 0, len: 4, offset: u64::from(line) * 64 });
        }
        chunk.split(&space, &records.waiting(), &[], &mut Resume::default());
        stack.run(&space, &chunk, round != 7, &mut Misses::default());
    }
}

fn counts<T: Times + 'static>(horizon: u32, sizes: &[u64]) -> Vec<LineCounts> {
    let mut stack = Box::new(LruStack::<T>::new(&space(), 1, sizes));
    stack.horizon = horizon;
    run(&mut *stack, 0..ROUNDS);
    stack.finish()
}

const ROUNDS: u32 = 500;
/// Lines of the caches of a stack.
const SIZES: [&[u64]; 5] = [&[1, 4, 30], &[4], &[30], &[2, 59], &[60]];

#[test]
fn times_that_run_out_are_numbered_anew() {
    for sizes in SIZES {
        let expected = counts::<OfLines>(u32::MAX, sizes);
        assert!(expected.iter().all(|of| of.fetches[0] > 0 && of.write_backs > 0));
        for horizon in [133, 200, 1001] {
            assert_eq!(counts::<OfLines>(horizon, sizes), expected, "horizon {horizon}, {sizes:?}");
            assert_eq!(counts::<OfPages>(horizon, sizes), expected, "of pages, horizon {horizon}, {sizes:?}");
        }
    }
}

#[test]
fn times_of_pages_tell_what_those_of_all_lines_tell() {
    for sizes in SIZES {
        let expected = counts::<OfLines>(u32::MAX, sizes);
        assert_eq!(counts::<OfPages>(u32::MAX, sizes), expected, "{sizes:?}");
        // And it does not matter when the lines become many: before there are writes, before the caches are full, or after that.
        for round in [1, 2, 7, 30, 60, 499] {
            let mut stack = Box::new(LruStack::<OfLines>::new(&space(), 1, sizes));
            run(&mut *stack, 0..round);
            let mut stack = Box::new(Growing::with_pages(*stack, &space()));
            run(&mut *stack, round..ROUNDS);
            assert_eq!(stack.finish(), expected, "from round {round} on, {sizes:?}");
        }
    }
}
