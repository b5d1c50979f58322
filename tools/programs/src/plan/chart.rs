//! The frontier that a plan was chosen on, as a drawing: error against cost.

use super::report::{root, two_sided};
use anyhow::Context as _;
use pm_plan::{Choice, PAPERS_MAP, Plan, Rival, frontier, frontier_of_map};
use pm_report::chart::{Look, Plot, Selection};
use pm_report::sheet::Sheet;
use pm_report::{Column, Format, Table, Value};
use std::sync::Arc;

/// Errors of the frontier, relative to the one that is wanted.
const AROUND: [f64; 9] = [0.4, 0.5, 0.63, 0.8, 1.0, 1.26, 1.6, 2.0, 2.5];

/// What is drawn: which pictures could be had for what, by the model as the trials left it, and what was tried.
pub(super) fn svg(plan: &Plan, (wanted, confidence): (f64, f64), pixels: f64, caustics: u64) -> anyhow::Result<String> {
    let bytes = plan.model.fetched(&plan.choice.recipe, pixels).is_some();
    let unit = if bytes { "bytes_fetched" } else { "seconds" };
    let mut table = Table::new(vec![
        Column::text("recipes"),
        Column::number(unit),
        Column::number("error"),
        Column::number("half_width"),
    ]);
    let mut point = |name: &str, choice: &Choice, error: f64, half_width: f64| {
        let cost = plan.model.fetched(&choice.recipe, pixels).unwrap_or(choice.cost);
        let real = |x: f64| Value::Float(x, 6);
        table.push(vec![Value::Text(name.to_owned()), real(cost), real(error), real(half_width)]);
    };
    let predicted = |choice: &Choice| root(choice.parts.total().value) * 100.0;
    let errors = AROUND.map(|factor| factor * wanted);
    for choice in frontier(&plan.model, pixels, &errors, caustics) {
        point("cheapest", &choice, predicted(&choice), f64::NAN);
    }
    let (photons, k) = PAPERS_MAP;
    for choice in frontier_of_map(&plan.model, pixels, &errors, caustics, PAPERS_MAP) {
        point(&format!("{photons} photons, k {k}"), &choice, predicted(&choice), f64::NAN);
    }
    for tried in &plan.trials {
        point("tried", &tried.choice, root(tried.error.value) * 100.0, f64::NAN);
    }
    if let Some(Rival::Dearer(rival) | Rival::TooCoarse(rival)) = &plan.rival {
        point("next best", rival, predicted(rival), f64::NAN);
    }
    let [low, high] = two_sided(&plan.error, confidence).map(|square| root(square) * 100.0);
    point("the plan", &plan.choice, root(plan.error.value) * 100.0, (high - low) / 2.0);
    let mut rows = vec![];
    table.write(Format::Csv, &mut rows)?;
    let sheet = Sheet::parse("the frontier", &rows)?;
    let selection = Selection {
        x: unit.to_owned(),
        y: "error".to_owned(),
        by: vec!["recipes".to_owned()],
        error: Some("half_width".to_owned()),
        ..Selection::default()
    };
    let mut plot = Plot::read(&selection, &[Arc::new(sheet)], &[]).context("the frontier")?;
    plot.x.label =
        if bytes { "bytes fetched".to_owned() } else { "seconds of processor time, by the parts".to_owned() };
    plot.y.label = "error, %".to_owned();
    let look = Look {
        title: format!("What an error costs; {} % wanted", wanted * 100.0),
        size: (900, 560),
        lines: true,
        frontier: false,
        legend: true,
    };
    Ok(plot.picture(&look))
}
