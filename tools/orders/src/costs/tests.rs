//! Are queries beyond the store counted as they go and come?

use super::*;

const fn store(bytes: u64) -> Store {
    Store { bytes, record: StoredQuery::Full }
}

#[test]
fn queries_beyond_the_store_are_written_and_read() {
    let mut costs = Costs::new(store(44 * 2));
    let inside: Vec<bool> = (0..4).map(|_| costs.admit()).collect();
    assert_eq!(inside, [true, true, false, false]);
    costs.release(true);
    assert!(costs.admit());
    inside.into_iter().for_each(|inside| costs.release(inside));
    let measure =
        |name: &str| costs.measures().into_iter().find(|(known, _)| known == name).map(|(_, number)| number).unwrap();
    assert_eq!(measure(measure::PEAK_QUERIES_HELD), Number::Count(4));
    assert_eq!(measure(measure::STORAGE), Number::Bytes(4 * 44));
    assert_eq!(measure(measure::STORAGE_COMPACT), Number::Bytes(4 * 9));
    assert_eq!(measure(measure::ON_CHIP), Number::Bytes(2 * 44));
    assert_eq!(measure(measure::SPILLED_WRITTEN), Number::Bytes(2 * 44));
    assert_eq!(measure(measure::SPILLED_READ), Number::Bytes(2 * 44));
}
