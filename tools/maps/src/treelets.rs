//! Searches that wait at treelets: a batch of queries goes through a kd-tree piece by piece, and a search that leaves a piece waits in
//! the queue of the next.
//!
//! Aila and Karras, *Architecture Considerations for Tracing Incoherent Rays*, HPG 2010, cut a hierarchy into treelets that fit a
//! cache and queue rays at them; here searches for k photons wait, each with its candidates. The treelet whose queue is
//! longest is next, and all who wait there go on until they want a node of another treelet. A search visits the same nodes as it
//! would by itself, so the neighbours are those of every exact map; only when it visits them depends on the batch. The tree is the
//! left-balanced one of [`KdTree`], a node being 20 bytes, and the nodes of a treelet lie side by side.

mod cut;
mod queues;

use super::error::check;
use super::geometry::distance_squared;
use super::{AccessObserver, BuildError, KdTree, Layout, Nearest, PhotonMap};
use cut::Cut;
use pm_formats::trace::{Coding, Region, lay_out};
use pm_formats::{Number, Photon};
use queues::Queues;

/// Region of the nodes.
const NODES: u16 = 0;
/// Region of the searches that wait, where they do so in memory, in lines.
const WAITING: u16 = 1;
/// Bytes of a node in the traced memory.
const NODE: usize = size_of::<Photon>();
/// Bytes of a search that waits: the query's record, and how many candidates and open nodes it has.
const SEARCH: usize = size_of::<pm_formats::Query>() + 4;
/// Bytes of a candidate (squared distance and photon), and of an open node (its number, and the squared distance of its plane).
const PAIR: usize = 8;

pm_registry::choices! {
    /// Where searches wait for their treelet.
    #[derive(Debug)]
    pub enum Waiting {
        /// On chip: all searches of a batch, each with room for k candidates
        Chip = "chip",
        /// In memory: what a search has is read when it goes on; as much was written when it began to wait, which is not in the trace
        Memory = "memory",
    }
}

/// What there is to say about treelets and the searches that wait at them.
#[derive(Clone, Copy, Debug)]
pub struct TreeletOptions {
    /// Bytes that a treelet has at most; one node is one all the same.
    pub treelet: u32,
    /// Searches of a batch.
    pub batch: usize,
    /// Where they wait.
    pub waiting: Waiting,
    /// Bytes of a line, in which searches are stored that wait in memory.
    pub line: u32,
    /// Photons that each looks for.
    pub k: usize,
}

/// A node of the tree: photon, split axis, id.
struct Node {
    position: [f32; 3],
    axis: u8,
    id: u32,
}

/// A kd-tree in treelets.
pub struct Treelets {
    /// Node i at index i - 1.
    nodes: Vec<Node>,
    cut: Cut,
    /// Which record of the traced memory each node is.
    records: Vec<u32>,
    options: TreeletOptions,
}

/// A search under way: nodes that are yet to be visited, the next one last, with the squared distance to the plane before each.
type Open = Vec<(u32, f32)>;

