//! A sample of photons that depends on nothing but them.

use pm_formats::Photon;
use pm_random::mix;

/// Ids of at most `most` photons, chosen by a hash of them: a sample that depends on the photons alone and not on the
/// queries or their order. In no order.
pub(super) fn chosen_ids(photons: &[Photon], most: usize) -> Vec<u32> {
    let mut ids: Vec<u32> = (0..u32::try_from(photons.len()).expect("maps hold fewer than 2^30 photons")).collect();
    if ids.len() > most {
        ids.select_nth_unstable_by_key(most, |&id| (mix(u64::from(id)), id));
        ids.truncate(most);
    }
    ids
}
