//! Memory that is asked for before work begins: a refusal is then an error as any other, and no abort in the middle.

use anyhow::bail;
use pm_parallel::is_room;
use pm_size::Bytes;

/// What any program takes besides: a block in every form on its way, what zstd knows of it, buffers of files.
const WORK: u64 = 8 << 20;

/// Sees whether the system would give so many bytes for something, and leave enough for all that is small. They are given back at
/// once: whoever asks takes them next.
///
/// # Errors
/// If it would not.
pub fn room_for(bytes: u64, what: &str) -> anyhow::Result<()> {
    if !usize::try_from(bytes.saturating_add(WORK)).is_ok_and(is_room) {
        bail!("not enough memory: {what} takes {}", Bytes(bytes));
    }
    Ok(())
}

/// Sees whether there is room for any work at all. Each small thing would be an abort of its own where the system refuses it.
///
/// # Errors
/// If there is not.
pub(super) fn room_to_begin() -> anyhow::Result<()> {
    if !is_room_for_work() {
        bail!("not enough memory to begin with: {} more are needed", Bytes(WORK));
    }
    Ok(())
}

/// Sees whether what is small would find its place still.
pub(super) fn is_room_for_work() -> bool {
    is_room(WORK as usize)
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
