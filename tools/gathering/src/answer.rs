//! Answering a block of queries: the searches, the trace of what they read, and what the pixels get.

use super::{Answered, Fault, HeldIrradiance, Lookups, Outcome, RadianceEstimate, Scratch, SearchCounts};
use pm_film::film::{Film, Overflow, Units};
use pm_film::irradiance::CachedIrradiance;
use pm_formats::trace::{Access, BlockEncoder, Coding, Region, Waits};
use pm_formats::{Block, Header, Query, decode_checked};
use pm_maps::{AccessObserver, AnyMap, Blind, Carry, Groups, Nearest, Search, SearchReads, WaitingReads, offset_of};

/// What it takes to answer queries; shared by all threads.
pub struct Answerer<'a> {
    /// How photons are searched for.
    pub search: Search,
    /// Does a search start from what the one before in its block knows?
    pub carry: bool,
    /// Neighbouring queries that share a search at most: 1 where each has its own. Such searches know what those before know.
    pub group: usize,
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
        let mut work = Work::new(self, queries.len());
        match self.map.batch() {
            Some(batch) => queries.chunks(batch).try_for_each(|queries| work.answer_together(queries))?,
            None if self.group > 1 => work.answer_in_groups(&queries)?,
            None => work.answer_one_by_one(&queries)?,
        }
        let Work { encoder, contributions, cached, counts, lookups, .. } = work;
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

/// A block of queries while it is answered.
struct Work<'a> {
    of: &'a Answerer<'a>,
    /// The reads of a search that is not one of a batch.
    reads: SearchReads,
    /// Does the trace say what reads wait for? What each of these does, then.
    waiting: bool,
    waits: Vec<Waits>,
    /// Where the coding of walks implies the second touches they need not be remembered.
    implied: bool,
    scratch: Scratch,
    encoder: Option<BlockEncoder<'a>>,
    contributions: Vec<(u32, Units)>,
    cached: Vec<(u32, Units)>,
    counts: SearchCounts,
    lookups: Option<Lookups>,
}

impl<'a> Work<'a> {
    fn new(of: &'a Answerer<'a>, queries: usize) -> Self {
        let any = |is: fn(&Region) -> bool| of.regions.is_some_and(|regions| regions.iter().any(is));
        let implied = any(|region| matches!(region.coding, Coding::HeapWalk { reread: true, .. }));
        let mut work = Self {
            of,
            reads: SearchReads::default(),
            waiting: any(|region| region.coding == Coding::Waiting),
            waits: vec![],
            implied,
            scratch: Scratch::default(),
            encoder: of.regions.map(BlockEncoder::new),
            contributions: Vec::with_capacity(if of.estimate.is_some() { queries } else { 0 }),
            cached: vec![],
            counts: SearchCounts::default(),
            lookups: of.describe.map(|(line, regions)| Lookups::new(line, regions, of.map.padding())),
        };
        work.reads = work.observer();
        work
    }

    /// What remembers the reads of a search.
    fn observer(&self) -> SearchReads {
        SearchReads::with_rereads(self.of.reread && !self.implied)
    }

    /// Each query by a search of its own.
    fn answer_one_by_one(&mut self, queries: &[Query]) -> Result<(), Fault> {
        let of = self.of;
        let mut found = Nearest::new(of.search.k, 0.0);
        let watched = self.is_watched();
        // A chain ends with its block: the stream says where.
        let mut carry = Carry::default();
        for query in queries {
            let known = self.known(query);
            if known.is_none() {
                self.counts.attempts += u64::from(if self.waiting {
                    let mut eyes = WaitingReads::new(&mut self.reads, &mut self.waits);
                    of.find(query.position, &mut carry, &mut found, &mut eyes)
                } else if watched {
                    of.find(query.position, &mut carry, &mut found, &mut self.reads)
                } else {
                    of.find(query.position, &mut carry, &mut found, &mut Blind)
                });
                self.counts.short += u64::from(!found.is_full());
                if let Some(lookups) = &mut self.lookups {
                    lookups.add(query, &found, &self.reads);
                }
            }
            self.log_own(&[query.pixel]);
            self.add(query, known, &found)?;
        }
        Ok(())
    }

    /// Those queries by one search that nothing held beforehand knows of.
    fn answer_together(&mut self, queries: &[Query]) -> Result<(), Fault> {
        let of = self.of;
        let (mut asking, mut together) = (vec![], self.observer());
        let nobody = Nearest::new(of.search.k, 0.0);
        for query in queries {
            let known = self.known(query);
            let reads = std::mem::take(&mut self.reads);
            if known.is_some() {
                self.log(&[query.pixel], &reads);
                self.add(query, known, &nobody)?;
            } else {
                asking.push(query);
                reads.runs().for_each(|(region, records)| records.iter().for_each(|&it| together.read(region, it)));
            }
            self.reads = reads;
        }
        if asking.is_empty() {
            return Ok(());
        }
        let points: Vec<[f32; 3]> = asking.iter().map(|query| query.position).collect();
        let mut found: Vec<Nearest> = points.iter().map(|_| Nearest::new(of.search.k, 0.0)).collect();
        self.counts.attempts += u64::from(of.search.run_all(of.map, &points, &mut found, &mut together));
        self.log(&asking.iter().map(|query| query.pixel).collect::<Vec<_>>(), &together);
        for (query, found) in asking.into_iter().zip(&found) {
            self.counts.short += u64::from(!found.is_full());
            if let Some(lookups) = &mut self.lookups {
                // The reads are the first one's, as if it had asked alone and the others had listened.
                lookups.add(query, found, &together);
                together.clear();
            }
            self.add(query, None, found)?;
        }
        Ok(())
    }

