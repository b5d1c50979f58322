//! Answering a block of queries: the searches, the trace of what they read, and what the pixels get.

use super::{Answered, Fault, HeldIrradiance, Lookups, Outcome, RadianceEstimate, Scratch, SearchCounts};
use pm_film::film::{Film, Overflow};
use pm_film::irradiance::CachedIrradiance;
use pm_formats::trace::{Access, BlockEncoder, Coding, Region, Waits};
use pm_formats::{Block, Header, Query, decode_checked};
use pm_maps::{AccessObserver, AnyMap, Blind, Carry, Nearest, Search, SearchReads, offset_of};

/// What it takes to answer queries; shared by all threads.
pub struct Answerer<'a> {
    /// How photons are searched for.
    pub search: Search,
    /// Does a search start from what the one before in its block knows?
    pub carry: bool,
    /// Bytes of the lines in which lookups are described, and the map's regions, if that is wanted.
    pub describe: Option<(u32, &'a [Region])>,
    /// Where.
    pub map: &'a dyn AnyMap,
    /// Header of the query stream.
    pub header: &'a Header,
    /// Regions of the trace, if one is wanted. If they are coded so, reads say what they wait for: of a map that tells of it,
    /// whose records are packed, without second touches.
    pub regions: Option<&'a [Region]>,
    /// Do second touches of a record count as reads?
    pub reread: bool,
    /// The irradiance records that queries may belong to.
    pub cache: &'a CachedIrradiance,
    /// Irradiance computed beforehand, where it is to answer queries of diffuse surfaces.
    pub precomputed: Option<&'a dyn HeldIrradiance>,
    /// How radiance is estimated, and a film that knows the picture's unit, if a picture is wanted.
    pub estimate: Option<(&'a RadianceEstimate<'a>, &'a Film)>,
}

impl Answerer<'_> {
    /// Answers the queries of one block, in their order.
    ///
    /// # Errors
    /// See [`Fault`].
    pub fn answer(&self, block: &Block) -> Result<Answered, Fault> {
        let (queries, tally) = decode_checked::<Query>(block, self.header).map_err(Fault::Damaged)?;
        let mut found = Nearest::new(self.search.k, 0.0);
        // Where the coding of walks implies the second touches they need not be remembered.
        let walk = |region: &Region| matches!(region.coding, Coding::HeapWalk { reread: true, .. });
        let implied = self.regions.is_some_and(|regions| regions.iter().any(walk));
        let waiting = self.regions.is_some_and(|regions| regions.iter().any(|it| it.coding == Coding::Waiting));
        let mut reads = match waiting {
            true => SearchReads::with_waits(),
            false => SearchReads::with_rereads(self.reread && !implied),
        };
        let mut scratch = Scratch::default();
        let mut encoder = self.regions.map(BlockEncoder::new);
        let mut contributions = Vec::with_capacity(if self.estimate.is_some() { queries.len() } else { 0 });
        let mut cached = vec![];
        let mut counts = SearchCounts::default();
        let mut lookups = self.describe.map(|(line, regions)| Lookups::new(line, regions, self.map.padding()));
        let watched = encoder.is_some() || lookups.is_some();
        // A chain ends with its block: the stream says where.
        let mut carry = Carry::default();
        for query in &queries {
            reads.clear();
            let known = match self.precomputed.filter(|sites| sites.serves(query)) {
                Some(sites) => {
                    let known = sites.contribution(query, &mut reads);
                    counts.attempts += 1;
                    counts.no_site += u64::from(known.is_none());
                    known
                }
                None => None,
            };
            if known.is_none() {
                counts.attempts += u64::from(if watched {
                    self.find(query.position, &mut carry, &mut found, &mut reads)
                } else {
                    self.find(query.position, &mut carry, &mut found, &mut Blind)
                });
                counts.short += u64::from(!found.is_full());
                if let Some(lookups) = &mut lookups {
                    lookups.add(query, &found, &reads);
                }
            }
            counts.accesses += reads.len() as u64 + if implied { reads.rereads() } else { 0 };
            if let Some(encoder) = &mut encoder {
                encoder.begin(&[query.pixel]);
                let mut waits = reads.waits();
                for (region, records) in reads.runs() {
                    let waits = waits.as_mut().and_then(|waits| waits.split_off(..records.len()));
                    self.encode(encoder, region, records, waits);
                }
                encoder.end();
            }
            if let Some((estimate, film)) = self.estimate {
                match known.unwrap_or_else(|| estimate.contribution(query, &found, &mut scratch)) {
                    Outcome::Radiance(radiance) if query.is_for_record() => {
                        let terms = self.cache.contributions(query.pixel, query.sample, radiance);
                        for (sum, value) in terms.ok_or(Fault::Damaged("a query's irradiance record is not there"))? {
                            cached.push((sum, film.quantise(value).ok_or(Fault::TooBright(Overflow(query.pixel)))?));
                        }
                    }
                    Outcome::Radiance(radiance) => {
                        let units = film.quantise(radiance).ok_or(Fault::TooBright(Overflow(query.pixel)))?;
                        contributions.push((query.pixel, units));
                    }
                    Outcome::NoArea => counts.no_area += 1,
                }
            }
        }
        let trace = encoder.map(|encoder| encoder.finish(block.meta)).transpose().map_err(Fault::Format)?;
        Ok(Answered { trace, tally, contributions, cached, counts, lookups })
    }

    #[inline]
    fn find(&self, point: [f32; 3], carry: &mut Carry, found: &mut Nearest, eyes: &mut impl AccessObserver) -> u32 {
        match self.carry {
            true => carry.run(&self.search, self.map, point, found, eyes),
            false => self.search.run(self.map, point, found, eyes),
        }
    }

    /// Reads of whole records, which a region holds packed or padded.
    fn encode(&self, encoder: &mut BlockEncoder<'_>, region: u16, records: &[u32], waits: Option<&[Waits]>) {
        if let Some(waits) = waits {
            return encoder.waiting_records(region, records, waits);
        }
        let padding = self.map.padding();
        if padding.is_none() {
            return encoder.records(region, records);
        }
        let size = self.regions.map_or(0, |regions| regions[usize::from(region)].record_size);
        for &record in records {
            encoder.access(Access::read(region, offset_of(record, size, padding), size));
        }
    }
}
