//! Are recall and dilation what they are by hand?

use super::*;

#[test]
fn recall_and_dilation_by_hand() {
    let mut accuracy = Accuracy { least_recall: 1.0, ..Accuracy::default() };
    let truth = [(1.0, 1), (4.0, 2), (9.0, 3), (16.0, 4)];
    accuracy.add(&truth, &truth);
    // Three of four, the farthest at 5 instead of 4; and half of them, the second at 3 instead of 2.
    accuracy.add(&[(1.0, 1), (4.0, 2), (9.0, 3), (25.0, 9)], &truth);
    accuracy.add(&[(1.0, 1), (9.0, 3)], &truth);
    assert!((accuracy.mean_recall() - 0.75).abs() < 1e-12);
    assert!((accuracy.least_recall - 0.5).abs() < 1e-12);
    assert!((accuracy.mean_dilation() - (1.0 + 1.25 + 1.5) / 3.0).abs() < 1e-12);
    assert!((accuracy.largest_dilation - 1.5).abs() < 1e-12);
    // Nothing found, and nothing to find.
    accuracy.add(&[], &truth);
    accuracy.add(&[], &[]);
    assert!((accuracy.mean_recall() - (0.75 * 3.0 + 1.0) / 5.0).abs() < 1e-12);
}
