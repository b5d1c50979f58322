//! Bytes that the searches of gather rays fetch, by the order they come in and what there is on the chip; measured on samples of
//! the picture, by our own programs.

use crate::pipe::Pipe;
use anyhow::Context as _;
use pm_orders::StoredQuery;
use pm_plan::{CAUSTICS_K, Estimate, MOST_SEEN, Recipe, Trouble, is_large};
use pm_report::sheet::{Sheet, number};
use pm_sampling::{CONFIDENCE, Spread, student_quantile};
use pm_size::Bytes;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

/// A picture whose searches fetch from memory through what is on the chip.
pub(super) struct Chip<'a> {
    scene: &'a [String],
    camera: &'a [String],
    size: [u32; 2],
    seed: u64,
    on_chip: u64,
    folder: tempfile::TempDir,
    /// Which maps there are in the folder, and how many bytes of each are read, where that is known.
    maps: RefCell<BTreeMap<String, Option<u64>>>,
}

/// In which order searches come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Order {
    /// Row by row.
    Scanline,
    /// Tile by tile.
    Tiled,
    /// Tile by tile of so many pixels a side, along a Hilbert curve within each.
    Hilbert(u32),
}

/// Which map is searched.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Searches {
    /// That of all photons, by gather rays.
    Gather,
    /// That of caustics, where eye rays end.
    Caustics,
}

impl Searches {
    /// Those that a recipe makes.
    fn of(recipe: &Recipe) -> &'static [Self] {
        if recipe.caustics > 0 { &[Self::Gather, Self::Caustics] } else { &[Self::Gather] }
    }

    /// Searches of a pixel, about.
    fn of_pixel(self, recipe: &Recipe) -> u64 {
        match self {
            Self::Gather => u64::from(recipe.samples) * u64::from(recipe.gathers),
            Self::Caustics => u64::from(recipe.samples.min(MOST_SEEN)),
        }
    }

    /// Photons of the map, and how many of them a search is for.
    fn map(self, recipe: &Recipe) -> (u64, u32) {
        match self {
            Self::Gather => (recipe.photons, recipe.k),
            Self::Caustics => (recipe.caustics, CAUSTICS_K),
        }
    }

    /// The rays that make them: options of `pm-queries`.
    fn rays(self, recipe: &Recipe) -> Vec<String> {
        let Recipe { samples, gathers, caustics, .. } = recipe;
        words(&match self {
            Self::Gather if *caustics > 0 => format!("-q --samples {samples} --gathers {gathers} --no-caustics"),
            Self::Gather => format!("-q --samples {samples} --gathers {gathers}"),
            Self::Caustics => format!("-q --samples {} --direct-visualisation", self.of_pixel(recipe)),
        })
    }

    fn file(self) -> &'static str {
        match self {
            Self::Gather => "map.pmp",
            Self::Caustics => "caustics.pmp",
        }
    }
}

/// What an order fetches.
pub(super) struct Fetched {
    pub(super) order: Order,
    /// Bytes of the map for the whole picture.
    pub(super) bytes: Estimate,
    /// Bytes of the cache.
    pub(super) cache: u64,
    /// How it is measured in full, for each map.
    pub(super) pipes: Vec<Pipe>,
}

/// What is measured of the picture's searches.
#[derive(Clone, Copy)]
struct Look {
    /// So many of them, about.
    searches: u64,
    /// Which sample: others have other seeds.
    sample: u64,
    /// Which map: others have other seeds.
    map: u64,
}

/// Searches of a sample, about.
const SAMPLE: u64 = 60_000;
/// What the bytes that are told are measured by.
const LAST_LOOK: Look = Look { searches: SAMPLE, sample: 0, map: 0 };
/// Searches of a window in scanline order, and of those before it that fill the cache.
const WINDOW: [u64; 2] = [400, 1600];
/// Of a large picture: the rays of a row are cast from its beginning, and its rows are long.
const LONG_WINDOW: [u64; 2] = [2400, 1600];
/// Side of a tile without an order of its own.
const TILE: u32 = 8;
/// Sides of tiles that are sorted.
const SORTED_TILES: [u32; 5] = [4, 8, 16, 32, 64];
/// Maps, each with a seed of its own, by which it is known how much one fetches more or less than another.
const MAPS: u64 = 6;
/// Caches are of whole multiples of so many bytes.
const CACHE_STEP: u64 = 4096;

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scanline => write!(f, "scanline"),
            Self::Tiled => write!(f, "tiles of {TILE}x{TILE}"),
            Self::Hilbert(side) => write!(f, "Hilbert in tiles of {side}x{side}"),
        }
    }
}

