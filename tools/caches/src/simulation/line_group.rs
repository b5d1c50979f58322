//! The caches of one line size, which share its line accesses.

use pm_formats::trace::Region;

use super::twins::Twins;
use crate::curves::{CurveCollector, Shards};
use crate::findings::WorkingSetCounter;
use crate::lines::{Accesses, LineChunk, LineSpace, PAGE_SHIFT, Repeats, Resume, SearchStart};
use crate::misses::{Banks, Chains, Misses, PageSwitches, Waiting};
use crate::models::{Answer, CacheModel, CacheOnTrace, Modelled};
use crate::{CacheConfig, Measures, Policy, SimulationError};

/// The line accesses of one line size and the caches they run through.
pub(super) struct LineGroup {
    pub(super) space: LineSpace,
    /// log2 of the bytes of the pages that have places, if they have.
    pub(super) page_shift: u32,
    chunk: LineChunk,
    /// Line accesses that count.
    pub(super) accesses: u64,
    pub(super) models: Vec<Running>,
    misses: Misses,
    /// Which misses they share with their twins, if somebody wants to know.
    pub(super) twins: Option<Twins>,
    pub(super) curve: Option<CurveCollector>,
    pub(super) shards: Option<Shards>,
    pub(super) working_sets: Option<WorkingSetCounter>,
    /// Region and line number of each fetch of the first of all caches, if somebody collects them.
    pub(super) fetched: Option<Fetched>,
    write_backs: bool,
}

/// A line that the first of all caches fetches, or writes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Moved {
    pub(crate) region: u16,
    pub(crate) line: u64,
    pub(crate) written: bool,
}

/// What the first of all caches fetched and wrote back, in order.
#[derive(Default)]
pub(super) struct Fetched {
    pub(super) moves: Vec<Moved>,
    /// The numbers of the accesses that did, if somebody wants to know that too.
    pub(super) by: Option<Vec<u64>>,
}

impl Fetched {
    /// One more, by the line access at this index.
    fn push(&mut self, moved: Moved, chunk: &LineChunk, index: usize) {
        self.moves.push(moved);
        if let Some(by) = &mut self.by {
            by.push(chunk.record(index));
        }
    }
}

/// A model, and the caches that it answers for.
pub(super) struct Running {
    pub(super) model: Box<dyn CacheModel>,
    pub(super) caches: Vec<CacheOfModel>,
}

/// One cache that a model answers for.
pub(super) struct CacheOfModel {
    /// Index into the configurations.
    pub(super) config: usize,
    /// Index into the model's counts.
    pub(super) counts: usize,
    pub(super) pages: Option<PageSwitches>,
    pub(super) banks: Option<Banks>,
    pub(super) chains: Option<Chains>,
    /// Where records count once: of each region, misses of records that had missed already.
    pub(super) spared: Vec<u64>,
    /// The record that missed last.
    missed: u64,
}

impl LineGroup {
    /// Those of `configs` whose indices are `members`, all of one line size.
    pub(super) fn new(
        line_bytes: u32,
        members: &[usize],
        configs: &[CacheConfig],
        regions: &[Region],
        measures: &Measures,
    ) -> Result<Self, SimulationError> {
        let page_shift = PAGE_SHIFT.max(line_bytes.ilog2());
        let space = match regions {
            [region] if region.is_addresses() => LineSpace::of_places(line_bytes, page_shift),
            _ => LineSpace::new(regions, line_bytes),
        };
        let space = space.with_span(measures.span);
        let slots = space.slots();
        space.check()?;
        let models = models(&space, members, configs, regions.len(), measures)?;
        let needed = models.iter().any(|running| running.model.repeats_matter());
        let curve = measures.curves.contains(&line_bytes);
        let wanted = measures.page_bytes.is_some()
            || measures.miss_by_miss
            || measures.dram.is_some()
            || measures.miss_chains
            || space.counts_records();
        let chunk = LineChunk::new(if needed { Repeats::Kept } else { Repeats::LeftOut });
        let twins = measures.miss_by_miss.then(|| Twins::new(&models, configs));
        Ok(Self {
            chunk: chunk.numbered(measures.miss_chains),
            accesses: 0,
            twins,
            models,
            misses: Misses::new(wanted),
            curve: (curve && measures.exact_curves()).then(|| CurveCollector::new(slots)),
            shards: measures.sampled.filter(|_| curve).map(|rate| Shards::new(&space, rate)),
            working_sets: measures.working_sets.then(|| WorkingSetCounter::new(slots)),
            fetched: None,
            write_backs: measures.write_backs,
            page_shift,
            space,
        })
    }

