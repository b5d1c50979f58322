//! Is a batch answered as its queries are one by one, and are the photons read once for all of them?

use super::*;
use crate::trial::{batch_finds_what_each_query_finds, cases, photons, query_points, random_points};
use crate::{Search, SearchReads};

fn built(photons: &[Photon], batch: usize, candidates: Candidates) -> ReverseMap {
    ReverseMap::build(photons, 128, batch, (10, candidates)).unwrap()
}

#[test]
fn a_batch_finds_what_looking_at_all_photons_finds_for_each_query() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        for candidates in [Candidates::Chip, Candidates::Memory] {
            let map = built(&photons, query_points(&positions).len(), candidates);
            for search in
                [Search::new(10, f32::INFINITY), Search::new(10, 0.05), Search { start: 0.01, ..Search::new(10, 0.3) }]
            {
                batch_finds_what_each_query_finds(name, &map, &positions, &search);
            }
        }
    }
}

#[test]
fn photons_are_read_once_a_batch_and_once_more_for_those_who_found_too_few() {
    // A line of photons 1 apart, 6 in a line of memory: 17 lines.
    let photons = photons((0..100u8).map(|x| [f32::from(x), 0.0, 0.0]));
    let map = built(&photons, 3, Candidates::Chip);
    let reads = |start: f32, points: &[[f32; 3]]| {
        let mut reads = SearchReads::default();
        let mut found: Vec<_> = points.iter().map(|_| Nearest::new(10, 0.0)).collect();
        let attempts = Search { start, ..Search::new(10, f32::INFINITY) }.run_all(&map, points, &mut found, &mut reads);
        let records: Vec<u32> = reads.runs().flat_map(|run| run.1.to_vec()).collect();
        assert!(records.iter().copied().eq((0..17).cycle().take(records.len())) && found.iter().all(Nearest::is_full));
        (attempts, records.len() / 17)
    };
    let middle = [[50.0, 0.0, 0.0], [30.0, 0.0, 0.0], [20.0, 1.0, 0.0]];
    assert_eq!(reads(f32::INFINITY, &middle), (3, 1));
    assert_eq!(reads(5.0, &middle), (4, 2), "the third has nine photons within 5");
    assert_eq!(
        reads(5.0, &[[50.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
        (3, 2),
        "the second has six within 5, eleven within 10"
    );
    assert_eq!(reads(1.0, &[[50.0, 0.0, 0.0]]), (4, 4), "3, 5, 9, 17 photons");
}

#[test]
fn the_index_offers_a_photon_to_every_query_that_wants_it() {
    let points = random_points(200, |p| p);
    let mut held: Vec<_> = points.iter().map(|_| Nearest::new(3, 0.02)).collect();
    let mut found: Vec<&mut Nearest> = held.iter_mut().collect();
    let mut index = QueryIndex::new(&points, &found);
    let mut skipped = 0;
    for (id, photon) in (0..).zip(random_points(300, |[x, y, z]| [z, x, y])) {
        let wanted: Vec<usize> = (0..points.len())
            .filter(|&at| crate::geometry::distance_squared(points[at], photon) <= found[at].bound())
            .collect();
        let mut offered = vec![];
        let examined = index.offer(photon, |query, distance| {
            if distance <= found[query].bound() {
                offered.push(query);
            }
            found[query].show(distance, id);
            found[query].bound()
        });
        offered.sort_unstable();
        assert_eq!(offered, wanted, "{photon:?}");
        skipped += points.len() - examined;
    }
    assert!(skipped > 100 * 300, "an index that looks at nearly every query is none: {skipped}");
}

#[test]
fn candidates_in_memory_are_touched_as_a_heap_is() {
    // Ten photons that come nearer and nearer, for k = 3: three go in, all are looked at to make the heap, and each of the
    // seven others takes the place of the farthest: both children, and where it goes.
    let photons = photons((0..10u8).map(|i| [10.0 - f32::from(i), 0.0, 0.0]));
    let map = ReverseMap::build(&photons, 128, 1, (3, Candidates::Memory)).unwrap();
    let mut reads = SearchReads::default();
    map.nearest([0.0; 3], &mut Nearest::new(3, f32::INFINITY), &mut reads);
    let slots: Vec<u32> = reads.runs().filter(|run| run.0 == CANDIDATES).flat_map(|run| run.1.to_vec()).collect();
    assert_eq!(slots[..3], [0, 1, 2], "in a row while there is room");
    assert_eq!(slots[slots.len() - 3..], [0, 1, 2], "and once more in the end");
    assert!(
        slots.iter().all(|&slot| slot < 3) && (3 + 3 + 7..3 + 6 + 7 * 4 + 3 + 1).contains(&slots.len()),
        "{slots:?}"
    );
    assert_eq!((map.bytes_on_chip(), built(&photons, 5, Candidates::Chip).bytes_on_chip()), (48, 5 * (48 + 80)));
}
