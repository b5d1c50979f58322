//! An external merge sort, its last runs kept on chip.

use super::machine::{Machine, Reader, Writer};
use crate::BURST_BUFFER;
use pm_formats::Query;
use std::collections::VecDeque;

/// All leave by key, equal keys as they came, from a store of whole records.
pub(super) fn sort(machine: &mut Machine, came: impl Iterator<Item = Query>, n: u64, key: &dyn Fn(&Query) -> u32) {
    let (came, room) = (&mut came.map(|query| (key(&query), query)), machine.store.room());
    let whole = machine.bytes(n.min(room));
    machine.chip.reserve(whole);
    // Runs as long as the store, a shorter one first: so that as many stay as it holds.
    let beyond = n.saturating_sub(room);
    let runs = beyond.div_ceil(room);
    assert!(runs <= machine.store.fan(), "one merging is all that is tried");
    let mut written: Vec<Writer> = vec![];
    for run in 0..runs {
        let length = if run == 0 { beyond - (runs - 1) * room } else { room };
        written.push(write(machine, take(came, length)));
    }
    let mut kept: VecDeque<_> = take(came, n - beyond).into();
    // Buffers take the place of records: of those that leave last, which are read back when the others have left.
    let buffers = runs * BURST_BUFFER;
    let out = kept.iter().rev().scan(0, |free, _| {
        let needed = *free < buffers;
        *free += machine.store.record.bytes();
        needed.then_some(())
    });
    let out = out.count();
    let pushed_out = write(machine, kept.split_off(kept.len() - out).into());
    let mut readers: Vec<Reader> = written.into_iter().map(|writer| machine.turn(writer)).collect();
    let mut last = Some(machine.turn(pushed_out));
    let mut heads: Vec<Option<(u32, Query)>> =
        readers.iter_mut().map(|reader| machine.next(reader).map(|query| (key(&query), query))).collect();
    loop {
        if kept.is_empty()
            && let Some(mut reader) = last.take()
        {
            while let Some(query) = machine.next(&mut reader) {
                kept.push_back((key(&query), query));
            }
            assert!(machine.bytes(kept.len() as u64) + buffers <= whole, "there is room again for what went out");
        }
        // Of equal keys those of the earlier run, what was kept last.
        let of_runs = heads.iter().enumerate().filter_map(|(run, head)| head.map(|head| (head.0, run)));
        let next = of_runs.chain(kept.front().map(|head| (head.0, heads.len()))).min();
        let Some((_, run)) = next else { break };
        if run == heads.len() {
            machine.left.extend(kept.pop_front().map(|head| head.1));
        } else {
            machine.left.extend(heads[run].map(|head| head.1));
            heads[run] = machine.next(&mut readers[run]).map(|query| (key(&query), query));
        }
    }
    machine.chip.release(whole);
}

/// The next records, sorted where they are.
fn take(came: &mut dyn Iterator<Item = (u32, Query)>, n: u64) -> Vec<(u32, Query)> {
    let mut run: Vec<_> = came.take(n as usize).collect();
    run.sort_by_key(|&(key, _)| key);
    run
}

/// Records go to memory from where they are in the store.
fn write(machine: &mut Machine, run: Vec<(u32, Query)>) -> Writer {
    let mut writer = Machine::writer();
    run.iter().for_each(|(key, query)| machine.write(&mut writer, query, *key));
    writer
}
