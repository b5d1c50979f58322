//! Colours come back as nearly as eight bits allow, and on the average exactly.

use super::*;
use proptest::prelude::*;

#[test]
fn known_colours() {
    // Ward's own example: white of radiance 1 is mantissa 128 at exponent 129.
    assert_eq!(pack_rgbe([1.0, 1.0, 1.0], [0.5; 3]), Some([128, 128, 128, 129]));
    assert_eq!(pack_rgbe([0.0; 3], [0.0; 3]), Some([0; 4]));
    assert_eq!(unpack_rgbe([128, 64, 0, 129]), [1.0, 0.5, 0.0]);
    assert_eq!(pack_rgbe([f32::NAN, 0.0, 0.0], [0.5; 3]), None);
    assert_eq!(pack_rgbe([-1.0, 0.0, 0.0], [0.5; 3]), None);
    assert_eq!(pack_rgbe([f32::MAX, 0.0, 0.0], [0.5; 3]), None);
}

#[test]
fn the_largest_mantissa_never_overflows() {
    // 255.9 would round up to 256: it must move to the next exponent instead.
    let packed = pack_rgbe([255.9, 1.0, 0.0], [0.0; 3]).unwrap();
    let back = unpack_rgbe(packed);
    assert!((back[0] - 255.9).abs() <= 2.0, "{back:?}");
}

#[test]
fn rounding_is_unbiased() {
    // The mean over uniform thresholds is the number itself: a plain round or floor fails.
    for value in [0.7317_f32, 255.3e-6, 254.9, 1.003e12, 3.1e-12] {
        let n = 4096;
        let mean: f64 = (0..n)
            .map(|i| unpack_rgbe(pack_rgbe([value, value / 3.0, 0.0], [(i as f32 + 0.5) / n as f32; 3]).unwrap()))
            .map(|rgb| rgb[0] + rgb[1])
            .sum::<f64>()
            / f64::from(n);
        let exact = f64::from(value) + f64::from(value / 3.0);
        assert!((mean / exact - 1.0).abs() < 2e-5, "{value}: {mean} for {exact}");
    }
}

#[test]
fn a_million_random_powers_keep_their_mean() {
    // Numbers and thresholds of SplitMix64 (Steele, Lea, Flood: *Fast Splittable Pseudorandom Number Generators*,
    // OOPSLA 2014). Within 0.05 % in each channel; rounding down would lose 0.3 % of the brightest and more of others.
    let mut state = 0u64;
    let mut random = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    };
    let (mut exact, mut packed) = ([0f64; 3], [0f64; 3]);
    for _ in 0..1_000_000 {
        let scale = 10f32.powf(random() * 4.0 - 2.0);
        let rgb = [random(), random(), random()].map(|x| x * scale);
        let back = unpack_rgbe(pack_rgbe(rgb, [random(), random(), random()]).unwrap());
        (0..3).for_each(|c| {
            exact[c] += f64::from(rgb[c]);
            packed[c] += back[c];
        });
    }
    for channel in 0..3 {
        let ratio = packed[channel] / exact[channel];
        assert!((ratio - 1.0).abs() < 5e-4, "channel {channel}: mean of the packed / mean = {ratio}");
    }
}

proptest! {
    #[test]
    fn colours_come_back(r in 0f32..1e3, g in 0f32..1e3, b in 0f32..1e3, t in 0f32..1.0) {
        let back = unpack_rgbe(pack_rgbe([r, g, b], [t; 3]).unwrap());
        let largest = f64::from(r.max(g).max(b));
        for (x, y) in [r, g, b].into_iter().zip(back) {
            prop_assert!((f64::from(x) - y).abs() <= largest / 127.0);
        }
    }
}
