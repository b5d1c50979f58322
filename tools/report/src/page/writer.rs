//! The page as a whole: its sections, what each block is called, and where links lead.

use super::html::{render, safe};
use super::written::evaluate;
use super::{About, Block, Description, Section, bars, chart, markdown, picture, table};
use crate::ReportError;
use crate::chart::dark_style;
use crate::expression::{Definition, Evaluator};
use crate::sheet::Sheets;
use minijinja::{Value, context};

const STYLE: &str = include_str!("style.css");

impl Description {
    /// Writes the page: one HTML file that needs nothing else. Equal descriptions and tables give equal bytes; `generator`
    /// is the program that says it wrote the page.
    ///
    /// # Errors
    /// Where a file, row or column that the description names is not there or not as it should be, with the line.
    pub fn html(&self, sheets: &Sheets, generator: &str) -> Result<String, ReportError> {
        Writer { page: self, sheets, evaluator: self.evaluator(sheets), links: vec![] }.page(generator)
    }

    /// What evaluates the expressions of its texts.
    pub(super) fn evaluator(&self, sheets: &Sheets) -> Evaluator {
        let definition = |named: &toml::Spanned<String>| Definition {
            text: named.as_ref().clone(),
            line: self.line(named.span().start),
        };
        Evaluator::new(sheets, self.numbers.iter().map(|(name, named)| (name.clone(), definition(named))).collect())
    }
}

struct Writer<'a> {
    page: &'a Description,
    sheets: &'a Sheets,
    evaluator: Evaluator,
    /// What links want to reach, each with the line.
    links: Vec<(String, Option<usize>)>,
}

impl Writer<'_> {
    fn page(mut self, generator: &str) -> Result<String, ReportError> {
        let page = self.page;
        let title = self.plain(&page.title)?;
        let intro = self.text(&page.intro, None)?;
        let bars =
            page.bars.as_ref().map(|bars| bars::bars(bars, &self.evaluator, |text| self.plain(text))).transpose()?;
        let about = page.about.as_ref().map(About::checked).transpose()?;
        let (ids, taken) = page.ids()?;
        let mut sections = vec![];
        for (section, id) in page.section.iter().zip(ids) {
            let line = page.line(section.span().start);
            sections.push(self.section(section.as_ref(), id, line).map_err(|error| error.at_line(line))?);
        }
        if let Some((lost, line)) = self.links.iter().find(|(link, _)| !taken.contains(link)) {
            return Err(ReportError::asked(format!("there is nothing called #{lost} on the page")).at_line(*line));
        }
        Ok(render(
            "page.html",
            context! {
                language => &*page.language,
                generator,
                title,
                style => safe(format!("{STYLE}{}", dark_style())),
                bars => bars.unwrap_or_else(|| Value::from(())),
                intro,
                about => about.unwrap_or_else(|| Value::from(())),
                sections,
            },
        ))
    }

    fn section(&mut self, section: &Section, id: String, line: Option<usize>) -> Result<Value, ReportError> {
        let heading = self.plain(&section.heading)?;
        let text = self.text(&section.text, line)?;
        // Pictures that follow one another stand side by side.
        let mut groups: Vec<(bool, Vec<Value>)> = vec![];
        for (start, block) in section.blocks() {
            let pictures = matches!(block, Block::Picture(_));
            let line = self.page.line(start);
            let block = self.block(block, section, line).map_err(|error| error.at_line(line))?;
            match groups.last_mut().filter(|(of_pictures, _)| *of_pictures == pictures) {
                Some((_, blocks)) => blocks.push(block),
                None => groups.push((pictures, vec![block])),
            }
        }
        let groups: Vec<Value> = groups.into_iter().map(|(pictures, blocks)| context! { pictures, blocks }).collect();
        Ok(context! { id, heading, text, groups })
    }

    fn block(&mut self, block: Block<'_>, section: &Section, line: Option<usize>) -> Result<Value, ReportError> {
        let page = self.page;
        // The nearest that says it.
        let command = |own: &Option<String>| own.clone().or(section.command.clone()).or(page.command.clone());
        match block {
            Block::Chart(block) => {
                let axes = format!("{} against {}", block.y, block.x).replace('_', " ");
                let title = self.plain(if block.title.is_empty() { &axes } else { &block.title })?;
                let text = self.text(&block.text, line)?;
                chart::block(block, (title, text), command(&block.command).as_deref(), self.sheets)
            }
            Block::Table(block) => {
                let title = self.plain(&block.title)?;
                let text = self.text(&block.text, line)?;
                table::block(block, (title, text), command(&block.command).as_deref(), self.sheets)
            }
            Block::Picture(block) => {
                let alt = self.plain(&block.alt)?;
                let caption = self.text(&block.caption, line)?;
                picture::block(block, (alt, caption), command(&block.command).as_deref(), self.sheets)
            }
            Block::Paragraph(block) => Ok(context! {
                template => "paragraph.html",
                id => block.id.as_deref(),
                heading => self.plain(&block.heading)?,
                text => self.text(&block.text, line)?,
            }),
        }
    }

    /// Markdown as HTML.
    fn text(&mut self, text: &str, line: Option<usize>) -> Result<Value, ReportError> {
        let text = markdown::html(text, &mut |expression| evaluate(expression, &self.evaluator))?;
        self.links.extend(text.links.into_iter().map(|link| (link, line)));
        Ok(safe(text.html))
    }

    /// A text that is no Markdown, not escaped.
    fn plain(&self, text: &str) -> Result<String, ReportError> {
        markdown::plain(text, &mut |expression| evaluate(expression, &self.evaluator))
    }
}
