//! Charts of a page: drawn wide and narrow, with their legend and what stands below.

use super::below::{self, FOUND};
use super::html::{escaped, id_attribute};
use super::sheet::{Sheet, number};
use super::{ChartBlock, PageError, Sheets};
use crate::chart::{Look, Plot, Selection, TableError};
use std::fmt::Write as _;
use std::path::Path;

/// Width and height of the drawing where there is room, in pixels.
const WIDE: (u32, u32) = (860, 440);
/// The same on a phone.
const NARROW: (u32, u32) = (380, 340);
/// The column that tells the tables apart where there are several.
const TABLE: &str = "table";

/// The chart in HTML; `title` and `text` are HTML already, `plain_title` is the title as text.
///
/// # Errors
/// If a file, column or row is not there, or cannot be drawn.
pub(super) fn html(
    block: &ChartBlock,
    (plain_title, title, text): (&str, &str, &str),
    command: Option<&str>,
    sheets: &mut Sheets,
) -> Result<String, PageError> {
    let data = data(block, sheets)?;
    let plot = plot(block, sheets)?;
    let look = |size| Look {
        title: plain_title.to_owned(),
        size,
        lines: !block.points,
        frontier: block.frontier,
        legend: false,
    };
    let mut html = format!("<figure class=\"chart\"{}>\n", id_attribute(block.id.as_deref()));
    if !title.is_empty() {
        let _ = writeln!(html, "<figcaption>{title}</figcaption>");
    }
    html += text;
    for (size, class) in [(WIDE, "wide"), (NARROW, "narrow")] {
        html += plot.svg_in_page(&look(size), class).trim_end();
        html.push('\n');
    }
    let keys = plot.keys(&look(WIDE));
    if keys.len() > 1 || !block.by.is_empty() {
        html += "<ul class=\"legend\">\n";
        for (name, key) in keys {
            let _ = writeln!(html, "<li>{}{}</li>", key.replace('\n', ""), escaped(name));
        }
        html += "</ul>\n";
    }
    html += &below::made_by(command);
    let shown = columns(block, &data)?;
    let file = Path::new(&block.tables[0]).file_name().map_or("data.csv".into(), |name| name.to_string_lossy());
    html += &below::data(&data, &shown, &file);
    Ok(html + "</figure>\n")
}

fn plot(block: &ChartBlock, sheets: &mut Sheets) -> Result<Plot, PageError> {
    let only = block.only.iter().flat_map(|(column, values)| {
        values.all().iter().map(|value| (column.clone(), value.clone())).collect::<Vec<_>>()
    });
    let selection = Selection {
        x: block.x.clone(),
        y: block.y.clone(),
        by: block.by.clone(),
        error: block.error.clone(),
        only: only.collect(),
        x_scale: block.x_scale,
        y_scale: block.y_scale,
    };
    let mut open = |names: &[String]| {
        names.iter().map(|name| Ok((name.clone(), sheets.get(name)?))).collect::<Result<Vec<_>, PageError>>()
    };
    let (tables, references) = (open(&block.tables)?, open(&block.reference)?);
    let texts = |tables: &[(String, std::rc::Rc<Sheet>)]| {
        tables.iter().map(|(name, sheet)| (name.clone(), std::io::Cursor::new(sheet.text.clone()))).collect()
    };
    let mut plot = Plot::read(&selection, texts(&tables), texts(&references)).map_err(|error| match error {
        TableError::Csv { .. } | TableError::Empty(_) | TableError::Number { .. } => PageError::read(error.to_string()),
        _ => PageError::asked(error.to_string()),
    })?;
    plot.x.label = block.x_label.clone().unwrap_or(plot.x.label);
    plot.y.label = block.y_label.clone().unwrap_or(plot.y.label);
    Ok(plot)
}

/// The rows that are drawn, with all their columns.
fn data(block: &ChartBlock, sheets: &mut Sheets) -> Result<Sheet, PageError> {
    let several = block.tables.len() + block.reference.len() > 1;
    let mut all: Option<Sheet> = None;
    for (number_of_table, name) in block.tables.iter().chain(&block.reference).enumerate() {
        let mut sheet = (*sheets.get(name)?).clone();
        sheet.column(&block.x)?;
        sheet.column(&block.y)?;
        if number_of_table >= block.tables.len() {
            // A reference need not have the columns that ours are chosen by.
            sheet.keep_what_fits(&block.only);
        }
        if several && sheet.find(TABLE).is_none() {
            sheet.add_column(TABLE, vec![name.clone(); sheet.rows.len()]);
        }
        match &mut all {
            None => all = Some(sheet),
            Some(all) => all.append(&sheet),
        }
        if number_of_table + 1 == block.tables.len()
            && let Some(all) = &mut all
        {
            all.keep(&block.only)?;
        }
    }
    let Some(mut all) = all else { return Err(PageError::asked("a chart has at least one of `tables`")) };
    let (x, y) = (all.column(&block.x)?, all.column(&block.y)?);
    all.rows.retain(|row| !row[x].is_empty() && number(&row[y]).is_some());
    Ok(all)
}

/// The columns that the chart is made of, the table first where there are several.
fn columns(block: &ChartBlock, data: &Sheet) -> Result<Vec<usize>, PageError> {
    let mut columns = vec![];
    let several = block.tables.len() + block.reference.len() > 1;
    for name in [TABLE].into_iter().filter(|_| several).chain(block.columns()) {
        let column = data.column(name)?;
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    columns.extend(data.find(FOUND).filter(|found| !columns.contains(found)));
    Ok(columns)
}
