//! Pictures: one described, two compared, rectangles of any measured, many on a sheet.

use super::{Args, seeds, tables};
use crate::cli::{
    create_output, describe_picture, named, picture_format, read_framed, read_preview, usage, write_picture,
};
use anyhow::{Context as _, bail};
use pm_pictures::{
    Comparison, Picture, PictureFormat, absolute_difference, contact_sheet, hdr_flip, heat, ldr_flip, ldr_flip_map,
};
use pm_report::Format;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Is it a picture that can be measured, by its name?
pub(super) fn is_picture(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"))
}

/// Writes what there is to say of a picture.
pub(super) fn describe(picture: &Path, output: &mut impl Write) -> anyhow::Result<()> {
    Ok(tables::picture(&describe_picture(picture)?, output)?)
}

/// Is it a preview, by its name?
pub(super) fn is_preview(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

/// Does `-o` name a picture of the difference, and not a file for the table?
pub(super) fn wants_difference(args: &Args) -> bool {
    args.output.output.as_deref().is_some_and(|path| is_picture(path) || is_preview(path))
}

/// Writes a picture of the difference: in EXR channel by channel, in PNG what FLIP sees of the previews.
fn draw_difference(path: &Path, [a, b]: [&Picture; 2], args: &Args) -> anyhow::Result<()> {
    let mut output = create_output(path)?;
    if is_picture(path) {
        write_picture(&absolute_difference(a, b), path, &mut output, &[])?;
    } else {
        let map = ldr_flip_map(&a.exposed(args.exposure), &b.exposed(args.exposure), args.pixels_per_degree);
        output.write_all(&heat(a.size, &map).encode_png()?)?;
    }
    output.commit()
}

/// Writes how far `b` is from `a`, and a picture of it if `-o` names one.
pub(super) fn compare(a: &Path, b: &Path, args: &Args, output: &mut impl Write) -> anyhow::Result<()> {
    let [(x, frame), (y, its)] = [read_framed(a)?, read_framed(b)?];
    let comparison = Comparison::new(&x, &y)?;
    if comparison.not_finite == comparison.pixels {
        bail!(
            "{} and {}: in none of the {} pixels are both finite; there is nothing to compare",
            named(a),
            named(b),
            comparison.pixels
        );
    }
    if let Some(difference) = frame.difference(&its) {
        args.voice.remark(format!("{difference}; pixels are compared by their order in the files"));
    } else if comparison.differing == 0 {
        args.voice.remark("the pictures are the same to the last bit");
    } else if seeds::differ_alone(&describe_picture(a)?, &describe_picture(b)?) {
        // Of independent pictures of the same mean the difference has the variance of both.
        let noise = comparison.rel_mse / 2.0;
        args.voice.remark(format!(
            "as far as they tell, these differ in their seeds alone: half of rel_mse, {noise:.3e}, is the noise that each of them \
             has, {:.3} % by root mean square; what bias they share is not seen",
            noise.sqrt() * 100.0
        ));
    }
    let flips = tables::Flips {
        ldr: ldr_flip(&x.exposed(args.exposure), &y.exposed(args.exposure), args.pixels_per_degree),
        exposure: args.exposure,
        hdr: hdr_flip(&x, &y, args.pixels_per_degree).mean,
        pixels_per_degree: args.pixels_per_degree,
    };
    if let Some(path) = args.output.output.as_deref().filter(|_| wants_difference(args)) {
        draw_difference(path, [&x, &y], args)?;
    }
    match args.format {
        Format::Table => Ok(tables::in_short(&named(a), &named(b), &comparison, &flips, output)?),
        format => Ok(tables::comparison(&named(a), &named(b), &comparison, &flips).write(format, output)?),
    }
}

/// Writes the means of rectangles of all pictures.
pub(super) fn measure(args: &Args, output: &mut impl Write) -> anyhow::Result<()> {
    let mut found = vec![];
    for path in &args.streams {
        let (picture, frame) = read_framed(path)?;
        for &region in &args.mean {
            let mean = frame.mean(&picture, region).with_context(|| named(path))?;
            if mean.not_finite == mean.pixels {
                args.voice.remark(format!(
                    "{}: region {region} has no mean: none of its {} pixels is finite",
                    named(path),
                    mean.pixels
                ));
            }
            found.push((named(path), mean));
        }
    }
    Ok(tables::regions(&found).write(args.format, output)?)
}

/// Puts all pictures on a contact sheet.
pub(super) fn make_sheet(sheet: &Path, args: &Args) -> anyhow::Result<()> {
    if picture_format(sheet)? != PictureFormat::Png {
        return Err(usage("a contact sheet's name ends in .png"));
    }
    let named = |path: &PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok((name, read_preview(path, args.exposure)?))
    };
    let previews = args.streams.iter().map(named).collect::<anyhow::Result<Vec<_>>>()?;
    let mut output = create_output(sheet)?;
    output.write_all(&contact_sheet(&previews)?)?;
    output.commit()
}
