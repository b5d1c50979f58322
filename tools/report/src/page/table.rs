//! Tables of a page.

use super::below::{self, FOUND, HISTORY};
use super::html::{escaped, id_attribute};
use super::sheet::{Sheet, number};
use super::{Format, Join, PageError, Sheets, Shown, ShownColumn, TableBlock};
use std::fmt::Write as _;
use std::path::Path;

/// A column that is shown: how its fields are found and written.
struct Column {
    heading: String,
    kind: Kind,
    error: Option<usize>,
    format: Option<Format>,
    /// To the right, as numbers are?
    of_numbers: bool,
    /// Text of several lines, which needs room?
    long: bool,
}

#[derive(Clone, Copy)]
enum Kind {
    Field(usize),
    Ratio(usize, usize),
}

/// Letters of a field from which on its column is given room.
const LONG: usize = 60;

/// What stands where there is nothing.
const NOTHING: &str = "–";

/// The table in HTML; `title` and `text` are HTML already, `plain_title` is the title as text.
///
/// # Errors
/// If a file, column or row is not there, or a format is asked of what is not a number.
pub(super) fn html(
    block: &TableBlock,
    (plain_title, title, text): (&str, &str, &str),
    command: Option<&str>,
    sheets: &mut Sheets,
) -> Result<String, PageError> {
    let sheet = rows(block, sheets)?;
    let columns = columns(block, &sheet)?;

    let mut html = format!("<figure class=\"table\"{}>\n", id_attribute(block.id.as_deref()));
    if !title.is_empty() {
        let _ = writeln!(html, "<figcaption>{title}</figcaption>");
    }
    html += text;
    let name = if plain_title.is_empty() { "Table" } else { plain_title };
    let _ = writeln!(html, "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">", escaped(name));
    html += "<table>\n<thead><tr>";
    for column in &columns {
        let class = if column.of_numbers { " class=\"n\"" } else { "" };
        let _ = write!(html, "<th scope=\"col\"{class}>{}</th>", escaped(&column.heading));
    }
    html += "</tr></thead>\n<tbody>\n";
    for row in &sheet.rows {
        html += "<tr>";
        for (at, column) in columns.iter().enumerate() {
            let field = escaped(&column.field(row, &sheet)?);
            // What stands in front names the row.
            html += &match (at, column.of_numbers) {
                (0, false) => format!("<th scope=\"row\">{field}</th>"),
                (_, false) if column.long => format!("<td class=\"long\">{field}</td>"),
                (_, false) => format!("<td>{field}</td>"),
                (_, true) => format!("<td class=\"n\">{field}</td>"),
            };
        }
        html += "</tr>\n";
    }
    html += "</tbody>\n</table>\n</div>\n";
    html += &below::made_by(command);
    let file = Path::new(&block.tables[0]).file_name().map_or("data.csv".into(), |name| name.to_string_lossy());
    let all: Vec<usize> = (0..sheet.columns.len()).filter(|&at| sheet.columns[at] != HISTORY).collect();
    html += &below::data(&sheet, &all, &file);
    Ok(html + "</figure>\n")
}

/// The rows that are shown, with the columns of the joined tables.
fn rows(block: &TableBlock, sheets: &mut Sheets) -> Result<Sheet, PageError> {
    let (first, others) =
        block.tables.split_first().ok_or_else(|| PageError::asked("a table has at least one of `tables`"))?;
    let mut sheet = (*sheets.get(first)?).clone();
    for other in others {
        sheet.append(&*sheets.get(other)?);
    }
    sheet.keep(&block.only)?;
    for join in &block.join {
        look_up(&mut sheet, join, sheets)?;
    }
    sheet.sort(&block.sort)?;
    if sheet.rows.is_empty() {
        return Err(PageError::asked(format!("{}: the table has no rows", sheet.name)));
    }
    Ok(sheet)
}

/// Adds the columns of another table from the row that has the same values in the columns to look up by; where there is no
/// such row they are empty.
fn look_up(sheet: &mut Sheet, join: &Join, sheets: &mut Sheets) -> Result<(), PageError> {
    let other = sheets.get(&join.table)?;
    let pairs = join.on.iter().map(|name| Ok((sheet.column(name)?, other.column(name)?)));
    let pairs = pairs.collect::<Result<Vec<_>, PageError>>()?;
    let mut matches = vec![];
    for row in &sheet.rows {
        let mut fits = other.rows.iter().filter(|theirs| pairs.iter().all(|&(a, b)| row[a] == theirs[b]));
        let first = fits.next();
        if first.is_some() && fits.next().is_some() {
            let values: Vec<&str> = pairs.iter().map(|&(a, _)| &*row[a]).collect();
            return Err(PageError::asked(format!(
                "{} has several rows with `{}` in {}; join on more columns",
                join.table,
                values.join("`, `"),
                join.on.join(", ")
            )));
        }
        matches.push(first);
    }
    for (at, column) in other.columns.iter().enumerate() {
        let fields = matches.iter().map(|row| row.map_or(String::new(), |row| row[at].clone())).collect();
        sheet.add_column(&format!("{}.{column}", join.name), fields);
    }
    Ok(())
}

/// The columns to show; the one that tells how a row was found always is.
fn columns(block: &TableBlock, sheet: &Sheet) -> Result<Vec<Column>, PageError> {
    let mut shown = block.columns.clone();
    if shown.is_empty() {
        let all = sheet.columns.iter().filter(|name| *name != HISTORY);
        shown = all.map(|name| Shown::Plain(name.clone())).collect();
    }
    let mut columns = shown.iter().map(|shown| column(shown, sheet)).collect::<Result<Vec<_>, _>>()?;
    if let Some(found) = sheet.find(FOUND)
        && !columns.iter().any(|column| matches!(column.kind, Kind::Field(at) if at == found))
    {
        columns.push(column(&Shown::Plain(FOUND.to_owned()), sheet)?);
    }
    Ok(columns)
}

fn column(shown: &Shown, sheet: &Sheet) -> Result<Column, PageError> {
    let full = match shown {
        Shown::Plain(name) => &ShownColumn { column: Some(name.clone()), ..ShownColumn::default() },
        Shown::Full(full) => full,
    };
    let (kind, name) = match (&full.column, &full.ratio) {
        (Some(name), None) => (Kind::Field(sheet.column(name)?), name.replace('_', " ")),
        (None, Some([a, b])) => (Kind::Ratio(sheet.column(a)?, sheet.column(b)?), format!("{a} / {b}")),
        _ => return Err(PageError::asked("of `column` and `ratio`, a column of a table has one")),
    };
    let format = full.format.as_deref().map(str::parse).transpose().map_err(|error: String| PageError::asked(error))?;
    let of_numbers = match kind {
        Kind::Ratio(..) => true,
        Kind::Field(at) => {
            let mut fields = sheet.rows.iter().map(|row| &row[at]).filter(|field| !field.is_empty()).peekable();
            format.is_some() || (fields.peek().is_some() && fields.all(|field| number(field).is_some()))
        }
    };
    let error = full.error.as_deref().map(|name| sheet.column(name)).transpose()?;
    let long = matches!(kind, Kind::Field(at) if sheet.rows.iter().any(|row| row[at].chars().count() >= LONG));
    Ok(Column { heading: full.heading.clone().unwrap_or(name), kind, error, format, of_numbers, long })
}

impl Column {
    /// What stands in a row.
    fn field(&self, row: &[String], sheet: &Sheet) -> Result<String, PageError> {
        let write = |value: f64| self.format.map_or_else(|| value.to_string(), |format| format.write(value));
        let at = match self.kind {
            Kind::Field(at) => at,
            Kind::Ratio(a, b) => {
                let ratio = number(&row[a]).zip(number(&row[b])).map(|(a, b)| a / b);
                return Ok(ratio.filter(|ratio| ratio.is_finite()).map_or(NOTHING.to_owned(), write));
            }
        };
        let field = &row[at];
        if field.is_empty() {
            return Ok(NOTHING.to_owned());
        }
        let mut text = match (self.format, number(field)) {
            (Some(_), Some(value)) => write(value),
            // As it is: a number without a format, or a word, such as `full` among numbers of ways.
            _ => field.clone(),
        };
        if let Some(error) = self.error.map(|at| &row[at]).filter(|error| !error.is_empty()) {
            let half = number(error).ok_or_else(|| {
                PageError::read(format!("{}: `{error}` as half the width of an interval is not a number", sheet.name))
            })?;
            // What is known in full has no interval.
            if half > 0.0 {
                text += &format!(" ± {}", write(half));
            }
        }
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Description;
    use super::*;

    fn table(toml: &str) -> Result<String, PageError> {
        let mut sheets = Sheets::default();
        let ours = "order,n,width,found,history\nb,2000,30,sampled,pm-queries | x\na,12.345,0,full,pm-queries\n";
        sheets.add("t.csv", ours.as_bytes().to_vec())?;
        sheets.add("p.csv", b"order,value\na,10\nb,58-63\n".to_vec())?;
        let page = format!("title = 'T'\n[[section]]\nheading = 'S'\n[[section.table]]\ntables = ['t.csv']\n{toml}");
        let page = Description::parse(&page)?;
        html(page.section[0].as_ref().table[0].as_ref(), ("T", "T", ""), Some("make <it>"), &mut sheets)
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
        assert_eq!(
            fields(&html),
            [["a", "12.3", "10", "1.23", "full"], ["b", "2,000.0 ± 30.0", "58-63", "–", "sampled"]]
        );
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
}
