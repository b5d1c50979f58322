//! The photon of a rank along an axis, with those before it in front of it: what every median split asks for.

/// A photon on its way into a tree.
pub(super) trait Placed: Copy {
    /// Where it is along an axis.
    fn coordinate(&self, axis: usize) -> f32;

    /// Which it is; below 2^31.
    fn id(&self) -> u32;
}

/// Puts the photon of the rank `nth` along an axis there, ties by id, those before it in front of it and the others behind it.
/// There are no NaNs among photons that were checked; -0 and 0 are one coordinate.
///
/// # Panics
/// If there are not that many.
#[inline]
pub(super) fn select_nth<T: Placed>(photons: &mut [T], nth: usize, axis: usize) {
    match photons.len() {
        ..=1 => {}
        2..=8 => sort::<8, T>(photons, axis),
        9..=16 => sort::<16, T>(photons, axis),
        17..=32 => sort::<32, T>(photons, axis),
        _ => _ = photons.select_nth_unstable_by_key(nth, |photon| key(photon.coordinate(axis), photon.id())),
    }
    assert!(nth < photons.len(), "{nth} of {}", photons.len());
}

/// One integer that orders by the coordinate and then the id: a comparison of these takes no branch.
#[inline(always)]
fn key(coordinate: f32, id: u32) -> u64 {
    // Adding 0 makes -0 of them 0. The bits of numbers below 0 order the wrong way round, and behind the others.
    let bits = (coordinate + 0.0).to_bits();
    let ordered = bits ^ (((bits as i32 >> 31) as u32) | 1 << 31);
    u64::from(ordered) << 32 | u64::from(id)
}

/// Sorts up to N: how many are before each is counted, which takes no branch and so is sooner done for a few.
#[inline]
fn sort<const N: usize, T: Placed>(photons: &mut [T], axis: usize) {
    let (mut coordinates, mut ids, mut ranks) = ([0.0; N], [0; N], [0_i32; N]);
    let mut unsorted = [photons[0]; N];
    for (lane, photon) in photons.iter().enumerate() {
        (coordinates[lane], ids[lane]) = (photon.coordinate(axis), photon.id() as i32);
        unsorted[lane] = *photon;
    }
    for other in 0..photons.len() {
        for lane in 0..N {
            let is_before = coordinates[other] < coordinates[lane];
            let is_tied = coordinates[other] == coordinates[lane];
            ranks[lane] += i32::from(is_before | (is_tied & (ids[other] < ids[lane])));
        }
    }
    for lane in 0..photons.len() {
        photons[ranks[lane] as usize] = unsorted[lane];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct One(f32, u32);

    impl Placed for One {
        fn coordinate(&self, _: usize) -> f32 {
            self.0
        }

        fn id(&self) -> u32 {
            self.1
        }
    }

    #[test]
    fn those_before_it_are_in_front_whatever_the_order() {
        let orders: [fn(u32) -> f32; 5] = [
            |at| at as f32,
            |at| -(at as f32),
            |at| (at * 7 % 11) as f32 - 5.0,
            |at| if at % 2 == 0 { 0.0 } else { -0.0 },
            |at| [f32::MIN, f32::MAX, f32::MIN_POSITIVE, -1e-40, 0.0][at as usize % 5],
        ];
        for count in [1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100] {
            for order in orders {
                let unsorted: Vec<One> = (0..count).map(|at| One(order(at), at * 13 % 101)).collect();
                let mut sorted = unsorted.clone();
                sorted.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap().then(a.1.cmp(&b.1)));
                for nth in 0..count as usize {
                    let mut found = unsorted.clone();
                    select_nth(&mut found, nth, 0);
                    let of = |photons: &[One]| {
                        let mut ids: Vec<u32> = photons.iter().map(|photon| photon.1).collect();
                        ids.sort_unstable();
                        ids
                    };
                    assert_eq!(found[nth], sorted[nth], "{nth} of {count}");
                    assert_eq!(of(&found[..nth]), of(&sorted[..nth]), "{nth} of {count}");
                    assert_eq!(of(&found[nth..]), of(&sorted[nth..]), "{nth} of {count}");
                }
            }
        }
    }
}
