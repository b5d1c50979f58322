//! Where the pixels of an EXR file lie, and which colours its numbers mean: what two pictures must share to be compared.

use crate::{PictureError, Region, RegionMean, Result};
use exr::meta::MetaData;
use exr::meta::attribute::Chromaticities;
use exr::meta::header::Header;
use std::io::Cursor;

#[cfg(test)]
mod tests;

/// Red, green, blue and white of Rec. 709, which EXR means where it says nothing: CIE x and y of each.
const REC_709: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];
/// Chromaticities that differ by less are the same, written otherwise.
const SAME: f32 = 1e-3;

/// Where pixels lie, in the plane that all windows share, and which colours they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// x0, y0, x1, y1 of the pixels that are there, the second ones excluded.
    pub data: [i64; 4],
    /// x0, y0, x1, y1 of what is to be shown.
    pub display: [i64; 4],
    /// Red, green, blue and white: CIE x and y of each.
    pub primaries: [[f32; 2]; 4],
}

impl Frame {
    /// That of a picture of ours: everything is shown, and the colours are Rec. 709.
    #[must_use]
    pub fn plain([width, height]: [u32; 2]) -> Self {
        let window = [0, 0, width.into(), height.into()];
        Self { data: window, display: window, primaries: REC_709 }
    }

    /// That of the first layer of an EXR file that has channels R, G, B.
    ///
    /// # Errors
    /// If there is none.
    pub fn of_exr(bytes: &[u8]) -> Result<Self> {
        let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(PictureError::NotExr)?;
        let header = meta.headers.iter().find(|header| has_rgb(header)).ok_or_else(|| channels_missing(&meta))?;
        let window = |x: i32, y: i32, width: usize, height: usize| {
            let (x, y) = (i64::from(x), i64::from(y));
            [x, y, x + width as i64, y + height as i64]
        };
        let at = header.own_attributes.layer_position;
        let shown = header.shared_attributes.display_window;
        let primaries = header.shared_attributes.chromaticities.map(|it| {
            let Chromaticities { red, green, blue, white } = it;
            [red, green, blue, white].map(|colour| [colour.x(), colour.y()])
        });
        Ok(Self {
            data: window(at.x(), at.y(), header.layer_size.width(), header.layer_size.height()),
            display: window(shown.position.x(), shown.position.y(), shown.size.width(), shown.size.height()),
            primaries: primaries.unwrap_or(REC_709),
        })
    }

    /// In what this differs from another so that pixel for pixel they are not the same thing: a phrase that names what is
    /// there, `None` if in nothing.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Option<String> {
        let near = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() < SAME && (a[1] - b[1]).abs() < SAME;
        if self.data != other.data {
            let [a, b] = [self, other].map(|frame| frame.data.map(|x| x.to_string()).join(","));
            return Some(format!("data windows differ: {a} and {b}"));
        }
        let same = self.primaries.iter().zip(&other.primaries).all(|(&a, &b)| near(a, b));
        (!same).then(|| {
            let [a, b] = [self, other].map(|frame| {
                let [red, green, blue, white] = frame.primaries.map(|[x, y]| format!("{x} {y}"));
                format!("{red}, {green}, {blue}, white {white}")
            });
            format!("primaries differ: {a}; and {b}")
        })
    }

    /// Measures a region of a picture in this frame: its numbers count from the display window, as viewers do.
    ///
    /// # Errors
    /// If it reaches beyond the pixels that are there.
    pub fn mean(&self, picture: &crate::Picture, region: Region) -> Result<RegionMean> {
        let [left, top, ..] = self.display;
        // Of the pixels that are there, in the numbers of the display window.
        let there = [self.data[0] - left, self.data[1] - top, self.data[2] - left, self.data[3] - top];
        let wanted = match region {
            Region::Rectangle(rectangle) => rectangle.map(i64::from),
            Region::All => {
                let shown = [0, 0, self.display[2] - left, self.display[3] - top];
                [there[0].max(0), there[1].max(0), there[2].min(shown[2]), there[3].min(shown[3])]
            }
        };
        let beyond = || PictureError::BeyondData { region, there };
        let in_data = |axis: usize, at: i64| u32::try_from(at - there[axis]).map_err(|_| beyond());
        let [x0, y0, x1, y1] = wanted;
        let rectangle = [in_data(0, x0)?, in_data(1, y0)?, in_data(0, x1)?, in_data(1, y1)?];
        if x0 >= x1 || y0 >= y1 || x1 > there[2] || y1 > there[3] {
            let whole = there == [0, 0, i64::from(picture.size[0]), i64::from(picture.size[1])];
            return Err(if whole { PictureError::RegionBeyond { region, size: picture.size } } else { beyond() });
        }
        let found = RegionMean::new(picture, Region::Rectangle(rectangle))?;
        Ok(RegionMean { rectangle: wanted.map(|x| u32::try_from(x).unwrap_or_default()), ..found })
    }
}

fn has_rgb(header: &Header) -> bool {
    let has = |wanted: &str| header.channels.list.iter().any(|channel| channel.name.to_string() == wanted);
    ["R", "G", "B"].into_iter().all(has)
}

/// What is said of an EXR file without channels R, G, B.
fn channels_missing(meta: &MetaData) -> PictureError {
    let names =
        meta.headers.iter().flat_map(|header| header.channels.list.iter().map(|channel| channel.name.to_string()));
    PictureError::ChannelsMissing(names.collect::<Vec<_>>().join(", "))
}

/// Why these bytes, in which no picture was found, hold none: wrong channels where that is so.
pub(crate) fn why_not(bytes: &[u8], error: exr::error::Error) -> PictureError {
    match MetaData::read_from_buffered(Cursor::new(bytes), false) {
        Ok(meta) if !meta.headers.iter().any(has_rgb) => channels_missing(&meta),
        _ => PictureError::NotExr(error),
    }
}
