//! Do searches come back from any of them on?

use super::*;
use pm_formats::trace::AccessKind;
use proptest::prelude::*;

fn any_access() -> impl Strategy<Value = Access> {
    let kind = prop_oneof![Just(AccessKind::Read), Just(AccessKind::Write), Just(AccessKind::ReadModifyWrite)];
    let offset = prop_oneof![0u64..500, any::<u64>()];
    let len = prop_oneof![Just(20u32), any::<u32>()];
    (kind, 0u16..2, len, offset).prop_map(|(kind, region, len, offset)| Access { kind, region, len, offset })
}

proptest! {
    #[test]
    fn searches_come_back_from_any_of_them_on(
        searches in prop::collection::vec(
            (any::<bool>(), prop::collection::vec(any::<u32>(), 0..4), prop::collection::vec(any_access(), 0..3000)),
            1..8,
        ),
        from in any::<prop::sample::Index>(),
    ) {
        let mut spool = Spool::new().unwrap();
        spool.search(false, &[1, 2, 3]).unwrap();
        spool.clear().unwrap();
        let (mut marks, mut events) = (vec![], vec![]);
        for (warm_up, destinations, accesses) in searches {
            marks.push((spool.mark(), events.len()));
            spool.search(warm_up, &destinations).unwrap();
            accesses.iter().for_each(|&access| spool.access(access).unwrap());
            spool.search_end().unwrap();
            events.push(Event::Search { warm_up, destinations });
            events.extend(accesses.into_iter().map(Event::Access));
            events.push(Event::SearchEnd);
        }
        let end = spool.mark();
        spool.flush().unwrap();
        let (place, first) = marks[from.index(marks.len())];
        let mut cursor = spool.cursor(place, end);
        for event in &events[first..] {
            let found = cursor.next_event().unwrap();
            prop_assert_eq!(found.as_ref(), Some(event));
        }
        prop_assert_eq!(cursor.next_event().unwrap(), None);
    }
}
