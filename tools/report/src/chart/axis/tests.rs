//! Scales follow the values, and ticks are round.

use super::*;

fn axis(label: &str, values: &[f64]) -> Axis {
    Axis::fit(label, Scale::Auto, vec![], values.iter().copied()).expect("an axis")
}

#[test]
fn the_scale_follows_the_values() {
    assert_eq!(axis("ways", &[1.0, 3.0, 16.0]).scale, Scale::Linear);
    assert_eq!(axis("ways", &[1.0, 2.0]).scale, Scale::Linear);
    // Powers of two are doublings, however few.
    assert_eq!(axis("ways", &[1.0, 2.0, 16.0]).scale, Scale::Log2);
    assert_eq!(axis("size", &[1024.0, 4096.0, 1_048_576.0]).scale, Scale::Log2);
    assert_eq!(axis("fetches", &[0.03, 71.0]).scale, Scale::Log10);
    assert_eq!(axis("fetches", &[0.0, 71.0]).scale, Scale::Linear);
    let refused = Axis::fit("n", Scale::Log10, vec![], [3.0, 0.0].into_iter());
    assert_eq!(refused, Err(0.0));
}

#[test]
fn ticks_are_round_and_within() {
    for (values, scale, expected) in [
        (vec![0.0, 100.0], Scale::Linear, "0 20 40 60 80 100"),
        (vec![4096.0, 131_072.0], Scale::Log2, "4K 8K 16K 32K 64K 128K"),
        (vec![0.5, 2e6], Scale::Log10, "1 10 100 1000 10k 100k 1M"),
        (vec![12.0, 80.0], Scale::Log10, "20 50"),
        (vec![1e6, 1.1e6], Scale::Linear, "1M 1.02M 1.04M 1.06M 1.08M 1.1M"),
    ] {
        let label = if scale == Scale::Log2 { "size" } else { "n" };
        let axis = Axis::fit(label, scale, vec![], values.iter().copied()).expect("an axis");
        let (low, high) = axis.range(values.iter().copied());
        let ticks = axis.ticks(low, high, 10);
        assert!(ticks.iter().all(|tick| (low..=high).contains(tick)));
        let labels: Vec<String> = ticks.iter().map(|&tick| axis.tick_label(tick)).collect();
        assert_eq!(labels.join(" "), expected, "{values:?} {scale:?}");
    }
}

#[test]
fn whole_numbers_keep_all_their_digits() {
    let lines = [32.0, 1024.0];
    let axis = Axis::fit("line", Scale::Log2, vec![], lines.into_iter()).expect("an axis");
    let labels: Vec<String> = axis.ticks(5.0, 10.0, 10).iter().map(|&tick| axis.tick_label(tick)).collect();
    assert_eq!(labels.join(" "), "32 64 128 256 512 1024");
}

#[test]
fn letters_of_an_axis_are_of_one_kind() {
    let labels = |label: &str, scale: Scale, values: [f64; 2]| {
        let axis = Axis::fit(label, scale, vec![], values.into_iter()).expect("an axis");
        let (low, high) = axis.range(values.into_iter());
        axis.ticks(low, high, 4).iter().map(|&tick| axis.tick_label(tick)).collect::<Vec<_>>().join(" ")
    };
    // Powers of 1024 where doublings are equal lengths, powers of 1000 elsewhere; of bytes with their unit.
    assert_eq!(labels("lines", Scale::Log2, [4096.0, 262_144.0]), "4096 16K 64K 256K");
    assert_eq!(labels("bytes", Scale::Log10, [1e4, 1e7]), "10kB 100kB 1MB 10MB");
    assert_eq!(labels("bytes", Scale::Linear, [0.0, 65536.0 * 4.0]), "0 100kB 200kB");
}

#[test]
fn small_ticks_stand_between_the_others() {
    let axis = Axis::fit("n", Scale::Log10, vec![], [1.0, 100.0].into_iter()).expect("an axis");
    let places = axis.small_ticks(0.0, 2.0);
    assert_eq!(places.len(), 16);
    assert!((places[0] - 2.0_f64.log10()).abs() < 1e-12 && places.iter().all(|place| (0.0..=2.0).contains(place)));
    assert!(axis.small_ticks(-10.0, 10.0).is_empty(), "too many to be told apart");
    let linear = Axis::fit("n", Scale::Linear, vec![], [1.0, 100.0].into_iter()).expect("an axis");
    assert!(linear.small_ticks(0.0, 2.0).is_empty());
}

#[test]
fn all_values_lie_within_the_range_even_if_there_is_but_one() {
    for values in [vec![5.0], vec![0.0], vec![-3.0, -1.0], vec![1e-9, 1e12]] {
        let axis = axis("n", &values);
        let (low, high) = axis.range(values.iter().copied());
        assert!(low < high && values.iter().all(|&x| (low..=high).contains(&axis.place(x))), "{values:?}");
    }
}

#[test]
fn words_stand_at_whole_numbers() {
    let axis = Axis::fit("ways", Scale::Auto, vec!["1".into(), "full".into()], [0.0, 1.0].into_iter()).unwrap();
    let (low, high) = axis.range([0.0, 1.0].into_iter());
    let labels: Vec<String> = axis.ticks(low, high, 10).into_iter().map(|place| axis.tick_label(place)).collect();
    assert_eq!(labels, ["1", "full"]);
}
