//! Are pages as full as asked, and apart?

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
