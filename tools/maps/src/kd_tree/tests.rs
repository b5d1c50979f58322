//! Does a search read what the textbook's reads, node for node?

use super::*;
use crate::SearchReads;
use crate::geometry::distance_squared;
use crate::layout::Layout;
use crate::trial::{photons, random_points};

/// Jensen's search as it is written in his book: recursive, its candidates in a sorted list.
struct Textbook<'a> {
    tree: &'a KdTree,
    point: [f32; 3],
    k: usize,
    start: f32,
    kept: Vec<(f32, u32)>,
    /// With second touches.
    reads: Vec<u32>,
    examined: u64,
}

impl Textbook<'_> {
    fn bound(&self) -> f32 {
        if self.kept.len() == self.k { self.kept[self.k - 1].0 } else { self.start }
    }

    fn visit(&mut self, at: usize) {
        let node = self.tree.nodes[at - 1];
        self.reads.push(at as u32 - 1);
        self.examined += 1;
        let count = self.tree.nodes.len();
        if 2 * at <= count {
            let delta = self.point[node.axis()] - node.position[node.axis()];
            let (near, far) = if delta > 0.0 { (2 * at + 1, 2 * at) } else { (2 * at, 2 * at + 1) };
            if near <= count {
                self.visit(near);
            }
            if far <= count && delta * delta <= self.bound() {
                self.visit(far);
            }
            self.reads.push(at as u32 - 1);
        }
        let distance = distance_squared(self.point, node.position);
        if distance <= self.bound() {
            self.kept.push((distance, node.id()));
            self.kept.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            self.kept.truncate(self.k);
        }
    }
}

#[test]
fn a_search_reads_what_the_textbooks_does_in_its_order() {
    // Every form of the last levels; on a grid of five places an axis there are ties everywhere.
    let anywhere = random_points(1000, |point| point);
    let tied = random_points(1000, |point| point.map(|x| (x * 5.0).floor()));
    for positions in [anywhere, tied] {
        for n in (1..40).chain([63, 64, 65, 500, 999, 1000]) {
            let tree = KdTree::build(&photons(positions[..n].iter().copied()), Layout::Heap).unwrap();
            for (query, &point) in positions.iter().step_by(37).enumerate() {
                for k in [1, 2, 3, 7, 20, 60] {
                    for start in [f32::INFINITY, 0.3, 0.02, 0.0] {
                        let mut book =
                            Textbook { tree: &tree, point, k, start, kept: vec![], reads: vec![], examined: 0 };
                        book.visit(1);
                        let (mut found, mut reads) = (Nearest::new(k, start), SearchReads::with_rereads(true));
                        tree.nearest(point, &mut found, &mut reads);
                        let read: Vec<u32> = reads.runs().flat_map(|(_, records)| records.to_vec()).collect();
                        let told = format!("{n} photons, query {query}, k = {k} from {start}");
                        assert_eq!(read, book.reads, "{told}");
                        assert_eq!(reads.photons_examined(), book.examined, "{told}");
                        assert_eq!(found.sorted(), book.kept, "{told}");
                    }
                }
            }
        }
    }
}
