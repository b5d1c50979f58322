//! Tables come back, and one is not taken for the other.

use super::*;

fn record(pixel: u32) -> IrradianceRecord {
    let ray = |i: u16| IrradianceRay { length: f32::from(i) * 0.1, light: [0.0, f32::from(i), 1.0] };
    IrradianceRecord {
        pixel,
        position: [1.0, 2.0, 3.0],
        normal: [0.0, 1.0, 0.0],
        radius: 0.25,
        strata: [2, 3],
        rays: (0..6).map(ray).collect(),
    }
}

#[test]
fn tables_come_back_and_are_told_apart() {
    let records: Vec<_> = (0..5).map(record).collect();
    let (block, tally) = encode_irradiance(&records).unwrap();
    assert_eq!(decode_irradiance(&block), Some((records.clone(), tally)));
    assert_eq!(tally_beside(&block), Some(tally));
    assert_eq!(tally.records, 0);
    let weight =
        PixelWeight { pixel: 7, record: 2, weight: [0.5; 3], displacement: [0.0, 0.1, 0.2], normal_change: [0.0; 3] };
    let (block, weights_tally) = encode_weights(&[weight, weight]).unwrap();
    assert_eq!(decode_weights(&block), Some((vec![weight, weight], weights_tally)));
    assert_eq!(tally_beside(&block), Some(weights_tally));
    assert_ne!(tally.digest, weights_tally.digest);
    assert_eq!(decode_irradiance(&block), None);
    assert_eq!(decode_weights(&encode_irradiance(&records).unwrap().0), None);
}

#[test]
fn records_of_different_strata_are_refused() {
    let mut odd = record(1);
    odd.strata = [1, 3];
    odd.rays.truncate(3);
    assert!(encode_irradiance(&[record(0), record(2), odd]).is_err());
}
