//! Any photon map, chosen by options.

use super::{
    AccessObserver, BlockHash, BlockHashOptions, BruteForce, BucketKdTree, BuildError, Cells, Grid, KdTree, KdbOptions,
    KdbTree, Layout, Nearest, Orphans, PageForm, PhotonMap, VvhTree,
};
use pm_formats::trace::Region;
use pm_formats::{Number, Photon};

pm_registry::choices! {
    /// Structures of photon maps.
    #[derive(Debug)]
    pub enum MapKind {
        /// Left-balanced kd-tree, 20-byte nodes, Jensen's search
        Kd = "kd",
        /// kd-tree of split planes, apart from photon leaves of one line: the fast one
        BucketKd = "bucket-kd",
        /// kd-tree split by the voxel volume heuristic
        Vvh = "vvh",
        /// kdB-tree: photon blocks and region pages of one line each
        Kdb = "kdb",
        /// Uniform grid with a directory of its cells
        Grid = "grid",
        /// Uniform grid of cells of one size: what does not fit is lost
        GridFixed = "grid-fixed",
        /// Block hashing (Ma and McCool): approximate
        BlockHash = "block-hash",
        /// No structure: every photon is read for every query; for checking
        Brute = "brute",
    }
}

/// Which map to build, and how.
#[derive(Clone, Debug)]
pub struct MapOptions {
    /// Structure of the photon map
    pub map: MapKind,
    /// kd, bucket-kd: where nodes lie in memory; changes the reads, not the answer
    pub layout: Layout,
    /// Bytes of a line (leaf, block, page, bucket)
    pub line: u32,
    /// kd: pad the records, so that none crosses a line
    pub pad: bool,
    /// kdb: how full blocks and pages are; 0.6 is what insertion one by one leaves
    pub fill: f64,
    /// kdb: what region pages say of their children
    pub pages: PageForm,
    /// block-hash: number of tables, L [default: ln N, 4 to 16]
    pub tables: Option<u32>,
    /// block-hash: thresholds along each axis, P [default: cells on a wall fill half a bucket, 4 to 64]
    pub thresholds: Option<u32>,
    /// block-hash: references in a bucket; grid-fixed: photons in a cell [default: a line's worth; twice the average]
    pub slots: Option<u32>,
    /// block-hash: photons read for each that is wanted, A
    pub budget: u32,
    /// block-hash: what becomes of blocks that no bucket has room for
    pub orphans: Orphans,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self {
            map: MapKind::Kd,
            layout: Layout::Heap,
            line: 128,
            pad: false,
            fill: 1.0,
            pages: PageForm::Compact,
            tables: None,
            thresholds: None,
            slots: None,
            budget: 20,
            orphans: Orphans::Keep,
        }
    }
}

impl MapOptions {
    /// What keeps these options from being one map, if anything does.
    #[must_use]
    pub fn problem(&self) -> Option<String> {
        let kdb = self.map == MapKind::Kdb && self.pages == PageForm::Boxes;
        if kdb && self.pages.fan_out(self.line) < 2 {
            return Some(format!(
                "--line {}: a region page of boxes needs 64 bytes for two of them; use --pages compact",
                self.line
            ));
        }
        if !self.line.is_multiple_of(4) {
            return Some(format!("--line {}: a multiple of 4 is expected", self.line));
        }
        (self.pad && self.map != MapKind::Kd).then(|| "--pad is for --map kd; the others know their lines".into())
    }

    /// Builds the map for searches of `k` photons.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(&self, photons: &[Photon], k: usize) -> Result<AnyMap, BuildError> {
        let line = self.line;
        Ok(match self.map {
            MapKind::Kd => {
                let tree = KdTree::build(photons, self.layout)?;
                AnyMap::Kd(if self.pad { tree.padded(line) } else { tree })
            }
            MapKind::BucketKd => AnyMap::BucketKd(BucketKdTree::build(photons, self.layout, line)?),
            MapKind::Vvh => AnyMap::Vvh(VvhTree::build(photons, k, line)?),
            MapKind::Kdb => {
                AnyMap::Kdb(KdbTree::build(photons, KdbOptions { line, pages: self.pages, fill: self.fill })?)
            }
            MapKind::Grid => AnyMap::Grid(Grid::build(photons, Cells::Indirect)?),
            MapKind::GridFixed => AnyMap::Grid(Grid::build(photons, Cells::Fixed { line, slots: self.slots })?),
            MapKind::BlockHash => {
                let options = BlockHashOptions {
                    line,
                    tables: self.tables,
                    thresholds: self.thresholds,
                    slots: self.slots,
                    budget: self.budget,
                    orphans: self.orphans,
                    seed: 0,
                };
                AnyMap::BlockHash(BlockHash::build(photons, options)?)
            }
            MapKind::Brute => AnyMap::Brute(BruteForce::build(photons)?),
        })
    }
}

/// One of the maps: the choice is made once a search.
pub enum AnyMap {
    /// [`KdTree`]
    Kd(KdTree),
    /// [`BucketKdTree`]
    BucketKd(BucketKdTree),
    /// [`VvhTree`]
    Vvh(VvhTree),
    /// [`KdbTree`]
    Kdb(KdbTree),
    /// [`Grid`]
    Grid(Grid),
    /// [`BlockHash`]
    BlockHash(BlockHash),
    /// [`BruteForce`]
    Brute(BruteForce),
}

impl AnyMap {
    /// What building it has brought to light, by name. The same for the same photons and options.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Number)> {
        let count = |number: usize| Number::Count(number as u64);
        match self {
            Self::Vvh(tree) => vec![("split_radius", Number::Real(tree.radius()))],
            Self::Grid(grid) => {
                let [x, y, z] = grid.cells();
                vec![("cells", count(x * y * z)), ("photons_lost", count(grid.lost()))]
            }
            Self::BlockHash(map) => {
                let (tables, thresholds) = map.sizes();
                vec![
                    ("tables", count(tables)),
                    ("thresholds", count(thresholds)),
                    ("buckets", count(map.buckets())),
                    ("blocks", count(map.blocks())),
                    ("blocks_unreferenced", count(map.unreferenced())),
                ]
            }
            Self::Kd(_) | Self::BucketKd(_) | Self::Kdb(_) | Self::Brute(_) => vec![],
        }
    }

    /// For maps that may miss photons of a block: number of the region of the blocks, and the block of each photon.
    #[must_use]
    pub fn blocks(&self) -> Option<(u16, Vec<u32>)> {
        match self {
            Self::BlockHash(map) => Some((BlockHash::BLOCKS, map.block_of_photons())),
            _ => None,
        }
    }
}

/// The same for whichever map it is.
macro_rules! with_map {
    ($any:expr, $map:ident => $do:expr) => {
        match $any {
            AnyMap::Kd($map) => $do,
            AnyMap::BucketKd($map) => $do,
            AnyMap::Vvh($map) => $do,
            AnyMap::Kdb($map) => $do,
            AnyMap::Grid($map) => $do,
            AnyMap::BlockHash($map) => $do,
            AnyMap::Brute($map) => $do,
        }
    };
}

impl PhotonMap for AnyMap {
    fn regions(&self, reread: bool) -> Vec<Region> {
        with_map!(self, map => map.regions(reread))
    }

    fn len(&self) -> usize {
        with_map!(self, map => map.len())
    }

    fn padding(&self) -> Option<u32> {
        with_map!(self, map => map.padding())
    }

    fn is_exact(&self) -> bool {
        with_map!(self, map => map.is_exact())
    }

    #[inline]
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        with_map!(self, map => map.nearest(point, found, eyes));
    }
}
