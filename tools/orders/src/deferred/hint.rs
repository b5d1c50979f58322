//! What a few bits buy: within a window of queries, those whose keys share so many bits leave together.
//!
//! So a ray-tracing device reorders the threads in flight by a hint of the program's (NVIDIA, *Shader Execution Reordering*, white
//! paper, 2022, where a hint has at most 16 bits). With one bit it is nearly the order in which they came; with many bits and a
//! window of all, the order along the curve.

use super::hilbert;
use crate::{Costs, Keys, Order, Outlet, Reorder, Setting, Store};
use pm_formats::{Bounds, Query};
use pm_registry::{Domain, Parameter, ParameterError, Values, words_of};

const BITS: Parameter = Parameter::new("bits", Domain::count(1, 30), "bits of the key that count").or("8");
const WINDOW: Parameter =
    Parameter::new("window", Domain::count(1, 1 << 24), "queries that are sorted together").or("1024");
const KEY: Parameter = Parameter::new("key", Domain::Word(words_of::<Key>), "what the key is of").or("position");

pm_registry::choices! {
    /// What a hint tells of a query.
    #[derive(Debug)]
    pub enum Key {
        /// Its place along a Hilbert curve through the scene
        Position = "position",
        /// Where its ray goes: a cell of the sphere of directions
        Direction = "direction",
        /// Where its surface faces: a cell of the sphere of directions
        Normal = "normal",
    }
}

pm_registry::registered! {
    /// Windows of queries, each sorted by a few bits of a key; streaming
    pub struct Hint = "hint" with [BITS, WINDOW, KEY];
}

impl Order for Hint {
    fn label(&self, values: &Values, _: Store) -> String {
        let (bits, window) = (values.count::<u32>(BITS.name), values.count::<u32>(WINDOW.name));
        let of = match values.choice(KEY.name) {
            Key::Position => "",
            Key::Direction => " direction",
            Key::Normal => " normal",
        };
        format!("hint{of} {bits}x{window}")
    }

    fn is_streaming(&self) -> bool {
        true
    }

    fn forms(&self) -> &'static [&'static str] {
        &["", "--bits 3 --window 64", "--key direction --bits 5", "--key normal --window 1"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let Setting { values, bounds, store, .. } = setting;
        let (bits, window) = (values.count(BITS.name), values.count(WINDOW.name));
        Ok(Box::new(Windows {
            keys: keys(values.choice(KEY.name), bits, bounds),
            window,
            held: vec![],
            costs: Costs::new(store),
        }))
    }
}

/// Bits of a whole key, of any kind.
const WHOLE: u32 = 30;

/// Computes the keys of queries, of so many bits.
pub(super) fn keys(of: Key, bits: u32, bounds: Bounds) -> Keys {
    let whole: Keys = match of {
        Key::Position => Box::new(hilbert::keys(bounds)),
        Key::Direction => Box::new(|queries| queries.iter().map(|query| cell_of_sphere(query.view)).collect()),
        Key::Normal => Box::new(|queries| queries.iter().map(|query| cell_of_sphere(query.normal)).collect()),
    };
    Box::new(move |queries| whole(queries).into_iter().map(|key| key >> (WHOLE - bits)).collect())
}

/// The cell of the octahedral square that a packed direction lies in, of 2^15 x 2^15, along Morton's curve: its first bits are a
/// coarser cell.
fn cell_of_sphere(packed: u32) -> u32 {
    let (u, v) = (packed & 0xffff, packed >> 16);
    (0..15).fold(0, |key, bit| key << 2 | (u >> (15 - bit) & 1) << 1 | v >> (15 - bit) & 1)
}

/// Windows, one after another.
struct Windows<K> {
    keys: K,
    window: usize,
    /// Queries, and whether they are on chip.
    held: Vec<(Query, bool)>,
    costs: Costs,
}

impl<K: Fn(&[Query]) -> Vec<u32>> Reorder for Windows<K> {
    fn push(&mut self, queries: &[Query], out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        for &query in queries {
            let on_chip = self.costs.admit();
            self.held.push((query, on_chip));
            if self.held.len() == self.window {
                self.drain(out)?;
            }
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        let queries: Vec<Query> = self.held.iter().map(|held| held.0).collect();
        let mut order: Vec<(u32, usize)> = (self.keys)(&queries).into_iter().zip(0..).collect();
        // Of equal keys the first that came.
        order.sort_unstable();
        for (_, at) in order {
            let (query, on_chip) = self.held[at];
            self.costs.release(on_chip);
            out.leave(query)?;
        }
        self.held.clear();
        Ok(())
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_of_the_sphere_is_cut_in_four_by_two_more_bits() {
        for packed in [0, u32::MAX, 0x1234_8765, 0x8000_7fff, 0xfffe_0001] {
            let key = cell_of_sphere(packed);
            let halves = [packed & 0xffff, packed >> 16].map(|x| x >> 15);
            assert_eq!(key >> 28, halves[0] << 1 | halves[1]);
            let quarters = [packed & 0xffff, packed >> 16].map(|x| x >> 14);
            assert_eq!(key >> 26, (halves[0] << 1 | halves[1]) << 2 | (quarters[0] & 1) << 1 | quarters[1] & 1);
            assert!(key < 1 << WHOLE);
        }
    }
}
