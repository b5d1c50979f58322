//! The description of a page: what its TOML may say. The format is explained in the module [`page`](super).

use super::PageError;
use crate::chart::Scale;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::Spanned;

/// A page.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Description {
    /// What it is called.
    pub title: String,
    /// What stands before the first section, in Markdown.
    #[serde(default)]
    pub intro: String,
    /// The folder that files are named from, seen from the description's own.
    #[serde(default)]
    pub folder: PathBuf,
    /// Language of the texts, as HTML has it.
    #[serde(default = "english")]
    pub language: String,
    /// The command that makes the tables, where nothing nearer says it.
    #[serde(default)]
    pub command: Option<String>,
    /// Names of numbers for the texts.
    #[serde(default)]
    pub numbers: BTreeMap<String, Spanned<String>>,
    /// Its sections.
    #[serde(default)]
    pub section: Vec<Spanned<Section>>,
    /// The description as it was read, for the lines of errors.
    #[serde(skip)]
    pub(super) toml: String,
}

fn english() -> String {
    "en".into()
}

/// A section of a page. Its blocks stand in the order in which the description has them.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// Its heading; may be empty.
    pub heading: String,
    /// By which links reach it [default: the words of the heading].
    #[serde(default)]
    pub id: Option<String>,
    /// What stands before its blocks, in Markdown.
    #[serde(default)]
    pub text: String,
    /// The command that makes its tables.
    #[serde(default)]
    pub command: Option<String>,
    /// Its charts.
    #[serde(default)]
    pub chart: Vec<Spanned<ChartBlock>>,
    /// Its tables.
    #[serde(default)]
    pub table: Vec<Spanned<TableBlock>>,
    /// Its pictures.
    #[serde(default)]
    pub picture: Vec<Spanned<PictureBlock>>,
    /// Texts between them.
    #[serde(default)]
    pub paragraph: Vec<Spanned<Paragraph>>,
}

/// A block of a section.
#[derive(Clone, Copy, Debug)]
pub enum Block<'a> {
    /// A chart.
    Chart(&'a ChartBlock),
    /// A table.
    Table(&'a TableBlock),
    /// A picture.
    Picture(&'a PictureBlock),
    /// A text.
    Paragraph(&'a Paragraph),
}

impl<'a> Block<'a> {
    /// By which links reach it, if that was said.
    #[must_use]
    pub fn id(self) -> Option<&'a str> {
        match self {
            Self::Chart(block) => block.id.as_deref(),
            Self::Table(block) => block.id.as_deref(),
            Self::Picture(block) => block.id.as_deref(),
            Self::Paragraph(block) => block.id.as_deref(),
        }
    }
}

impl Section {
    /// The blocks in the order of the description, each with where it begins there, in bytes.
    #[must_use]
    pub fn blocks(&self) -> Vec<(usize, Block<'_>)> {
        let charts = self.chart.iter().map(|block| (block.span().start, Block::Chart(block.as_ref())));
        let tables = self.table.iter().map(|block| (block.span().start, Block::Table(block.as_ref())));
        let pictures = self.picture.iter().map(|block| (block.span().start, Block::Picture(block.as_ref())));
        let texts = self.paragraph.iter().map(|block| (block.span().start, Block::Paragraph(block.as_ref())));
        let mut blocks: Vec<_> = charts.chain(tables).chain(pictures).chain(texts).collect();
        blocks.sort_by_key(|(start, _)| *start);
        blocks
    }
}

/// Values that a column may have, or the one.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Values {
    /// This one.
    One(String),
    /// Any of these.
    Any(Vec<String>),
}

impl Values {
    /// All of them.
    pub fn all(&self) -> &[String] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::Any(values) => values,
        }
    }
}

/// A chart: what `pm-chart` can draw.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartBlock {
    /// What stands above it.
    #[serde(default)]
    pub title: String,
    /// What is to be said of it, in Markdown.
    #[serde(default)]
    pub text: String,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// The command that makes its tables.
    #[serde(default)]
    pub command: Option<String>,
    /// Tables.
    pub tables: Vec<String>,
    /// Tables to compare with, in grey.
    #[serde(default)]
    pub reference: Vec<String>,
    /// Column across.
    pub x: String,
    /// Column up.
    pub y: String,
    /// Columns whose values name the series.
    #[serde(default)]
    pub by: Vec<String>,
    /// Column of half widths of intervals around y.
    #[serde(default)]
    pub error: Option<String>,
    /// Only rows with these values in these columns.
    #[serde(default)]
    pub only: BTreeMap<String, Values>,
    /// Scale across.
    #[serde(default)]
    pub x_scale: Scale,
    /// Scale up.
    #[serde(default)]
    pub y_scale: Scale,
    /// Points only, not joined by lines?
    #[serde(default)]
    pub points: bool,
    /// With the frontier: what no other point beats on both axes?
    #[serde(default)]
    pub frontier: bool,
    /// What stands below the axis across [default: the column's name].
    #[serde(default)]
    pub x_label: Option<String>,
    /// What stands beside the axis up [default: the column's name].
    #[serde(default)]
    pub y_label: Option<String>,
    /// Further columns for the data below the chart.
    #[serde(default)]
    pub data: Vec<String>,
}

