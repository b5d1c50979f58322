//! What is resident is answered as it comes, and only the rest is charged?

use super::*;
use crate::{BURST_BUFFER, Limits, Per, Reordering, StoredQuery};
use bytemuck::Zeroable as _;
use pm_formats::vocabulary::measure;
use pm_formats::{BlockMeta, Query};

/// Four cells of ten photons along x, each a unit long.
fn residents(most: u64, casts: u32) -> Residents {
    let photons = (0..40).map(|i| [i as f32 / 10.0, 0.0, 0.0]).collect();
    Residents::new(photons, 10, most, casts)
}

/// Queries in these cells, numbered as they come.
fn queries(cells: &[u8]) -> Vec<Query> {
    let at = |&cell: &u8| [f32::from(cell) + 0.55, 0.0, 0.0];
    (0..).zip(cells).map(|(pixel, cell)| Query { position: at(cell), pixel, ..Query::zeroed() }).collect()
}

/// Pixels as they leave, and the order.
fn pass(residents: Residents, room: u64, cells: &[u8], memory: u64) -> (Vec<u32>, Reordering) {
    let store = Store { bytes: room * 44, record: StoredQuery::Full };
    let limits = Limits { memory, folder: std::env::temp_dir(), announce: Box::new(|| {}) };
    let mut order = Reordering::new(Per::Image, Box::new(Join::new(residents, store, limits)));
    let mut out = vec![];
    let mut emit = |_: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|query| query.pixel));
        Ok(())
    };
    for piece in queries(cells).chunks(3) {
        order.push(BlockMeta::default(), piece, &mut emit).unwrap();
    }
    order.drain(&mut emit).unwrap();
    (out, order)
}

fn told(order: &Reordering, name: &str) -> f64 {
    order.measures().into_iter().find(|(known, _)| known == name).map_or(f64::NAN, |(_, number)| number.as_f64())
}

/// Cell 2 has four queries, cell 0 three, cell 3 two, cell 1 one.
const CELLS: [u8; 10] = [0, 2, 3, 2, 1, 0, 2, 3, 0, 2];

#[test]
fn cells_with_most_queries_a_photon_are_resident_first() {
    let chosen = |most, casts| {
        let mut residents = residents(most, casts);
        let asked: Vec<u32> = queries(&CELLS).iter().map(|query| residents.cell(query.position)).collect();
        let chosen = residents.choose(&asked);
        (chosen, queries(&[0, 1, 2, 3]).iter().map(|query| residents.rank(query.position)).collect::<Vec<_>>())
    };
    // Ranks from the number of casts on are cells that wait.
    assert_eq!(chosen(0, 1), ((1, 4), vec![1, 2, 3, 4]));
    assert_eq!(chosen(10, 1), ((1, 3), vec![1, 2, 0, 4]));
    assert_eq!(chosen(25, 1), ((1, 2), vec![0, 2, 0, 4]));
    assert_eq!(chosen(10, 3), ((3, 1), vec![1, 4, 0, 2]));
    // Once all are resident, no further cast is needed.
    assert_eq!(chosen(20, 9), ((2, 0), vec![0, 1, 0, 1]));
}

#[test]
fn queries_leave_cast_by_cast_as_they_came_and_then_cell_by_cell() {
    // In memory and, two queries at a time, on disk.
    for memory in [1 << 20, 200] {
        assert_eq!(pass(residents(20, 1), 1, &CELLS, memory).0, [0, 1, 3, 5, 6, 8, 9, 4, 2, 7]);
        assert_eq!(pass(residents(10, 2), 1, &CELLS, memory).0, [1, 3, 6, 9, 0, 5, 8, 4, 2, 7]);
        assert_eq!(pass(residents(0, 1), 1, &CELLS, memory).0, [0, 5, 8, 4, 1, 3, 6, 9, 2, 7]);
    }
}

#[test]
fn only_what_waits_is_charged_and_every_further_cast() {
    let (_, order) = pass(residents(20, 1), 1, &CELLS, 1 << 20);
    assert_eq!(told(&order, measure::SPILLED_WRITTEN), 3.0 * 44.0);
    assert_eq!(told(&order, measure::SPILLED_READ), 3.0 * 44.0);
    assert_eq!(told(&order, measure::PREPASS_RAYS), 2.0 * 10.0);
    assert!(told(&order, measure::RAYS_CAST_AGAIN).is_nan());
    // Seven nodes, four cells; of the buffers a store this small has two.
    assert_eq!(told(&order, measure::ON_CHIP), (7 * 8 + 4 * 8 + 2 * BURST_BUFFER) as f64);
    // Where the store holds the batch, what waits stays in it.
    let (_, order) = pass(residents(20, 1), 10, &CELLS, 1 << 20);
    assert_eq!(told(&order, measure::SPILLED_WRITTEN), 0.0);
    assert_eq!(told(&order, measure::ON_CHIP), (7 * 8 + 4 * 8 + 3 * 44) as f64);
    // What three casts of ten photons answer, a tenth waits after.
    let (_, order) = pass(residents(10, 3), 1, &CELLS, 1 << 20);
    assert_eq!(told(&order, measure::SPILLED_WRITTEN), 44.0);
    assert_eq!(told(&order, measure::RAYS_CAST_AGAIN), 2.0 * 2.0 * 10.0);
}
