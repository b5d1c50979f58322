//! What is advised to one who typed a number in a way that is not understood.

use clap::error::{ContextKind, ContextValue};

/// A line of advice, if there is something to advise.
pub(super) fn on(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(typed)) = error.get(ContextKind::InvalidValue) else { return None };
    let number = written_out(typed)?;
    Some(format!("  tip: write the number out: {number}"))
}

/// The whole number that is meant by `1e6`, `1.5M` or `450k`: a letter is a power of ten, where no size in bytes is meant.
fn written_out(text: &str) -> Option<u64> {
    let (digits, zeros) = match text.split_once(['e', 'E']) {
        Some((digits, zeros)) => (digits, zeros.parse().ok()?),
        None => {
            let letter = text.chars().next_back()?;
            let zeros = match letter.to_ascii_lowercase() {
                'k' => 3,
                'm' => 6,
                'g' => 9,
                _ => return None,
            };
            (&text[..text.len() - 1], zeros)
        }
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let zeros = usize::checked_sub(zeros, part.len()).filter(|&zeros| zeros < 20)?;
    let all_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    (!whole.is_empty() && all_digits(whole) && all_digits(part)).then_some(())?;
    format!("{whole}{part}{}", "0".repeat(zeros)).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_out() {
        for (text, number) in [("1M", 1_000_000), ("1e6", 1_000_000), ("1.5k", 1500), ("450K", 450_000), ("2E0", 2)] {
            assert_eq!(written_out(text), Some(number), "{text}");
        }
        for text in ["", "M", "1.5", "1e-3", "1.2345k", "many", "1e99", "e6", "-1M"] {
            assert_eq!(written_out(text), None, "{text}");
        }
    }
}
