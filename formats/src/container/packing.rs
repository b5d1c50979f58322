//! Payloads made small and large again, by contexts that each thread keeps: to make one costs as much as a small block.

use std::cell::RefCell;
use std::io;
use zstd::bulk::{Compressor, Decompressor};
use zstd::zstd_safe::{CCtx, CParameter, DCtx};

thread_local! {
    static COMPRESSOR: RefCell<Option<Compressor<'static>>> = const { RefCell::new(None) };
    static DECOMPRESSOR: RefCell<Option<Decompressor<'static>>> = const { RefCell::new(None) };
}

/// A zstd frame that holds the payload.
pub(super) fn compress(payload: &[u8], level: i32) -> io::Result<Vec<u8>> {
    COMPRESSOR.with_borrow_mut(|kept| {
        let compressor = match kept {
            Some(compressor) => compressor,
            // The library would panic where the system refuses its memory.
            None if CCtx::try_create().is_none() => return Err(no_memory()),
            None => kept.insert(Compressor::new(level)?),
        };
        compressor.set_compression_level(level)?;
        compressor.compress(payload)
    })
}

/// The same where what repeats may be far apart, anywhere in the payload.
pub(crate) fn compress_long(payload: &[u8], level: i32) -> io::Result<Vec<u8>> {
    // All of the payload in the window, but for the smallest and the largest that zstd has.
    let window = payload.len().next_power_of_two().ilog2().clamp(10, 27);
    let mut compressor = Compressor::new(level)?;
    compressor.set_parameter(CParameter::EnableLongDistanceMatching(true))?;
    compressor.set_parameter(CParameter::WindowLog(window))?;
    compressor.compress(payload)
}

/// Makes this thread's context for [`decompress`].
///
/// # Errors
/// If there is no memory for it.
pub(super) fn prepare() -> io::Result<()> {
    DECOMPRESSOR.with_borrow_mut(|kept| {
        if kept.is_none() {
            DCtx::try_create().ok_or_else(no_memory)?;
            *kept = Some(Decompressor::new()?);
        }
        Ok(())
    })
}

fn no_memory() -> io::Error {
    io::Error::new(io::ErrorKind::OutOfMemory, "not enough memory")
}

/// What a zstd frame says of the size of its payload.
pub(crate) fn content_size(frame: &[u8]) -> Option<usize> {
    zstd::zstd_safe::get_frame_content_size(frame).ok()??.try_into().ok()
}

/// The payload of a zstd frame, into a buffer. Returns its size.
pub(crate) fn decompress(frame: &[u8], payload: &mut [u8]) -> io::Result<usize> {
    DECOMPRESSOR.with_borrow_mut(|kept| {
        let decompressor = match kept {
            Some(decompressor) => decompressor,
            None => kept.insert(Decompressor::new()?),
        };
        decompressor.decompress_to_buffer(frame, payload)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_context_that_was_used_before_makes_the_same_frame() {
        let text = |n: usize, step: usize| (0..n).map(|i| (i * step / 7 % 251) as u8).collect::<Vec<_>>();
        for (at, level) in [0, 1, 3, 1, 9, 0, 1].into_iter().enumerate() {
            for payload in [text(100_000, 3 + at), text(10, 1), vec![], text(300_000, 1)] {
                let frame = compress(&payload, level).unwrap();
                assert_eq!(frame, zstd::bulk::compress(&payload, level).unwrap(), "{at}, {level}");
                let mut again = vec![0; payload.len()];
                assert_eq!(decompress(&frame, &mut again).unwrap(), payload.len());
                assert_eq!(again, payload);
            }
            // What is damaged does no harm to those that come after it.
            assert!(decompress(&[0x28, 0xb5, 0x2f, 0xfd, 1, 2, 3], &mut [0; 100]).is_err());
        }
    }
}
