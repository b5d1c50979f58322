//! Rectangles of pixels.

use std::fmt;
use std::str::FromStr;

/// Pixels x0 to x1 and y0 to y1, the second ones excluded, counted from the upper left corner; or all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// The whole picture.
    All,
    /// x0, y0, x1, y1.
    Rectangle([u32; 4]),
}

impl FromStr for Region {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "all" {
            return Ok(Self::All);
        }
        let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x0, y0, x1, y1]) if x0 < x1 && y0 < y1 => Ok(Self::Rectangle([x0, y0, x1, y1])),
            _ => Err("four pixel numbers X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1 are expected, or `all`".into()),
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => write!(f, "all"),
            Self::Rectangle([x0, y0, x1, y1]) => write!(f, "{x0},{y0},{x1},{y1}"),
        }
    }
}
