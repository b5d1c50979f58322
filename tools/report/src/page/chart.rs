//! Charts of a page: drawn wide and narrow, with their legend and what stands below.

use super::ChartBlock;
use super::below::{self, FOUND};
use super::html::safe;
use crate::ReportError;
use crate::chart::{Look, Plot, Selection, part_title};
use crate::sheet::{Sheet, Sheets, number};
use minijinja::{Value, context};

/// Width and height of the drawing where there is room, in pixels.
const WIDE: (u32, u32) = (860, 440);
/// The same on a phone.
const NARROW: (u32, u32) = (380, 340);
/// The column that tells the tables apart where there are several.
const TABLE: &str = "table";

/// What the template of a chart needs; `title` is text, `text` HTML.
///
/// # Errors
/// If a file, column or row is not there, or cannot be drawn.
pub(super) fn block(
    block: &ChartBlock,
    (title, text): (String, Value),
    command: Option<&str>,
    sheets: &Sheets,
) -> Result<Value, ReportError> {
    let data = data(block, sheets)?;
    let plots = plot(block, sheets)?.parts();
    let count = plots.len();
    let parts = plots.iter().enumerate().map(|(number, plot)| part(plot, block, part_title(&title, number, count)));
    let parts: Vec<Value> = parts.collect();
    Ok(context! {
        template => "chart.html",
        id => block.id.as_deref(),
        title,
        text,
        folded => block.folded,
        parts,
        command,
        data => below::data(&data, &columns(block, &data)?, &block.tables[0]),
    })
}

/// A drawing, wide and narrow, with its legend; series that have their names at the ends of their lines need it on a phone only.
fn part(plot: &Plot, block: &ChartBlock, title: String) -> Value {
    let several = plot.series.len() + plot.reference.len() + usize::from(block.frontier) > 1;
    let look = |size, legend| Look {
        title: title.clone(),
        size,
        lines: !block.points,
        frontier: block.frontier,
        legend: legend && (several || !block.by.is_empty()),
    };
    let wide = look(WIDE, true);
    let drawings = [(&wide, "wide"), (&look(NARROW, false), "narrow")]
        .map(|(look, class)| safe(plot.svg_in_page(look, class).trim_end().to_owned()));
    let keys = if wide.legend { plot.keys(&wide) } else { vec![] };
    let named = if plot.has_named_ends(&wide) { plot.series.len() } else { 0 };
    let legend = keys.into_iter().enumerate().map(|(number, (name, key))| {
        let ended = number < named;
        context! { name, key => safe(key.replace('\n', "")), ended }
    });
    context! { drawings => drawings.to_vec(), legend => legend.collect::<Vec<_>>() }
}

fn plot(block: &ChartBlock, sheets: &Sheets) -> Result<Plot, ReportError> {
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
    let open = |names: &[String]| names.iter().map(|name| sheets.get(name)).collect::<Result<Vec<_>, ReportError>>();
    let mut plot = Plot::read(&selection, &open(&block.tables)?, &open(&block.reference)?)?;
    plot.x.label = block.x_label.clone().unwrap_or(plot.x.label);
    plot.y.label = block.y_label.clone().unwrap_or(plot.y.label);
    Ok(plot)
}

/// The rows that are drawn, with all their columns.
fn data(block: &ChartBlock, sheets: &Sheets) -> Result<Sheet, ReportError> {
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
    let Some(mut all) = all else { return Err(ReportError::asked("a chart has at least one of `tables`")) };
    let (x, y) = (all.column(&block.x)?, all.column(&block.y)?);
    all.retain(|row| !row[x].is_empty() && number(&row[y]).is_some());
    Ok(all)
}

/// The columns that the chart is made of, the table first where there are several.
fn columns(block: &ChartBlock, data: &Sheet) -> Result<Vec<usize>, ReportError> {
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
