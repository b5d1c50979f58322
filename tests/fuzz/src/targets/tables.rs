//! Tables and pages.

use pm_report::page::Description;
use pm_report::sheet::Sheet;

/// The same bytes as a table and as a page's description.
pub(super) fn read(data: &[u8]) {
    let _ = Sheet::parse("t.csv", data);
    let _ = Sheet::parse_with_remarks("t.csv", data);
    if let Ok(text) = std::str::from_utf8(data) {
        let _ = Description::parse(text);
    }
}
