//! Is every order a permutation, whatever it is given, and does it hold no more than it says?

use super::*;
use bytemuck::Zeroable as _;
use pm_curves::{Grid, hilbert_keys, morton_keys};
use pm_formats::vocabulary::measure;
use pm_formats::{BlockMeta, Bounds};
use pm_random::{Random, mix};

fn queries(n: u32, position: impl Fn(&mut Random) -> [f32; 3]) -> Vec<Query> {
    let mut random = Random::new(&[u64::from(n)]);
    (0..n).map(|i| Query { position: position(&mut random), pixel: i / 4, sample: i % 4, ..Query::zeroed() }).collect()
}

fn in_a_cube(random: &mut Random) -> [f32; 3] {
    [(); 3].map(|()| random.unit())
}

/// What comes out of an order, and what it says of itself. The most that was in it at any time is checked against that.
fn pass(order: &mut Reordering, batches: &[&[Query]]) -> Vec<(u64, Query)> {
    let mut out = vec![];
    let (mut given, mut most) = (0, 0);
    for (batch, queries) in (0..).zip(batches) {
        // Blocks of a batch come in pieces.
        for piece in queries.chunks(7) {
            let meta = BlockMeta { batch, ..BlockMeta::default() };
            let mut emit = |meta: BlockMeta, queries: &[Query]| {
                out.extend(queries.iter().map(|&query| (meta.batch, query)));
                Ok(())
            };
            order.push(meta, piece, &mut emit).unwrap();
            given += piece.len();
            most = most.max(given - out.len());
        }
    }
    let mut emit = |meta: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|&query| (meta.batch, query)));
        Ok(())
    };
    order.drain(&mut emit).unwrap();
    let peak = measure(order, "peak_queries_held") as usize;
    // A piece is taken at once, and what it lets go is given at its end.
    assert!(most <= peak && peak <= most + 7, "{most} queries were held, {peak} are told");
    out
}

fn measure(order: &Reordering, name: &str) -> f64 {
    let measures = order.measures();
    measures.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no {name}")).1.as_f64()
}

const UNIT: Bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };
const STORAGE: u64 = 32 << 10;
const STORE: Store = Store { bytes: STORAGE, record: Record::Full };

fn hilbert(queries: &[Query]) -> Vec<u32> {
    hilbert_keys(&UNIT, queries, |query| query.position)
}

fn random(queries: &[Query]) -> Vec<u32> {
    queries.iter().map(|query| (mix(u64::from(query.pixel) << 32 | u64::from(query.sample)) >> 32) as u32).collect()
}

fn limits(memory: u64) -> Limits {
    Limits { memory, folder: std::env::temp_dir(), announce: Box::new(|| {}) }
}

fn sorted_by_hilbert(per: Per) -> Reordering {
    Reordering::new(per, Box::new(Sorted::new(hilbert, Charge::MergeSort, STORE, 0, limits(1 << 30))))
}

/// Every order, for a scene of these bounds and with this much memory to sort in.
fn every_order(per: Per, bounds: Bounds, memory: u64) -> Vec<(&'static str, Reordering)> {
    type Keys = Box<dyn Fn(&[Query]) -> Vec<u32>>;
    let mut random_photons = Random::new(&[9]);
    let photons: Vec<_> = (0..2000).map(|_| in_a_cube(&mut random_photons)).collect();
    let leaves = MedianSplit::new(photons, 64);
    let (by_leaf, in_leaf, number) = (leaves.clone(), leaves.clone(), leaves.cells());
    let sort = |keys: Keys, charge: Charge| -> Box<dyn Reorder> {
        Box::new(Sorted::new(keys, charge, STORE, 0, limits(memory)))
    };
    let curve = move |queries: &[Query]| hilbert_keys(&bounds, queries, |query| query.position);
    let morton = move |queries: &[Query]| morton_keys(&bounds, queries, |query| query.position);
    let leaf = move |queries: &[Query]| queries.iter().map(|query| by_leaf.cell(query.position)).collect();
    let cell = leaf.clone();
    let grid = Grid::across(&bounds, 32);
    let orders: Vec<(_, Box<dyn Reorder>)> = vec![
        ("hilbert", sort(Box::new(curve), Charge::MergeSort)),
        ("morton", sort(Box::new(morton), Charge::MergeSort)),
        ("leaf", sort(Box::new(leaf), Charge::MergeSort)),
        ("random", sort(Box::new(random), Charge::MergeSort)),
        ("partition", sort(Box::new(curve), Charge::Partition(Partition::new()))),
        ("cells", sort(Box::new(cell), Charge::Cells(number.into()))),
        ("hashed", Box::new(Hashed::new(grid, 7, 16, STORE))),
        ("hashed in one bucket of one", Box::new(Hashed::new(grid, 1, 1, STORE))),
        ("hashed beyond the store", Box::new(Hashed::new(grid, 37, 128, STORE))),
        ("snowplow", Box::new(Snowplow::new(curve, STORE))),
        ("buffered", Box::new(Buffered::new(move |query: &Query| in_leaf.cell(query.position), number, STORE, 0))),
    ];
    orders.into_iter().map(|(name, order)| (name, Reordering::new(per, order))).collect()
}

