//! Which format an input is of, as its beginning tells.

use super::{Recognition, TraceImport};
use pm_registry::Registry;

/// What a beginning tells.
pub(super) enum Recognised {
    /// It is of no format that is known.
    Unknown,
    /// It is of this format.
    Known(&'static dyn TraceImport),
    /// It may be of any of these.
    Doubtful(Vec<&'static dyn TraceImport>),
}

/// The format of which the beginning of an input has the signature.
pub(super) fn signed(beginning: &[u8], imports: &Registry<dyn TraceImport>) -> Option<&'static dyn TraceImport> {
    imports.iter().find(|import| import.signs(beginning))
}

/// The format of a text that begins so: the one that understands its lines for longest. `whole` says that nothing follows.
pub(super) fn recognise(beginning: &[u8], whole: bool, imports: &Registry<dyn TraceImport>) -> Recognised {
    let mut lines: Vec<&[u8]> = beginning.split(|&byte| byte == b'\n').collect();
    if !whole && lines.len() > 1 {
        // Its end is not there.
        lines.pop();
    }
    let mut longest = 0;
    let mut fitting = vec![];
    for import in imports.iter().filter(|import| import.recognition() == Recognition::FirstLine) {
        let understood = understood(import, &lines);
        if understood > longest {
            longest = understood;
            fitting.clear();
        }
        if understood == longest && longest > 0 {
            fitting.push(import);
        }
    }
    match fitting[..] {
        [] => Recognised::Unknown,
        [one] => Recognised::Known(one),
        _ => Recognised::Doubtful(fitting),
    }
}

/// How many lines a format understands before the first that is none of its own; 0 if there is no entry among them while
/// a line is wrong, or if there are only empty ones.
fn understood(import: &dyn TraceImport, lines: &[&[u8]]) -> usize {
    let mut parser = import.parser();
    let (mut entries, mut comments) = (0, 0);
    for (number, line) in lines.iter().enumerate().filter(|(_, line)| !line.trim_ascii().is_empty()) {
        let text = !line.iter().any(|&byte| byte.is_ascii_control() && !b"\t\r".contains(&byte));
        match parser.parse(line) {
            Ok(Some(_)) if text => entries += 1,
            Ok(None) if text => comments += 1,
            _ => return if entries > 0 { number } else { 0 },
        }
    }
    if entries + comments > 0 { lines.len() } else { 0 }
}
