//! Choices in a world whose errors and costs are known in closed form.

use super::*;
use crate::survey::{Layer, Survey};
use crate::{Estimate, Law, Times};

/// A world whose errors and costs are known in closed form.
fn world(scale: f64) -> Model {
    let known = |value: f64| Estimate { value, ..Estimate::default() };
    let soft = Layer {
        rays: vec![known(0.04); KS.len()],
        photons: vec![known(1.0); KS.len()],
        lumps: vec![0.0; KS.len()],
        bias: Law { scale: known(scale), power: 1.0 },
    };
    let survey = Survey {
        soft,
        rays: DESIGNS.map(|[gathers, shadows]| known(0.16 / f64::from(gathers) + 0.01 / f64::from(shadows))),
        times: Times {
            photon: 1e-6,
            rays: DESIGNS.map(|[gathers, shadows]| 1e-6 * f64::from(1 + gathers) + 1e-7 * f64::from(shadows)),
            searches: vec![(5, 1e-6), (10, 2e-6), (20, 4e-6), (40, 8e-6), (80, 16e-6)],
            of: 100_000,
            ..Times::default()
        },
        ..Survey::default()
    };
    Model::new(survey)
}

/// The same found by trying everything.
fn by_force(model: &Model, pixels: f64, error: f64) -> f64 {
    let mut best = f64::INFINITY;
    for recipe in skeletons(0) {
        for &samples in GRIDS.iter() {
            let recipe = Recipe { samples, ..recipe };
            if model.predict(&recipe).total().value <= error * error {
                best = best.min(model.times().of(&recipe, pixels));
            }
        }
    }
    best
}

#[test]
fn the_cheapest_is_found() {
    for (scale, error) in [(0.0, 0.05), (1e4, 0.02), (1e7, 0.03)] {
        let model = world(scale);
        let found = choose(&model, 1e4, error, 0.0, 0);
        let least = by_force(&model, 1e4, error);
        assert!(found.iter().any(|choice| (choice.cost / least - 1.0).abs() < 1e-12));
        assert!(found.iter().all(|choice| choice.parts.total().value <= error * error));
        // First those that cost about as much, by their photons; then the others, by their cost.
        let alike = found.partition_point(|choice| choice.cost <= 1.1 * least);
        assert!(alike > 1 && found[..alike].is_sorted_by_key(|choice| choice.recipe.photons));
        assert!(found[alike..].is_sorted_by_key(|choice| choice.cost) && found[alike].cost > 1.1 * least);
    }
}

#[test]
fn photons_of_a_large_picture_count_as_often_as_planning_traces_them() {
    let model = Model {
        survey: Survey { times: Times { photon: 1e-3, ..world(1e4).survey.times }, ..world(1e4).survey },
        ..world(1e4)
    };
    let pixels = 512.0 * 512.0;
    let found = choose(&model, pixels, 0.02, 0.0, 0);
    let whole =
        |choice: &Choice| model.times().of(&choice.recipe, pixels) + 10.0 * model.times().of(&choice.recipe, 0.0);
    let least = found.iter().map(whole).fold(f64::INFINITY, f64::min);
    let alike = found.partition_point(|choice| whole(choice) <= 1.1 * least);
    assert!(alike > 0 && found[alike..].is_sorted_by_key(whole));
    // What is cheapest alone has more.
    let alone = found.iter().min_by(|a, b| a.cost.total_cmp(&b.cost)).unwrap();
    assert!(found[..alike].iter().all(|choice| choice.recipe.photons < alone.recipe.photons), "{alone:?}");
}

#[test]
fn frontiers_are_of_the_cheapest_for_each_error() {
    let model = world(1e7);
    let errors = [0.02, 0.03, 0.1, 1e-9];
    let found = frontier(&model, 1e4, &errors, 0);
    let by_force = errors.map(|error| by_force(&model, 1e4, error));
    // The last is had by nothing.
    assert_eq!(found.len(), 3);
    assert!(found.iter().zip(by_force).all(|(choice, cost)| (choice.cost / cost - 1.0).abs() < 1e-12));
    let fixed = frontier_of_map(&model, 1e4, &errors, 0, (5_000_000, 10));
    assert!(fixed.iter().all(|choice| (choice.recipe.photons, choice.recipe.k) == (5_000_000, 10)));
    assert!(!fixed.is_empty() && fixed.iter().zip(&found[3 - fixed.len()..]).all(|(a, b)| a.cost >= b.cost));
}

#[test]
fn blur_asks_for_photons() {
    let [sharp, blurred] = [0.0, 1e7].map(|scale| choose(&world(scale), 1e4, 0.03, 0.0, 0)[0].recipe);
    assert!(blurred.share() < sharp.share(), "{sharp:?} {blurred:?}");
    // x^2 1e7 alone is at most the square of the error.
    assert!(blurred.share() <= 0.03 / libm::sqrt(1e7));
}

#[test]
fn what_nothing_reaches_has_a_nearest_point() {
    let model = world(1e7);
    assert!(choose(&model, 1e4, 1e-6, 0.0, 0).is_empty());
    let near = nearest_in(&model, 1e4, 10.0, 0).unwrap();
    assert!(near.cost <= 10.0);
    let error = libm::sqrt(near.parts.total().value);
    // Nothing that is cheaper has less error.
    let cheapest =
        |error: f64| choose(&model, 1e4, error, 0.0, 0).iter().map(|choice| choice.cost).fold(f64::INFINITY, f64::min);
    assert!(cheapest(error * 1.000_001) <= 10.0 && cheapest(error * 0.99) > 10.0);
}

#[test]
fn levels_are_round() {
    assert_eq!(levels(5_000, 20_000), [5_000, 7_900, 13_000, 20_000]);
    assert_eq!(levels(300, 300), [300]);
}