impl<'a> Chip<'a> {
    pub(super) fn new(
        (scene, camera, size): (&'a [String], &'a [String], [u32; 2]),
        seed: u64,
        on_chip: Bytes,
    ) -> anyhow::Result<Self> {
        let folder = tempfile::tempdir().context("a folder for photon maps")?;
        Ok(Self { scene, camera, size, seed, on_chip: on_chip.0, folder, maps: RefCell::default() })
    }

    /// All orders that the chip has room for, those that fetch least first.
    pub(super) fn measure(&self, recipe: &Recipe) -> anyhow::Result<Vec<Fetched>> {
        let orders = self.orders(recipe).into_iter();
        let mut found: Vec<Fetched> =
            orders.map(|order| self.fetched(recipe, order, self.first_look())).collect::<anyhow::Result<_>>()?;
        found.sort_by(|a, b| a.bytes.value.total_cmp(&b.bytes.value));
        let Some(least) = found.first_mut() else { return Ok(found) };
        if least.bytes.spread.variance > 0.0 {
            // By another sample: that of what is the least of several is too good to be true.
            *least = self.fetched(recipe, least.order, LAST_LOOK)?;
        }
        if !self.is_large() {
            // The picture will have another map. Of a large one that is far less than what a sample leaves open.
            let another = self.another_map(recipe, least)?;
            found.iter_mut().for_each(|fetched| fetched.bytes = fetched.bytes.times(another));
        }
        Ok(found)
    }

    /// How many times what the first map fetches in this order another one does, by the same searches as were looked at last.
    fn another_map(&self, recipe: &Recipe, first: &Fetched) -> anyhow::Result<Estimate> {
        let by_map = |map| Ok(self.fetched(recipe, first.order, Look { map, ..LAST_LOOK })?.bytes.value);
        let others = (1..MAPS).map(by_map).collect::<anyhow::Result<Vec<f64>>>()?;
        Ok(beside(first.bytes.value, &others))
    }

    /// Bytes that a search fetches: in the order that needs little room, of rays as few as there may be.
    pub(super) fn search_bytes(&self, k: u32, photons: u64) -> Result<f64, Trouble> {
        let recipe = Recipe { samples: 4, gathers: 4, light_samples: 1, photons, k, caustics: 0 };
        let order = self.orders(&recipe).into_iter().find(|order| matches!(order, Order::Hilbert(_)));
        let found = self.fetched(&recipe, order.unwrap_or(Order::Scanline), self.first_look())?;
        let [width, height] = self.size;
        let searches = f64::from(width) * f64::from(height) * f64::from(recipe.samples * recipe.gathers);
        Ok(found.bytes.value / searches)
    }

    fn orders(&self, recipe: &Recipe) -> Vec<Order> {
        let longest = self.size[0].max(self.size[1]);
        let fits = |side: u32| side <= longest && self.store(recipe, Order::Hilbert(side)) <= self.on_chip / 2;
        let sorted = SORTED_TILES.into_iter().filter(|&side| fits(side)).map(Order::Hilbert);
        // Rows of a large picture take long to be sampled: is the map one that fits? Tiles say it first.
        let plain = if self.is_large() { [Order::Tiled, Order::Scanline] } else { [Order::Scanline, Order::Tiled] };
        plain.into_iter().chain(sorted).collect()
    }

    /// Bytes of the queries that an order holds.
    fn store(&self, recipe: &Recipe, order: Order) -> u64 {
        match order {
            Order::Scanline | Order::Tiled => 0,
            Order::Hilbert(side) => {
                let most = Searches::of(recipe).iter().map(|searches| searches.of_pixel(recipe)).max().unwrap_or(0);
                u64::from(side * side) * most * StoredQuery::Full.bytes()
            }
        }
    }

