//! Templates find rows, write fields as they are, and note what is not as it has to be.

use super::*;

fn rendered(template: &str) -> Result<Rendered, ReportError> {
    let sheet = |name: &str, text: &[u8]| Arc::new(Sheet::parse(name, text).unwrap());
    let tables = vec![
        sheet("out/full.csv", b"order,n,history\na,1.50,\"x, y\"\nb,3,z\n"),
        sheet("paper-full.csv", b"order,n\nb,6\n"),
    ];
    render(template, tables, &BTreeMap::from([("size".to_owned(), "16x8".to_owned())]))
}

fn text(template: &str) -> String {
    rendered(template).unwrap_or_else(|error| panic!("{template}: {error}")).text
}

#[test]
fn rows_are_those_of_the_tables() {
    let rows =
        "{% for row in tables.full %}\n{{ row.csv('n', 'history') }}:{{ '%.3g'|format(row.n * 2) }}\n{% endfor %}\n";
    assert_eq!(text(rows), "1.50,\"x, y\":3\n3,z:6\n");
    assert_eq!(text("{{ tables['paper-full'].find(order='b').n / tables[0].find(order='b', n=3).n }}"), "2.0");
    assert_eq!(
        text("{{ 'none' if not tables[1].find(order='a') else 'one' }} {{ tables[1].name }}"),
        "none paper-full"
    );
    assert_eq!(text("{% set wide, high = size | split('x') %}{{ wide | int * high | int }}"), "128");
    assert_eq!(text("{{ (tables.full | selectattr('n', '<=', 2) | first).order }}"), "a");
}

#[test]
fn what_is_not_there_is_said_with_its_line() {
    for (template, hint) in [
        ("\n{{ tables.lost }}", "line 2: a table lost.csv is wanted"),
        (
            "{{ tables[0].find(orders='a') }}",
            "line 1: out/full.csv: there is no column `orders`; there are order, n, history",
        ),
        ("{{ tables[0][0].csv('m') }}", "line 1: out/full.csv: there is no column `m`"),
        ("a\n{{ tables[0][0].m }}", "line 2: "),
        ("{% for %}", "line 1: "),
    ] {
        let error = rendered(template).expect_err(template).to_string();
        assert!(error.starts_with(hint), "{template}: {error}");
    }
}

#[test]
fn what_has_to_be_and_is_not_is_noted() {
    let template =
        "{% for row in tables[0] %}{{ require(row.n > 2, row.order ~ ' is small') }}{{ row.order }}{% endfor %}";
    let expected = Rendered { text: "ab".into(), failures: vec!["a is small".into()] };
    assert_eq!(rendered(template).unwrap(), expected);
}
