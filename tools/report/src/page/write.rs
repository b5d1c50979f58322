//! The page as a whole: its frame, its sections, what each block is called.

use super::description::line_at;
use super::expression::evaluate;
use super::html::{data_uri, escaped, id_attribute, png_size, slug};
use super::markdown;
use super::{Block, Description, PageError, PictureBlock, Section, Sheets, chart, table};
use crate::chart::dark_style;
use std::collections::BTreeSet;
use std::fmt::Write as _;

const STYLE: &str = include_str!("style.css");

impl Description {
    /// Writes the page: one HTML file that needs nothing else. Equal descriptions and tables give equal bytes; `generator`
    /// is the program that says it wrote the page.
    ///
    /// # Errors
    /// Where a file, row or column that the description names is not there or not as it should be, with the line.
    pub fn html(&self, sheets: &mut Sheets, generator: &str) -> Result<String, PageError> {
        Writer { page: self, sheets, ids: BTreeSet::new(), links: vec![] }.page(generator)
    }

    /// The line of the description that a byte is in.
    fn line(&self, byte: usize) -> Option<usize> {
        (!self.toml.is_empty()).then(|| line_at(&self.toml, byte))
    }
}

struct Writer<'a> {
    page: &'a Description,
    sheets: &'a mut Sheets,
    /// What links can reach.
    ids: BTreeSet<String>,
    /// What links want to reach, each with the line.
    links: Vec<(String, Option<usize>)>,
}