    fn is_large(&self) -> bool {
        let [width, height] = self.size.map(f64::from);
        is_large(width * height)
    }

    /// What is looked at to choose by: beside a large picture all that is measured has to be cheap.
    fn first_look(&self) -> Look {
        Look { searches: if self.is_large() { SAMPLE / 3 } else { SAMPLE }, sample: 1, map: 0 }
    }

    /// Bytes of the cache: what is on the chip, less the order's store.
    fn cache(&self, recipe: &Recipe, order: Order) -> u64 {
        ((self.on_chip - self.store(recipe, order)) / CACHE_STEP).max(1) * CACHE_STEP
    }

    /// What an order fetches.
    fn fetched(&self, recipe: &Recipe, order: Order, look: Look) -> anyhow::Result<Fetched> {
        let cache = self.cache(recipe, order);
        let mut bytes = Estimate::default();
        let mut pipes = vec![];
        for &searches in Searches::of(recipe) {
            let map = self.map(searches, searches.map(recipe).0, look.map)?;
            // Beside a large picture nothing is measured that is known.
            let known = self.maps.borrow()[&map].filter(|&size| self.is_large() && size <= cache);
            bytes = bytes.plus(match known {
                Some(size) => once(size),
                None => {
                    let sample = self.sample(recipe, searches, order, look);
                    let printed = self.pipe(recipe, searches, order, cache, &map, &sample).with(quiet_csv()).run()?;
                    let (found, size) = read(&printed, cache)?;
                    self.maps.borrow_mut().insert(map, Some(size));
                    found
                }
            });
            pipes.push(self.pipe(recipe, searches, order, cache, searches.file(), &[]));
        }
        Ok(Fetched { order, bytes, cache, pipes })
    }

    /// Which rays are cast: options of `pm-queries`; none where all are.
    fn sample(&self, recipe: &Recipe, searches: Searches, order: Order, look: Look) -> Vec<String> {
        let [width, height] = self.size.map(u64::from);
        if width * height * searches.of_pixel(recipe) <= 2 * SAMPLE {
            return vec![];
        }
        let wanted = look.searches;
        let seed = ["--sample-seed".to_owned(), self.seed.wrapping_add(look.sample).to_string()];
        let side = match order {
            Order::Scanline => {
                let long = self.is_large() && searches == Searches::Gather;
                let [window, warm_up] = if long { LONG_WINDOW } else { WINDOW };
                let of_row = width * searches.of_pixel(recipe);
                let warm_up = warm_up.min(of_row.saturating_sub(window));
                let windows = (wanted / (window + warm_up)).max(8).min(height);
                let numbers = [("--only-tiles", windows), ("--window", window.min(of_row)), ("--warm-up", warm_up)];
                let words = numbers.into_iter().flat_map(|(name, number)| [name.to_owned(), number.to_string()]);
                return words.chain(seed).collect();
            }
            // Windows would do as well, with a warm-up, but all rays before them are cast: tiles begin with an empty cache.
            Order::Tiled => u64::from(TILE),
            Order::Hilbert(side) => u64::from(side),
        };
        let all = width.div_ceil(side) * height.div_ceil(side);
        let tiles =
            (wanted / (side * side * searches.of_pixel(recipe))).clamp(8, if wanted < SAMPLE { 24 } else { 64 });
        if tiles >= all {
            return vec![];
        }
        ["--only-tiles".to_owned(), tiles.to_string()].into_iter().chain(seed).collect()
    }

