//! Colours of charts, and what they become on a dark page.

use plotters::style::RGBColor;
use std::fmt::Write as _;

/// Of series, in turn: those that people with any kind of colour vision tell apart (Okabe and Ito, *Color Universal
/// Design*, 2008) without the yellow; orange and sky blue other and darker, so that each stands off white 3 to 1 or more.
pub(super) const SERIES: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xc7, 0x6b, 0x9c),
    RGBColor(0x9c, 0x8a, 0x00),
    RGBColor(0x2b, 0x95, 0xd0),
    RGBColor(0x8a, 0x5a, 0x3c),
];
pub(super) const PAPER: RGBColor = RGBColor(0xff, 0xff, 0xff);
pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(super) const GRID: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
/// Of what is compared with.
pub(super) const GREY: RGBColor = RGBColor(0x80, 0x80, 0x80);

/// Each colour beside what takes its place on a dark page.
const PAIRS: [(RGBColor, RGBColor); 11] = [
    (PAPER, RGBColor(0x16, 0x18, 0x1c)),
    (INK, RGBColor(0xe4, 0xe4, 0xe4)),
    (GRID, RGBColor(0x3a, 0x3d, 0x42)),
    (GREY, RGBColor(0x9a, 0x9a, 0x9a)),
    (SERIES[0], RGBColor(0x4a, 0x9d, 0xf0)),
    (SERIES[1], RGBColor(0xff, 0x85, 0x40)),
    (SERIES[2], RGBColor(0x22, 0xc4, 0x93)),
    (SERIES[3], RGBColor(0xe7, 0x9a, 0xc8)),
    (SERIES[4], RGBColor(0xf2, 0xc1, 0x4e)),
    (SERIES[5], RGBColor(0x8f, 0xe0, 0xff)),
    (SERIES[6], RGBColor(0xb9, 0x8a, 0x6a)),
];

/// Colour of series number `number`.
pub(super) const fn of_series(number: usize) -> RGBColor {
    SERIES[number % SERIES.len()]
}

/// A style sheet that makes charts dark where the page is, but not on paper. One does for all charts of a page.
#[must_use]
pub fn dark_style() -> String {
    let mut style = String::from("@media screen and (prefers-color-scheme: dark){");
    for (light, dark) in PAIRS {
        let (light, dark) = (hexadecimal(light), hexadecimal(dark));
        let _ = write!(style, "svg [fill=\"{light}\"]{{fill:{dark}}}svg [stroke=\"{light}\"]{{stroke:{dark}}}");
    }
    style + "}"
}

fn hexadecimal(colour: RGBColor) -> String {
    format!("#{:02X}{:02X}{:02X}", colour.0, colour.1, colour.2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Web Content Accessibility Guidelines 2.2: contrast ratio, from relative luminance.
    fn contrast(a: RGBColor, b: RGBColor) -> f64 {
        let luminance = |colour: RGBColor| {
            let linear = |channel: u8| {
                let c = f64::from(channel) / 255.0;
                if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
            };
            0.2126 * linear(colour.0) + 0.7152 * linear(colour.1) + 0.0722 * linear(colour.2)
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn everything_stands_off_its_paper() {
        for (light, dark) in PAIRS {
            // Letters 4.5 to 1, other graphics 3 to 1; the grid need not, and the paper cannot.
            let least = match light {
                PAPER | GRID => continue,
                INK => 4.5,
                _ => 3.0,
            };
            for (colour, paper) in [(light, PAPER), (dark, PAIRS[0].1)] {
                assert!(contrast(colour, paper) >= least, "{} {}", hexadecimal(light), contrast(colour, paper));
            }
        }
    }

    #[test]
    fn no_two_series_look_alike_on_either_paper() {
        let of = |pairs: &[(RGBColor, RGBColor)]| {
            for (i, a) in pairs.iter().enumerate() {
                for b in &pairs[..i] {
                    for (a, b) in [(a.0, b.0), (a.1, b.1)] {
                        let apart = a.0.abs_diff(b.0).max(a.1.abs_diff(b.1)).max(a.2.abs_diff(b.2));
                        assert!(apart >= 40, "{} and {}", hexadecimal(a), hexadecimal(b));
                    }
                }
            }
        };
        of(&PAIRS[3..]);
    }
}
