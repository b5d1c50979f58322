//! Is every order a permutation, whatever it is given?

use super::*;
use crate::random::{Random, mix};
use bytemuck::Zeroable as _;
use pm_formats::Bounds;

fn queries(n: u32, position: impl Fn(&mut Random) -> [f32; 3]) -> Vec<Query> {
    let mut random = Random::new(&[u64::from(n)]);
    (0..n).map(|i| Query { position: position(&mut random), pixel: i / 4, sample: i % 4, ..Query::zeroed() }).collect()
}

fn reorder(mut order: impl Reorder, batches: &[&[Query]]) -> Vec<(u64, Query)> {
    let mut out = vec![];
    let mut emit = |meta: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|&query| (meta.batch, query)));
        Ok(())
    };
    for (batch, queries) in (0..).zip(batches) {
        // Blocks of a batch come in pieces.
        for piece in queries.chunks(7) {
            order.push(BlockMeta { batch, ..BlockMeta::default() }, piece, &mut emit).unwrap();
        }
    }
    order.drain(&mut emit).unwrap();
    out
}

const UNIT: Bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };

fn hilbert(queries: &[Query]) -> Vec<u32> {
    hilbert_keys(&UNIT, queries, |query| query.position)
}

fn random(queries: &[Query]) -> Vec<u32> {
    queries.iter().map(|query| (mix(u64::from(query.pixel) << 32 | u64::from(query.sample)) >> 32) as u32).collect()
}

fn multiset(queries: impl IntoIterator<Item = Query>) -> Vec<Vec<u8>> {
    let mut all: Vec<_> = queries.into_iter().map(|query| bytemuck::bytes_of(&query).to_vec()).collect();
    all.sort();
    all
}

#[test]
fn every_order_is_a_permutation() {
    let cube = |random: &mut Random| [(); 3].map(|()| random.unit());
    for n in [0, 1, 2, 5000] {
        for all in [queries(n, cube), queries(n, |_| [0.5; 3]), queries(n, |_| [f32::MAX, f32::MIN, 0.0])] {
            let (first, second) = all.split_at(all.len() / 3);
            for per in [Per::Batch, Per::Image] {
                for out in [
                    reorder(Sorted::new(per, hilbert), &[first, second]),
                    reorder(Sorted::new(per, random), &[first, second]),
                ] {
                    assert_eq!(multiset(out.iter().map(|&(_, query)| query)), multiset(all.iter().copied()));
                }
            }
        }
    }
}

#[test]
fn per_batch_stays_in_its_batch_and_per_image_is_one() {
    let all = queries(300, |random| [(); 3].map(|()| random.unit()));
    let (first, second) = all.split_at(100);
    let out = reorder(Sorted::new(Per::Batch, hilbert), &[first, second]);
    assert!(out[..100].iter().all(|&(batch, query)| batch == 0 && first.contains(&query)));
    assert!(out[100..].iter().all(|&(batch, query)| batch == 1 && second.contains(&query)));
    let out = reorder(Sorted::new(Per::Image, hilbert), &[first, second]);
    assert!(out.iter().all(|&(batch, _)| batch == 0));
    let keys = hilbert(&out.iter().map(|&(_, query)| query).collect::<Vec<_>>());
    assert!(keys.is_sorted());
}

#[test]
fn equal_keys_keep_their_order() {
    let all = queries(50, |_| [0.25; 3]);
    let out: Vec<_> = reorder(Sorted::new(Per::Image, hilbert), &[&all]).into_iter().map(|(_, query)| query).collect();
    assert_eq!(out, all);
}
