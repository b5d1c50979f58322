//! What a description says is read, and what it cannot say is refused with its line.

use super::*;
use crate::sheet::Sheets;

const PAGE: &str = "title = 'T'\n[numbers]\na = 't.csv[x=1].y'\n[[section]]\nheading = 'One'\n\
        [[section.chart]]\ntables = ['t.csv']\nx = 'x'\ny = 'y'\nx_scale = 'log2'\nonly = { a = '1', b = ['2', '3'] }\n\
        [[section.paragraph]]\ntext = 'between'\n[[section.chart]]\ntables = ['u.csv']\nx = 'x'\ny = 'y'\n\
        [[section]]\nheading = 'Two'\n[[section.table]]\ntables = ['t.csv']\n\
        columns = ['x', { column = 'y', format = '.1f' }]\n";

#[test]
fn blocks_stand_as_they_are_written() {
    let page = Description::parse(PAGE).unwrap();
    let blocks = page.section[0].as_ref().blocks();
    let kinds: Vec<_> = blocks
        .iter()
        .map(|(start, block)| {
            let kind = match block {
                Block::Chart(chart) => &*chart.tables[0],
                Block::Paragraph(_) => "text",
                _ => "other",
            };
            (line_at(PAGE, *start), kind)
        })
        .collect();
    assert_eq!(kinds, [(6, "t.csv"), (12, "text"), (14, "u.csv")]);
    assert_eq!(page.section.len(), 2);
    assert_eq!(line_at(PAGE, page.numbers["a"].span().start), 3);
}

#[test]
fn what_is_not_known_is_refused_with_its_line() {
    for (from, to, hint) in [
        ("x_scale = 'log2'", "x_scael = 'log2'", "line 10: unknown field `x_scael`"),
        ("'log2'", "'log3'", "line 10: unknown variant `log3`"),
        ("heading = 'Two'", "", "line 18: missing field `heading`"),
        ("y = 'y'", "y = ", "line 9: "),
    ] {
        let error = Description::parse(&PAGE.replace(from, to)).unwrap_err().to_string();
        assert!(error.starts_with(hint), "{error}");
    }
}

#[test]
fn a_page_leads_out_to_what_it_is_about_and_nowhere_else() {
    let page = |address: &str| {
        let toml = format!(
            "title = 'T'\nabout = {{ name = 'A & B', address = '{address}' }}\nintro = '[there](https://a.org)'\n"
        );
        Description::parse(&toml).unwrap().html(&Sheets::default(), "test")
    };
    let html = page("https://a.org/?a=1&b=\"").unwrap();
    assert_eq!(html.matches("<a ").count(), 1);
    assert!(html.contains("<a href=\"https://a.org/?a=1&amp;b=&quot;\" rel=\"noreferrer\">A &amp; B</a>"), "{html}");
    for address in ["http://a.org", "javascript:alert(1)", "file:///etc", "https://a.org/ b", ""] {
        let error = page(address).unwrap_err().to_string();
        assert!(error.contains("begins with https://"), "{address}: {error}");
    }
}

#[test]
fn what_is_folded_stands_behind_its_title() {
    let sheets = Sheets::default();
    sheets.add("t.csv", b"a,b\n1,2\n2,3\n").unwrap();
    let page = |folded: &str| {
        let block = |kind: &str, more: &str| {
            format!("[[section.{kind}]]\ntitle = 'A {kind}'\ntables = ['t.csv']\n{more}{folded}")
        };
        let toml = format!(
            "title = 'T'\n[[section]]\nheading = 'H'\n{}{}",
            block("table", ""),
            block("chart", "x = 'a'\ny = 'b'\n")
        );
        Description::parse(&toml).unwrap().html(&sheets, "test").unwrap()
    };
    let (open, folded) = (page(""), page("folded = true\n"));
    for kind in ["table", "chart"] {
        let (summary, caption) = (
            format!("<details class=\"folded\"><summary>A {kind}</summary>\n<figure"),
            format!("<figcaption>A {kind}"),
        );
        assert!(open.contains(&caption) && !open.contains(&summary), "{kind}");
        assert!(folded.contains(&summary) && !folded.contains(&caption), "{kind}");
    }
    assert_eq!(folded.matches("<details").count(), folded.matches("</details>").count());
}