    /// Neighbours by one search, unless something is held beforehand for one of them.
    fn answer_in_groups(&mut self, queries: &[Query]) -> Result<(), Fault> {
        // What is known of the query before ends with the block: the stream says where.
        let (mut groups, mut found) = (Groups::default(), Nearest::new(self.of.search.k, 0.0));
        let mut asking = Vec::with_capacity(queries.len());
        for query in queries {
            let known = self.known(query);
            if known.is_none() && self.reads.is_empty() {
                asking.push(query);
                continue;
            }
            let reads = std::mem::take(&mut self.reads);
            self.answer_groups_of(&asking, &mut groups, &mut found)?;
            asking.clear();
            self.reads = reads;
            if known.is_some() {
                self.log_own(&[query.pixel]);
                self.add(query, known, &found)?;
            } else {
                self.answer_group(&[query], &mut groups, &mut found)?;
            }
        }
        self.answer_groups_of(&asking, &mut groups, &mut found)
    }

    /// Queries of which nothing is held, in groups.
    fn answer_groups_of(&mut self, queries: &[&Query], groups: &mut Groups, found: &mut Nearest) -> Result<(), Fault> {
        let of = self.of;
        let points: Vec<[f32; 3]> = queries.iter().map(|query| query.position).collect();
        let mut at = 0;
        while at < queries.len() {
            self.reads.clear();
            let reads = self.is_watched().then_some(&mut self.reads);
            let count = groups.begin((of.group, &points[at..]), &of.search, of.map, found, reads);
            self.answer_group(&queries[at..at + count], groups, found)?;
            at += count;
        }
        Ok(())
    }

    /// The queries of a group, which has begun.
    fn answer_group(&mut self, queries: &[&Query], groups: &mut Groups, found: &mut Nearest) -> Result<(), Fault> {
        let of = self.of;
        let pixels: Vec<u32> = queries.iter().map(|query| query.pixel).collect();
        for (number, &query) in queries.iter().enumerate() {
            let reads = self.is_watched().then_some(&mut self.reads);
            self.counts.attempts += u64::from(groups.next(query.position, &of.search, of.map, found, reads));
            self.counts.short += u64::from(!found.is_full());
            if number == 0 {
                self.log_own(&pixels);
            }
            if let Some(lookups) = &mut self.lookups {
                // The reads are the first one's, as if it had asked alone and the others had listened.
                lookups.add(query, found, &self.reads);
                self.reads.clear();
            }
            self.add(query, None, found)?;
        }
        Ok(())
    }

    /// Does anybody ask for reads?
    const fn is_watched(&self) -> bool {
        self.encoder.is_some() || self.lookups.is_some()
    }

    /// Counts the reads of a search that serves these pixels by itself, and puts them into the trace.
    fn log_own(&mut self, pixels: &[u32]) {
        let reads = std::mem::take(&mut self.reads);
        self.log(pixels, &reads);
        self.reads = reads;
    }

    /// What is known of a query beforehand, of which the reads are remembered, and no others.
    fn known(&mut self, query: &Query) -> Option<Outcome> {
        self.reads.clear();
        let held = self.of.precomputed.filter(|held| held.serves(query))?;
        let known = held.contribution(query, &mut self.reads);
        self.counts.attempts += 1;
        self.counts.no_site += u64::from(known.is_none());
        known
    }

    /// Counts the reads of a search that serves these pixels, and puts them into the trace.
    fn log(&mut self, pixels: &[u32], reads: &SearchReads) {
        self.counts.accesses += reads.len() as u64 + if self.implied { reads.rereads() } else { 0 };
        if let Some(encoder) = &mut self.encoder {
            encoder.begin(pixels);
            let mut rest = &self.waits[..];
            for (region, records) in reads.runs() {
                let waits = if self.waiting { rest.split_off(..records.len()) } else { None };
                self.of.encode(encoder, region, records, waits);
            }
            encoder.end();
        }
    }

    /// Adds what a query sees, known or estimated from what was found, to its pixel or record, if there is a picture.
    fn add(&mut self, query: &Query, known: Option<Outcome>, found: &Nearest) -> Result<(), Fault> {
        let Some((estimate, film)) = self.of.estimate else { return Ok(()) };
        match known.unwrap_or_else(|| estimate.contribution(query, found, &mut self.scratch)) {
            Outcome::Radiance(radiance) if query.is_for_record() => {
                let terms = self.of.cache.contributions(query.pixel, query.sample, radiance);
                for (sum, value) in terms.ok_or(Fault::Damaged("a query's irradiance record is not there"))? {
                    self.cached.push((sum, film.quantise(value).ok_or(Fault::TooBright(Overflow(query.pixel)))?));
                }
            }
            Outcome::Radiance(radiance) => {
                let units = film.quantise(radiance).ok_or(Fault::TooBright(Overflow(query.pixel)))?;
                self.contributions.push((query.pixel, units));
            }
            Outcome::NoArea => self.counts.no_area += 1,
        }
        Ok(())
    }
}
