//! Colours as the eye tells them apart.

/// Linear Rec. 709 RGB to XYZ.
pub(super) const TO_XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// Distance of colours far apart: by steps in lightness, as the crow flies in hue and chroma.
pub(super) fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0]).abs() + ((a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
}

/// XYZ in units of white.
#[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
fn to_xyz(rgb: [f32; 3]) -> [f32; 3] {
    TO_XYZ.map(|row| {
        let white: f64 = row.iter().sum();
        ((0..3).map(|c| row[c] * f64::from(rgb[c])).sum::<f64>() / white) as f32
    })
}

/// Linear RGB to Y Cx Cz, a linear form of CIE L a b.
pub(super) fn to_opponent(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = to_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
pub(super) fn from_opponent([y, cx, cz]: [f32; 3], to_rgb: &glam::DMat3) -> [f32; 3] {
    let y = (y + 16.0) / 116.0;
    let shares = [y + cx / 500.0, y, y - cz / 200.0];
    let xyz = glam::DVec3::from_array([0, 1, 2].map(|i| f64::from(shares[i]) * TO_XYZ[i].iter().sum::<f64>()));
    (*to_rgb * xyz).to_array().map(|x| x as f32)
}

/// CIE L a b of a linear RGB colour, a and b scaled by L / 100: in the dark, colours differ less (Hunt).
pub(super) fn adjusted_lab(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let [x, y, z] = to_xyz(rgb).map(|t| match t > DELTA * DELTA * DELTA {
        true => libm::cbrtf(t),
        false => t / (3.0 * DELTA * DELTA) + 4.0 / 29.0,
    });
    let lightness = 116.0 * y - 16.0;
    [lightness, 5.0 * lightness * (x - y), 2.0 * lightness * (y - z)]
}
