//! The templates of a page, and pieces of HTML.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use minijinja::syntax::SyntaxConfig;
use minijinja::{AutoEscape, Environment, Output, State, UndefinedBehavior, Value};
use std::sync::OnceLock;

/// A file of this folder each; what they are given is escaped unless it is HTML already.
const TEMPLATES: [(&str, &str); 10] = [
    ("page.html", include_str!("templates/page.html")),
    ("bars.html", include_str!("templates/bars.html")),
    ("chart.html", include_str!("templates/chart.html")),
    ("table.html", include_str!("templates/table.html")),
    ("picture.html", include_str!("templates/picture.html")),
    ("paragraph.html", include_str!("templates/paragraph.html")),
    ("below.html", include_str!("templates/below.html")),
    ("made.html", include_str!("templates/made.html")),
    ("number.html", include_str!("templates/number.html")),
    ("code.html", include_str!("templates/code.html")),
];

/// What a template makes of these values.
///
/// # Panics
/// Never: the templates are ours, and the tests render all of them.
pub(super) fn render(template: &str, values: Value) -> String {
    static ENVIRONMENT: OnceLock<Environment<'static>> = OnceLock::new();
    let environment = ENVIRONMENT.get_or_init(|| {
        let mut environment = Environment::new();
        let mut syntax = SyntaxConfig::builder();
        environment.set_syntax(
            syntax.trim_blocks(true).lstrip_blocks(true).keep_trailing_newline(true).build().expect("it is valid"),
        );
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        environment.set_auto_escape_callback(|_| AutoEscape::Html);
        environment.set_formatter(escape);
        for (name, text) in TEMPLATES {
            environment.add_template(name, text).expect("the templates are valid");
        }
        environment
    });
    let rendered = environment.get_template(template).and_then(|template| template.render(values));
    rendered.unwrap_or_else(|error| panic!("{template}: {error:#}"))
}

/// HTML that a template is not to escape.
pub(super) fn safe(html: String) -> Value {
    Value::from_safe_string(html)
}

/// Writes a value as HTML has it, in elements and in attributes in double quotes.
fn escape(out: &mut Output<'_>, _: &mut State<'_, '_>, value: &Value) -> Result<(), minijinja::Error> {
    let text = value.to_string();
    let text = if value.is_safe() { text } else { escaped(&text) };
    Ok(out.write_str(&text)?)
}

fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // What no HTML may hold.
            '\u{0}'..='\u{8}' | '\u{b}' | '\u{e}'..='\u{1f}' | '\u{7f}' => safe.push('\u{fffd}'),
            _ => safe.push(letter),
        }
    }
    safe
}

/// Bytes as an address that holds them.
pub(super) fn data_uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_text_is_markup() {
        assert_eq!(escaped("a < b & \"c\" > d\u{7}"), "a &lt; b &amp; &quot;c&quot; &gt; d\u{fffd}");
    }

    #[test]
    fn data_addresses_hold_the_bytes() {
        // RFC 4648, section 10.
        assert_eq!(data_uri("text/csv", b"foobar"), "data:text/csv;base64,Zm9vYmFy");
    }
}
