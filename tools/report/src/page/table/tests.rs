//! Tables show what their columns say, and refuse what is not there.

use super::super::Description;
use super::super::html::render;
use super::*;

fn table(toml: &str) -> Result<String, ReportError> {
    let sheets = Sheets::default();
    let ours = "order,n,width,found,history\nb,2000,30,sampled,pm-queries | x\na,12.345,0,full,pm-queries\n";
    sheets.add("t.csv", ours.as_bytes())?;
    sheets.add("p.csv", b"order,value\na,10\nb,58-63\n")?;
    let page = format!("title = 'T'\n[[section]]\nheading = 'S'\n[[section.table]]\ntables = ['t.csv']\n{toml}");
    let page = Description::parse(&page)?;
    let texts = ("T".to_owned(), Value::from(""));
    let block = block(page.section[0].as_ref().table[0].as_ref(), texts, Some("make <it>"), &sheets)?;
    Ok(render("table.html", context! { block }))
}

/// The fields of the rows, heading and marks left out.
fn fields(html: &str) -> Vec<Vec<String>> {
    let body = html.split("<tbody>").nth(1).unwrap().split("</tbody>").next().unwrap();
    let text = |cell: &str| Some(cell.split_once('>')?.1.split('<').next()?.to_owned());
    let cells = |row: &str| row.split("<t").filter_map(text).filter(|cell| !cell.is_empty()).collect();
    body.trim().lines().map(cells).collect()
}

#[test]
fn columns_are_looked_up_written_and_divided() {
    let html = table(
        "sort = ['order']\njoin = [{ name = 'paper', table = 'p.csv', on = ['order'] }]\ncolumns = ['order', \
             { column = 'n', format = ',.1f', error = 'width' }, 'paper.value', \
             { ratio = ['n', 'paper.value'], format = '.2f' }]",
    )
    .unwrap();
    assert_eq!(fields(&html), [["a", "12.3", "10", "1.23", "full"], ["b", "2,000.0 ± 30.0", "58-63", "–", "sampled"]]);
    assert!(html.contains("<th scope=\"col\" class=\"n\">n</th><th scope=\"col\">paper.value</th>"), "{html}");
    assert!(html.contains("Made by <code>make &lt;it&gt;</code>"));
    assert!(html.contains("<li><code>pm-queries | x</code></li>"));
}

#[test]
fn without_columns_all_are_shown_but_the_history() {
    let html = table("only = { order = 'b' }").unwrap();
    assert_eq!(fields(&html), [["b", "2000", "30", "sampled"]]);
}

#[test]
fn what_is_not_there_is_refused() {
    for (toml, hint) in [
        ("columns = ['m']", "t.csv: there is no column `m`; there are order, n, width"),
        ("columns = [{ heading = 'm' }]", "of `column` and `ratio`"),
        ("columns = [{ column = 'n', format = '3' }]", "`3` is not a format"),
        ("join = [{ name = 'p', table = 'q.csv', on = ['order'] }]", "q.csv: No such file"),
        ("join = [{ name = 'p', table = 'p.csv', on = ['n'] }]", "p.csv: there is no column `n`"),
        ("only = { order = 'c' }", "no row"),
        ("only = { order = ['a', 'c'] }", "no row"),
        ("sort = ['-m']", "there is no column `m`"),
    ] {
        let error = table(toml).expect_err(toml).to_string();
        assert!(error.contains(hint), "{toml}: {error}");
    }
}
