//! Queries pass through an order, and what it says of itself is watched.

use super::inputs;
use super::verdict::{Fault, STORE, Verdict};
use crate::{Limits, Order, Per, Reordering, Setting, Store};
use pm_formats::vocabulary::measure;
use pm_formats::{BlockMeta, Bounds, Number, Query};
use pm_random::Random;
use pm_registry::{Chosen, Registry};

/// An order in one of the forms in which it is to be tried.
pub struct Form {
    /// How it is asked for: its word and options.
    pub line: String,
    /// The order.
    pub chosen: Chosen<dyn Order>,
}

/// Every order in each of its forms.
///
/// # Errors
/// If one cannot be asked for like that.
pub fn forms(orders: &Registry<dyn Order>) -> Result<Vec<Form>, Fault> {
    let forms = orders.iter().flat_map(|entry| entry.forms().iter().map(move |form| (entry.word(), form)));
    let asked = |(word, form)| {
        let line = format!("{word} {form}").trim().to_owned();
        match orders.choose(&line) {
            Ok(chosen) => Ok(Form { line, chosen }),
            Err(error) => Err(Fault { order: line, what: error.to_string() }),
        }
    };
    forms.map(asked).collect()
}

impl Form {
    /// The order at work on a scene, with [`STORE`] and so much memory of this machine.
    ///
    /// # Errors
    /// If it cannot be built.
    pub fn build(&self, per: Per, bounds: Bounds, memory: u64) -> Result<Reordering, Fault> {
        self.build_with(STORE, per, bounds, memory)
    }

    /// The same with another store.
    pub(crate) fn build_with(&self, store: Store, per: Per, bounds: Bounds, memory: u64) -> Result<Reordering, Fault> {
        let setting = Setting {
            values: &self.chosen.values,
            bounds,
            store,
            photons: self.chosen.values.file().map(|_| photons()),
            limits: Limits { memory, folder: std::env::temp_dir(), announce: Box::new(|| {}) },
        };
        match self.chosen.entry.build(setting) {
            Ok(order) => Ok(Reordering::new(per, order)),
            Err(error) => Err(Fault { order: self.line.clone(), what: error.to_string() }),
        }
    }

    /// A fault of this order, unless something holds.
    pub(super) fn holds(&self, holds: bool, what: impl FnOnce() -> String) -> Verdict {
        if holds { Ok(()) } else { Err(Fault { order: self.line.clone(), what: what() }) }
    }
}

/// The photons of `map.pmp` in forms of orders.
pub(crate) fn photons() -> Vec<[f32; 3]> {
    let mut random = Random::new(&[9]);
    (0..2000).map(|_| inputs::in_a_cube(&mut random)).collect()
}

/// What came out of an order, and what it says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Passed {
    /// The batch and the query, in the order in which they left.
    pub queries: Vec<(u64, Query)>,
    /// For the end block.
    pub measures: Vec<(String, Number)>,
    /// Bytes of tables on chip beside the store.
    pub tables: u64,
}

impl Passed {
    /// A measure by its name; NaN if it is not told, which is equal to nothing.
    #[must_use]
    pub fn measure(&self, name: &str) -> f64 {
        self.measures.iter().find(|(known, _)| known == name).map_or(f64::NAN, |(_, number)| number.as_f64())
    }
}

/// Batches of queries pass through an order. The most that was in it at any time is checked against what it tells.
pub(super) fn pass(form: &Form, order: &mut Reordering, batches: &[&[Query]]) -> Result<Passed, Fault> {
    let mut out = vec![];
    let (mut given, mut most) = (0, 0);
    let failed = |error: pm_formats::Error| Fault { order: form.line.clone(), what: error.to_string() };
    for (batch, queries) in (0..).zip(batches) {
        // Blocks of a batch come in pieces.
        for piece in queries.chunks(PIECE) {
            let meta = BlockMeta { batch, ..BlockMeta::default() };
            let mut emit = |meta: BlockMeta, queries: &[Query]| {
                out.extend(queries.iter().map(|&query| (meta.batch, query)));
                Ok(())
            };
            order.push(meta, piece, &mut emit).map_err(failed)?;
            given += piece.len();
            most = most.max(given.saturating_sub(out.len()));
        }
    }
    let mut emit = |meta: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|&query| (meta.batch, query)));
        Ok(())
    };
    order.drain(&mut emit).map_err(failed)?;
    let passed = Passed { queries: out, measures: order.measures(), tables: order.order().costs().tables() };
    let peak = passed.measure(measure::PEAK_QUERIES_HELD);
    // A piece is taken at once, and what it lets go is given at its end.
    let told = most as f64 <= peak && peak <= (most + PIECE) as f64;
    form.holds(told, || format!("{most} queries were held, {peak} are told"))?;
    Ok(passed)
}

/// Queries that are pushed at a time.
const PIECE: usize = 7;