impl Treelets {
    /// Cuts the left-balanced tree of these photons.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], options: TreeletOptions) -> Result<Self, BuildError> {
        check(photons)?;
        let tree = KdTree::build(photons, Layout::Heap)?;
        let node = |(axis, id): (usize, u32)| Node { position: photons[id as usize].position, axis: axis as u8, id };
        let nodes: Vec<Node> = tree.nodes().map(node).collect();
        let cut = Cut::new(nodes.len(), (options.treelet as usize / NODE).max(1));
        let records = cut.records(nodes.len());
        let map = Self { nodes, cut, records, options };
        if options.waiting == Waiting::Memory && u32::try_from(options.batch.saturating_mul(map.lines())).is_err() {
            return Err(BuildError::TooLarge);
        }
        Ok(map)
    }

    /// Bytes that a search takes at most.
    fn most_bytes(&self) -> usize {
        SEARCH + PAIR * (self.options.k + self.cut.levels() + 1)
    }

    /// Lines of memory that a search has room in.
    fn lines(&self) -> usize {
        self.most_bytes().div_ceil(self.options.line as usize)
    }

    /// Bytes that the searches of a batch take on chip; those in memory have their numbers in queues there.
    #[must_use]
    pub fn bytes_on_chip(&self) -> u64 {
        let each = match self.options.waiting {
            Waiting::Chip => self.most_bytes(),
            Waiting::Memory => size_of::<u32>(),
        };
        (self.options.batch * each) as u64
    }

    /// A search goes on in a treelet until it wants a node of another, which is returned, or is done.
    fn go_on(
        &self,
        treelet: u32,
        open: &mut Open,
        (point, found): ([f32; 3], &mut Nearest),
        eyes: &mut impl AccessObserver,
    ) -> Option<u32> {
        while let Some(&(at, plane)) = open.last() {
            // Not `>=`: a photon as far as the farthest found may have the smaller id.
            if plane > found.bound() {
                open.pop();
                continue;
            }
            let wanted = self.cut.treelet(at);
            if wanted != treelet {
                return Some(wanted);
            }
            open.pop();
            let node = &self.nodes[at as usize - 1];
            eyes.read(NODES, self.records[at as usize - 1]);
            eyes.examined(1);
            found.show(distance_squared(point, node.position), node.id);
            let delta = point[usize::from(node.axis)] - node.position[usize::from(node.axis)];
            let (near, far) = if delta > 0.0 { (2 * at + 1, 2 * at) } else { (2 * at, 2 * at + 1) };
            let there = |node: u32| node as usize <= self.nodes.len();
            open.extend([(far, delta * delta), (near, 0.0)].into_iter().filter(|&(node, _)| there(node)));
        }
        None
    }

    /// A search that waited in memory is read: as many lines as what it has takes.
    fn fetch(&self, search: u32, open: &Open, found: &Nearest, eyes: &mut impl AccessObserver) {
        let bytes = SEARCH + PAIR * (found.len() + open.len());
        let base = search * self.lines() as u32;
        let lines = bytes.div_ceil(self.options.line as usize) as u32;
        (base..base + lines).for_each(|line| eyes.read(WAITING, line));
    }
}

impl PhotonMap for Treelets {
    fn regions(&self, _: bool) -> Vec<Region> {
        let nodes = ("kd nodes".to_owned(), (self.nodes.len() * NODE) as u64, NODE as u32, Coding::InTurns);
        let waiting = (self.options.waiting == Waiting::Memory).then(|| {
            let line = self.options.line;
            let bytes = (self.options.batch * self.lines()) as u64 * u64::from(line);
            ("waiting searches".to_owned(), bytes, line, Coding::InTurns)
        });
        lay_out([nodes].into_iter().chain(waiting))
    }

    fn len(&self) -> usize {
        self.nodes.len()
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        vec![
            ("batch_queries", Number::Count(self.options.batch as u64)),
            ("batch_bytes_on_chip", Number::Bytes(self.bytes_on_chip())),
            ("treelets", Number::Count(self.cut.treelets(self.nodes.len()))),
        ]
    }

    fn batch(&self) -> Option<usize> {
        Some(self.options.batch)
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        self.nearest_of_all(&[point], &mut [found], eyes);
    }

    fn nearest_of_all(&self, points: &[[f32; 3]], found: &mut [&mut Nearest], eyes: &mut impl AccessObserver) {
        if self.is_empty() {
            return;
        }
        let mut open: Vec<Open> = vec![vec![(1, 0.0)]; points.len()];
        let mut queues = Queues::default();
        // All begin at the root; until then a search is its query, which comes along the stream.
        (0..points.len() as u32).for_each(|search| queues.push(self.cut.treelet(1), search));
        let mut begun = vec![false; points.len()];
        while let Some((treelet, waiting)) = queues.pop() {
            for search in waiting {
                let at = search as usize;
                if std::mem::replace(&mut begun[at], true) && self.options.waiting == Waiting::Memory {
                    self.fetch(search, &open[at], found[at], eyes);
                }
                let state = (points[at], &mut *found[at]);
                if let Some(next) = self.go_on(treelet, &mut open[at], state, eyes) {
                    queues.push(next, search);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