    /// From now on, what the first of all caches fetches is kept.
    pub(super) fn keep_fetched(&mut self) {
        self.fetched = Some(Fetched::default());
        self.misses = Misses::new(true);
    }

    /// The same, and by which access.
    pub(super) fn keep_fetched_by(&mut self) {
        self.keep_fetched();
        self.chunk = std::mem::take(&mut self.chunk).numbered(true);
        self.fetched = Some(Fetched { by: Some(vec![]), ..Fetched::default() });
    }

    /// Simulates accesses, among which searches begin at `starts`; what they wait for, if somebody wants to know.
    pub(super) fn run(
        &mut self,
        accesses: &Accesses,
        counted: bool,
        starts: &[SearchStart],
        waiting: Option<&Waiting>,
    ) {
        let starts = if self.working_sets.is_some() { starts } else { &[] };
        let mut resume = Resume::default();
        let first = self.chunk.last_record() + 1;
        while self.chunk.split(&self.space, accesses, starts, &mut resume) {
            if counted {
                self.accesses += self.chunk.accesses();
                self.working_sets.iter_mut().for_each(|sets| sets.run(&self.chunk));
            }
            for (at, Running { model, caches }) in self.models.iter_mut().enumerate() {
                self.misses.clear();
                model.run(&self.space, &self.chunk, counted, &mut self.misses);
                if let Some(twins) = &mut self.twins {
                    twins.note(at, &self.misses);
                }
                follow(
                    &self.space,
                    &self.chunk,
                    &self.misses,
                    caches,
                    self.fetched.as_mut(),
                    (counted, self.write_backs),
                );
            }
            if let Some(twins) = &mut self.twins
                && counted
            {
                twins.compare();
            }
            if let Some(curve) = &mut self.curve {
                curve.run(self.space.slots(), &self.chunk, counted);
            }
            if let Some(shards) = &mut self.shards {
                shards.run(&self.space, &self.chunk, counted);
            }
        }
        if let Some(waiting) = waiting {
            let caches = self.models.iter_mut().flat_map(|running| &mut running.caches);
            for chains in caches.filter_map(|cache| cache.chains.as_mut()) {
                chains.run(waiting, first, accesses.len(), counted);
            }
        }
    }
}

/// The models that answer for all members, policy by policy.
fn models(
    space: &LineSpace,
    members: &[usize],
    configs: &[CacheConfig],
    regions: usize,
    measures: &Measures,
) -> Result<Vec<Running>, SimulationError> {
    let mut by_policy: Vec<(&dyn Policy, Vec<usize>)> = vec![];
    for &member in members {
        let policy = configs[member].policy().entry();
        match by_policy.iter_mut().find(|(known, _)| known.word() == policy.word()) {
            Some((_, members)) => members.push(member),
            None => by_policy.push((policy, vec![member])),
        }
    }
    let mut models = vec![];
    for (policy, members) in by_policy {
        let caches = members.iter().map(|&member| CacheOnTrace::new(configs[member], space, regions));
        let caches = caches.collect::<Result<Vec<_>, _>>()?;
        let mut unanswered: Vec<usize> = (0..caches.len()).collect();
        // Of the first of all caches may be asked what others need not tell.
        let first = members.iter().position(|&member| member == 0).filter(|_| measures.write_backs);
        let mut modelled = vec![];
        if let Some(first) = first {
            let model = policy.model_with_write_backs(&caches[first]);
            if !model.tells_write_backs() {
                return Err(SimulationError::NoWriteBacks(configs[0]));
            }
            modelled.push(Modelled::one(first, model));
        }
        let others: Vec<usize> = (0..caches.len()).filter(|&cache| Some(cache) != first).collect();
        let caches_of_others: Vec<CacheOnTrace> = others.iter().map(|&other| caches[other]).collect();
        for of_others in if others.is_empty() { vec![] } else { policy.models(&caches_of_others) } {
            let answers = of_others.answers.iter().map(|answer| Answer { cache: others[answer.cache], ..*answer });
            modelled.push(Modelled { answers: answers.collect(), model: of_others.model });
        }
        for modelled in modelled {
            let of_model = modelled.answers.into_iter().map(|answer| {
                unanswered.retain(|&cache| cache != answer.cache);
                let pages = measures.page_bytes.map(PageSwitches::new);
                let (config, counts) = (members[answer.cache], answer.counts);
                let banks = measures.dram.map(Banks::new);
                let chains = measures.miss_chains.then(|| Chains::new(configs[config].keeps_lines()));
                CacheOfModel { config, counts, pages, banks, chains, spared: vec![0; regions], missed: 0 }
            });
            models.push(Running { model: modelled.model, caches: of_model.collect() });
        }
        assert!(unanswered.is_empty(), "{} has no model for some of its caches", policy.word());
    }
    Ok(models)
}

