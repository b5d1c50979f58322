//! The kdB-tree: photons in blocks of one line, found through region pages of one line each.
//!
//! Robinson, *The K-D-B-tree: a search structure for large multidimensional dynamic indexes*, SIGMOD 1981. Pages are
//! filled from a known set of photons, so that no split is ever forced on a page below.

use super::leaves::{Leaves, Point};
use super::{AccessObserver, Box3, BuildError, Nearest, PhotonMap, check, extent, longest_axis};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};

/// Number of the region that holds the region pages.
const PAGES: u16 = 0;
/// Number of the region that holds the photons.
const BLOCKS: u16 = 1;

/// Bytes that every page spends on its level, its number of entries, and which child or photon is the first.
const HEADER: u32 = 8;

pm_registry::choices! {
    /// What a region page says of its children.
    #[derive(Debug, Default)]
    pub enum PageForm {
        /// The planes between them: 5 bytes each, one fewer than children, who lie one after another
        #[default]
        Compact = "compact",
        /// The bounds of each, as Robinson has it: 28 bytes with its number
        Boxes = "boxes",
    }
}

impl PageForm {
    /// The most children that a page of `line` bytes describes; a page of fewer than two is of no use.
    #[must_use]
    pub const fn fan_out(self, line: u32) -> u32 {
        let room = line.saturating_sub(HEADER);
        match self {
            Self::Compact => room / 5 + 1,
            Self::Boxes => room / 28,
        }
    }
}

/// How the pages of a kdB-tree are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KdbOptions {
    /// Bytes of a block or a page.
    pub line: u32,
    /// What region pages hold.
    pub pages: PageForm,
    /// How full blocks and pages are, up to 1. Pages that grow photon by photon are about 0.6 full (Robinson).
    pub fill: f64,
}

/// The tree. The pages, or blocks, below a page have numbers that follow one another.
pub struct KdbTree {
    pages: Vec<Page>,
    children: Vec<Child>,
    blocks: Leaves,
    photons: usize,
    line: u32,
}

/// A region page: which children it has.
#[derive(Clone, Copy, Default)]
struct Page {
    first: u32,
    count: u32,
}

#[derive(Clone, Copy)]
struct Child {
    bounds: Box3,
    target: Target,
}

/// A page, or a block of photons: by number, the kind in the top bit.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Target(u32);

impl Target {
    const BLOCK: u32 = 1 << 31;

    const fn block(self) -> Option<u32> {
        if self.0 & Self::BLOCK == 0 { None } else { Some(self.0 & !Self::BLOCK) }
    }
}

/// What the recursion that makes pages needs to know.
struct Builder {
    form: PageForm,
    /// Photons in a block.
    leaf: usize,
    /// Children of a page.
    fan_out: usize,
    pages: Vec<Page>,
    children: Vec<Child>,
    blocks: Vec<Vec<Point>>,
}

impl KdbTree {
    /// Builds the tree in O(n log n).
    ///
    /// # Errors
    /// See [`BuildError`].
    ///
    /// # Panics
    /// If a line has no room for a photon, or a page no room for two children.
    pub fn build(photons: &[Photon], options: KdbOptions) -> Result<Self, BuildError> {
        check(photons)?;
        let capacity = ((options.line - HEADER) as usize) / size_of::<Photon>();
        let fan_out = options.pages.fan_out(options.line) as usize;
        assert!(capacity > 0 && fan_out > 1, "a line must hold a photon, or two children");
        let filled = |room: usize, least: usize| ((room as f64 * options.fill) as usize).clamp(least, room);
        let mut builder = Builder {
            form: options.pages,
            leaf: filled(capacity, 1),
            fan_out: filled(fan_out, 2),
            pages: vec![],
            children: vec![],
            blocks: vec![],
        };
        let mut points = Point::all(photons);
        let mut level = 1;
        while builder.capacity(level) < points.len() {
            level += 1;
        }
        if !points.is_empty() {
            let bounds = extent(points.iter().map(|point| point.position));
            builder.pages.push(Page::default());
            builder.page(0, &mut points, bounds, level);
        }
        let mut blocks = Leaves::new(builder.blocks.len(), capacity);
        builder.blocks.iter().enumerate().for_each(|(block, points)| blocks.fill(block, points));
        Ok(Self {
            pages: builder.pages,
            children: builder.children,
            blocks,
            photons: photons.len(),
            line: options.line,
        })
    }
}

impl Builder {
    /// The most photons below a page of this level; blocks are level 0.
    fn capacity(&self, level: u32) -> usize {
        self.leaf.saturating_mul(self.fan_out.saturating_pow(level))
    }

    /// Makes region page `number` and all below it.
    fn page(&mut self, number: usize, points: &mut [Point], cell: Box3, level: u32) {
        let below = self.capacity(level - 1);
        let mut parts = vec![];
        cut(points, cell, points.len().div_ceil(below), below, &mut parts);
        self.pages[number] = Page { first: self.children.len() as u32, count: parts.len() as u32 };
        let (first_page, first_block) = (self.pages.len(), self.blocks.len());
        if level > 1 {
            self.pages.resize(first_page + parts.len(), Page::default());
        }
        for (at, (points, cell)) in parts.iter().enumerate() {
            let bounds = match self.form {
                PageForm::Compact => *cell,
                PageForm::Boxes => extent(points.iter().map(|point| point.position)),
            };
            let target = match level {
                1 => Target((first_block + at) as u32 | Target::BLOCK),
                _ => Target((first_page + at) as u32),
            };
            self.children.push(Child { bounds, target });
        }
        for (at, (points, cell)) in parts.into_iter().enumerate() {
            match level {
                1 => self.blocks.push(points.to_vec()),
                _ => self.page(first_page + at, points, cell, level - 1),
            }
        }
    }
}

