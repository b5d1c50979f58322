//! Series come of tables by name, and wrong tables are refused with where.

use super::super::Scale;
use super::*;

const TABLE: &str = "\
order,cache,size,fetches,width
scanline,\"4K,full,128,lru\",4096,100,2
hilbert,\"4K,full,128,lru\",4096,50,
scanline,\"8K,full,128,lru\",8192,80,1
hilbert,\"8K,full,128,lru\",8192,,
";

fn selection() -> Selection {
    Selection { x: "size".into(), y: "fetches".into(), by: vec!["order".into()], ..Selection::default() }
}

fn sheet(name: &str, text: &str) -> Result<Arc<Sheet>, ReportError> {
    Sheet::parse(name, text.as_bytes()).map(Arc::new)
}

fn read(selection: &Selection, table: &str) -> Result<Plot, ReportError> {
    Plot::read(selection, &[sheet("t.csv", table)?], &[])
}

#[test]
fn series_come_by_name_and_rows_without_a_value_are_passed_over() {
    let selection = Selection { error: Some("width".into()), ..selection() };
    let plot = read(&selection, TABLE).unwrap();
    let names: Vec<_> = plot.series.iter().map(|s| (s.name.as_str(), s.points.len())).collect();
    assert_eq!(names, [("scanline", 2), ("hilbert", 1)]);
    assert_eq!(plot.series[0].points[1], Point { x: 8192.0, y: 80.0, error: Some(1.0) });
    assert_eq!(plot.series[1].points[0].error, None);
}

#[test]
fn of_several_values_of_a_column_any_does() {
    let only = [("size", "8192"), ("size", "4096"), ("order", "scanline")];
    let only = only.map(|(column, value)| (column.to_owned(), value.to_owned())).to_vec();
    let plot = read(&Selection { only, ..selection() }, TABLE).unwrap();
    let points = |series: &Series| (series.name.clone(), series.points.len());
    assert_eq!(plot.series.iter().map(points).collect::<Vec<_>>(), [("scanline".to_owned(), 2)]);
}

#[test]
fn references_need_only_the_columns_of_the_axes() {
    let selection = Selection { only: vec![("order".into(), "hilbert".into())], ..selection() };
    let paper = sheet("p.csv", "size,fetches\n4096,58\n").unwrap();
    let plot = Plot::read(&selection, &[sheet("t.csv", TABLE).unwrap()], &[paper]).unwrap();
    assert_eq!((plot.reference[0].name.as_str(), plot.reference[0].points.len()), ("p", 1));
}

#[test]
fn lines_go_from_left_to_right() {
    let plot = read(&selection(), "order,size,fetches\na,512,1\na,32,2\na,64,3\n").unwrap();
    assert_eq!(
        plot.series[0].points.iter().map(|p| (p.x, p.y)).collect::<Vec<_>>(),
        [(32.0, 2.0), (64.0, 3.0), (512.0, 1.0)]
    );
}

#[test]
fn words_make_an_axis_of_words() {
    let selection = Selection { x: "cache".into(), by: vec![], ..selection() };
    let plot = read(&selection, TABLE).unwrap();
    assert_eq!(plot.x.words, ["4K,full,128,lru", "8K,full,128,lru"]);
    assert_eq!(plot.series[0].name, "t");
    assert_eq!(plot.series[0].points.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 0.0, 1.0]);
}

#[test]
fn refusals_say_where() {
    let hint = |selection: &Selection, table: &str| read(selection, table).unwrap_err().to_string();
    let x = |x: &str| Selection { x: x.into(), ..selection() };
    assert_eq!(
        hint(&x("sise"), TABLE),
        "t.csv: there is no column `sise`; there are order, cache, size, fetches, width"
    );
    let bad = "order,size,fetches\na,1,2\na,2,many\n";
    assert_eq!(hint(&selection(), bad), "t.csv, line 3: `many` in column fetches is not a number");
    let only = Selection { only: vec![("order".into(), "tiled".into())], ..selection() };
    assert_eq!(hint(&only, TABLE), "no row has a value in both size and fetches and fits --only");
    let log = Selection { y_scale: Scale::Log10, ..selection() };
    assert!(hint(&log, "order,size,fetches\na,1,0\n").starts_with("0 in column fetches has no place"));
    assert!(hint(&selection(), "order,size,fetches\na,1\n").starts_with("t.csv: CSV error: record 1"));
    assert_eq!(hint(&selection(), ""), "t.csv: the table is empty");
}

#[test]
fn references_stand_apart() {
    let paper = sheet("p.csv", "order,size,fetches\npaper,4096,58\n").unwrap();
    let plot = Plot::read(&selection(), &[sheet("t.csv", TABLE).unwrap()], &[paper]).unwrap();
    assert_eq!((plot.series.len(), plot.reference.len()), (2, 1));
    assert_eq!(plot.reference[0].name, "paper");
}
