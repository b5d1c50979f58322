//! What every order must pass, whoever wrote it, in a test of the crate that adds one: [`all`] if it is a deferred one,
//! [`generative`] if it is one of those.
//!
//! ```no_run
//! # let orders = pm_orders::orders();
//! // With an order of one's own: pm_orders::orders().with(&MyOrder)
//! pm_orders::trial::all(&orders).unwrap();
//! ```

mod inputs;
mod passing;
mod verdict;

pub use inputs::queries;
#[cfg(test)]
pub(crate) use passing::photons;
pub use passing::{Form, Passed, forms};
pub use verdict::{Fault, STORAGE, STORE, Verdict};

use crate::generative::broken_promise;
use crate::{GenerativeOrder, Order, Per};
use passing::pass;
use pm_formats::Query;
use pm_formats::vocabulary::measure;
use pm_registry::Registry;

/// More memory than any trial needs, and so little that orders which hold everything must use files.
const MUCH: u64 = 1 << 30;
const LITTLE: u64 = 64 << 10;

/// Each form, batch by batch and over the image.
fn both(forms: &[Form]) -> impl Iterator<Item = (Per, &Form)> {
    [Per::Batch, Per::Image].into_iter().flat_map(move |per| forms.iter().map(move |form| (per, form)))
}

/// All trials.
///
/// # Errors
/// The first fault that is found.
pub fn all(orders: &Registry<dyn Order>) -> Verdict {
    [permutation, determinism, label, batches, store, memory, streaming].into_iter().try_for_each(|trial| trial(orders))
}

/// Every query that goes in comes out once, whatever the queries are like.
///
/// # Errors
/// The first fault that is found.
pub fn permutation(orders: &Registry<dyn Order>) -> Verdict {
    let forms = forms(orders)?;
    for n in [0, 1, 2, 5000] {
        for (name, bounds, all) in inputs::hard(n) {
            let expected = sorted(all.iter().copied());
            let (first, second) = all.split_at(all.len() / 3);
            for (per, form) in both(&forms) {
                let out = pass(form, &mut form.build(per, bounds, MUCH)?, &[first, second])?;
                let same = sorted(out.queries.iter().map(|&(_, query)| query)) == expected;
                form.holds(same, || format!("{n} queries, {name}: what comes out is not what went in"))?;
            }
        }
    }
    Ok(())
}

/// The same queries leave in the same order when they come again, and what is told of it is the same.
///
/// # Errors
/// The first fault that is found.
pub fn determinism(orders: &Registry<dyn Order>) -> Verdict {
    let all = queries(5000, inputs::in_a_cube);
    for form in forms(orders)? {
        let once = || pass(&form, &mut form.build(Per::Image, inputs::UNIT, MUCH)?, &[&all]);
        form.holds(once()? == once()?, || "does not do the same twice".into())?;
    }
    Ok(())
}

/// An order is called by its word in tables.
///
/// # Errors
/// The first fault that is found.
pub fn label(orders: &Registry<dyn Order>) -> Verdict {
    for form in forms(orders)? {
        let label = form.chosen.entry.label(&form.chosen.values, STORE);
        let word = form.chosen.entry.word();
        form.holds(label.split(' ').next() == Some(word), || format!("is called `{label}` in tables"))?;
    }
    Ok(())
}

/// What is ordered batch by batch stays in its batch, and an image is one.
///
/// # Errors
/// The first fault that is found.
pub fn batches(orders: &Registry<dyn Order>) -> Verdict {
    let all = queries(300, inputs::in_a_cube);
    let (first, second) = all.split_at(100);
    for form in forms(orders)? {
        let out = pass(&form, &mut form.build(Per::Batch, inputs::UNIT, MUCH)?, &[first, second])?.queries;
        let stays = out.len() == 300
            && out[..100].iter().all(|(batch, query)| *batch == 0 && first.contains(query))
            && out[100..].iter().all(|(batch, query)| *batch == 1 && second.contains(query));
        form.holds(stays, || "does not keep batches".into())?;
        let out = pass(&form, &mut form.build(Per::Image, inputs::UNIT, MUCH)?, &[first, second])?.queries;
        form.holds(out.iter().all(|(batch, _)| *batch == 0), || "an image is not one batch".into())?;
    }
    Ok(())
}

