//! Cells that hold equally many photons: boxes split at the median until few enough are left in each.

/// Cells of a median split, numbered so that neighbours in the tree have neighbouring numbers.
#[derive(Clone, Debug)]
pub struct MedianSplit {
    nodes: Vec<Node>,
    cells: u32,
}

#[derive(Clone, Copy, Debug)]
enum Node {
    /// Below `at` on `axis` the next node goes on, else the node `above`.
    Split {
        axis: u8,
        at: f32,
        above: u32,
    },
    Cell(u32),
}

/// Bytes of a node in hardware: a split, two bits of axis, and an index or a number.
const NODE_BYTES: u64 = 8;

impl MedianSplit {
    /// Splits the longest side of the box around the photons at their median, until at most `most` are left in each
    /// cell. Photons that are all at one place cannot be told apart: their cell holds them all.
    #[must_use]
    pub fn new(mut positions: Vec<[f32; 3]>, most: usize) -> Self {
        let mut tree = Self { nodes: vec![], cells: 0 };
        tree.split(&mut positions, most.max(1));
        tree
    }

    fn split(&mut self, photons: &mut [[f32; 3]], most: usize) {
        let this = self.nodes.len();
        let extent = |axis: usize| {
            let (min, max) = photons.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(min, max), photon| {
                (min.min(photon[axis]), max.max(photon[axis]))
            });
            max - min
        };
        let extents = [extent(0), extent(1), extent(2)];
        let axis = (1..3).fold(0, |best, axis| if extents[axis] > extents[best] { axis } else { best });
        if photons.len() <= most || extents[axis] <= 0.0 {
            self.nodes.push(Node::Cell(self.cells));
            self.cells += 1;
            return;
        }
        let middle = photons.len() / 2;
        let (_, median, _) = photons.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
        let mut at = median[axis];
        let mut below = partition(photons, |photon| photon[axis] < at);
        if below == 0 {
            // More than half lie on the lower face: the cut goes just above it.
            at = photons.iter().map(|photon| photon[axis]).filter(|&x| x > at).fold(f32::INFINITY, f32::min);
            below = partition(photons, |photon| photon[axis] < at);
        }
        let (low, high) = photons.split_at_mut(below);
        self.nodes.push(Node::Split { axis: axis as u8, at, above: 0 });
        self.split(low, most);
        let next = self.nodes.len() as u32;
        self.nodes[this] = Node::Split { axis: axis as u8, at, above: next };
        self.split(high, most);
    }

    /// The cell that a point lies in.
    #[must_use]
    pub fn cell(&self, point: [f32; 3]) -> u32 {
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Cell(cell) => return cell,
                Node::Split { axis, at, .. } if point[usize::from(axis)] < at => node += 1,
                Node::Split { above, .. } => node = above as usize,
            }
        }
    }

    /// Number of cells.
    #[must_use]
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// Bytes that the tree takes on chip.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.nodes.len() as u64 * NODE_BYTES
    }
}

/// Moves what fulfils the test to the front; how many do.
fn partition(photons: &mut [[f32; 3]], test: impl Fn(&[f32; 3]) -> bool) -> usize {
    let mut front = 0;
    for i in 0..photons.len() {
        if test(&photons[i]) {
            photons.swap(front, i);
            front += 1;
        }
    }
    front
}

#[cfg(test)]
mod tests;
