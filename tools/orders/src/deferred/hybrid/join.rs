//! A batch at work: a sample first, then the casts, then the cells that were written.

use crate::arrivals::Arrivals;
use crate::deferred::residents::Residents;
use crate::sample::{RAYS_OF_A_SAMPLE, Sample};
use crate::{BURST_BUFFER, Charge, Costs, Keys, Limits, Outlet, Reorder, Sorted, Store};
use pm_formats::vocabulary::measure;
use pm_formats::{Number, Query};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// What a batch was before, since the sample of all of it decides: this machine keeps it, where the machine that is counted casts
/// it again.
pub(super) struct Join {
    residents: Rc<RefCell<Residents>>,
    sample: Sample,
    arrivals: Arrivals,
    by_rank: Sorted<Keys>,
    came: u64,
    /// Queries of the samples of all batches.
    sampled: u64,
    announce: Rc<dyn Fn()>,
    costs: Costs,
}

impl Join {
    pub(super) fn new(residents: Residents, store: Store, limits: Limits) -> Self {
        let mut costs = Costs::new(store);
        costs.set_tables(residents.bytes());
        let residents = Rc::new(RefCell::new(residents));
        let ranks = residents.clone();
        let keys: Keys =
            Box::new(move |queries| queries.iter().map(|query| ranks.borrow().rank(query.position)).collect());
        let Limits { memory, folder, announce } = limits;
        let announce = once(announce);
        let (memory, told) = (memory / 2, announce.clone());
        let arrivals = Arrivals::new(folder.clone(), memory);
        let limits = Limits { memory, folder, announce: Box::new(move || told()) };
        // What is spilled is charged here.
        let by_rank = Sorted::new(keys, Charge::MergeSort, store, 0, limits);
        Self { residents, sample: Sample::default(), arrivals, by_rank, came: 0, sampled: 0, announce, costs }
    }

    /// A batch of so many queries is done, of which so many did not wait.
    fn charge(&mut self, n: u64, at_once: u64, casts: u32, cells: u64) {
        let store = self.costs.store();
        let waiting = n - at_once;
        // How many will wait is not known while they come; how many come is.
        if n <= store.room() {
            self.costs.group(n, 0, waiting * store.record.bytes());
        } else {
            // A buffer for each cell while they are written, one while they are read.
            let buffers = (cells + 1).min(store.fan()) * BURST_BUFFER;
            self.costs.group(n, waiting * store.passes_to_part(cells), buffers);
        }
        self.costs.cast_again(n * u64::from(casts - 1));
        self.costs.tell(measure::PREPASS_RAYS, Number::Count(self.sampled * RAYS_OF_A_SAMPLE));
    }
}

/// Calls it the first time only.
fn once(announce: Box<dyn Fn()>) -> Rc<dyn Fn()> {
    let announced = Cell::new(false);
    Rc::new(move || {
        if !announced.replace(true) {
            announce();
        }
    })
}

impl Reorder for Join {
    fn push(&mut self, queries: &[Query], _: &mut Outlet<'_>) -> pm_formats::Result<()> {
        let residents = self.residents.borrow();
        queries.iter().for_each(|query| self.sample.see(query, residents.cell(query.position)));
        self.came += queries.len() as u64;
        if self.arrivals.overflows(queries.len()) {
            (self.announce)();
        }
        self.arrivals.push(queries)
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        let sample = self.sample.take();
        self.sampled += sample.len() as u64;
        let (casts, cells) = self.residents.borrow_mut().choose(&sample);
        let mut at_once = 0;
        let (residents, by_rank) = (&self.residents, &mut self.by_rank);
        self.arrivals.drain(|queries| {
            let residents = residents.borrow();
            at_once += queries.iter().filter(|query| residents.at_once(residents.rank(query.position))).count() as u64;
            by_rank.push(queries, out)
        })?;
        self.by_rank.drain(out)?;
        let n = std::mem::take(&mut self.came);
        self.charge(n, at_once, casts, cells);
        Ok(())
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }
}
