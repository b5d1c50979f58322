//! Texts: Markdown into HTML, with the numbers that they name.

use super::html::{render, safe};
use super::written::Written;
use crate::ReportError;
use minijinja::{Value, context};
use pulldown_cmark::{CowStr, Event, HeadingLevel, LinkType, Options, Parser, Tag, TagEnd};

/// Around the number of an expression, while Markdown is read: letters that no text has (Unicode: private use).
const BEFORE: char = '\u{f8f0}';
const BEHIND: char = '\u{f8f1}';

/// A text of a page.
pub(super) struct Text {
    /// It in HTML.
    pub(super) html: String,
    /// Places of the page that it links to.
    pub(super) links: Vec<String>,
}

/// Markdown as HTML. Its headings are those below a section's; what looks like HTML is text; of an address outside the page
/// only the text is left, the address in brackets behind it.
///
/// # Errors
/// If an expression is wrong, or a picture is named: pictures are blocks of their own.
pub(super) fn html(
    markdown: &str,
    evaluate: &mut dyn FnMut(&str) -> Result<Written, ReportError>,
) -> Result<Text, ReportError> {
    let (marked, numbers) = take_out(markdown, evaluate)?;
    let mut events = vec![];
    let mut links = vec![];
    // Addresses of the links that are open.
    let mut outside: Vec<Option<CowStr<'_>>> = vec![];
    for event in Parser::new_ext(&marked, Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH) {
        match event {
            Event::Html(text) | Event::InlineHtml(text) => put_in(&text, &numbers, &mut events),
            Event::Text(text) => put_in(&text, &numbers, &mut events),
            Event::Code(text) => {
                events.push(Event::InlineHtml(code(&text, &numbers).into()));
            }
            Event::Start(Tag::Heading { level, .. }) => {
                let level = lower(level);
                events.push(Event::Start(Tag::Heading { level, id: None, classes: vec![], attrs: vec![] }));
            }
            Event::End(TagEnd::Heading(level)) => events.push(Event::End(TagEnd::Heading(lower(level)))),
            Event::Start(Tag::Link { link_type, dest_url, .. }) => match dest_url.strip_prefix('#') {
                Some(place) => {
                    links.push(place.to_owned());
                    outside.push(None);
                    let (title, id) = ("".into(), "".into());
                    events.push(Event::Start(Tag::Link { link_type: LinkType::Inline, dest_url, title, id }));
                }
                None => outside.push(Some(if link_type == LinkType::Autolink { "".into() } else { dest_url })),
            },
            Event::End(TagEnd::Link) => match outside.pop().flatten() {
                None => events.push(Event::End(TagEnd::Link)),
                Some(address) if address.is_empty() => {}
                Some(address) => events.push(Event::Text(format!(" ({address})").into())),
            },
            Event::Start(Tag::Image { dest_url, .. }) => {
                return Err(ReportError::asked(format!(
                    "{dest_url}: pictures are blocks of their own, [[section.picture]]"
                )));
            }
            other => events.push(other),
        }
    }
    let mut html = String::new();
    pulldown_cmark::html::push_html(&mut html, events.into_iter());
    Ok(Text { html: with_tables(&html), links })
}

/// A text that is no Markdown, with its numbers, not yet escaped: for headings and attributes.
///
/// # Errors
/// If an expression is wrong.
pub(super) fn plain(
    text: &str,
    evaluate: &mut dyn FnMut(&str) -> Result<Written, ReportError>,
) -> Result<String, ReportError> {
    let (marked, numbers) = take_out(text, evaluate)?;
    let mut plain = String::new();
    for piece in pieces(&marked, &numbers) {
        plain += match piece {
            Piece::Text(text) => text,
            Piece::Number(written) => &written.text,
        };
    }
    Ok(plain)
}

/// The tables of Markdown as the page has its own: headings say what they head, and what is wide can be moved.
fn with_tables(html: &str) -> String {
    // Text is escaped: these are marks.
    html.replace("<th>", "<th scope=\"col\">")
        .replace("<th style", "<th scope=\"col\" style")
        .replace("<table>", "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"Table\"><table>")
        .replace("</table>", "</table></div>")
}

/// `#` is a heading below that of a block, which is at level 3.
fn lower(level: HeadingLevel) -> HeadingLevel {
    HeadingLevel::try_from((level as usize + 3).min(6)).unwrap_or(HeadingLevel::H6)
}

