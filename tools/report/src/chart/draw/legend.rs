//! The legend beside a plot.

use super::{Area, Drawn, LETTER, Names, draw_key, own};
use crate::chart::Plot;
use crate::chart::colours::{GREY, INK, of_series};
use plotters::prelude::*;

impl Plot {
    /// Draws a name for each series, however many there are, in this height: where the series end, so far down, or below one
    /// another; with a key each, or joined to its end.
    pub(super) fn draw_legend(
        &self,
        area: &Area<'_>,
        height: i32,
        lines: bool,
        (kind, ends): (Names, Vec<i32>),
    ) -> Drawn {
        let names: Vec<&str> = self.names(kind).collect();
        let rows = i32::try_from(names.len().max(1))?;
        let step = ((height - 48) / rows).clamp(1, LETTER + 4);
        let places = apart(ends.clone(), names.len(), step, (36, height - 12));
        for (row, (name, at)) in names.iter().zip(places).enumerate() {
            let (number, colour, lines) = match row.checked_sub(self.series.len()) {
                Some(reference) => (self.mark_of(reference), GREY, false),
                None => (row, of_series(row), lines),
            };
            match ends.get(row).filter(|_| kind == Names::AtEnds) {
                Some(&end) => {
                    let joined = vec![(0, end), (10, end), (20, at), (28, at)];
                    area.draw(&PathElement::new(joined, colour.stroke_width(1))).map_err(own)?;
                }
                None => draw_key(area, at, number, colour, lines)?,
            }
            let style = ("sans-serif", LETTER.min(step)).into_font().color(&INK);
            area.draw(&Text::new((*name).to_owned(), (32, at - LETTER.min(step) / 2), style)).map_err(own)?;
        }
        Ok(())
    }
}

/// Places for so many names, at least a step apart and within these bounds, each as near as may be to the one wanted; those for
/// which none is wanted below the others.
fn apart(wanted: Vec<i32>, names: usize, step: i32, (top, bottom): (i32, i32)) -> Vec<i32> {
    let known = wanted.len();
    let below = wanted.iter().max().map_or(top, |most| most + step);
    let wanted: Vec<i32> = wanted.into_iter().chain((known..names).map(|_| below)).collect();
    let mut order: Vec<usize> = (0..names).collect();
    order.sort_by_key(|&name| (wanted[name], name));
    let mut places = vec![top; names];
    let mut free = top;
    for &name in &order {
        places[name] = wanted[name].max(free);
        free = places[name] + step;
    }
    // Those that stand too low push those above them up.
    let mut last = bottom;
    for &name in order.iter().rev() {
        places[name] = places[name].min(last);
        last = places[name] - step;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn names_stand_where_their_series_end_and_never_on_one_another() {
        assert_eq!(apart(vec![], 3, 20, (36, 300)), [36, 56, 76]);
        assert_eq!(apart(vec![200, 100], 2, 20, (36, 300)), [200, 100]);
        assert_eq!(apart(vec![100, 105, 90], 3, 20, (36, 300)), [110, 130, 90]);
        assert_eq!(apart(vec![300, 299], 2, 20, (36, 300)), [300, 280]);
        // What is compared with stands below.
        assert_eq!(apart(vec![100], 2, 20, (36, 300)), [100, 120]);
    }
}