/// Follows the misses of a model's caches: the pages they are in, and the lines that its first cache fetches.
fn follow(
    space: &LineSpace,
    chunk: &LineChunk,
    misses: &Misses,
    caches: &mut [CacheOfModel],
    mut fetched: Option<&mut Fetched>,
    (counted, write_backs): (bool, bool),
) {
    let line_bytes = u64::from(space.line_bytes());
    let pages_alone = |cache: &CacheOfModel| cache.chains.is_none() && cache.banks.is_none();
    if fetched.is_none() && !space.counts_records() && caches.iter().all(pages_alone) {
        caches.iter_mut().for_each(|cache| follow_pages(space, chunk, misses, cache, counted));
        return;
    }
    let mut written_back = misses.written_back().iter().filter(|_| write_backs).peekable();
    for miss in misses.list() {
        let region = chunk.attributes(miss.index as usize).region();
        let line = space.line(region, chunk.slots()[miss.index as usize]);
        for cache in caches.iter_mut().filter(|cache| cache.counts < miss.caches as usize) {
            if space.counts_records() {
                let record = chunk.record(miss.index as usize);
                cache.spared[region] += u64::from(counted && cache.missed == record);
                cache.missed = record;
            }
            if let Some(chains) = &mut cache.chains {
                chains.miss(chunk.record(miss.index as usize));
            }
            if let Some(pages) = &mut cache.pages {
                pages.fetch(line * line_bytes, line * line_bytes + (line_bytes - 1), counted);
            }
            if let Some(banks) = &mut cache.banks {
                banks.fetch(line * line_bytes, line * line_bytes + (line_bytes - 1), counted);
            }
        }
        let by_first = caches.iter().any(|cache| cache.config == 0 && cache.counts < miss.caches as usize);
        if let Some(fetched) = &mut fetched
            && by_first
        {
            // A line leaves before another takes its place.
            while let Some(back) = written_back.next_if(|back| back.index == miss.index) {
                let line = space.line(back.region.into(), back.slot);
                fetched.push(Moved { region: back.region, line, written: true }, chunk, miss.index as usize);
            }
            fetched.push(Moved { region: region as u16, line, written: false }, chunk, miss.index as usize);
        }
    }
}

/// Follows the misses of one cache where all that is asked is the pages they are in, which is what every table but the one on
/// the terminal has: where most accesses miss it would else take a third of the time of the cache itself.
fn follow_pages(space: &LineSpace, chunk: &LineChunk, misses: &Misses, cache: &mut CacheOfModel, counted: bool) {
    let Some(mut pages) = cache.pages.take() else { return };
    let line_bytes = u64::from(space.line_bytes());
    for miss in misses.list().iter().filter(|miss| cache.counts < miss.caches as usize) {
        let index = miss.index as usize;
        let first = space.line(chunk.attributes(index).region(), chunk.slots()[index]) * line_bytes;
        pages.fetch(first, first + (line_bytes - 1), counted);
    }
    cache.pages = Some(pages);
}
