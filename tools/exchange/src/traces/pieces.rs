//! What becomes an entry of an export: an access, or its part in one line.

use pm_formats::trace::AccessKind;

/// An access, or its part in one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// What is done.
    pub kind: AccessKind,
    /// First byte.
    pub address: u64,
    /// Bytes.
    pub len: u32,
    /// Number of the search that it belongs to, from 0.
    pub search: u64,
}

impl Piece {
    /// Is it a write?
    #[must_use]
    pub fn is_write(&self) -> bool {
        self.kind == AccessKind::Write
    }

    /// The parts in lines of `line` bytes: where they begin in each, or the whole lines.
    pub(super) fn in_lines(self, line: u64, whole: bool) -> impl Iterator<Item = Self> {
        let last = self.address + u64::from(self.len.max(1) - 1);
        (self.address / line..=last / line).map(move |number| {
            let (begin, end) = (number * line, number * line + (line - 1));
            if whole {
                return Self { address: begin, len: line as u32, ..self };
            }
            let (first, last) = (begin.max(self.address), end.min(last));
            let len = if self.len == 0 { 0 } else { (last - first + 1) as u32 };
            Self { address: first, len, ..self }
        })
    }
}
