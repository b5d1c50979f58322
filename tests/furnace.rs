//! A room whose radiance is known: every surface shines and reflects alike, so that it is the same wherever one looks.

use crate::support::Folder;
use pm_pictures::Picture;

/// Gathers in the furnace with each of these options, and sees that the mean of each channel is what it must be.
pub(crate) fn radiance_is_the_known_one(photons: u32, queries: &str, options: impl IntoIterator<Item = String>) {
    let folder = Folder::new();
    let furnace = format!("{}/../../scenes/furnace.obj", env!("CARGO_MANIFEST_DIR"));
    folder.run(&format!("pm-photons {furnace} -n {photons} -t 2 -o map.pmp")).ok();
    folder.run(&format!("pm-queries {furnace} {queries} -t 2 --base base.exr -o q.pmq")).ok();
    for options in options {
        let line = format!("pm-gather -q map.pmp q.pmq {options} -t 2 --no-trace --base base.exr");
        folder.run(&format!("{line} --image x.exr")).ok();
        let picture = Picture::decode_exr(&folder.read("x.exr")).unwrap();
        let count = picture.pixels.len() as f64;
        for (channel, known) in [1.25, 2.0, 5.0].into_iter().enumerate() {
            let mean = picture.pixels.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / count;
            assert!((mean / known - 1.0).abs() < 0.02, "{options}, channel {channel}: {mean} for {known}");
        }
    }
}
