//! What an EXR file says of itself, and what its channels hold.

use crate::{PictureError, Result};
use exr::prelude::{ReadChannels as _, ReadLayers as _, read};
use std::io::Cursor;

/// A channel of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name, such as `R` or `direct.R`.
    pub name: String,
    /// Least finite value.
    pub min: f64,
    /// Mean of the finite values; not a number if there are none.
    pub mean: f64,
    /// Greatest finite value.
    pub max: f64,
    /// Values that are infinite or no number.
    pub not_finite: u64,
}

/// The first layer of an EXR file.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Channels in the order of the file.
    pub channels: Vec<Channel>,
    /// Names and values of attributes, in a fixed order.
    pub attributes: Vec<(String, String)>,
}

impl Description {
    /// Of the bytes of an EXR file.
    ///
    /// # Errors
    /// If there is none.
    pub fn of_exr(bytes: &[u8]) -> Result<Self> {
        let reader = read().no_deep_data().largest_resolution_level().all_channels();
        let image = reader.first_valid_layer().all_attributes().from_buffered(Cursor::new(bytes));
        let image = image.map_err(PictureError::NotExr)?;
        let layer = image.layer_data;
        let channels = layer.channel_data.list.iter().map(|channel| {
            let mut described = Channel {
                name: channel.name.to_string(),
                min: f64::INFINITY,
                mean: 0.0,
                max: f64::NEG_INFINITY,
                not_finite: 0,
            };
            let mut finite = 0f64;
            for value in channel.sample_data.values_as_f32().map(f64::from) {
                if value.is_finite() {
                    described.min = described.min.min(value);
                    described.max = described.max.max(value);
                    described.mean += value;
                    finite += 1.0;
                } else {
                    described.not_finite += 1;
                }
            }
            described.mean /= finite;
            described
        });
        let known = [("software", &layer.attributes.software_name), ("comments", &layer.attributes.comments)];
        let mut attributes: Vec<(String, String)> =
            known.iter().filter_map(|(name, text)| Some(((*name).to_owned(), text.as_ref()?.to_string()))).collect();
        let others = layer.attributes.other.iter().chain(&image.attributes.other);
        let mut others: Vec<_> = others.map(|(name, value)| (name.to_string(), format!("{value:?}"))).collect();
        others.sort();
        attributes.extend(others);
        Ok(Self { size: [layer.size.width(), layer.size.height()], channels: channels.collect(), attributes })
    }
}
