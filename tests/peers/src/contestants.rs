//! Who takes part: ours, each over the same photons.

use crate::aim::Aim;
use crate::streams::{Photons, Queries};
use pm_maps::{AnyMap, Blind, BucketKdTree, Carry, Groups, Instructions, KdTree, Layout, Nearest, Search, WideTree};
use std::hint::black_box;

/// Whoever looks at what was found for a query: squared distances and ids, in any order.
pub(crate) type Eyes<'a> = Option<&'a mut dyn FnMut(&[(f32, u32)])>;

/// One who finds the k nearest.
pub(crate) trait Contestant {
    /// Finds them for all queries, window by window, and shows them to the eyes, if there are any.
    fn run(&mut self, queries: &Queries, aim: Aim, eyes: Eyes<'_>);
}

/// A map of ours that is being searched.
pub(crate) struct Ours<'a> {
    pub(crate) name: &'static str,
    map: &'a dyn AnyMap,
    search: Search,
    how: How,
}

impl Contestant for Ours<'_> {
    fn run(&mut self, queries: &Queries, aim: Aim, mut eyes: Eyes<'_>) {
        let mut found = Nearest::new(aim.k, 0.0);
        let mut show = |found: &Nearest| match &mut eyes {
            Some(eyes) => eyes(&found.iter().collect::<Vec<_>>()),
            None => _ = black_box(found.bound()),
        };
        for window in &queries.points {
            if let How::Grouped(most) = self.how {
                let mut groups = Groups::default();
                let mut rest = &window[..];
                while !rest.is_empty() {
                    let count = groups.begin((most, rest), &self.search, self.map, &mut found, None);
                    for &point in rest.split_off(..count).expect("as many at most") {
                        groups.next(point, &self.search, self.map, &mut found, None);
                        show(&found);
                    }
                }
                continue;
            }
            let mut carry = Carry::default();
            for &point in window {
                match self.how == How::Carried {
                    true => carry.run(&self.search, self.map, point, &mut found, &mut Blind),
                    false => self.search.run(self.map, point, &mut found, &mut Blind),
                };
                show(&found);
            }
        }
    }
}

/// How a map is searched.
#[derive(Clone, Copy, PartialEq)]
enum How {
    Plain,
    /// From what the search before knew.
    Carried,
    /// So many neighbours at most by one search.
    Grouped(usize),
}

/// A map of ours, and how it is searched.
pub(crate) struct Map {
    pub(crate) name: &'static str,
    pub(crate) map: Box<dyn AnyMap>,
    how: How,
}

impl Map {
    fn new(name: &'static str, map: impl AnyMap + 'static, how: How) -> Self {
        Self { name, map: Box::new(map), how }
    }

    /// Searched for the nearest, from a radius fit for so many.
    pub(crate) fn searched_for(&self, aim: Aim, photons: &Photons) -> Ours<'_> {
        let search = Search::new(aim.k, aim.max_dist).fit_start(&*self.map, &photons.records);
        Ours { name: self.name, map: &*self.map, search, how: self.how }
    }
}

/// How the structures of ours are built.
pub(crate) const STRUCTURES: [(&str, Build); 3] = [
    ("kd", |photons| Ok(Box::new(KdTree::build(&photons.records, Layout::Heap)?))),
    ("bucket-kd", |photons| Ok(Box::new(BucketKdTree::build(&photons.records, Layout::Heap, 320)?))),
    ("wide", |photons| Ok(Box::new(WideTree::build(&photons.records)?))),
];

/// Builds a map.
type Build = fn(&Photons) -> anyhow::Result<Box<dyn AnyMap>>;

/// The maps of ours of which is shown how their costs grow, by the best instructions that there are.
pub(crate) fn grown(photons: &Photons) -> anyhow::Result<Vec<Map>> {
    let records = &photons.records[..];
    Ok(vec![
        Map::new("kd", KdTree::build(records, Layout::Heap)?, How::Plain),
        Map::new("wide --carry", WideTree::build(records)?, How::Carried),
        Map::new("wide --group 32", WideTree::build(records)?, How::Grouped(32)),
    ])
}

/// The maps of ours; the first says what is right.
pub(crate) fn ours(photons: &Photons) -> anyhow::Result<Vec<Map>> {
    let records = &photons.records[..];
    let mut maps = vec![
        Map::new("kd", KdTree::build(records, Layout::Heap)?, How::Plain),
        Map::new("bucket-kd, carried", BucketKdTree::build(records, Layout::Heap, 320)?, How::Carried),
        Map::new("wide, uncarried", WideTree::build(records)?, How::Plain),
    ];
    let names = [
        (Instructions::Plain, ["wide, plain", "grouped, plain"]),
        (Instructions::Avx2, ["wide, AVX2", "grouped, AVX2"]),
        (Instructions::Avx512, ["wide, AVX-512", "grouped, AVX-512"]),
    ];
    for (instructions, [carried, grouped]) in names.into_iter().filter(|(instructions, _)| instructions.are_there()) {
        for (name, how) in [(carried, How::Carried), (grouped, How::Grouped(32))] {
            maps.push(Map::new(name, WideTree::build(records)?.with(instructions), how));
        }
    }
    Ok(maps)
}