/// An order takes no more on chip than its store and its tables; what does not fit is told; what is written is read.
///
/// # Errors
/// The first fault that is found.
pub fn store(orders: &Registry<dyn Order>) -> Verdict {
    let forms = forms(orders)?;
    let all = queries(20_000, inputs::in_a_cube);
    let (first, second) = all.split_at(5000);
    for (per, form) in both(&forms) {
        let out = pass(form, &mut form.build(per, inputs::UNIT, MUCH)?, &[first, second])?;
        let on_chip = out.measure(measure::ON_CHIP);
        form.holds(on_chip <= (STORAGE + out.tables) as f64, || format!("{on_chip} bytes on chip"))?;
        let (written, read) = (out.measure(measure::SPILLED_WRITTEN), out.measure(measure::SPILLED_READ));
        form.holds(written == read, || format!("{written} bytes are written, {read} are read"))?;
        form.holds(form.chosen.entry.is_streaming() || written > 0.0, || "holds everything and spills nothing".into())?;
        let (full, compact) = (out.measure(measure::STORAGE), out.measure(measure::STORAGE_COMPACT));
        form.holds(full * 9.0 == compact * 44.0, || format!("{full} bytes would be {compact} compact ones"))?;
    }
    Ok(())
}

/// Memory of this machine changes no query and no measure.
///
/// # Errors
/// The first fault that is found.
pub fn memory(orders: &Registry<dyn Order>) -> Verdict {
    let forms = forms(orders)?;
    let all = queries(20_000, |random| [random.unit(), (random.unit() * 4.0).floor() / 4.0, 0.25]);
    let (first, second) = all.split_at(5000);
    for (per, form) in both(&forms) {
        let with = |memory| pass(form, &mut form.build(per, inputs::UNIT, memory)?, &[first, second]);
        form.holds(with(MUCH)? == with(LITTLE)?, || "does otherwise with little memory".into())?;
    }
    Ok(())
}

/// An order that says that it is streaming holds no more of a longer stream; one that says nothing holds everything.
///
/// # Errors
/// The first fault that is found.
pub fn streaming(orders: &Registry<dyn Order>) -> Verdict {
    for form in forms(orders)? {
        let peak = |n: u32| {
            let all = queries(n, inputs::in_a_cube);
            let out = pass(&form, &mut form.build(Per::Image, inputs::UNIT, MUCH)?, &[&all])?;
            Ok(out.measure(measure::PEAK_QUERIES_HELD))
        };
        let (short, long) = (peak(20_000)?, peak(100_000)?);
        let told = || format!("held {short} queries of 20,000 and {long} of 100,000");
        let fits = if form.chosen.entry.is_streaming() { short > 0.8 * long } else { long == 100_000.0 };
        form.holds(fits, told)?;
    }
    Ok(())
}

/// The bytes of queries, sorted.
fn sorted(queries: impl IntoIterator<Item = Query>) -> Vec<Vec<u8>> {
    let mut all: Vec<_> = queries.into_iter().map(|query| bytemuck::bytes_of(&query).to_vec()).collect();
    all.sort();
    all
}

/// Every generative order, asked with nothing but its word: does it visit every pixel of some images for every ray once,
/// batch by batch?
///
/// # Errors
/// The first fault that is found.
pub fn generative(orders: &Registry<dyn GenerativeOrder>) -> Verdict {
    for entry in orders.iter() {
        let fault = |what: String| Fault { order: entry.word().to_owned(), what };
        let chosen = orders.ask(entry, []).map_err(|error| fault(error.to_string()))?;
        let order = entry.make(&chosen.values, 4).map_err(|error| fault(error.to_string()))?;
        for size in [[1, 1], [7, 5], [33, 17]] {
            broken_promise(&*order, size).map_or(Ok(()), |what| Err(fault(format!("{size:?}: {what}"))))?;
        }
    }
    Ok(())
}