fn multiset(queries: impl IntoIterator<Item = Query>) -> Vec<Vec<u8>> {
    let mut all: Vec<_> = queries.into_iter().map(|query| bytemuck::bytes_of(&query).to_vec()).collect();
    all.sort();
    all
}

#[test]
fn every_order_is_a_permutation() {
    let flat = Bounds { min: [0.0, 0.5, 0.0], max: [1.0, 0.5, 1.0] };
    let tiny = Bounds { min: [0.0; 3], max: [1e-42; 3] };
    let vast = Bounds { min: [f32::MIN; 3], max: [f32::MAX; 3] };
    for n in [0, 1, 2, 5000] {
        for (bounds, all) in [
            (UNIT, queries(n, in_a_cube)),
            (UNIT, queries(n, |_| [0.5; 3])),
            (UNIT, queries(n, |_| [f32::MAX, f32::MIN, 0.0])),
            (flat, queries(n, |random| [random.unit(), 0.5, random.unit()])),
            (tiny, queries(n, |random| [random.unit() * 1e-42, 0.0, 1e-42])),
            (vast, queries(n, |random| [(random.unit() - 0.5) * f32::MAX, f32::MIN_POSITIVE, -0.0])),
        ] {
            let expected = multiset(all.iter().copied());
            let (first, second) = all.split_at(all.len() / 3);
            for per in [Per::Batch, Per::Image] {
                for (name, mut order) in every_order(per, bounds, 1 << 30) {
                    let out = pass(&mut order, &[first, second]);
                    assert!(
                        multiset(out.iter().map(|&(_, query)| query)) == expected,
                        "{name}, {n} queries, {bounds:?}: no permutation"
                    );
                }
            }
        }
    }
}

#[test]
fn every_order_keeps_to_its_store() {
    let all = queries(20_000, in_a_cube);
    for per in [Per::Batch, Per::Image] {
        for (name, mut order) in every_order(per, UNIT, 1 << 30) {
            let (first, second) = all.split_at(5000);
            pass(&mut order, &[first, second]);
            let tables = match name {
                // Places of 37 buckets beside the store.
                "hashed beyond the store" => 37 * 8,
                _ => 0,
            };
            let on_chip = measure(&order, measure::ON_CHIP);
            assert!(on_chip <= (STORAGE + tables) as f64, "{name}: {on_chip}");
            let (written, read) = (measure(&order, measure::SPILLED_WRITTEN), measure(&order, measure::SPILLED_READ));
            assert_eq!(written, read, "{name}: all that is written is read");
            let streaming = ["snowplow", "buffered", "hashed", "hashed in one bucket of one"].contains(&name);
            assert_eq!(written == 0.0, streaming, "{name}: {written} bytes spilled");
            assert!(measure(&order, measure::STORAGE) / measure(&order, measure::STORAGE_COMPACT) == 44.0 / 9.0);
        }
    }
}

