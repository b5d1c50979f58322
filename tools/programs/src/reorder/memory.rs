//! What this machine may spend on sorting, and what is said of it.

use super::args::Args;
use indicatif::BinaryBytes;
use pm_formats::{Header, Query};
use pm_orders::{Limits, Per};
use pm_size::Bytes;

/// Streams that need more than this while they are held are announced.
const WORTH_SAYING: u64 = 256 << 20;

/// The limits, with a remark if much memory will be taken.
pub(super) fn limits(args: &Args, header: &Header) -> Limits {
    let (voice, memory, folder) = (args.rest.voice, args.rest.memory.0, std::env::temp_dir());
    // A record and its sorting key each.
    let bytes = |records: u64| records.saturating_mul((size_of::<Query>() + size_of::<u64>()) as u64);
    let expected = header.expected_records.filter(|_| args.first.per == Per::Image);
    let held = expected.filter(|_| !args.order.entry.is_streaming());
    if let Some(records) = held.filter(|&records| (WORTH_SAYING..=memory).contains(&bytes(records))) {
        let size = BinaryBytes(bytes(records));
        voice.remark(format!("up to {records} queries will be held in {size} of memory to order the whole image"));
    }
    let size = expected.map_or(String::new(), |records| format!(", up to {}", BinaryBytes(bytes(records))));
    let place = folder.display().to_string();
    let announce = move || {
        let memory = Bytes(memory);
        voice.remark(format!("more than --memory {memory} holds: sorting in temporary files in {place}{size}"));
    };
    Limits { memory, folder, announce: Box::new(announce) }
}