impl ChartBlock {
    /// The columns that it is made of, and those that are to be shown with it.
    pub(super) fn columns(&self) -> impl Iterator<Item = &str> {
        let by = self.by.iter().map(|name| &**name);
        let drawn = [&*self.x, &*self.y].into_iter().chain(self.error.as_deref());
        by.chain(drawn).chain(self.data.iter().map(|name| &**name))
    }
}

/// A table.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableBlock {
    /// What stands above it.
    #[serde(default)]
    pub title: String,
    /// What is to be said of it, in Markdown.
    #[serde(default)]
    pub text: String,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// The command that makes its tables.
    #[serde(default)]
    pub command: Option<String>,
    /// CSV files, one below the other.
    pub tables: Vec<String>,
    /// Tables to look further columns up in.
    #[serde(default)]
    pub join: Vec<Join>,
    /// Only rows with these values in these columns.
    #[serde(default)]
    pub only: BTreeMap<String, Values>,
    /// Columns to sort by, the first one first; `-` before a name: the greatest first.
    #[serde(default)]
    pub sort: Vec<String>,
    /// What is shown [default: every column].
    #[serde(default)]
    pub columns: Vec<Shown>,
}

/// A table to look further columns up in; they are called `NAME.COLUMN`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Join {
    /// What stands before the dot.
    pub name: String,
    /// The CSV file.
    pub table: String,
    /// Columns that have to have the same values in both.
    pub on: Vec<String>,
}

/// A column of a table.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Shown {
    /// As it is, under its name.
    Plain(String),
    /// With more to say.
    Full(ShownColumn),
}

/// A column of a table, with its heading and format.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShownColumn {
    /// A column of the table, or `NAME.COLUMN` of a joined one.
    #[serde(default)]
    pub column: Option<String>,
    /// Or the ratio of two columns.
    #[serde(default)]
    pub ratio: Option<[String; 2]>,
    /// The column of half widths of the intervals around it.
    #[serde(default)]
    pub error: Option<String>,
    /// What stands above it [default: the column's name].
    #[serde(default)]
    pub heading: Option<String>,
    /// How its numbers are written.
    #[serde(default)]
    pub format: Option<String>,
}

/// A picture: a PNG file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureBlock {
    /// The file.
    pub file: String,
    /// What it shows, for those who do not see it.
    pub alt: String,
    /// What stands below it, in Markdown.
    #[serde(default)]
    pub caption: String,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// The command that makes it.
    #[serde(default)]
    pub command: Option<String>,
}

/// A text between other blocks.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paragraph {
    /// Its heading, below that of the section.
    #[serde(default)]
    pub heading: String,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// What it says, in Markdown.
    pub text: String,
}

impl Description {
    /// Reads a description.
    ///
    /// # Errors
    /// Where it is not TOML, or says what a description cannot: with the line.
    pub fn parse(toml: &str) -> Result<Self, PageError> {
        let page: Self = toml::from_str(toml).map_err(|error| {
            let line = error.span().map(|span| line_at(toml, span.start));
            PageError::asked(error.message()).at_line(line)
        })?;
        Ok(Self { toml: toml.to_owned(), ..page })
    }

    /// The page of a single chart, with its title as heading and its data as a table below.
    #[must_use]
    pub fn of_chart(chart: ChartBlock) -> Self {
        let title = match &*chart.title {
            "" => format!("{} against {}", chart.y, chart.x).replace('_', " "),
            title => title.to_owned(),
        };
        let table = TableBlock {
            title: "Data".into(),
            tables: chart.tables.clone(),
            only: chart.only.clone(),
            columns: chart.columns().map(|column| Shown::Plain(column.to_owned())).collect(),
            ..TableBlock::default()
        };
        let section = Section {
            chart: vec![Spanned::new(0..0, ChartBlock { title: String::new(), ..chart })],
            table: vec![Spanned::new(1..1, table)],
            ..Section::default()
        };
        Self { title, language: english(), section: vec![Spanned::new(0..0, section)], ..Self::default() }
    }
}

/// The line of a text that a byte is in, the first being 1.
pub(super) fn line_at(text: &str, byte: usize) -> usize {
    1 + text.bytes().take(byte).filter(|&b| b == b'\n').count()
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
