//! What lines, sizes and sets there can be.

use pm_size::Bytes;

use super::{ConfigError, SetIndex, Ways};

/// Smallest line, in bytes.
const MIN_LINE: u32 = 4;

/// The line as its type, if it will do.
pub(crate) fn check_line(line: u64) -> Result<u32, ConfigError> {
    match u32::try_from(line) {
        Ok(line) if line.is_power_of_two() && line >= MIN_LINE => Ok(line),
        Ok(short) => {
            let below = 1 << short.max(MIN_LINE).ilog2();
            let nearest = nearest(line, Some(below), (below < 1 << 31).then_some(below * 2));
            Err(ConfigError::Line { line, nearest: nearest as u32 })
        }
        Err(_) => Err(ConfigError::Line { line, nearest: 1 << 31 }),
    }
}

/// Whichever of two numbers exists and is nearer to `wanted`, the lower of equals.
pub(crate) fn nearest(wanted: u64, below: Option<u64>, above: Option<u64>) -> u64 {
    below.into_iter().chain(above).min_by_key(|n| n.abs_diff(wanted)).unwrap_or(wanted)
}

/// The size is a whole number of lines, at least one; each is of `line_bytes` bytes.
pub(super) fn check_lines(size_bytes: u64, line_bytes: u32) -> Result<(), ConfigError> {
    let line = u64::from(line_bytes);
    if size_bytes > 0 && size_bytes.is_multiple_of(line) {
        return Ok(());
    }
    let below = (size_bytes / line).max(1).checked_mul(line);
    let above = (size_bytes / line + 1).checked_mul(line);
    let nearest = Bytes(nearest(size_bytes, below, above));
    Err(ConfigError::NotLines { size: Bytes(size_bytes), line: line_bytes, nearest })
}

/// The lines fill a number of sets; a power of two if the set is a hash of the line's number.
pub(super) fn check_sets(size_bytes: u64, ways: Ways, line_bytes: u32, index: SetIndex) -> Result<(), ConfigError> {
    let Ways::N(ways) = ways else { return Ok(()) };
    let (number, line) = (u64::from(ways.get()), u64::from(line_bytes));
    let lines = size_bytes / line;
    if lines.is_multiple_of(number) && (index == SetIndex::Plain || (lines / number).is_power_of_two()) {
        return Ok(());
    }
    // Powers of two of sets on either side; a cache of fewer lines than ways has the lower one at 1 set.
    let below = 1 << (lines / number).max(1).ilog2();
    let bytes = |sets: u64| sets.checked_mul(number)?.checked_mul(line);
    let above = if lines < number { bytes(1) } else { bytes(below * 2) };
    let nearest = Bytes(nearest(size_bytes, bytes(below), above));
    Err(ConfigError::Sets { size: Bytes(size_bytes), ways: ways.get(), line: line_bytes, lines, nearest })
}
