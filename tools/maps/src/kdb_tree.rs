//! The kdB-tree: photons in blocks of one line, found through region pages of one line each.
//!
//! Robinson, *The K-D-B-tree: a search structure for large multidimensional dynamic indexes*, SIGMOD 1981. Pages are
//! filled from a known set of photons, so that no split is ever forced on a page below.

mod build;
mod page_form;

use super::error::check;
use super::geometry::{Box3, extent};
use super::photon_blocks::PhotonBlocks;
use super::point::Point;
use super::{AccessObserver, BuildError, Nearest, PhotonMap};
use build::Builder;
pub use page_form::PageForm;
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, Waits, lay_out};

/// Number of the region that holds the region pages.
const PAGES: u16 = 0;
/// Number of the region that holds the photons.
const BLOCKS: u16 = 1;

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
    blocks: PhotonBlocks,
    photons: usize,
    line: u32,
    /// Pages on the way to a block, the same for all.
    height: u8,
}

/// A region page: which children it has.
#[derive(Clone, Copy, Default)]
struct Page {
    first: u32,
    count: u32,
    /// How many pages lie above it.
    depth: u8,
}

#[derive(Clone, Copy)]
struct Child {
    bounds: Box3,
    target: Target,
}

/// A page, or a block of photons: by number, which of the two in the top bit.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Target(u32);

impl Target {
    const BLOCK: u32 = 1 << 31;

    const fn block(self) -> Option<u32> {
        if self.0 & Self::BLOCK == 0 { None } else { Some(self.0 & !Self::BLOCK) }
    }
}

impl KdbTree {
    /// Builds the tree in O(n log n).
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], options: KdbOptions) -> Result<Self, BuildError> {
        check(photons)?;
        BuildError::unless_fits(options.line, options.pages.least_line())?;
        let capacity = ((options.line - page_form::HEADER) as usize) / size_of::<Photon>();
        let fan_out = options.pages.fan_out(options.line) as usize;
        let filled = |room: usize, least: usize| ((room as f64 * options.fill) as usize).clamp(least, room);
        let mut builder = Builder {
            form: options.pages,
            block: filled(capacity, 1),
            fan_out: filled(fan_out, 2),
            height: 1,
            pages: vec![],
            children: vec![],
            blocks: vec![],
        };
        let mut points = Point::all(photons);
        let mut level = 1u8;
        while builder.capacity(level) < points.len() {
            level += 1;
        }
        if !points.is_empty() {
            let bounds = extent(points.iter().map(|point| point.position));
            builder.height = level;
            builder.pages.push(Page::default());
            builder.page(0, &mut points, bounds, level);
        }
        let mut blocks = PhotonBlocks::new(builder.blocks.len(), capacity);
        builder.blocks.iter().enumerate().for_each(|(block, points)| blocks.fill(block, points));
        Ok(Self {
            pages: builder.pages,
            children: builder.children,
            blocks,
            photons: photons.len(),
            line: options.line,
            height: level,
        })
    }
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
            ("region pages".into(), bytes(self.pages.len()), self.line, Coding::InTurns),
            ("photon blocks".into(), bytes(self.blocks.len()), self.line, Coding::InTurns),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn tells_waits(&self) -> bool {
        true
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
                eyes.read_after(BLOCKS, block, Waits::last_above(self.height.into()));
                eyes.examined(self.blocks.count(block as usize));
                self.blocks.show(block as usize, point, found);
                continue;
            }
            let page = self.pages[target.0 as usize];
            eyes.read_after(PAGES, target.0, Waits::last_above(page.depth.into()));
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
mod tests;
