//! Numbers in text, checked: no sign, no overflow, nothing beside the digits.

/// Words between blanks.
pub fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|byte| byte.is_ascii_whitespace()).filter(|word| !word.is_empty())
}

/// A piece of the input, for a message.
pub fn quoted(text: &[u8]) -> String {
    const MOST: usize = 60;
    let cut = if text.len() > MOST { "..." } else { "" };
    format!("`{}{cut}`", String::from_utf8_lossy(&text[..text.len().min(MOST)]).escape_debug())
}

fn digits(text: &[u8], whole: &[u8], radix: u64) -> Result<u64, String> {
    if text.is_empty() {
        return Err(format!("{} is no number", quoted(whole)));
    }
    let mut value = 0u64;
    for &byte in text {
        let digit = char::from(byte).to_digit(radix as u32);
        let digit = digit.ok_or_else(|| {
            format!("{} is no {} number", quoted(whole), if radix == 16 { "hexadecimal" } else { "decimal" })
        })?;
        let next = value.checked_mul(radix).and_then(|value| value.checked_add(digit.into()));
        value = next.ok_or_else(|| format!("{} does not fit 64 bits", quoted(whole)))?;
    }
    Ok(value)
}

/// Digits after `0x`, if that is how it begins.
fn after_0x(text: &[u8]) -> Option<&[u8]> {
    text.strip_prefix(b"0x").or_else(|| text.strip_prefix(b"0X"))
}

/// A hexadecimal number, with or without `0x`.
pub fn hexadecimal(text: &[u8]) -> Result<u64, String> {
    digits(after_0x(text).unwrap_or(text), text, 16)
}

/// A decimal number, or a hexadecimal one that begins with `0x`.
pub fn number(text: &[u8]) -> Result<u64, String> {
    match after_0x(text) {
        Some(hex) => digits(hex, text, 16),
        None => digits(text, text, 10),
    }
}

/// A number of bytes.
pub fn size(value: u64) -> Result<u32, String> {
    u32::try_from(value).map_err(|_| format!("an access of {value} bytes is too long; 4294967295 is the most"))
}
