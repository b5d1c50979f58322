//! Places are found in the order in which they are needed, and files by other names.

use super::*;

fn evaluator() -> Evaluator {
    let sheets = Sheets::default();
    sheets.add("t.csv", b"order,n,n_error\na,1.50,0.1\nb,3,\n").unwrap();
    let place = Definition { text: "row('t.csv', order='b').n".into(), line: Some(7) };
    Evaluator::new(&sheets, Names::from([("b".to_owned(), place)]))
        .with_rows("of", &sheets, |name| name.to_owned() + ".csv")
}

#[test]
fn a_value_tells_its_places_in_order() {
    let found = evaluator().evaluate("b * of('t', order='a').n").unwrap();
    assert_eq!((found.number, &*found.text), (Some(4.5), "4.5"));
    let places: Vec<String> = found.places.iter().map(ToString::to_string).collect();
    assert_eq!(places, ["row('t.csv', order='b').n", "of('t', order='a').n"]);
    assert_eq!((found.places[1].field(), found.places[1].beside("n_error")), ("1.50", Some("0.1")));
    assert_eq!(evaluator().evaluate("1").unwrap().places, []);
}

#[test]
fn a_place_is_written_as_the_file_has_it() {
    assert_eq!(evaluator().evaluate("of('t', n=1.5).n").unwrap().text, "1.50");
    assert_eq!(evaluator().evaluate("of('t', n=1.5).order").unwrap().text, "a");
    assert_eq!(evaluator().evaluate("of('t', n=1.5).n * 2").unwrap().text, "3");
}

#[test]
fn a_column_or_a_word_that_is_called_as_a_name_is_no_name() {
    let sheets = Sheets::default();
    sheets.add("t.csv", b"order,n\nn,2\n").unwrap();
    let place = Definition { text: "1 / 2".into(), line: None };
    let evaluator = Evaluator::new(&sheets, Names::from([("n".to_owned(), place)]));
    let found = evaluator.evaluate("row('t.csv', order='n').n * n").unwrap();
    assert_eq!((found.number, &*found.source), (Some(1.0), "row('t.csv', order='n').n * (1 / 2)"));
}
