//! The eight-wide hierarchy: nodes of eight boxes side by side, made of a binary one by opening the largest boxes.

use super::lanes::LANES;
use glam::Vec3;
use obvhs::bvh2::Bvh2;

/// Eight boxes and what is in each.
#[repr(C, align(32))]
pub(super) struct Node {
    /// Of each axis, the smallest and the largest coordinates of each box. Where there is no box, no ray is between.
    pub(super) planes: [[[f32; LANES]; 2]; 3],
    pub(super) children: [Child; LANES],
}

/// What is in a box: a node or a leaf, by its number.
#[derive(Clone, Copy)]
pub(super) struct Child(u32);

const LEAF: u32 = 1 << 31;

impl Child {
    /// The node where every search begins.
    pub(super) const ROOT: Self = Self(0);
    /// A leaf that no hierarchy has.
    pub(super) const END: Self = Self(u32::MAX);

    #[inline(always)]
    pub(super) const fn bits(self) -> u32 {
        self.0
    }

    /// Of what [`bits`](Self::bits) told.
    #[inline(always)]
    pub(super) const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The number of a node, or else of a leaf.
    #[inline(always)]
    pub(super) const fn place(self) -> Result<usize, usize> {
        if self.0 & LEAF == 0 { Ok(self.0 as usize) } else { Err((self.0 & !LEAF) as usize) }
    }
}

/// At most eight triangles side by side.
#[repr(C, align(32))]
pub(super) struct Leaf {
    /// Of each corner, of each axis, of each triangle; not numbers where there is none, which no ray meets. The last row is of
    /// none: there for [`row`](Self::row).
    corners: [[f32; LANES]; 10],
    /// Their indices in the scene.
    pub(super) triangles: [u32; LANES],
}

impl Leaf {
    /// Of a corner, along an axis, of each triangle.
    #[inline(always)]
    pub(super) const fn row(&self, corner: usize, axis: usize) -> &[f32; LANES] {
        // A row there is, whatever the axis: nothing to check.
        &self.corners[corner * 3 + (axis & 3)]
    }

    /// The corners of one.
    pub(super) fn triangle(&self, lane: usize) -> [Vec3; 3] {
        [0, 1, 2].map(|corner| Vec3::from([0, 1, 2].map(|axis| self.row(corner, axis)[lane])))
    }
}

/// The whole of it.
pub(super) struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<Leaf>,
}

impl Wide {
    /// Of a binary hierarchy with at most eight triangles in a leaf, and the triangles in the order of its leaves.
    pub(super) fn new(tree: &Bvh2, triangles: &[([Vec3; 3], u32)]) -> Self {
        let mut made = Self { nodes: vec![], leaves: vec![] };
        if !tree.nodes.is_empty() {
            let within = triangles_within(tree);
            made.add_node(&Binary { tree, triangles, within }, 0);
        }
        made
    }

    /// Adds the node that holds what is below a binary one, and all below it.
    fn add_node(&mut self, binary: &Binary<'_>, at: usize) -> Child {
        let place = self.nodes.len();
        self.nodes.push(Node {
            planes: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
            children: [Child::ROOT; LANES],
        });
        for (lane, below) in binary.eight_below(at).into_iter().enumerate() {
            let aabb = binary.tree.nodes[below].aabb();
            let child =
                if binary.fits_a_leaf(below) { self.add_leaf(binary, below) } else { self.add_node(binary, below) };
            let node = &mut self.nodes[place];
            for axis in 0..3 {
                node.planes[axis][0][lane] = aabb.min[axis];
                node.planes[axis][1][lane] = aabb.max[axis];
            }
            node.children[lane] = child;
        }
        Child(u32::try_from(place).expect("fewer nodes than triangles"))
    }

    fn add_leaf(&mut self, binary: &Binary<'_>, at: usize) -> Child {
        let mut leaf = Leaf { corners: [[f32::NAN; LANES]; 10], triangles: [u32::MAX; LANES] };
        for (lane, place) in binary.places_below(at).into_iter().enumerate() {
            let (corners, triangle) = binary.triangles[place];
            leaf.triangles[lane] = triangle;
            let numbers = corners.into_iter().flat_map(|corner| corner.to_array());
            leaf.corners.iter_mut().zip(numbers).for_each(|(row, number)| row[lane] = number);
        }
        self.leaves.push(leaf);
        Child(LEAF | u32::try_from(self.leaves.len() - 1).expect("no more leaves than triangles"))
    }
}

/// What the wide one is made of.
struct Binary<'a> {
    tree: &'a Bvh2,
    triangles: &'a [([Vec3; 3], u32)],
    /// How many triangles are below each node.
    within: Vec<u32>,
}

impl Binary<'_> {
    fn children(&self, at: usize) -> [usize; 2] {
        let first = self.tree.nodes[at].first_index as usize;
        [first, first + 1]
    }

    fn fits_a_leaf(&self, at: usize) -> bool {
        self.tree.nodes[at].is_leaf() || self.within[at] as usize <= LANES
    }

    /// Nodes that hold all that a node holds, at most eight: always the largest is opened next, which most rays meet.
    fn eight_below(&self, at: usize) -> Vec<usize> {
        let mut below = vec![at];
        while below.len() < LANES {
            let area = |&i: &usize| self.tree.nodes[below[i]].aabb().half_area();
            let can_be_opened = (0..below.len()).filter(|&i| !self.fits_a_leaf(below[i]));
            let Some(largest) = can_be_opened.max_by(|a, b| area(a).total_cmp(&area(b))) else { break };
            below.splice(largest..=largest, self.children(below[largest]));
        }
        below
    }

    /// Where the triangles below a node stand in the order of the leaves.
    fn places_below(&self, at: usize) -> Vec<usize> {
        let (mut places, mut nodes) = (vec![], vec![at]);
        while let Some(at) = nodes.pop() {
            let node = &self.tree.nodes[at];
            if node.is_leaf() {
                let first = node.first_index as usize;
                places.extend(first..first + node.prim_count as usize);
            } else {
                nodes.extend(self.children(at));
            }
        }
        places
    }
}

/// How many triangles are below each node of a binary hierarchy.
fn triangles_within(tree: &Bvh2) -> Vec<u32> {
    let mut within: Vec<u32> = tree.nodes.iter().map(|node| node.prim_count).collect();
    // Each node, and below it whether its children have been counted.
    let mut nodes = vec![(0, false)];
    while let Some((at, counted)) = nodes.pop() {
        let node = &tree.nodes[at];
        if node.is_leaf() {
            continue;
        }
        let first = node.first_index as usize;
        if counted {
            within[at] = within[first] + within[first + 1];
        } else {
            nodes.extend([(at, true), (first, false), (first + 1, false)]);
        }
    }
    within
}