    /// The searches in this order, and the cache that they go through.
    fn pipe(
        &self,
        recipe: &Recipe,
        searches: Searches,
        order: Order,
        cache: u64,
        map: &str,
        sample: &[String],
    ) -> Pipe {
        let mut rays = searches.rays(recipe);
        if let Order::Tiled | Order::Hilbert(_) = order {
            let side = if let Order::Hilbert(side) = order { side } else { TILE };
            rays.extend(words(&format!("--order tiled --tile {side}")));
        }
        rays.extend(sample.iter().chain(self.camera).chain(self.scene).cloned());
        let mut pipe = Pipe::new("pm-queries", rays);
        if let Order::Hilbert(_) = order {
            let store = Bytes(self.store(recipe, order));
            pipe = pipe.then("pm-reorder", words(&format!("-q hilbert --per batch --storage {store}")));
        }
        let (_, k) = searches.map(recipe);
        let gather = words("-q").into_iter().chain([map.to_owned()]).chain(words(&format!("-k {k}")));
        pipe.then("pm-gather", gather).then("pm-cachesim", words(&format!("--sizes {} --ways full", Bytes(cache))))
    }

    /// A map of so many photons, as the picture's will be; those of other numbers have other seeds.
    fn map(&self, searches: Searches, photons: u64, number: u64) -> anyhow::Result<String> {
        let path = self.folder.path().join(format!("{photons}.{number}.{}", searches.file())).display().to_string();
        if !self.maps.borrow().contains_key(&path) {
            let which = if searches == Searches::Caustics { "--caustics " } else { "" };
            let seed = self.seed.wrapping_add(number);
            let options = words(&format!("{which}-q -n {photons} --seed {seed}"));
            let output = ["-o".to_owned(), path.clone()];
            Pipe::new("pm-photons", options.into_iter().chain(output).chain(self.scene.iter().cloned())).run()?;
            self.maps.borrow_mut().insert(path.clone(), None);
        }
        Ok(path)
    }
}

fn words(line: &str) -> Vec<String> {
    line.split(' ').map(str::to_owned).collect()
}

fn quiet_csv() -> Vec<String> {
    words("-q --format csv")
}

/// How many times what the first map fetches another one does, as these others do.
fn beside(first: f64, others: &[f64]) -> Estimate {
    // No search meets a photon, and none will: where gather rays leave the scene there are no searches.
    if first <= 0.0 {
        return Estimate { value: 1.0, spread: Spread::default() };
    }
    let all: Vec<f64> = std::iter::once(&first).chain(others).map(|bytes| bytes / first).collect();
    Estimate::of_another(&all)
}

/// A map that fits is fetched once.
fn once(bytes_of_map: u64) -> Estimate {
    Estimate { value: bytes_of_map as f64, spread: Spread::default() }
}

/// What `pm-cachesim` found, and the bytes of the map: its interval is of 95 %, by Student's t. Of a map that fits, each line is fetched
/// once, whatever a sample says that begins with an empty cache, or sees some of the lines.
fn read(printed: &[u8], cache: u64) -> anyhow::Result<(Estimate, u64)> {
    let sheet = Sheet::parse("pm-cachesim", printed)?;
    let row = sheet.rows().first().context("pm-cachesim has printed no row")?;
    let field = |name: &str| anyhow::Ok(number(&row[sheet.column(name)?]).unwrap_or(0.0));
    let (value, half_width) = (field("bytes_fetched")?, field("bytes_fetched_error")?);
    let map = field("blocks")? * field("line_bytes")?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of lines")]
    let bytes_of_map = map as u64;
    if bytes_of_map <= cache {
        return Ok((once(bytes_of_map), bytes_of_map));
    }
    let freedom = field("degrees_of_freedom")?.max(1.0);
    let variance = (half_width / student_quantile(CONFIDENCE, freedom)).powi(2);
    Ok((Estimate { value, spread: Spread { variance, freedom } }, bytes_of_map))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_map_fetches_as_much_as_others_do_and_nothing_where_nothing_is_searched() {
        let bytes = once(1000).times(beside(1000.0, &[1100.0, 900.0, 1200.0]));
        assert!((bytes.value - 1050.0).abs() < 1e-9);
        assert!(bytes.lower(0.95) < 900.0 && bytes.upper(0.95) > 1200.0, "{bytes:?}");
        let nothing = once(0).times(beside(0.0, &[0.0; 5]));
        assert_eq!((nothing.value, nothing.lower(0.95), nothing.upper(0.95)), (0.0, 0.0, 0.0));
    }
}