impl Writer<'_> {
    fn page(mut self, generator: &str) -> Result<String, PageError> {
        let page = self.page;
        let title = escaped(&self.plain(&page.title)?);
        let intro = self.text(&page.intro, None)?;
        let ids = self.section_ids()?;
        let mut sections = String::new();
        let mut contents = String::new();
        for (section, id) in page.section.iter().zip(&ids) {
            let line = page.line(section.span().start);
            let (heading, html) = self.section(section.as_ref(), id, line).map_err(|error| error.at_line(line))?;
            sections += &html;
            let heading = if heading.is_empty() { id } else { &heading };
            let _ = writeln!(contents, "<li><a href=\"#{}\">{heading}</a></li>", escaped(id));
        }
        if let Some((lost, line)) = self.links.iter().find(|(link, _)| !self.ids.contains(link)) {
            return Err(PageError::asked(format!("there is nothing called #{lost} on the page")).at_line(*line));
        }
        let contents = match ids.len() {
            0 | 1 => String::new(),
            _ => format!("<nav aria-label=\"Contents\">\n<ol>\n{contents}</ol>\n</nav>\n"),
        };
        Ok(format!(
            "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"{}\">\n\
             <title>{title}</title>\n<style>\n{STYLE}{}\n</style>\n</head>\n<body>\n\
             <header>\n<h1>{title}</h1>\n{intro}{contents}</header>\n<main>\n{sections}</main>\n</body>\n</html>\n",
            escaped(&page.language),
            escaped(generator),
            dark_style()
        ))
    }

    /// A name for each section: the one given, or the words of its heading.
    fn section_ids(&mut self) -> Result<Vec<String>, PageError> {
        let page = self.page;
        // Names that are given come first, whatever headings there are.
        for section in &page.section {
            let inside = section.as_ref();
            let blocks = inside.blocks();
            let given = blocks.iter().filter_map(|(start, block)| Some((*start, block.id()?)));
            for (start, id) in inside.id.as_deref().map(|id| (section.span().start, id)).into_iter().chain(given) {
                if id.is_empty() || id.contains(char::is_whitespace) || !self.ids.insert(id.to_owned()) {
                    let wrong = format!("`{id}` as an id is empty, has blanks or is there twice");
                    return Err(PageError::asked(wrong).at_line(page.line(start)));
                }
            }
        }
        let sections = page.section.iter().map(|section| match &section.as_ref().id {
            Some(id) => id.clone(),
            None => {
                let slug = slug(&section.as_ref().heading);
                let mut numbered = (2..).map(|number| format!("{slug}-{number}"));
                let mut id = slug.clone();
                while !self.ids.insert(id.clone()) {
                    id = numbered.next().unwrap_or_default();
                }
                id
            }
        });
        Ok(sections.collect())
    }

    /// A section: its heading, and all of it.
    fn section(&mut self, section: &Section, id: &str, line: Option<usize>) -> Result<(String, String), PageError> {
        let heading = escaped(&self.plain(&section.heading)?);
        let mut html = format!("<section{}>\n", id_attribute(Some(id)));
        if !heading.is_empty() {
            let _ = writeln!(html, "<h2>{heading}</h2>");
        }
        html += &self.text(&section.text, line)?;
        let mut in_pictures = false;
        for (start, block) in section.blocks() {
            let is_picture = matches!(block, Block::Picture(_));
            if is_picture != in_pictures {
                html += if is_picture { "<div class=\"pictures\">\n" } else { "</div>\n" };
                in_pictures = is_picture;
            }
            let line = self.page.line(start);
            html += &self.block(block, section, line).map_err(|error| error.at_line(line))?;
        }
        if in_pictures {
            html += "</div>\n";
        }
        Ok((heading, html + "</section>\n"))
    }

    fn block(&mut self, block: Block<'_>, section: &Section, line: Option<usize>) -> Result<String, PageError> {
        let page = self.page;
        // The nearest that says it.
        let command = |own: &Option<String>| own.clone().or(section.command.clone()).or(page.command.clone());
        match block {
            Block::Chart(block) => {
                let axes = format!("{} against {}", block.y, block.x).replace('_', " ");
                let title = self.plain(if block.title.is_empty() { &axes } else { &block.title })?;
                let texts = (&*title, &*escaped(&title), &*self.text(&block.text, line)?);
                chart::html(block, texts, command(&block.command).as_deref(), self.sheets)
            }
            Block::Table(block) => {
                let title = self.plain(&block.title)?;
                let texts = (&*title, &*escaped(&title), &*self.text(&block.text, line)?);
                table::html(block, texts, command(&block.command).as_deref(), self.sheets)
            }
            Block::Picture(block) => self.picture(block, command(&block.command).as_deref(), line),
            Block::Paragraph(block) => {
                let heading = escaped(&self.plain(&block.heading)?);
                let id = id_attribute(block.id.as_deref());
                let heading = match (heading.is_empty(), block.id.is_some()) {
                    (false, _) => format!("<h3{id}>{heading}</h3>\n"),
                    (true, true) => format!("<div{id}></div>\n"),
                    (true, false) => String::new(),
                };
                Ok(heading + &self.text(&block.text, line)?)
            }
        }
    }

    fn picture(
        &mut self,
        block: &PictureBlock,
        command: Option<&str>,
        line: Option<usize>,
    ) -> Result<String, PageError> {
        let bytes = self.sheets.bytes(&block.file)?;
        let (width, height) =
            png_size(&bytes).ok_or_else(|| PageError::read(format!("{}: this is not a PNG file", block.file)))?;
        let alt = self.plain(&block.alt)?;
        if alt.trim().is_empty() {
            return Err(PageError::asked("`alt` says what the picture shows, for those who do not see it"));
        }
        let mut html = format!(
            "<figure class=\"picture\"{}>\n<img src=\"{}\" alt=\"{}\" width=\"{width}\" height=\"{height}\">\n",
            id_attribute(block.id.as_deref()),
            data_uri("image/png", &bytes),
            escaped(&alt)
        );
        let caption = self.text(&block.caption, line)? + &super::below::made_by(command);
        if !caption.is_empty() {
            let _ = writeln!(html, "<figcaption>{caption}</figcaption>");
        }
        Ok(html + "</figure>\n")
    }

    /// Markdown as HTML.
    fn text(&mut self, text: &str, line: Option<usize>) -> Result<String, PageError> {
        let Self { page, sheets, .. } = self;
        let text = markdown::html(text, &mut |expression| evaluate(expression, page, sheets))?;
        self.links.extend(text.links.into_iter().map(|link| (link, line)));
        Ok(text.html)
    }

    /// A text that is no Markdown, not escaped.
    fn plain(&mut self, text: &str) -> Result<String, PageError> {
        let Self { page, sheets, .. } = self;
        markdown::plain(text, &mut |expression| evaluate(expression, page, sheets))
    }
}
