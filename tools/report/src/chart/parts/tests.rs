//! No drawing has more series than can be told apart, none is lost, and all have the same axes.

use super::super::{Scale, Selection};
use super::*;
use crate::sheet::Sheet;

/// A plot of so many series of two points each, and of a grey point for each of them but the first.
fn plot(series: usize) -> Plot {
    let row = |i: usize| format!("s{i},1,{}\ns{i},2,{}\n", i + 1, 10 * (i + 1));
    let paper = |i: usize| format!("s{i},1,{}\n", i + 2);
    let sheet = |name: &str, rows: String| {
        let table = format!("order,size,fetches\n{rows}");
        Arc::new(Sheet::parse(name, table.as_bytes()).expect("a table"))
    };
    let selection = Selection {
        x: "size".into(),
        y: "fetches".into(),
        by: vec!["order".into()],
        y_scale: Scale::Log10,
        ..Selection::default()
    };
    let ours = sheet("ours", (0..series).map(row).collect());
    let others = sheet("paper", (1..series).map(paper).chain(["other,1,5\n".to_owned()]).collect());
    Plot::read(&selection, &[ours], &[others]).expect("a plot")
}

fn look() -> Look {
    Look { title: "Fetches".into(), size: (700, 300), lines: true, frontier: true, legend: true }
}

#[test]
fn a_drawing_has_at_most_seven_series_and_none_is_lost() {
    for (series, expected) in [(1, vec![1]), (7, vec![7]), (8, vec![4, 4]), (15, vec![5, 5, 5]), (60, vec![7; 9])] {
        let parts = plot(series).parts();
        let mut counts: Vec<usize> = parts.iter().map(|part| part.series.len()).collect();
        assert_eq!(counts.iter().sum::<usize>(), series);
        assert!(counts.iter().all(|&count| count <= MOST_SERIES), "{counts:?}");
        counts.truncate(expected.len() - 1);
        assert_eq!(counts, expected[..expected.len() - 1]);
        let names: Vec<String> = parts.iter().flat_map(|part| &part.series).map(|series| series.name.clone()).collect();
        assert_eq!(names, (0..series).map(|i| format!("s{i}")).collect::<Vec<_>>());
    }
}

#[test]
fn what_is_compared_with_a_series_is_drawn_beside_it() {
    for part in plot(15).parts() {
        let ours: Vec<String> = part.series.iter().map(|series| format!("{} (paper)", series.name)).collect();
        let others: Vec<&str> = part.reference.iter().map(|series| series.name.as_str()).collect();
        let expected: Vec<&str> = ours.iter().map(String::as_str).filter(|name| *name != "s0 (paper)").collect();
        let first = part.series[0].name == "s0";
        assert_eq!(others, [expected, if first { vec!["other"] } else { vec![] }].concat());
    }
}

#[test]
fn parts_have_the_axes_and_the_frontier_of_the_whole() {
    let whole = plot(15);
    for part in whole.clone().parts() {
        assert_eq!((part.extent(), part.frontier()), (whole.extent(), whole.frontier()));
    }
}

#[test]
fn a_picture_of_many_series_is_parts_one_below_another() {
    let seven = plot(7);
    assert_eq!(seven.clone().picture(&look()), seven.svg(&look()));
    let svg = plot(8).picture(&look());
    assert!(svg.starts_with("<svg width=\"700\" height=\"600\" viewBox=\"0 0 700 600\""), "{svg:.99}");
    for found in ["<svg y=\"0\"", "<svg y=\"300\"", "Fetches (1 of 2)", "Fetches (2 of 2)", "\ns7\n"] {
        assert!(svg.contains(found), "{found}");
    }
    assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
}
