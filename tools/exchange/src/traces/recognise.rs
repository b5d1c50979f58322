//! Which format an input is of, as its beginning tells.

use super::{Recognition, TraceImport};
use pm_registry::Registry;

/// The format of a text that begins so, if it is one of these: those that mistake no other for their own come first.
pub(super) fn recognise(beginning: &[u8], imports: &Registry<dyn TraceImport>) -> Option<&'static dyn TraceImport> {
    let tried = |how| imports.iter().filter(move |import| import.recognition() == how);
    let mut tried = tried(Recognition::FirstLine).chain(tried(Recognition::FirstLineAtLast));
    tried.find(|import| begins_as(*import, beginning))
}

/// Whether the beginning of an input is that of a format: its first line that is no comment is one of the format's.
fn begins_as(import: &dyn TraceImport, beginning: &[u8]) -> bool {
    let mut parser = import.parser();
    let mut comments = false;
    for line in beginning.split(|&byte| byte == b'\n') {
        if line.iter().any(|&byte| byte.is_ascii_control() && !b"\t\r".contains(&byte)) {
            return false;
        }
        match parser.parse(line) {
            Ok(Some(_)) => return true,
            Ok(None) => comments |= !line.trim_ascii().is_empty(),
            Err(_) => return false,
        }
    }
    comments
}