/// Evaluates the expressions of a text, and leaves marks with their numbers in their places.
fn take_out(
    text: &str,
    evaluate: &mut dyn FnMut(&str) -> Result<Written, ReportError>,
) -> Result<(String, Vec<Written>), ReportError> {
    let mut marked = String::with_capacity(text.len());
    let mut numbers = vec![];
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("{{") {
        let (expression, after) = behind.split_once("}}").ok_or_else(|| {
            let start: String = behind.chars().take(40).collect();
            ReportError::asked(format!("`{{{{{start}` is not closed by `}}}}`"))
        })?;
        marked.extend(before.chars().filter(|&c| c != BEFORE && c != BEHIND));
        marked += &format!("{BEFORE}{}{BEHIND}", numbers.len());
        numbers.push(evaluate(expression)?);
        rest = after;
    }
    marked.extend(rest.chars().filter(|&c| c != BEFORE && c != BEHIND));
    Ok((marked, numbers))
}

enum Piece<'a> {
    Text(&'a str),
    Number(&'a Written),
}

/// A marked text in pieces.
fn pieces<'a>(marked: &'a str, numbers: &'a [Written]) -> Vec<Piece<'a>> {
    let mut pieces = vec![];
    for piece in marked.split_inclusive(BEHIND) {
        let number = piece.strip_suffix(BEHIND).and_then(|piece| {
            let (before, number) = piece.rsplit_once(BEFORE)?;
            Some((before, numbers.get(number.parse::<usize>().ok()?)?))
        });
        match number {
            Some((before, written)) => pieces.extend([Piece::Text(before), Piece::Number(written)]),
            None => pieces.push(Piece::Text(piece)),
        }
    }
    pieces
}

fn put_in(text: &str, numbers: &[Written], events: &mut Vec<Event<'_>>) {
    for piece in pieces(text, numbers) {
        events.push(match piece {
            Piece::Text(text) => Event::Text(text.to_owned().into()),
            Piece::Number(written) => Event::InlineHtml(shown(written).into()),
        });
    }
}

fn code(text: &str, numbers: &[Written]) -> String {
    let pieces = pieces(text, numbers).into_iter().map(|piece| match piece {
        Piece::Text(text) => Value::from(text),
        Piece::Number(written) => safe(shown(written)),
    });
    render("code.html", context! { pieces => pieces.collect::<Vec<_>>() })
}

/// A number as it stands in the page: where it is from, and how it was found if not in full.
fn shown(written: &Written) -> String {
    let Written { text, source, found } = written;
    let found = found.as_deref().filter(|found| *found != "full");
    render("number.html", context! { text => &**text, source => &**source, found })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(markdown: &str) -> String {
        let mut number = |text: &str| {
            let found = Some(if text.trim() == "a" { "full" } else { "sampled" }.to_owned());
            Ok(Written { text: format!("<{}>", text.trim()), source: "t.csv".into(), found })
        };
        html(markdown, &mut number).unwrap_or_else(|error| panic!("{error}")).html
    }

    #[test]
    fn numbers_stand_wherever_text_does() {
        let a = "<span class=\"number\" title=\"t.csv\">&lt;a&gt;</span>";
        let b = "<span class=\"number\" title=\"t.csv\">&lt;b&gt;</span><span class=\"found\"> (sampled)</span>";
        assert_eq!(written("x {{a}} **{{ b }}** y"), format!("<p>x {a} <strong>{b}</strong> y</p>\n"));
        assert_eq!(written("`{{a}}`"), format!("<p><code>{a}</code></p>\n"));
        assert_eq!(written("{{a}}{{a}}"), format!("<p>{a}{a}</p>\n"));
        let table = written("| x | y |\n| --- | --- |\n| {{a}} | 2 |\n");
        assert!(table.contains(&format!("<td>{a}</td>")) && table.contains("<th scope=\"col\">y</th>"), "{table}");
    }

    #[test]
    fn html_is_text_and_addresses_outside_are_told_but_not_linked() {
        assert_eq!(written("a <b>c</b>"), "<p>a &lt;b&gt;c&lt;/b&gt;</p>\n");
        assert_eq!(written("<script>\n"), "&lt;script&gt;\n");
        assert_eq!(written("[paper](https://a.org/x)"), "<p>paper (https://a.org/x)</p>\n");
        assert_eq!(written("<https://a.org/x>"), "<p>https://a.org/x</p>\n");
        assert_eq!(written("[there](#here)"), "<p><a href=\"#here\">there</a></p>\n");
        assert_eq!(written("# One"), "<h4>One</h4>\n");
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let refused = |text: &str| {
            let mut number = |_: &str| Err(ReportError::asked("no such number"));
            html(text, &mut number).err().expect("refused").to_string()
        };
        assert_eq!(refused("a {{ b"), "`{{ b` is not closed by `}}`");
        assert_eq!(refused("a {{b}}"), "no such number");
        assert!(refused("![a](b.png)").starts_with("b.png: pictures are blocks"));
    }
}
