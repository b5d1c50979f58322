//! Boxes around balls: who may reach a point?

use super::LINE;
use super::disc::{LEAF, PhotonDisc};
use pm_maps::AccessObserver;

/// Boxes of a node: what a line holds.
const FAN: usize = LINE as usize / size_of::<Box3>();
/// What squared distances in single precision may be off, and more.
const GROWN: f32 = 1.0 + 8.0 * f32::EPSILON;

/// A box with its sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Box3 {
    least: [f32; 3],
    most: [f32; 3],
}

const _: () = assert!(size_of::<Box3>() == 24 && FAN == 5);

impl Box3 {
    /// Around a ball, whatever is rounded.
    fn around(disc: &PhotonDisc) -> Self {
        let radius = disc.radius * GROWN;
        Self {
            least: disc.position().map(|x| (x - radius).next_down()),
            most: disc.position().map(|x| (x + radius).next_up()),
        }
    }

    fn with(self, other: Self) -> Self {
        Self {
            least: [0, 1, 2].map(|axis| self.least[axis].min(other.least[axis])),
            most: [0, 1, 2].map(|axis| self.most[axis].max(other.most[axis])),
        }
    }

    #[inline]
    fn holds(&self, point: [f32; 3]) -> bool {
        (0..3).all(|axis| self.least[axis] <= point[axis] && point[axis] <= self.most[axis])
    }
}

/// Boxes of leaves, and of nodes of boxes, each level side by side.
pub(super) struct Tree {
    /// From the leaves up to one node of [`FAN`] boxes or fewer.
    levels: Vec<Vec<Box3>>,
    /// Number of the first node of each level in the memory, which has the root first.
    firsts: Vec<usize>,
}

impl Tree {
    /// The tree over these discs, leaf after leaf.
    pub(super) fn over(discs: &[PhotonDisc]) -> Self {
        let all = |boxes: &mut dyn Iterator<Item = Box3>| boxes.reduce(Box3::with);
        let mut level: Vec<Box3> =
            discs.chunks(LEAF).filter_map(|leaf| all(&mut leaf.iter().map(Box3::around))).collect();
        let mut levels = vec![];
        while level.len() > FAN {
            let above = level.chunks(FAN).filter_map(|node| all(&mut node.iter().copied())).collect();
            levels.push(std::mem::replace(&mut level, above));
        }
        levels.push(level);
        let mut firsts = vec![0; levels.len()];
        for (below, above) in (0..levels.len()).zip(1..levels.len()).rev() {
            firsts[below] = firsts[above] + levels[above].len().div_ceil(FAN);
        }
        Self { levels, firsts }
    }

    /// Nodes, of a line each.
    pub(super) fn nodes(&self) -> usize {
        self.levels.iter().map(|level| level.len().div_ceil(FAN)).sum()
    }

    /// Calls `visit` with each leaf whose box holds the point, once it is read. Nodes are of the region `first`, leaves of the
    /// one behind it.
    #[inline]
    pub(super) fn walk(&self, point: [f32; 3], first: u16, eyes: &mut impl AccessObserver, mut visit: impl FnMut(u32)) {
        let mut waiting: Vec<(usize, usize)> = vec![];
        if !self.levels[self.levels.len() - 1].is_empty() {
            waiting.push((self.levels.len() - 1, 0));
        }
        while let Some((level, node)) = waiting.pop() {
            eyes.read(first, (self.firsts[level] + node) as u32);
            let from = node * FAN;
            let boxes = &self.levels[level];
            let inside = (from..boxes.len().min(from + FAN)).filter(|&child| boxes[child].holds(point));
            if level == 0 {
                for leaf in inside {
                    eyes.read(first + 1, leaf as u32);
                    visit(leaf as u32);
                }
            } else {
                // The first is looked at first.
                inside.rev().for_each(|child| waiting.push((level - 1, child)));
            }
        }
    }
}

/// The same discs so that those of a leaf, and of a node, lie near each other: halved across the longest side, at whole nodes.
pub(super) fn in_leaves(discs: Vec<PhotonDisc>) -> Vec<PhotonDisc> {
    let mut numbered: Vec<(u32, PhotonDisc)> = (0..).zip(discs).collect();
    let mut parts = vec![&mut numbered[..]];
    while let Some(part) = parts.pop() {
        if part.len() <= LEAF {
            part.sort_unstable_by_key(|&(number, _)| number);
            continue;
        }
        let mut whole = LEAF;
        while whole * FAN < part.len() {
            whole *= FAN;
        }
        let middle = ((part.len() / 2 + whole / 2) / whole * whole).clamp(whole, (part.len() - 1) / whole * whole);
        let side = |axis: usize| {
            let places = || part.iter().map(|(_, disc)| disc.position()[axis]);
            places().fold(f32::NEG_INFINITY, f32::max) - places().fold(f32::INFINITY, f32::min)
        };
        let sides = [side(0), side(1), side(2)];
        let longest = (0..3).rev().max_by(|&a, &b| sides[a].total_cmp(&sides[b])).unwrap_or(0);
        let key = |&(number, ref disc): &(u32, PhotonDisc)| (disc.position()[longest], number);
        part.select_nth_unstable_by(middle, |a, b| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        });
        let (before, behind) = part.split_at_mut(middle);
        parts.extend([before, behind]);
    }
    numbered.into_iter().map(|(_, disc)| disc).collect()
}
