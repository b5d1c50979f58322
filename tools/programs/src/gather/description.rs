//! What `pm-gather --report` says: the lookups, the map, its building, and how near an approximate map comes.

use super::answering::Done;
use super::args::Args;
use super::building::Building;
use crate::cli::Output;
use pm_formats::trace::Region;
use pm_formats::{Header, Number, Photon};
use pm_gathering::{LightError, Lookups, RadianceEstimate, Scratch};
use pm_maps::{Accuracy, AnyMap, BucketKdTree, Layout, Search};
use pm_report::{Column, Format, Table, Value};

/// A measure by name.
type Named = (&'static str, Value);

/// What was done, when all is done. Times and memory are in the report and in no stream.
pub(super) struct Description<'a> {
    pub(super) args: &'a Args,
    pub(super) map: &'a dyn AnyMap,
    pub(super) building: Option<Building>,
    pub(super) photons: &'a [Photon],
    pub(super) search: Search,
    /// Of the trace, written or not.
    pub(super) header: &'a Header,
    pub(super) done: &'a Done,
}

impl Description<'_> {
    /// Writes the report: a row for programs, or a line for each value for people.
    pub(super) fn write(
        &self,
        estimate: &RadianceEstimate<'_>,
        mut lookups: Lookups,
        mut output: Output,
    ) -> anyhow::Result<()> {
        let mut values = self.lookups(&lookups);
        values.extend(self.map.measures().into_iter().map(|(name, number)| (name, measured(number))));
        if !self.map.is_exact() {
            values.extend(self.accuracy(estimate, &mut lookups)?);
        }
        let of_region = |region: &Region| format!("bytes_of_{}", region.name.replace(' ', "_"));
        let regions = self.header.regions.iter().map(|region| (of_region(region), Value::Int(region.size)));
        let values: Vec<_> = values.into_iter().map(|(name, value)| (name.to_owned(), value)).chain(regions).collect();

        let ending =
            self.args.rest.report.as_ref().and_then(|path| path.extension()).and_then(|ending| ending.to_str());
        let format = match ending {
            Some("csv") => Format::Csv,
            Some("json") => Format::Json,
            _ => Format::Table,
        };
        let mut table;
        if format == Format::Table {
            table = Table::new(vec![Column::text("measure"), Column::number("value")]);
            values.into_iter().for_each(|(name, value)| table.push(vec![Value::Text(name), value]));
        } else {
            let (names, row): (Vec<_>, Vec<_>) = values.into_iter().unzip();
            table = Table::new(names.into_iter().map(Column::number).collect());
            table.push(row);
        }
        table.write(format, &mut output)?;
        output.commit()
    }

    fn lookups(&self, lookups: &Lookups) -> Vec<Named> {
        use Value::{Float, Int, Text};
        let per_query = |number: u64, digits: u8| Float(number as f64 / lookups.queries as f64, digits);
        let building = |seconds: fn(Building) -> f64| Float(self.building.map_or(f64::NAN, seconds), 3);
        let line = u64::from(self.args.line());
        vec![
            ("map", Text(self.args.map.entry.word().into())),
            ("line", Int(line)),
            ("k", Int(self.search.k as u64)),
            ("photons", Int(self.photons.len() as u64)),
            ("structure_bytes", Int(self.header.regions.iter().map(|region| region.size).sum())),
            ("build_seconds", building(|building| building.seconds)),
            ("build_processor_seconds", building(|building| building.processor_seconds)),
            ("build_peak_bytes", self.building.and_then(|building| building.peak_bytes).map_or(Text("-".into()), Int)),
            ("gather_seconds", Float(self.done.seconds, 3)),
            ("queries", Int(lookups.queries)),
            ("start_radius", Float(f64::from(self.search.start), 4)),
            ("attempts_per_query", per_query(self.done.counts.attempts, 4)),
            ("photons_examined_per_query", per_query(lookups.photons_examined, 5)),
            ("reads_per_query", per_query(lookups.reads, 5)),
            ("lines_per_query", per_query(lookups.lines, 5)),
            ("line_bytes_per_query", per_query(lookups.lines * line, 5)),
            ("short_lookups", Int(self.done.counts.short)),
            ("distance_mean", Float(lookups.mean_distance(), 4)),
            ("distance_p5", Float(lookups.distance_quantile(0.05), 4)),
            ("distance_p50", Float(lookups.distance_quantile(0.5), 4)),
            ("distance_p95", Float(lookups.distance_quantile(0.95), 4)),
            ("distance_largest", Float(lookups.distance_quantile(1.0), 4)),
        ]
    }

    /// How near the map's answers come to exact ones, and the light that they make.
    fn accuracy(&self, estimate: &RadianceEstimate<'_>, lookups: &mut Lookups) -> anyhow::Result<Vec<Named>> {
        use Value::{Float, Int};
        let truth = BucketKdTree::build(self.photons, Layout::Heap, 320)?;
        let queries = lookups.sample();
        let points: Vec<[f32; 3]> = queries.iter().map(|query| query.position).collect();
        let blocks = self.map.blocks();
        let blocks = blocks.as_ref().map(|(region, blocks)| (*region, &blocks[..]));
        let (mut light, mut scratch) = (LightError::default(), Scratch::default());
        let near = Accuracy::measure(self.map, &truth, self.search, &points, blocks, |at, found, expected| {
            let found = estimate.contribution(&queries[at], found, &mut scratch);
            light.add(found, estimate.contribution(&queries[at], expected, &mut scratch));
        });
        let mut values = vec![
            ("sampled_queries", Int(near.queries)),
            ("recall_mean", Float(near.mean_recall(), 4)),
            ("recall_least", Float(near.least_recall, 4)),
            ("dilation_mean", Float(near.mean_dilation(), 5)),
            ("dilation_largest", Float(near.largest_dilation, 4)),
            ("light_error_rms", Float(light.rms(), 4)),
            ("light_bias", Float(light.bias(), 3)),
        ];
        let asked = &self.args.map;
        values.extend(asked.entry.described_by().iter().map(|&name| (name, told(asked.values.get(name)))));
        if blocks.is_some() {
            values.extend([
                ("blocks_wanted", Int(near.blocks_wanted())),
                ("blocks_unreached", Int(near.blocks_unreached())),
                ("blocks_missed_per_query", Float(near.blocks_missed as f64 / near.queries as f64, 4)),
            ]);
        }
        Ok(values)
    }
}

/// A measure, as a table has it.
fn measured(number: Number) -> Value {
    match number {
        Number::Count(n) | Number::Bytes(n) => Value::Int(n),
        Number::Real(x) => Value::Float(x, 4),
    }
}

/// The value of a parameter, as a table has it.
fn told(value: Option<&pm_registry::Value>) -> Value {
    use pm_registry::Value::{Count, File, Flag, Length, Share, Word};
    match value {
        None => Value::Text("-".into()),
        Some(Flag(given)) => Value::Text(if *given { "yes" } else { "no" }.into()),
        Some(Count(count)) => Value::Int(*count),
        Some(Share(share)) => Value::Float(*share, 4),
        Some(Length(length)) => Value::Float(f64::from(*length), 4),
        Some(Word(word)) => Value::Text((*word).into()),
        Some(File(file)) => Value::Text(file.clone()),
    }
}
