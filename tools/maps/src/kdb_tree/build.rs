//! Filling pages from a known set of photons.

use super::{Child, Page, PageForm, Target};
use crate::geometry::{Box3, extent, longest_axis};
use crate::point::Point;
use crate::select_nth::select_nth;

/// What the recursion that makes pages needs to know.
pub(super) struct Builder {
    pub(super) form: PageForm,
    /// Photons in a block.
    pub(super) block: usize,
    /// Children of a page.
    pub(super) fan_out: usize,
    /// Level of the root.
    pub(super) height: u8,
    pub(super) pages: Vec<Page>,
    pub(super) children: Vec<Child>,
    pub(super) blocks: Vec<Vec<Point>>,
}

impl Builder {
    /// The most photons below a page of this level; blocks are level 0.
    pub(super) fn capacity(&self, level: u8) -> usize {
        self.block.saturating_mul(self.fan_out.saturating_pow(level.into()))
    }

    /// Makes region page `number` and all below it.
    pub(super) fn page(&mut self, number: usize, points: &mut [Point], cell: Box3, level: u8) {
        let below = self.capacity(level - 1);
        let mut parts = vec![];
        cut(points, cell, points.len().div_ceil(below), below, &mut parts);
        self.pages[number] =
            Page { first: self.children.len() as u32, count: parts.len() as u32, depth: self.height - level };
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
    select_nth(points, middle, axis);
    let plane = points[middle].position[axis];
    let (left, right) = points.split_at_mut(middle);
    let (mut left_cell, mut right_cell) = (cell, cell);
    left_cell.1[axis] = plane;
    right_cell.0[axis] = plane;
    cut(left, left_cell, left_count, below, parts);
    cut(right, right_cell, count - left_count, below, parts);
}