/// Cuts a cell into `count` parts of at most `below` photons each, by median planes across its longest side.
fn cut<'a>(points: &'a mut [Point], cell: Box3, count: usize, below: usize, parts: &mut Vec<(&'a mut [Point], Box3)>) {
    if count <= 1 {
        return parts.push((points, cell));
    }
    let axis = longest_axis(&cell);
    let left_count = count / 2;
    let middle = left_count * below;
    points.select_nth_unstable_by(middle, Point::along(axis));
    let plane = points[middle].position[axis];
    let (left, right) = points.split_at_mut(middle);
    let (mut left_cell, mut right_cell) = (cell, cell);
    left_cell.1[axis] = plane;
    right_cell.0[axis] = plane;
    cut(left, left_cell, left_count, below, parts);
    cut(right, right_cell, count - left_count, below, parts);
}

/// Squared distance from a box. Rounded as a photon's own is, so that none inside is nearer.
#[inline(always)]
fn distance_squared(point: [f32; 3], bounds: &Box3) -> f32 {
    let beyond = |axis: usize| (bounds.0[axis] - point[axis]).max(point[axis] - bounds.1[axis]).max(0.0);
    let [dx, dy, dz] = [beyond(0), beyond(1), beyond(2)];
    (dx * dx + dy * dy) + dz * dz
}

impl PhotonMap for KdbTree {
    fn regions(&self, _: bool) -> Vec<Region> {
        let bytes = |count: usize| count as u64 * u64::from(self.line);
        lay_out([
            ("region pages".into(), bytes(self.pages.len()), self.line, Coding::Records),
            ("photon blocks".into(), bytes(self.blocks.len()), self.line, Coding::Records),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    /// Depth first, the children of each page by their distance. A page is read once.
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if self.photons == 0 {
            return;
        }
        let mut later = Vec::with_capacity(256);
        later.push((0f32, Target(0)));
        while let Some((distance, target)) = later.pop() {
            // Not `<`: a photon as far as the farthest found may have the smaller id.
            if distance > found.bound() {
                continue;
            }
            if let Some(block) = target.block() {
                eyes.read(BLOCKS, block);
                eyes.examined(self.blocks.count(block as usize));
                self.blocks.show(block as usize, point, found);
                continue;
            }
            eyes.read(PAGES, target.0);
            let page = self.pages[target.0 as usize];
            let from = later.len();
            for child in &self.children[page.first as usize..(page.first + page.count) as usize] {
                let distance = distance_squared(point, &child.bounds);
                if distance <= found.bound() {
                    later.push((distance, child.target));
                }
            }
            // The nearest last, to be taken first.
            later[from..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(n: u16) -> Vec<Photon> {
        let positions = (0..n).map(|i| [f32::from(i % 32), f32::from(i / 32), 0.5]);
        positions.map(|p| Photon::new(p, [1.0; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap()).collect()
    }

    #[test]
    fn what_fits_a_page() {
        // 128 bytes: 24 planes and 25 children, or four boxes; 32 bytes: four planes, no box.
        assert_eq!([PageForm::Compact.fan_out(128), PageForm::Boxes.fan_out(128)], [25, 4]);
        assert_eq!([PageForm::Compact.fan_out(32), PageForm::Boxes.fan_out(32)], [5, 0]);
    }

    #[test]
    fn pages_are_as_full_as_asked() {
        let photons = grid(1024);
        for (pages, fill) in [(PageForm::Compact, 1.0), (PageForm::Boxes, 1.0), (PageForm::Compact, 0.6)] {
            let tree = KdbTree::build(&photons, KdbOptions { line: 128, pages, fill }).unwrap();
            let full = (6.0 * fill) as usize;
            let partial = (0..tree.blocks.len()).filter(|&block| tree.blocks.count(block) < full).count();
            assert_eq!(tree.blocks.len(), 1024usize.div_ceil(full));
            assert!(partial <= 1, "{partial} blocks of {} are not full", tree.blocks.len());
            let children: u32 = tree.pages.iter().map(|page| page.count).sum();
            assert_eq!(children as usize, tree.blocks.len() + tree.pages.len() - 1, "each but the root has one parent");
            for page in &tree.pages {
                assert!(page.count <= pages.fan_out(128));
                let children = &tree.children[page.first as usize..(page.first + page.count) as usize];
                assert!(children.windows(2).all(|pair| pair[1].target.0 == pair[0].target.0 + 1), "one after another");
            }
        }
    }

    #[test]
    fn siblings_do_not_overlap() {
        let tree = KdbTree::build(&grid(1024), KdbOptions { line: 256, pages: PageForm::Compact, fill: 1.0 }).unwrap();
        for page in &tree.pages {
            let children = &tree.children[page.first as usize..(page.first + page.count) as usize];
            for (i, a) in children.iter().enumerate() {
                for b in &children[..i] {
                    let apart = |x: usize| a.bounds.1[x] <= b.bounds.0[x] || b.bounds.1[x] <= a.bounds.0[x];
                    assert!((0..3).any(apart), "{:?} {:?}", a.bounds, b.bounds);
                }
            }
        }
    }
}
