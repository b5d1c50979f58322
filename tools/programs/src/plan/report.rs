//! A plan in words.

use super::args::Args;
use super::pilots::Time;
use super::traffic::Fetched;
use crate::pipe::Pipe;
use pm_plan::{Choice, Estimate, PAPERS_MAP, Plan, Recipe, Rival};
use pm_report::{Column, Table, Value};
use std::fmt::Write as _;

/// What is said of a plan.
pub(super) struct Report<'a> {
    pub(super) args: &'a Args,
    pub(super) plan: &'a Plan,
    pub(super) time: &'a Time,
    /// What orders fetch, the least first; none where it was not asked.
    pub(super) fetched: &'a [Fetched],
    /// The mean of FLIP; none where it was not asked.
    pub(super) flip: Option<Estimate>,
    /// What would have no more error with the paper's map.
    pub(super) usual: Option<Choice>,
    /// Seconds of processor time that planning took, without the small pictures.
    pub(super) own: f64,
    pub(super) pipe: Pipe,
    pub(super) size: [u32; 2],
}

/// The error, of its square.
pub(super) fn root(square: f64) -> f64 {
    square.max(0.0).sqrt()
}

/// A share in percent, with three digits.
pub(super) fn percent(share: f64) -> String {
    let percent = share * 100.0;
    let digits = if percent >= 99.95 {
        0
    } else if percent >= 9.995 {
        1
    } else {
        2
    };
    let text = format!("{percent:.digits$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{short}%")
}

