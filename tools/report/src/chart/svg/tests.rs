//! Drawings are whole, to scale, and name every series.

use super::super::{Scale, Selection};
use super::*;
use crate::sheet::Sheet;
use std::sync::Arc;

fn plot(table: &str) -> Plot {
    let selection = Selection {
        x: "size".into(),
        y: "fetches".into(),
        by: vec!["order".into()],
        error: Some("width".into()),
        y_scale: Scale::Log10,
        ..Selection::default()
    };
    let sheet = Sheet::parse("t", table.as_bytes()).expect("a table");
    Plot::read(&selection, &[Arc::new(sheet)], &[]).expect("a plot")
}

fn look() -> Look {
    Look { title: "a < b".into(), size: (800, 500), lines: true, frontier: true, legend: true }
}

/// Centres of the circles of the first series, in the order drawn, the legend's left out.
fn circles(svg: &str) -> Vec<(f64, f64)> {
    let attribute = |tag: &str, name: &str| -> f64 {
        let from = tag.find(&format!(" {name}=\"")).expect("the attribute") + name.len() + 3;
        tag[from..].split('"').next().expect("a value").parse().expect("a number")
    };
    let tags = svg.split('<').filter(|tag| tag.starts_with("circle"));
    let all: Vec<_> = tags.map(|tag| (attribute(tag, "cx"), attribute(tag, "cy"))).collect();
    all[..all.len() - 1].to_vec()
}

#[test]
fn equal_ratios_are_equal_lengths() {
    let svg = plot("order,size,fetches,width\na,1024,1000,\na,4096,100,\na,1048576,10,\n").svg(&look());
    let at = circles(&svg);
    assert_eq!(at.len(), 3);
    // Two doublings, then eight; a decade each down.
    let ((dx1, dy1), (dx2, dy2)) = ((at[1].0 - at[0].0, at[1].1 - at[0].1), (at[2].0 - at[1].0, at[2].1 - at[1].1));
    assert!((dx2 / dx1 - 4.0).abs() < 0.05, "{at:?}");
    assert!(dy1 > 50.0 && (dy2 - dy1).abs() <= 1.0, "{at:?}");
}

#[test]
fn the_picture_is_whole_and_the_same_each_time() {
    let table = "order,size,fetches,width\na,1024,1000,20\na,1048576,10,300\nb,2048,5,\n";
    let svg = plot(table).svg(&look());
    assert_eq!(svg, plot(table).svg(&look()));
    assert!(svg.contains("a &lt; b") && !svg.contains("a < b"));
    for text in ["fetches", "size", "1K", "prefers-color-scheme"] {
        assert!(svg.contains(text), "{text}");
    }
    let count = |tag: &str| svg.matches(tag).count();
    assert_eq!(count("<svg"), count("</svg>"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn a_part_of_a_page_has_no_style_of_its_own_and_a_key_for_each_series() {
    let plot = plot("order,size,fetches,width\na,1,1,\nb,2,5,\n");
    let svg = plot.svg_in_page(&look(), "wide");
    assert!(svg.starts_with("<svg class=\"wide\" role=\"img\" viewBox=\"0 0 800 500\"><title>a &lt; b</title><"));
    assert!(!svg.contains("<style") && svg.matches("<svg").count() == 1 && svg.trim_end().ends_with("</svg>"));
    // The marks are the points', not a legend's.
    assert_eq!(svg.matches("<circle").count(), 1);
    let keys = plot.keys(&look());
    assert_eq!(keys.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["a", "b", "frontier"]);
    assert!(keys[0].1.contains("<circle") && keys[1].1.contains("<rect"), "{keys:?}");
}

#[test]
fn every_series_is_named_however_many_there_are() {
    let rows: String = (0..60).map(|i| format!("series{i},1,{},\n", i + 1)).collect();
    let svg = plot(&format!("order,size,fetches,width\n{rows}")).svg(&look());
    for i in 0..60 {
        assert!(svg.contains(&format!("\nseries{i}\n")), "series{i}");
    }
    let lowest = svg
        .split("<text ")
        .filter(|text| text.contains("\nseries59\n"))
        .find_map(|text| text.split(" y=\"").nth(1)?.split('"').next()?.parse::<i32>().ok());
    assert!(lowest.expect("the last series is named") < 500);
}

#[test]
fn long_words_stand_upright() {
    let words = |word: &str| (0..9).map(|i| format!("a,{word}{i},1,\n")).collect::<String>();
    let svg = |word: &str| plot(&format!("order,size,fetches,width\n{}", words(word))).svg(&look());
    let turned = |svg: &str| svg.matches("rotate(270").count();
    // The label of the axis up always is.
    assert_eq!(turned(&svg("a rather long word ")), turned(&svg("w")) + 9);
}
