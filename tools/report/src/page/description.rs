//! The description of a page: what its TOML may say. The format is explained in the module [`page`](super).

use super::bars::Bars;
use super::blocks::{ChartBlock, Paragraph, PictureBlock, Shown, TableBlock};
use crate::ReportError;
use minijinja::{Value, context};
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
    /// What stands above all else.
    #[serde(default)]
    pub bars: Option<Bars>,
    /// What it is about, with an address: the one link of a page that leads out of it.
    #[serde(default)]
    pub about: Option<About>,
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

/// What a page is about.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// What it is called.
    pub name: String,
    /// Where it is: an address that begins with `https://`.
    pub address: String,
}

impl About {
    /// What the template needs.
    ///
    /// # Errors
    /// If the address is of another kind: a browser would run or load what it names.
    pub(super) fn checked(&self) -> Result<Value, ReportError> {
        let Self { name, address } = self;
        if !address.starts_with("https://") || address.contains(|c: char| c.is_whitespace() || c.is_control()) {
            return Err(ReportError::asked(format!(
                "`{address}` as an address: it begins with https:// and has no blanks"
            )));
        }
        Ok(context! { name => &**name, address => &**address })
    }
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

impl Description {
    /// Reads a description.
    ///
    /// # Errors
    /// Where it is not TOML, or says what a description cannot: with the line.
    pub fn parse(toml: &str) -> Result<Self, ReportError> {
        let page: Self = toml::from_str(toml).map_err(|error| {
            let line = error.span().map(|span| line_at(toml, span.start));
            ReportError::asked(error.message()).at_line(line)
        })?;
        Ok(Self { toml: toml.to_owned(), ..page })
    }

    /// The line of the description that a byte is in.
    pub(super) fn line(&self, byte: usize) -> Option<usize> {
        (!self.toml.is_empty()).then(|| line_at(&self.toml, byte))
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
fn line_at(text: &str, byte: usize) -> usize {
    1 + text.bytes().take(byte).filter(|&b| b == b'\n').count()
}

#[cfg(test)]
mod tests;