#[test]
fn streaming_orders_hold_no_more_of_a_longer_stream() {
    let room = STORE.room() as f64;
    for (name, most) in
        [("hashed", 7.0 * 16.0), ("hashed beyond the store", 37.0 * 128.0), ("snowplow", room), ("buffered", room)]
    {
        let peak = |n: u32| {
            let all = queries(n, in_a_cube);
            let orders = every_order(Per::Image, UNIT, 1 << 30);
            let (_, mut order) = orders.into_iter().find(|(known, _)| *known == name).unwrap();
            pass(&mut order, &[&all]);
            measure(&order, measure::PEAK_QUERIES_HELD)
        };
        let (short, long) = (peak(20_000), peak(200_000));
        assert!(long <= most && short > 0.8 * most, "{name}: {short} of 20,000, {long} of 200,000");
    }
}

#[test]
fn memory_changes_no_query_and_no_measure() {
    let all = queries(20_000, |random| [random.unit(), (random.unit() * 4.0).floor() / 4.0, 0.25]);
    for per in [Per::Batch, Per::Image] {
        let much = every_order(per, UNIT, 1 << 30);
        let little = every_order(per, UNIT, 64 << 10);
        for ((name, mut in_memory), (_, mut on_disk)) in much.into_iter().zip(little) {
            let (first, second) = all.split_at(5000);
            let (a, b) = (pass(&mut in_memory, &[first, second]), pass(&mut on_disk, &[first, second]));
            assert!(a == b, "{name}: other queries");
            assert_eq!(in_memory.measures(), on_disk.measures(), "{name}");
        }
    }
}

#[test]
fn temporary_files_are_announced_once() {
    let announced = std::rc::Rc::new(std::cell::Cell::new(0));
    let count = announced.clone();
    let announce = Box::new(move || count.set(count.get() + 1));
    let limits = Limits { memory: 64 << 10, folder: std::env::temp_dir(), announce };
    let mut order = Reordering::new(Per::Image, Box::new(Sorted::new(hilbert, Charge::MergeSort, STORE, 0, limits)));
    let all = queries(5000, in_a_cube);
    pass(&mut order, &[&all[..1000]]);
    assert_eq!(announced.get(), 0);
    pass(&mut order, &[&all]);
    assert_eq!(announced.get(), 1);
}

#[test]
fn per_batch_stays_in_its_batch_and_per_image_is_one() {
    let all = queries(300, in_a_cube);
    let (first, second) = all.split_at(100);
    for (name, mut order) in every_order(Per::Batch, UNIT, 1 << 30) {
        let out = pass(&mut order, &[first, second]);
        assert!(out[..100].iter().all(|&(batch, query)| batch == 0 && first.contains(&query)), "{name}");
        assert!(out[100..].iter().all(|&(batch, query)| batch == 1 && second.contains(&query)), "{name}");
    }
    for (name, mut order) in every_order(Per::Image, UNIT, 1 << 30) {
        assert!(pass(&mut order, &[first, second]).iter().all(|&(batch, _)| batch == 0), "{name}");
    }
    let out = pass(&mut sorted_by_hilbert(Per::Image), &[first, second]);
    let keys = hilbert(&out.iter().map(|&(_, query)| query).collect::<Vec<_>>());
    assert!(keys.is_sorted());
}

#[test]
fn equal_keys_keep_their_order() {
    let all = queries(50, |_| [0.25; 3]);
    let out: Vec<_> = pass(&mut sorted_by_hilbert(Per::Image), &[&all]).into_iter().map(|(_, query)| query).collect();
    assert_eq!(out, all);
}

#[test]
fn a_partition_is_the_curve() {
    let all = queries(20_000, in_a_cube);
    let sorted = Sorted::new(hilbert, Charge::Partition(Partition::new()), STORE, 0, limits(1 << 30));
    let mut partition = Reordering::new(Per::Image, Box::new(sorted));
    assert!(pass(&mut partition, &[&all]) == pass(&mut sorted_by_hilbert(Per::Image), &[&all]));
    // What is told of it: all out and in once, of partitions that fit the store.
    let once = 20_000.0 * 44.0;
    assert!((once..1.1 * once).contains(&measure(&partition, measure::SPILLED_WRITTEN)));
    assert!(measure(&partition, "partitions") >= once / STORAGE as f64);
}
