//! Do times that run out make no difference?

use pm_formats::trace::{Access, AccessKind, Coding, lay_out};

use super::*;
use crate::lines::{AccessBuffer, Resume};

/// Runs pseudo-random accesses to 60 lines, one in five a write, through caches of 1, 4 and 30 lines.
fn counts(horizon: u32) -> Vec<LineCounts> {
    let regions = lay_out([("a".to_owned(), 60 * 64, 64, Coding::Records)]);
    let space = LineSpace::new(&regions, 64);
    let mut stack = Box::new(LruStack::new(&space, 1, &[1, 4, 30]));
    stack.horizon = horizon;
    let mut chunk = LineChunk::default();
    let mut state = 1_u32;
    for round in 0..500 {
        let mut records = AccessBuffer::new(40);
        for _ in 0..40 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let line = (state >> 16) % if round % 50 < 25 { 60 } else { 6 };
            let kind = if state >> 29 == 0 { AccessKind::Write } else { AccessKind::Read };
            records.push(&Access { kind, region: 0, len: 4, offset: u64::from(line) * 64 });
        }
        chunk.split(&space, &records.waiting(), &mut Resume::default());
        stack.run(&space, &chunk, round != 7, &mut Misses::default());
    }
    stack.finish()
}

#[test]
fn times_that_run_out_are_numbered_anew() {
    let expected = counts(u32::MAX);
    assert!(expected.iter().all(|of| of.fetches[0] > 0 && of.write_backs > 0));
    for horizon in [73, 100, 1001] {
        assert_eq!(counts(horizon), expected, "horizon {horizon}");
    }
}
