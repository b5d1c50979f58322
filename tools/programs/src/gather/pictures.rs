//! The picture: what queries add to it, and the files that hold it.

use super::args::Args;
use super::photons::Photons;
use crate::cli::{
    Output, PART, QUERIES, named, picture_format, picture_says, read_framed, room_for, usage, write_picture,
};
use anyhow::{Context as _, bail, ensure};
use pm_film::film::{Film, Overflow};
use pm_film::irradiance::CachedIrradiance;
use pm_formats::vocabulary::meaning;
use pm_formats::{Header, Tally};
use pm_gathering::{Answered, FOOTPRINT};
use pm_pictures::{Frame, Picture, PictureFormat};
use std::path::{Path, PathBuf};

/// Bytes of a pixel on the film, and then three times in the picture's file while that is written.
pub(crate) const FILM_BYTES: u64 = 3 * 16 + 3 * 12;

/// What pixels, and sums of the cached irradiance, add up to; nothing if no picture is wanted.
pub(super) struct Films {
    pixels: Film,
    sums: Film,
}

impl Films {
    /// Dark films for a picture of these queries, in this unit.
    pub(super) fn new(wanted: bool, queries: &Header, cache: &CachedIrradiance, scale: f64) -> anyhow::Result<Self> {
        let pixels = if wanted { usize::try_from(queries.pixels())? } else { 0 };
        let sums = if wanted { cache.sums() } else { 0 };
        room_for((pixels as u64 + sums as u64).saturating_mul(FILM_BYTES), "the picture")?;
        Ok(Self { pixels: Film::new(pixels, scale), sums: Film::new(sums, scale) })
    }

    /// Adds what a block of queries became.
    pub(super) fn add(&mut self, answered: &Answered) -> Result<(), Overflow> {
        self.pixels.add_all(&answered.contributions)?;
        self.sums.add_all(&answered.cached)
    }

    /// The picture, of this size.
    pub(super) fn develop(
        mut self,
        size: [u32; 2],
        cache: &CachedIrradiance,
        is_added_to: bool,
    ) -> anyhow::Result<Picture> {
        let mut picture = Picture { size, pixels: self.pixels.pixels() };
        if !picture.pixels.is_empty() && !cache.is_empty() {
            // Like the base picture, which holds the light that comes without a search to all other points.
            if is_added_to {
                cache.add_lights(&mut self.sums)?;
            }
            cache.interpolate(&self.sums, &mut picture.pixels);
        }
        Ok(picture)
    }
}

/// What a picture says of itself. Nothing that differs between two orders of the same work, so no history of the queries
/// but their number and digest: equal pictures are equal files.
pub(super) fn origin(args: &Args, photons: &Photons, queries: &Header, tally: Tally) -> Vec<(&'static str, String)> {
    let told = |Tally { records, digest }| format!("{records}, digest {digest}");
    let mut attributes = vec![
        ("photonmap.k", args.rest.k.to_string()),
        ("photonmap.estimator", format!("{:?}", args.rest.estimator)),
        ("photonmap.kernel", format!("{:?}", args.kernel(&photons.header))),
        ("photonmap.edges", format!("{:?}", args.rest.edges)),
        ("photonmap.photons", told(photons.tally)),
        (QUERIES, told(tally)),
    ];
    if let Some(structure) = args.structure_held() {
        let footprint = args.map.values.length_if_any(FOOTPRINT.name).map_or("the rays'".to_owned(), |x| x.to_string());
        let (share, name) = (args.rest.precomputed_share, structure.name());
        attributes
            .push(("photonmap.precomputed", format!("at 1 of {share} photons, in {name}, footprint {footprint}")));
    } else if args.rest.precomputed {
        attributes.push(("photonmap.precomputed", format!("at 1 of {} photons", args.rest.precomputed_share)));
    }
    attributes.extend(queries.meaning(meaning::GATHERS).map(|gathers| ("photonmap.gathers", gathers.to_owned())));
    attributes.extend(queries.meaning(meaning::PART).map(|part| (PART, part.to_owned())));
    let commands = pm_formats::as_commands(&photons.header.history);
    attributes.extend(commands.lines().map(|command| ("photonmap.history", command.to_owned())));
    attributes
}

/// To a part of a picture the same part of another is added, so that all parts together have it once.
fn check_base(base: &Path, attributes: &[(&str, String)]) -> anyhow::Result<()> {
    let part = attributes.iter().find(|(name, _)| *name == PART).map(|(_, part)| part.clone());
    let its = picture_says(base)?.into_iter().find(|(name, _)| name == PART).map(|(_, part)| part);
    let called =
        |part: &Option<String>| part.as_ref().map_or("of the whole picture".into(), |part| format!("part {part}"));
    if part == its {
        return Ok(());
    }
    let (base, its, part) = (named(base), called(&its), called(&part));
    Err(usage(format!("--base {base} is {its}, and the queries are {part}: give the base that was made with them")))
}

/// Writes the picture to every file that was asked for, with the base picture added.
pub(super) fn write(
    args: &Args,
    mut picture: Picture,
    images: Vec<(&PathBuf, Output)>,
    attributes: &[(&str, String)],
) -> anyhow::Result<()> {
    if images.is_empty() {
        return Ok(());
    }
    if let Some(base) = &args.rest.base {
        check_base(base, attributes)?;
        let (added, frame) = read_framed(base)?;
        let own = Frame::plain(picture.size);
        picture.add(&added).with_context(|| base.display().to_string())?;
        if let Some(difference) = frame.difference(&own) {
            bail!("{}: cannot be added to the picture: {difference}; write it again in those", base.display());
        }
    }
    let finite = |pixel: &[f32; 3]| pixel.iter().all(|x| x.is_finite());
    let odd = picture.pixels.iter().filter(|pixel| !finite(pixel)).count();
    ensure!(odd == 0, "{odd} pixels are not finite; is the base image damaged?");
    let preview = picture.exposed(args.rest.exposure);
    for (path, mut output) in images {
        let picture = if picture_format(path)? == PictureFormat::Png { &preview } else { &picture };
        if picture_format(path)? == PictureFormat::Png && picture.clipped() > 0.0 {
            args.rest.common.remark(format!(
                "{}: {:.1} % of the pixels clipped",
                path.display(),
                picture.clipped() * 100.0
            ));
        }
        write_picture(picture, path, &mut output, attributes)?;
        output.commit()?;
    }
    Ok(())
}
