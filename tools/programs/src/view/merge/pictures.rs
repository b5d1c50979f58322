//! Pictures of all parts, each black where the others are not, added up.

use super::Args;
use crate::cli::{PART, QUERIES, create_output, named, picture_says, read_framed, refuse_parts, usage, write_picture};
use anyhow::Context as _;
use pm_formats::vocabulary::Part;
use pm_formats::{Digest, Tally, each_part_once};
use pm_pictures::{Frame, Picture};
use std::path::Path;

/// Writes the picture that one machine would have made.
pub(super) fn merge(args: &Args) -> anyhow::Result<()> {
    let Some(output) = &args.output.output else {
        return Err(usage("--merge of pictures: name the whole by -o FILE.exr"));
    };
    let said: Vec<Said> = args.streams.iter().map(|path| Said::by(path)).collect::<anyhow::Result<_>>()?;
    let parts: Vec<(&str, Part)> = said.iter().map(|said| (said.name.as_str(), said.part)).collect();
    each_part_once(&parts).map_err(refuse_parts)?;
    if let Some(odd) = said.iter().find(|other| other.rest != said[0].rest) {
        let (one, other) = (&said[0].name, &odd.name);
        return Err(usage(format!("{one} and {other} are parts of two pictures: what they say of themselves differs")));
    }
    let mut file = create_output(output)?;
    let mut whole: Option<Picture> = None;
    for path in &args.streams {
        let (picture, frame) = read_framed(path)?;
        if let Some(difference) = frame.difference(&Frame::plain(picture.size)) {
            return Err(usage(format!("{}: not as it was written as a part: {difference}", named(path))));
        }
        let Some(whole) = &mut whole else {
            whole = Some(picture);
            continue;
        };
        let dark = |pixel: &[f32; 3]| *pixel == [0.0; 3];
        if whole.size == picture.size && whole.pixels.iter().zip(&picture.pixels).any(|(a, b)| !dark(a) && !dark(b)) {
            return Err(usage(format!("{}: it has light where another part has some", named(path))));
        }
        whole.add(&picture).with_context(|| named(path))?;
    }
    let mut queries = Tally::default();
    said.iter().filter_map(|said| said.queries).for_each(|more| queries += more);
    let told = format!("{}, digest {}", queries.records, queries.digest);
    let attributes: Vec<(&str, String)> = (said[0].rest.iter())
        .map(|(name, value)| (name.as_str(), if name == QUERIES { told.clone() } else { value.clone() }))
        .collect();
    write_picture(&whole.context("no picture")?, output, &mut file, &attributes)?;
    file.commit()
}

/// What a picture says of itself.
struct Said {
    name: String,
    part: Part,
    queries: Option<Tally>,
    /// All but that; of the queries that it tells of them.
    rest: Vec<(String, String)>,
}

impl Said {
    fn by(path: &Path) -> anyhow::Result<Self> {
        let name = named(path);
        let mut rest = picture_says(path)?;
        let part = rest.iter().find(|(name, _)| name == PART).and_then(|(_, part)| part.parse().ok());
        let part = part.ok_or_else(|| {
            usage(format!("{name}: not a part of a picture; pm-gather --image makes one of a part of the queries"))
        })?;
        rest.retain(|(name, _)| name != PART);
        let mut queries = None;
        for (_, value) in rest.iter_mut().filter(|(name, _)| name == QUERIES) {
            queries =
                Some(tally(value).ok_or_else(|| usage(format!("{name}: `{value}` is not what it tells of queries")))?);
            value.clear();
        }
        Ok(Self { name, part, queries, rest })
    }
}

/// Number and digest of queries, as pictures tell them.
fn tally(text: &str) -> Option<Tally> {
    let (records, digest) = text.split_once(", digest ")?;
    Some(Tally { records: records.parse().ok()?, digest: Digest(u128::from_str_radix(digest, 16).ok()?) })
}
