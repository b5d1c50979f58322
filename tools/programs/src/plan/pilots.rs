//! The time of a picture, by smaller ones made here and now.

use crate::pipe::Pipe;
use crate::{clock, picture};
use anyhow::Context as _;
use pm_plan::{Choice, Estimate, Recipe, Times, is_large};

/// What small pictures are made of.
pub(super) struct Pilots<'a> {
    pub(super) scene: &'a [String],
    pub(super) camera: &'a [String],
    /// Of the picture that is planned.
    pub(super) size: [u32; 2],
    pub(super) threads: u16,
    pub(super) seed: u64,
}

/// Seconds of processor time.
pub(super) struct Time {
    /// Of the picture that is planned.
    pub(super) total: Estimate,
    /// Of the small pictures, all together.
    pub(super) pilots: f64,
}

/// Small pictures of the same size, and the share of the planned one that each is, unless that is soon done.
const PICTURES: u32 = 4;
const SHARE: f64 = 0.003;
/// Seconds that a small picture shall take: less is measured badly. Where the picture is large its pixels take about as much as any
/// of its parts, and half does.
const LEAST: f64 = 0.2;
/// What takes time to be made of photons again for each small picture, as a share of what tracing them takes: it has to be told
/// from what pixels take.
const OF_BUILDING: f64 = 0.25;

impl Pilots<'_> {
    /// The pipe that makes the picture.
    pub(super) fn pasted(&self, choice: &Choice) -> Pipe {
        let threads = (self.threads > 1).then(|| ["-t".to_owned(), self.threads.to_string()]);
        let recipe = words(&choice.recipe).into_iter().chain(threads.into_iter().flatten());
        let image = ["--image".to_owned(), "plan.exr".to_owned()];
        let camera = self.camera.iter().chain(self.scene).cloned();
        Pipe::new("pm-picture", recipe.chain(image).chain(camera))
    }

    /// What the picture will take: a tiny one as a whole, and some small ones of its photon maps, which are the same for any size.
    pub(super) fn measure(&self, choice: &Choice, times: &Times) -> anyhow::Result<Time> {
        let folder = tempfile::tempdir().context("a folder for small pictures")?;
        let pixels = f64::from(self.size[0]) * f64::from(self.size[1]);
        let of_photons = times.of(&choice.recipe, 0.0);
        let of_pixels = times.of(&choice.recipe, pixels) - of_photons;
        let least = if is_large(pixels) { LEAST / 2.0 } else { LEAST };
        let share = (least.max(of_photons * OF_BUILDING) / of_pixels).clamp(SHARE, 1.0);
        let small = self.scaled(share);
        let tiny = self.scaled(share / 16.0);
        let of = |size: [u32; 2]| f64::from(size[0]) * f64::from(size[1]);
        let seconds = |made: &dyn Fn() -> anyhow::Result<()>| {
            let before = clock::seconds_of_others();
            made().map(|()| clock::seconds_of_others() - before)
        };
        let (recipe, folder) = (&choice.recipe, folder.path());
        let image = folder.join("pilot.exr").display().to_string();
        let kept = ["--keep".to_owned(), folder.display().to_string()];
        let whole = self.small(recipe, tiny, 0, &image).with(kept);
        let whole = seconds(&|| whole.run().map(drop))?;
        let gathered = |size: [u32; 2], number: u32| {
            let asked = self.small_words(recipe, size, number.into(), &image);
            let pipes = picture::gathers(asked, recipe.caustics, folder.to_owned())?;
            seconds(&|| pipes.iter().try_for_each(|pipe| pipe.run().map(drop)))
        };
        let before = gathered(tiny, 0)?;
        let mut pilots = whole + before;
        let mut slopes = vec![];
        for number in 1..=PICTURES {
            let one = gathered(small, number)?;
            pilots += one;
            slopes.push(((one - before) / (of(small) - of(tiny)).max(1.0)).max(0.0));
        }
        let slope = Estimate::mean(&slopes);
        let total = slope.scaled(pixels - of(tiny));
        Ok(Time { total: Estimate { value: total.value + whole, ..total }, pilots })
    }

    /// A picture of the same shape with this share of the pixels.
    pub(super) fn scaled(&self, share: f64) -> [u32; 2] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "smaller than a size of a picture")]
        let side = |side: u32| (f64::from(side) * share.sqrt()).ceil().max(1.0) as u32;
        self.size.map(side)
    }

    /// What makes a picture of another size.
    pub(super) fn small(&self, recipe: &Recipe, size: [u32; 2], number: u64, image: &str) -> Pipe {
        Pipe::new("pm-picture", self.small_words(recipe, size, number, image))
    }

    fn small_words(
        &self,
        recipe: &Recipe,
        [width, height]: [u32; 2],
        number: u64,
        image: &str,
    ) -> impl Iterator<Item = String> {
        let seed = (self.seed ^ 0x0070_696c_6f74) + number;
        let options = ["-q".to_owned(), "--seed".to_owned(), seed.to_string(), "--image".to_owned(), image.to_owned()];
        let size = ["--size".to_owned(), format!("{width}x{height}")];
        let camera = self.camera.iter().filter(|word| !word.starts_with("--size=")).chain(self.scene).cloned();
        words(recipe).into_iter().chain(options).chain(size).chain(camera)
    }
}

/// A recipe as `pm-picture` takes it.
fn words(recipe: &Recipe) -> Vec<String> {
    let Recipe { samples, gathers, light_samples, photons, k, caustics } = recipe;
    let line = format!("--samples {samples} --gathers {gathers} --light-samples {light_samples} -n {photons} -k {k}");
    let of_caustics = format!(" --caustics {caustics}");
    let line = line + if *caustics > 0 { &of_caustics } else { "" };
    line.split(' ').map(str::to_owned).collect()
}