/// Bytes in powers of 1000, as bandwidths are.
pub(super) fn bytes(bytes: f64) -> String {
    let units = [(1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let bytes = bytes.max(0.0);
    let (unit, name) = units.into_iter().find(|(unit, _)| bytes >= unit * 0.9995).unwrap_or((1.0, "bytes"));
    let digits = if bytes / unit < 9.995 { 2 } else { usize::from(bytes / unit < 99.95) };
    format!("{:.digits$} {name}", bytes / unit)
}

/// A recipe in short.
pub(super) fn recipe(recipe: &Recipe) -> String {
    let Recipe { samples, gathers, light_samples, photons, k, caustics } = recipe;
    let of_caustics = format!(", {caustics} photons of caustics");
    let of_caustics = if *caustics > 0 { &*of_caustics } else { "" };
    format!(
        "{samples} eye rays x {gathers} gather rays, {light_samples} shadow rays, k {k} of {photons} photons{of_caustics}"
    )
}

impl Report<'_> {
    /// The plan, for people.
    pub(super) fn text(&self) -> String {
        let Self { args, plan, time, own, pipe, size: [width, height], .. } = self;
        let confidence = args.confidence;
        let mut text = String::new();
        let mut line = |words: String| writeln!(text, "{words}").expect("a string takes all");
        line(format!("{pipe}"));
        line(String::new());
        let between = |estimate: &Estimate, show: &dyn Fn(f64) -> String| {
            format!(
                "{} ({} to {})",
                show(estimate.value),
                show(two_sided(estimate, confidence)[0]),
                show(two_sided(estimate, confidence)[1])
            )
        };
        let share = |square: f64| percent(root(square));
        let seconds = |seconds: f64| format!("{:.*}", if seconds < 10.0 { 2 } else { 1 }, seconds.max(0.0));
        line(format!(
            "error     {}; wanted: {} with {} confidence",
            between(&plan.error, &share),
            percent(args.error),
            percent(confidence)
        ));
        let parts = &plan.parts;
        line(format!(
            "          of this, noise of rays {}, noise of photons {}, bias {}",
            share(parts.rays.value),
            share(parts.photons.value),
            share(parts.bias.value)
        ));
        if let Some(flip) = &self.flip {
            let looks = between(flip, &|flip| format!("{:.4}", flip.max(0.0)));
            line(format!("looks     off by FLIP {looks}, the mean over small pictures"));
        }
        let total = between(&time.total, &seconds);
        line(format!("time      {total} s of processor time for {width}x{height} pixels"));
        let shown = |value: f64| bytes(value);
        for (at, Fetched { order, bytes, cache, .. }) in self.fetched.iter().enumerate() {
            let label = if at == 0 { "traffic" } else { "" };
            let cache = pm_size::Bytes(*cache);
            line(format!("{label:<9} {} fetched: {order}, a cache of {cache}", between(bytes, &shown)));
        }
        if let Some(least) = self.fetched.first() {
            least.pipes.iter().for_each(|pipe| line(format!("          in full: {pipe}")));
        }
        for tried in &plan.trials {
            line(format!(
                "tried     {}: {} where {} was predicted; {} s by the parts",
                recipe(&tried.choice.recipe),
                share(tried.error.value),
                share(tried.choice.parts.total().value),
                seconds(plan.model.times().of(&tried.choice.recipe, f64::from(*width) * f64::from(*height)))
            ));
        }
        line(format!("next best {}", self.rival()));
        line(format!("saves     {}", self.saved()));
        let all = own + time.pilots;
        let dear = all / time.total.value;
        line(format!(
            "planning  {} s of processor time, {} of the picture's; {} s of it for pilots of time; seconds differ from run \
             to run, and so may the choice",
            seconds(all),
            percent(dear),
            seconds(time.pilots)
        ));
        text
    }

    /// The plan as a row, for programs. Errors and chances are shares of 1.
    pub(super) fn table(&self) -> Table {
        let Self { args, plan, time, own, pipe, size: [width, height], .. } = self;
        let Recipe { samples, gathers, light_samples, photons, k, caustics } = plan.choice.recipe;
        let [low, high] = two_sided(&plan.error, args.confidence).map(root);
        let [fast, slow] = two_sided(&time.total, args.confidence).map(|seconds| seconds.max(0.0));
        let real = |x: f64| Value::Float(x, 4);
        let (times, pixels) = (plan.model.times(), f64::from(*width) * f64::from(*height));
        let least = self.fetched.first();
        let fetched = least.map(|least| least.bytes);
        let [low_bytes, high_bytes] = fetched.map_or([f64::NAN; 2], |bytes| two_sided(&bytes, args.confidence));
        let whole = |x: u32| Value::Int(x.into());
        let pipes = least.map_or_else(String::new, |least| {
            least.pipes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
        });
        let cells = [
            (Column::text("pipe"), Value::Text(pipe.to_string())),
            (Column::number("wanted"), real(args.error)),
            (Column::number("confidence"), real(args.confidence)),
            (Column::number("error"), real(root(plan.error.value))),
            (Column::number("error_low"), real(low)),
            (Column::number("error_high"), real(high)),
            (Column::number("noise_of_rays"), real(root(plan.parts.rays.value))),
            (Column::number("noise_of_photons"), real(root(plan.parts.photons.value))),
            (Column::number("bias"), real(root(plan.parts.bias.value))),
            (Column::number("seconds"), real(time.total.value)),
            (Column::number("seconds_low"), real(fast)),
            (Column::number("seconds_high"), real(slow)),
            (Column::number("planning_seconds"), real(own + time.pilots)),
            (Column::number("width"), whole(*width)),
            (Column::number("height"), whole(*height)),
            (Column::number("samples"), whole(samples)),
            (Column::number("gathers"), whole(gathers)),
            (Column::number("light_samples"), whole(light_samples)),
            (Column::number("photons"), Value::Int(photons)),
            (Column::number("k"), whole(k)),
            (Column::number("caustics"), Value::Int(caustics)),
            (Column::text("next_best"), Value::Text(self.rival())),
            (Column::number("flip"), real(self.flip.map_or(f64::NAN, |flip| flip.value))),
            (
                Column::number("seconds_of_papers_map"),
                real(self.usual.map_or(f64::NAN, |usual| times.of(&usual.recipe, pixels))),
            ),
            (Column::text("order"), Value::Text(least.map_or_else(String::new, |least| least.order.to_string()))),
            (Column::number("bytes_fetched"), real(fetched.map_or(f64::NAN, |bytes| bytes.value))),
            (Column::number("bytes_fetched_low"), real(low_bytes)),
            (Column::number("bytes_fetched_high"), real(high_bytes)),
            (Column::text("traffic_pipe"), Value::Text(pipes)),
        ];
        let (columns, row) = cells.into_iter().unzip();
        let mut table = Table::new(columns);
        table.push(row);
        table
    }

    /// By what the recipe is cheaper than one with the paper's map.
    fn saved(&self) -> String {
        let (photons, k) = PAPERS_MAP;
        let map = format!("{photons} photons with k {k}, next to the paper's 100");
        let pixels = self.size.map(f64::from).iter().product();
        let fetched = |choice: &Choice| self.plan.model.fetched(&choice.recipe, pixels);
        let Some(usual) = self.usual else { return format!("a picture that could not be: {map}, do not do") };
        let seconds = |choice: &Choice| self.plan.model.times().of(&choice.recipe, pixels);
        let times = seconds(&usual) / seconds(&self.plan.choice);
        let of_bytes = fetched(&usual).zip(fetched(&self.plan.choice)).filter(|(_, own)| *own > 0.0);
        let of_bytes =
            of_bytes.map_or_else(String::new, |(usual, own)| format!(", {:.1} times the bytes", usual / own));
        format!("{map}, take {times:.1} times the time{of_bytes} for this error, by the parts")
    }

    /// Who came next, and why it lost.
    fn rival(&self) -> String {
        let chosen = &self.plan.choice;
        let by = |other: &Choice| other.cost / chosen.cost;
        match &self.plan.rival {
            Some(Rival::Dearer(other)) if by(other) < 1.0 => {
                format!(
                    "{}: {:.2} times the cost, by the model: to try it would take more than it is likely to save",
                    recipe(&other.recipe),
                    by(other)
                )
            }
            Some(Rival::Dearer(other)) => {
                format!("{}: would do, and costs {:.2} times as much", recipe(&other.recipe), by(other))
            }
            Some(Rival::TooCoarse(other)) => {
                let error = percent(root(other.parts.total().value));
                format!("{}: {:.2} times the cost, but an error of {error}", recipe(&other.recipe), by(other))
            }
            None => "none: nothing else would do".to_owned(),
        }
    }
}

/// Both ends of the interval that holds the truth with this chance.
pub(super) fn two_sided(estimate: &Estimate, confidence: f64) -> [f64; 2] {
    let one_sided = f64::midpoint(1.0, confidence);
    [estimate.lower(one_sided), estimate.upper(one_sided)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percent_have_three_digits_and_no_idle_zeros() {
        let shown = [0.02, 0.01234, 0.1, 0.12345, 1.0, 2.5].map(percent);
        assert_eq!(shown, ["2%", "1.23%", "10%", "12.3%", "100%", "250%"]);
    }
}
