//! Memory that is asked for before work begins: a refusal is then an error as any other, and no abort in the middle.

use anyhow::bail;
use pm_size::Bytes;

/// Sees whether the system would give so many bytes for something. They are given back at once: whoever asks takes them next.
///
/// # Errors
/// If it would not.
pub fn room_for(bytes: u64, what: &str) -> anyhow::Result<()> {
    let mut room: Vec<u8> = vec![];
    let reserved = usize::try_from(bytes).ok().and_then(|bytes| room.try_reserve_exact(bytes).ok());
    if std::hint::black_box(reserved).is_none() {
        bail!("not enough memory: {what} takes {}", Bytes(bytes));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_machine_has_room_for_everything() {
        assert!(room_for(0, "nothing").is_ok() && room_for(1 << 20, "little").is_ok());
        for bytes in [1 << 62, u64::MAX] {
            let said = room_for(bytes, "a picture of 3 x 4 pixels").unwrap_err().to_string();
            assert!(said.starts_with("not enough memory: a picture of 3 x 4 pixels takes "), "{said}");
        }
    }
}
