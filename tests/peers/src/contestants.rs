//! Who takes part: ours, and kiddo, each over the same photons.

use crate::streams::{Photons, Queries};
use kiddo::{Eytzinger, FlatVec, QueryScratch, SquaredEuclidean};
use pm_maps::{AnyMap, Blind, BucketKdTree, Carry, Groups, Instructions, KdTree, Layout, Nearest, Search, WideTree};
use std::hint::black_box;
use std::num::NonZero;

/// Whoever looks at what was found for a query: squared distances and ids, in any order.
pub(crate) type Eyes<'a> = Option<&'a mut dyn FnMut(&[(f32, u32)])>;

/// One who finds the k nearest.
pub(crate) trait Contestant {
    /// Finds them for all queries, window by window, and shows them to the eyes, if there are any.
    fn run(&mut self, queries: &Queries, k: usize, eyes: Eyes<'_>);
}

/// A map of ours that is being searched.
pub(crate) struct Ours<'a> {
    pub(crate) name: &'static str,
    map: &'a dyn AnyMap,
    search: Search,
    how: How,
}

impl Contestant for Ours<'_> {
    fn run(&mut self, queries: &Queries, k: usize, mut eyes: Eyes<'_>) {
        let mut found = Nearest::new(k, 0.0);
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

    /// Searched for the k nearest, from a radius fit for it.
    pub(crate) fn searched_for(&self, k: usize, photons: &Photons) -> Ours<'_> {
        let search = Search::new(k, f32::INFINITY).fit_start(&*self.map, &photons.records);
        Ours { name: self.name, map: &*self.map, search, how: self.how }
    }
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

type Tree = kiddo::KdTree<f32, u32, Eytzinger, FlatVec<f32, u32, 3, 16>, 3, 16>;

/// kiddo as it is fastest: buckets of 16, answers unsorted, room used again.
pub(crate) struct Kiddo {
    tree: Tree,
    scratch: QueryScratch<Eytzinger, f32, 3>,
}

impl Kiddo {
    /// Its tree of these photons.
    pub(crate) fn build(photons: &Photons) -> anyhow::Result<Self> {
        let points: Vec<[f32; 3]> = photons.records.iter().map(|photon| photon.position).collect();
        let tree = Tree::new_from_slice(&points).map_err(|error| anyhow::anyhow!("kiddo: {error:?}"))?;
        Ok(Self { scratch: tree.create_scratch::<SquaredEuclidean<f32>>(), tree })
    }
}

impl Contestant for Kiddo {
    fn run(&mut self, queries: &Queries, k: usize, mut eyes: Eyes<'_>) {
        let k = NonZero::new(k).expect("k is not 0");
        for point in queries.points.iter().flatten() {
            let query = self.tree.query(point).nearest_n::<SquaredEuclidean<f32>>(k).unsorted();
            let found = query.with_scratch(&mut self.scratch).execute();
            match &mut eyes {
                Some(eyes) => eyes(&found.iter().map(|one| (one.distance, one.item)).collect::<Vec<_>>()),
                None => _ = black_box(found.len()),
            }
        }
    }
}
