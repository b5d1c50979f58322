//! Gather points from rows.

use super::RowOptions;
use super::reader::Rows;
use super::row::Row;
use super::spool::{Imported, Spool};
use crate::fault::bad_question;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{Header, Material, Number, Query, StageReport, Step};
use std::collections::HashMap;
use std::io::BufRead;

/// Columns that mean something for queries.
const KNOWN: [&str; 19] = [
    "batch",
    "pixel",
    "sample",
    "material",
    "x",
    "y",
    "z",
    "n_x",
    "n_y",
    "n_z",
    "view_x",
    "view_y",
    "view_z",
    "weight_r",
    "weight_g",
    "weight_b",
    "diffuse_r",
    "diffuse_g",
    "diffuse_b",
];
/// Reflectance where none is given.
const GREY: [f32; 3] = [0.5; 3];
/// Ids of materials have 16 bits.
const MOST_MATERIALS: u64 = 1 << 16;

/// Reads gather points: `x,y,z`; `n_x,n_y,n_z`, normal of the surface (0,1,0); `view_x,...`, towards the viewer (the
/// normal); `pixel` (the number of the row; without a size of the image, one pixel for all); `sample` (the number of
/// the row); `weight_r,...` (1); `material` (0), and `diffuse_r,...`, its reflectance (0.5); `batch` (0).
///
/// # Errors
/// With the line, if a number is missing, not finite or out of bounds; usage errors for columns and the image.
pub fn queries(input: impl BufRead, options: &RowOptions, step: Step) -> anyhow::Result<Imported<Query>> {
    let mut rows = Rows::new(input, options)?;
    let columns = rows.columns.clone();
    let unused = columns.unknown(&KNOWN)?;
    let position = columns.position()?;
    let normal = columns.triple(["n_x", "n_y", "n_z"])?;
    let view = columns.triple(["view_x", "view_y", "view_z"])?;
    let weight = columns.triple(["weight_r", "weight_g", "weight_b"])?;
    let diffuse = columns.triple(["diffuse_r", "diffuse_g", "diffuse_b"])?;
    let [batch, pixel, sample, material] = ["batch", "pixel", "sample", "material"].map(|name| columns.find(name));
    let image = match options.size {
        Some(size) => size,
        None if pixel.is_some() => {
            return Err(bad_question("there is a column pixel: give the size of the picture with --size WxH"));
        }
        None => [1, 1],
    };
    let pixels = u64::from(image[0]) * u64::from(image[1]);

    let mut materials = Materials::default();
    let mut spool = Spool::new()?;
    while let Some(row) = rows.next()? {
        let at = row.triple(position)?;
        let normal = normal.map_or(Ok([0.0, 1.0, 0.0]), |columns| row.direction(columns))?;
        let view = view.map_or(Ok(normal), |columns| row.direction(columns))?;
        let weight = weight.map_or(Ok([1.0; 3]), |columns| row.triple(columns))?;
        let diffuse = diffuse.map(|columns| row.triple(columns)).transpose()?;
        let given = material.map(|column| row.whole(column, MOST_MATERIALS - 1)).transpose()?;
        let pixel = match pixel {
            Some(column) => row.whole(column, u64::from(u32::MAX))?,
            None if options.size.is_some() => row.number,
            None => 0,
        };
        if pixel >= pixels {
            let [width, height] = image;
            return Err(row.wrong(format!("pixel {pixel} lies outside the image of {width}x{height}")));
        }
        let sample = sample.map_or(Ok(row.number), |column| row.whole(column, u64::from(u32::MAX)))?;
        let too_many = |_| row.wrong("no more than 2^32 samples can be told apart");
        let (normal, view) = Query::pack_vectors(normal, view);
        let query = Query {
            position: at,
            normal,
            view,
            material: materials.id(given, diffuse, &row)?,
            flags: 0,
            pixel: u32::try_from(pixel).map_err(too_many)?,
            sample: u32::try_from(sample).map_err(too_many)?,
            weight,
        };
        spool.push(batch.map_or(Ok(0), |column| row.whole(column, u64::MAX))?, at, &query)?;
    }
    let mut header = Header { image, materials: materials.table(), history: vec![step.clone()], ..Header::empty() };
    header.set_meaning(meaning::ORDER, "imported");
    let stage = StageReport::new(&step.program).with(measure::QUERIES, Number::Count(spool.records));
    Ok(spool.finish(header, stage, unused))
}

/// Materials as the rows speak of them.
#[derive(Default)]
struct Materials {
    /// Reflectance by id, where a row has told it.
    by_id: Vec<Option<[f32; 3]>>,
    /// Ids by the bits of the reflectance, where rows have no ids.
    by_colour: HashMap<[u32; 3], u16>,
}

impl Materials {
    /// The id of a row's material.
    fn id(&mut self, given: Option<u64>, diffuse: Option<[f32; 3]>, row: &Row) -> anyhow::Result<u16> {
        if let Some(colour) = diffuse.filter(|colour| !colour.iter().all(|x| (0.0..=1.0).contains(x))) {
            return Err(row.wrong(format!("diffuse {colour:?}: a reflectance lies between 0 and 1")));
        }
        let too_many = |_| row.wrong("no more than 65536 different materials are possible; round diffuse_r,g,b");
        let bits = diffuse.unwrap_or(GREY).map(f32::to_bits);
        let id = match (given, self.by_colour.get(&bits)) {
            (Some(id), _) => u16::try_from(id).map_err(too_many)?,
            (None, Some(&id)) => id,
            (None, None) => {
                let id = u16::try_from(self.by_id.len()).map_err(too_many)?;
                self.by_colour.insert(bits, id);
                id
            }
        };
        let at = usize::from(id);
        if self.by_id.len() <= at {
            self.by_id.resize(at + 1, None);
        }
        match (self.by_id[at], diffuse) {
            (Some(known), Some(diffuse)) if known != diffuse => {
                Err(row.wrong(format!("material {id} is {diffuse:?} here, but {known:?} before")))
            }
            (_, Some(_)) => {
                self.by_id[at] = diffuse;
                Ok(id)
            }
            _ => Ok(id),
        }
    }

    fn table(self) -> Vec<Material> {
        let diffuse = self.by_id.into_iter().map(|diffuse| diffuse.unwrap_or(GREY));
        let material =
            |(id, diffuse)| Material { name: format!("imported-{id}"), diffuse, specular: [0.0; 3], exponent: 0.0 };
        let mut table: Vec<Material> = diffuse.enumerate().map(material).collect();
        if table.is_empty() {
            table.push(material((0, GREY)));
        }
        table
    }
}
