//! Does every order visit every pixel for every ray once, batch by batch?

use super::*;
use pm_formats::vocabulary::OrderLabel;

/// An order by its word and options.
fn order(line: &str, strata: u32) -> Box<dyn Generative> {
    let chosen = generative_orders().choose(line).unwrap();
    chosen.entry.make(&chosen.values, strata).unwrap()
}

/// Every order, with each of its options at work.
fn orders() -> Vec<(String, Box<dyn Generative>)> {
    let mut lines: Vec<String> = generative_orders().words().into_iter().map(String::from).collect();
    let more = ["tiled --tile 1", "direction-binned --tile 1 --bins 3", "direction-binned --tile 4294967295 --bins 1"];
    lines.extend(more.map(String::from));
    lines.into_iter().map(|line| (line.clone(), order(&line, 4))).collect()
}

#[test]
fn every_order_keeps_its_promises() {
    for size in [[1, 1], [7, 5], [16, 16], [33, 17]] {
        for (line, order) in orders() {
            assert_eq!(broken_promise(&*order, size), None, "{line} {size:?}");
        }
    }
}

/// The rows of an image, spoiled.
struct Spoiled(fn(u32, PixelRun) -> Vec<PixelRun>, Vec<Pass>);

impl Generative for Spoiled {
    fn label(&self) -> OrderLabel {
        OrderLabel::new("spoiled")
    }

    fn batches(&self, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Vec<PixelRun>> + '_> {
        Box::new((0..height).map(move |row| self.0(row, PixelRun { row, columns: 0..width })))
    }

    fn passes(&self) -> Vec<Pass> {
        self.1.clone()
    }
}

#[test]
fn broken_promises_are_found() {
    let all = Pass::every_ray(&[VisiblePoints::All], 2);
    let broken = |spoil, passes: &[Pass]| broken_promise(&Spoiled(spoil, passes.to_vec()), [4, 3]).unwrap_or_default();
    assert_eq!(broken(|_, run| vec![run], &all), "");
    assert_eq!(broken(|_, run| vec![PixelRun { columns: 0..3, ..run }], &all), "9 pixels are visited");
    assert!(broken(|_, run| vec![PixelRun { columns: 0..5, ..run }], &all).ends_with("outside of the image"));
    assert!(broken(|_, run| vec![run.clone(), run], &all).contains("is visited for"));
    assert_eq!(broken(|row, run| if row == 1 { vec![] } else { vec![run] }, &all), "batch 2 comes after batch 0");
    assert!(broken(|_, run| vec![run], &all[1..]).starts_with("not every ray"));
    let direct = Pass::every_ray(&[VisiblePoints::Direct], 1);
    assert!(broken(|_, run| vec![run], &direct).starts_with("not every ray"));
    let late = Pass::every_ray(&[VisiblePoints::BehindSpecular, VisiblePoints::Direct], 1);
    assert!(broken(|_, run| vec![run], &late).starts_with("the first pass"));
}

#[test]
fn labels_begin_with_the_word() {
    for (line, order) in orders() {
        assert_eq!(Some(order.label().word.as_str()), line.split(' ').next());
    }
    assert_eq!(order("direction-binned --tile 8 --bins 3", 9).label().to_string(), "direction-binned 8x8, bins 3");
    assert_eq!(order("direction-binned", 9).label().to_string(), "direction-binned 16x16, bins 9");
}

#[test]
fn a_tile_is_finished_before_the_next_begins_and_specular_comes_last() {
    let tiled = order("tiled --tile 2", 1);
    let order: Vec<_> =
        tiled.spans([4, 2]).map(|span| (span.batch, span.row, span.columns.start, span.pass.is_first())).collect();
    assert_eq!(order[..4], [(0, 0, 0, true), (0, 1, 0, true), (0, 0, 0, false), (0, 1, 0, false)]);
    assert_eq!(order[4], (1, 0, 2, true));
}

#[test]
fn a_bin_of_all_pixels_of_a_tile_comes_before_the_next_bin() {
    let order = order("direction-binned --tile 2 --bins 2", 4);
    let passes: Vec<_> =
        order.spans([4, 2]).map(|span| (span.batch, span.pass.points, span.pass.bin, span.row)).collect();
    let (direct, behind) = (VisiblePoints::Direct, VisiblePoints::BehindSpecular);
    assert_eq!(passes[..4], [(0, direct, 0, 0), (0, direct, 0, 1), (0, direct, 1, 0), (0, direct, 1, 1)]);
    assert_eq!(passes[4..8], [(0, behind, 0, 0), (0, behind, 0, 1), (0, behind, 1, 0), (0, behind, 1, 1)]);
    assert_eq!(passes[8], (1, direct, 0, 0));
}

#[test]
fn the_largest_tile_is_the_image() {
    let order = order("tiled --tile 4294967295", 1);
    assert_eq!(order.spans([3, 3]).map(|span| span.batch).max(), Some(0));
}

#[test]
fn more_bins_than_strata_are_refused() {
    let chosen = generative_orders().choose("direction-binned --bins 5").unwrap();
    let refused = chosen.entry.make(&chosen.values, 4).err().map(|error| error.to_string());
    assert_eq!(refused.as_deref(), Some("--bins 5 is more than the 4 strata: give at most 4"));
}

#[test]
fn the_table_of_the_readme_is_that_of_the_registry() {
    let table = generative_orders().table();
    assert!(include_str!("../../README.md").contains(&table), "tools/orders/README.md lacks:\n{table}");
}
