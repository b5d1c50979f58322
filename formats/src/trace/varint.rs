//! Variable-length integers: seven bits a byte, low bits first, the high bit set on all bytes but the last (LEB128).

pub(super) fn push(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// Takes an integer from the front of `bytes`; `None` if they end too early or it does not fit 64 bits.
pub(super) fn take(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        let part = u64::from(byte & 0x7f);
        if part << shift >> shift != part {
            return None;
        }
        value |= part << shift;
        if byte < 0x80 {
            return Some(value);
        }
    }
    None
}

/// The same as [`take`], faster where eight bytes more are there and the integer takes no more of them.
#[inline(always)]
pub(super) fn take_fast(bytes: &mut &[u8]) -> Option<u64> {
    let Some(eight) = bytes.first_chunk::<8>() else { return take(bytes) };
    let word = u64::from_le_bytes(*eight);
    let ends = !word & 0x8080_8080_8080_8080;
    if ends == 0 {
        return take(bytes);
    }
    // The bits up to that of the first byte that ends it.
    let bits = ends.trailing_zeros() + 1;
    *bytes = &bytes[bits as usize / 8..];
    let of_it = word & (u64::MAX >> (64 - bits)) & 0x7f7f_7f7f_7f7f_7f7f;
    // Groups of 7 bits side by side, then of 14, then of 28.
    let pairs = (of_it & 0x007f_007f_007f_007f) | (of_it & 0x7f00_7f00_7f00_7f00) >> 1;
    let fours = (pairs & 0x0000_3fff_0000_3fff) | (pairs & 0x3fff_0000_3fff_0000) >> 2;
    Some((fours & 0x0fff_ffff) | (fours & 0x0fff_ffff_0000_0000) >> 4)
}

/// Signed to unsigned, small magnitudes to small numbers: 0, -1, 1, -2 become 0, 1, 2, 3.
pub(super) const fn zigzag(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)) as u64
}

pub(super) const fn unzigzag(value: u64) -> i64 {
    (value >> 1) as i64 ^ -((value & 1) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn integers_come_back(value in any::<u64>(), signed in any::<i64>()) {
            let mut bytes = vec![];
            push(&mut bytes, value);
            push(&mut bytes, zigzag(signed));
            let mut fast = &bytes[..];
            prop_assert_eq!(take_fast(&mut fast), Some(value));
            prop_assert_eq!(take_fast(&mut fast).map(unzigzag), Some(signed));
            prop_assert_eq!(take_fast(&mut fast), None);
            let mut rest = &bytes[..];
            prop_assert_eq!(take(&mut rest), Some(value));
            prop_assert_eq!(take(&mut rest).map(unzigzag), Some(signed));
            prop_assert_eq!(take(&mut rest), None);
        }
    }

    proptest! {
        #[test]
        fn the_fast_way_takes_what_the_slow_one_takes(bytes in prop::collection::vec(any::<u8>(), 0..24), high in any::<u64>()) {
            // Also integers of many bytes, and such as are longer than they need to be.
            let bytes: Vec<u8> = bytes.iter().enumerate().map(|(at, byte)| byte | ((high >> at & 1) as u8) << 7).collect();
            let (mut fast, mut slow) = (&bytes[..], &bytes[..]);
            while !slow.is_empty() {
                let taken = take(&mut slow);
                prop_assert_eq!(take_fast(&mut fast), taken);
                if taken.is_none() {
                    break;
                }
                prop_assert_eq!(fast, slow);
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert_eq!(take(&mut &[0xff; 9][..]), None);
        assert_eq!(take(&mut &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x02][..]), None);
        assert_eq!(zigzag(-1), 1);
    }
}
