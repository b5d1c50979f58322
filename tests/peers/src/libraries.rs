//! Others' libraries, each as it is fastest and exact.

use crate::aim::Aim;
use crate::contestants::{Contestant, Eyes};
use crate::streams::{Photons, Queries};
use kiddo::{Eytzinger, FlatVec, QueryScratch, SquaredEuclidean};
use nabo::simple_point::{P3, SimplePoint};
use nabo::{CandidateContainer, KDTree, NotNan, Parameters};
use std::hint::black_box;
use std::num::NonZero;

/// Those that there are; the first is the yardstick.
pub(crate) const LIBRARIES: [Library; 2] = [
    Library { name: "kiddo", build: |photons| Ok(Box::new(Kiddo::build(photons)?)) },
    Library { name: "nabo", build: |photons| Ok(Box::new(Nabo::build(photons))) },
];

/// A library.
pub(crate) struct Library {
    pub(crate) name: &'static str,
    pub(crate) build: fn(&Photons) -> anyhow::Result<Box<dyn Contestant>>,
}

type Tree = kiddo::KdTree<f32, u32, Eytzinger, FlatVec<f32, u32, 3, 16>, 3, 16>;

/// kiddo: buckets of 16, answers unsorted, room used again.
struct Kiddo {
    tree: Tree,
    scratch: QueryScratch<Eytzinger, f32, 3>,
}

impl Kiddo {
    fn build(photons: &Photons) -> anyhow::Result<Self> {
        let points: Vec<[f32; 3]> = photons.records.iter().map(|photon| photon.position).collect();
        let tree = Tree::new_from_slice(&points).map_err(|error| anyhow::anyhow!("kiddo: {error:?}"))?;
        Ok(Self { scratch: tree.create_scratch::<SquaredEuclidean<f32>>(), tree })
    }
}

impl Contestant for Kiddo {
    fn run(&mut self, queries: &Queries, aim: Aim, mut eyes: Eyes<'_>) {
        let k = NonZero::new(aim.k).expect("k is not 0");
        for point in queries.points.iter().flatten() {
            let query = self.tree.query(point).nearest_n::<SquaredEuclidean<f32>>(k);
            // Without a limit it is asked as it is fastest without one.
            let found = if aim.max_dist == f32::INFINITY {
                query.unsorted().with_scratch(&mut self.scratch).execute()
            } else {
                query.within(aim.max_dist * aim.max_dist).unsorted().with_scratch(&mut self.scratch).execute()
            };
            match &mut eyes {
                Some(eyes) => eyes(&found.iter().map(|one| (one.distance, one.item)).collect::<Vec<_>>()),
                None => _ = black_box(found.len()),
            }
        }
    }
}

/// nabo: buckets of 16, candidates in the container that it takes itself for so many, answers unsorted.
struct Nabo(KDTree<f32, P3>);

impl Nabo {
    fn build(photons: &Photons) -> Self {
        let points: Vec<P3> = photons.records.iter().map(|photon| point(photon.position)).collect();
        Self(KDTree::new_with_bucket_size(&points, 16))
    }
}

fn point(position: [f32; 3]) -> P3 {
    SimplePoint(position.map(|coordinate| NotNan::new(coordinate).expect("photons and queries are where they are")))
}

impl Contestant for Nabo {
    fn run(&mut self, queries: &Queries, aim: Aim, mut eyes: Eyes<'_>) {
        let parameters =
            Parameters { epsilon: 0.0, max_radius: aim.max_dist, allow_self_match: true, sort_results: false };
        for &at in queries.points.iter().flatten() {
            let container = if aim.k <= 16 { CandidateContainer::Linear } else { CandidateContainer::BinaryHeap };
            let found = self.0.knn_advanced(aim.k as u32, &point(at), container, &parameters, None);
            match &mut eyes {
                Some(eyes) => eyes(&found.iter().map(|one| (*one.dist2, one.index)).collect::<Vec<_>>()),
                None => _ = black_box(found.len()),
            }
        }
    }
}
