//! Do intervals hold the truth as often as they say?

use super::*;
use pm_random::Random;

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs().max(1.0)
}

#[test]
fn pairs_and_a_triple_by_hand() {
    // (1 - 3)^2, then 3/2 of the squares about the mean 4 of 2, 4 and 6.
    let spread = Spread::of_sum(&[1.0, 3.0, 2.0, 4.0, 6.0]);
    assert!(close(spread.variance, 4.0 + 1.5 * 8.0), "{spread:?}");
    // 16^2 / (4^2 / 3 + 12^2 / 2) - 2.
    assert!(close(spread.freedom, 256.0 / (16.0 / 3.0 + 72.0) - 2.0), "{spread:?}");
    assert!(close(Spread::of_sum(&[1.0, 4.0]).variance, 9.0));
    assert!(close(Spread::of_sum(&[1.0, 4.0]).freedom, 1.0));
    // No more than there are pairs.
    assert!(close(Spread::of_sum(&[0.0, 1.0].repeat(50)).freedom, 50.0));
    assert_eq!(Spread::of_sum(&[5.0]), Spread::default());
    assert!(Spread::of_sum(&[5.0]).half_width().is_nan());
}

#[test]
fn a_ratio_by_hand() {
    let ratio = Ratio::of(&[2.0, 6.0], &[1.0, 3.0]);
    assert!(close(ratio.value, 2.0) && close(ratio.weight, 4.0) && close(ratio.spread.variance, 0.0));
    let ratio = Ratio::of(&[2.0, 7.0], &[1.0, 2.0]);
    // Residuals -1 and 1: variance 4 over 3^2.
    assert!(close(ratio.value, 3.0) && close(ratio.spread.variance, 4.0 / 9.0));
    assert!(close(ratio.spread.half_width(), libm::tan(0.475 * std::f64::consts::PI) * 2.0 / 3.0));
}

#[test]
fn what_is_unknown_is_halved() {
    let (most, unknown, below) = ([4.0, 10.0, 7.0], [2.0, 0.0, 1.0], [1.0, 2.0, 2.0]);
    let ratio = Ratio::between(&most, &unknown, &below);
    assert_eq!(Ratio { doubt: 0.0, ..ratio }, Ratio::of(&[3.0, 10.0, 6.5], &below));
    assert!(close(ratio.doubt, 1.5 / 5.0) && close(ratio.value - ratio.doubt, 18.0 / 5.0));
    let total = Ratio::total(&most, &unknown, 0.1);
    assert!(close(total.value, 195.0) && close(total.doubt, 15.0));
    assert!(close(total.spread.variance, 100.0 * Spread::of_sum(&[3.0, 10.0, 6.5]).variance));
}

#[test]
fn a_ratio_is_known_from_its_interval() {
    let ratio = Ratio::between(&[4.0, 10.0, 7.0, 8.0], &[2.0, 0.0, 1.0, 0.0], &[1.0, 2.0, 2.0, 3.0]);
    let Ratio { value, weight, spread, doubt } = ratio;
    let again = Ratio::of_interval(value, weight, ratio.half_width(), doubt, spread.freedom);
    assert!(close(again.spread.variance, spread.variance) && again.spread.freedom == spread.freedom);
    assert_eq!((again.value, again.weight, again.doubt), (value, weight, doubt));
    let unknown = Ratio::of_interval(value, weight, f64::NAN, doubt, 0.0);
    assert!(unknown.spread == Spread::default() && unknown.half_width().is_nan());
}

#[test]
fn samples_put_together_are_weighted_by_size() {
    let one = Ratio { value: 1.0, weight: 3.0, spread: Spread { variance: 4.0, freedom: 9.0 }, doubt: 0.4 };
    let other = Ratio { value: 5.0, weight: 1.0, spread: Spread { variance: 16.0, freedom: 4.0 }, doubt: 0.8 };
    let both = one.with(other);
    assert!(close(both.value, 2.0) && close(both.weight, 4.0) && close(both.doubt, 0.5));
    assert!(close(both.half_width(), both.spread.half_width() + 0.5));
    assert!(close(both.spread.variance, 4.0 * 9.0 / 16.0 + 1.0));
    assert!(close(both.spread.freedom, 3.25 * 3.25 / (2.25 * 2.25 / 9.0 + 0.25)));
}

/// A number that is normal enough: the sum of twelve.
fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| f64::from(random.unit())).sum::<f64>() - 6.0
}

#[test]
fn satterthwaite_is_about_right_for_equal_pairs() {
    let (pairs, trials) = (40, 4000);
    let mut random = Random::new(&[5]);
    let freedom: f64 = (0..trials)
        .map(|_| Spread::of_sum(&(0..2 * pairs).map(|_| normal(&mut random)).collect::<Vec<_>>()).freedom)
        .sum::<f64>()
        / f64::from(trials);
    // What is above 40 is cut off.
    assert!((33.0..40.0).contains(&freedom), "{freedom}");
}

/// A population of cells in strata: what each has above and below the line. It trends, wobbles, and is skewed.
fn population(strata: usize, cells: usize, seed: u64) -> Vec<Vec<(f64, f64)>> {
    let mut random = Random::new(&[seed]);
    (0..strata)
        .map(|stratum| {
            let level = 50.0 + 20.0 * (stratum as f64 / 9.0).sin();
            (0..cells)
                .map(|_| {
                    let below = 150.0 + f64::from(random.unit()) * 106.0;
                    (below * (level + 40.0 * f64::from(random.unit()).powi(3)), below)
                })
                .collect()
        })
        .collect()
}

#[test]
fn intervals_hold_the_truth_of_a_population_made_up() {
    for (strata, least) in [(10, 0.93), (41, 0.935), (120, 0.935)] {
        let population = population(strata, 30, 9);
        let all: Vec<(f64, f64)> = population.iter().flatten().copied().collect();
        let truth = all.iter().map(|cell| cell.0).sum::<f64>() / all.iter().map(|cell| cell.1).sum::<f64>();
        let seeds = 2000;
        let (mut held, mut widths, mut squares) = (0, 0.0, 0.0);
        for seed in 0..seeds {
            let mut random = Random::new(&[77, seed]);
            let chosen: Vec<(f64, f64)> =
                population.iter().map(|cells| cells[random.next_u64() as usize % cells.len()]).collect();
            let (above, below): (Vec<f64>, Vec<f64>) = chosen.into_iter().unzip();
            let ratio = Ratio::of(&above, &below);
            held += u32::from((ratio.value - truth).abs() <= ratio.spread.half_width());
            widths += ratio.spread.half_width() / seeds as f64;
            squares += (ratio.value - truth).powi(2) / seeds as f64;
        }
        let share = f64::from(held) / seeds as f64;
        assert!((least..0.985).contains(&share), "{strata} strata: {share}");
        // Not wider than need be: 1.96 standard errors, more where there are few degrees of freedom.
        let wide = widths / (1.96 * squares.sqrt());
        assert!((0.9..if strata > 20 { 1.3 } else { 1.6 }).contains(&wide), "{strata} strata: {wide}");
    }
}
