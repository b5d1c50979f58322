//! Is every order charged for what a machine does that runs it? Here is that machine: a chip of so many bytes, and files for
//! memory. Queries leave it in the same order, and it takes the bytes on chip, and writes and reads those, that are charged.
//!
//! Who sorts or parts more than the store holds is told beforehand how many queries come, as the charge is; the size of the picture
//! tells that. Orders whose window is larger than their store (`hashed` and `hint`) keep a directory beside the store of what
//! lies where, which no charge counts; all else is on chip to the byte.

mod linking;
mod machine;
mod methods;
mod parting;
mod sorting;
mod waiting;

use crate::trial::{self, Form, queries};
use crate::{Per, Store, StoredQuery, orders};
use machine::{Machine, UNIT};
use pm_formats::vocabulary::measure;
use pm_formats::{BlockMeta, Query};
use pm_random::Random;

/// Queries as they left, and bytes on chip, written and read.
type Ran = (Vec<Query>, [u64; 3]);

/// What the order does, and what it says that it costs.
fn charged(form: &Form, store: Store, queries: &[Query]) -> Ran {
    let mut order = form.build_with(store, Per::Image, UNIT, 1 << 30).unwrap();
    let mut out = vec![];
    let mut emit = |_: BlockMeta, queries: &[Query]| {
        out.extend_from_slice(queries);
        Ok(())
    };
    order.push(BlockMeta::default(), queries, &mut emit).unwrap();
    order.drain(&mut emit).unwrap();
    let measures = order.measures();
    let told = |name: &str| measures.iter().find(|(known, _)| known == name).unwrap().1.as_f64() as u64;
    (out, [measure::ON_CHIP, measure::SPILLED_WRITTEN, measure::SPILLED_READ].map(told))
}

/// What a machine does that runs it.
fn executed(form: &Form, store: Store, queries: &[Query]) -> Ran {
    let mut machine = Machine::new(store, queries);
    methods::run(form, &mut machine, queries);
    (machine.left, [machine.chip.most, machine.written, machine.read])
}

/// Anywhere in a cube, and crowded in a corner, where many have one place.
fn streams(n: u32) -> [Vec<Query>; 2] {
    let crowded = |random: &mut Random| [(); 3].map(|()| (random.unit() * random.unit() * 32.0).floor() / 32.0);
    [queries(n, |random| [(); 3].map(|()| random.unit())), queries(n, crowded)]
}

#[test]
fn every_order_runs_as_it_is_charged() {
    for form in trial::forms(&orders()).unwrap() {
        for record in [StoredQuery::Full, StoredQuery::Compact] {
            let store = Store { bytes: 32 << 10, record };
            // What fits, what just does not, and much more.
            let room = store.room() as u32;
            for n in [room / 2, room, room + 1, 20_000] {
                for (stream, kind) in streams(n).iter().zip(["anywhere", "crowded"]) {
                    let (charged, executed) = (charged(&form, store, stream), executed(&form, store, stream));
                    let which = format!("{}, {} queries {kind}, {record:?} records", form.line, stream.len());
                    assert!(charged.0 == executed.0, "{which}: another order");
                    assert_eq!(charged.1, executed.1, "{which}: bytes on chip, written, read: charged and executed");
                }
            }
        }
    }
}
