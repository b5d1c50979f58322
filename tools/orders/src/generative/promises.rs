//! What every generative order promises, to be asked of any.

use super::order::Generative;
use std::collections::HashMap;

/// A promise that an order breaks for an image of this width and height, if there is one: that batches are numbered from 0
/// without a gap and as many as it says, that every pixel is visited once in each pass, that the passes cast every ray once,
/// and that the first of them is one that tells what a pixel's eye rays see.
pub(crate) fn broken_promise(order: &dyn Generative, size: [u32; 2]) -> Option<String> {
    let [width, height] = size;
    let passes = order.passes();
    let mut visits: HashMap<(u32, u32), Vec<_>> = HashMap::new();
    let mut batches = 0;
    for span in order.spans(size) {
        if span.batch > batches || span.batch + 1 < batches {
            return Some(format!("batch {} comes after batch {}", span.batch, batches.saturating_sub(1)));
        }
        batches = span.batch + 1;
        span.columns.for_each(|x| visits.entry((x, span.row)).or_default().push(span.pass));
    }
    if batches != order.batch_count(size) || order.batches(size).count() as u64 != batches {
        return Some(format!("{batches} batches, not {}", order.batch_count(size)));
    }
    if let Some((pixel, _)) = visits.iter().find(|((x, y), _)| *x >= width || *y >= height) {
        return Some(format!("pixel {pixel:?} is outside of the image"));
    }
    if visits.len() as u64 != u64::from(width) * u64::from(height) {
        return Some(format!("{} pixels are visited", visits.len()));
    }
    if let Some((pixel, found)) = visits.iter().find(|(_, found)| **found != passes) {
        return Some(format!("pixel {pixel:?} is visited for {found:?}"));
    }
    for behind_specular in [false, true] {
        let bins = passes.iter().filter(|pass| pass.points.include(behind_specular)).map(|pass| pass.bin);
        if bins.ne(0..order.bins()) {
            return Some(format!("not every ray is cast once: {passes:?}"));
        }
    }
    let is_led = passes.iter().position(|pass| pass.is_first()) == Some(0);
    (!is_led).then(|| format!("the first pass is none that visits every pixel: {passes:?}"))
}
