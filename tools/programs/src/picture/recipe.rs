//! The recipe of a picture: which pipes, in which order.

use super::args::{Args, Words};
use crate::pipe::Pipe;
use pm_plan::{CAUSTICS_K, MOST_SEEN};
use std::path::{Path, PathBuf};

/// What is cooked, and from what.
pub(super) struct Recipe<'a> {
    pub(super) args: &'a Args,
    /// Options and files of the scene.
    pub(super) scene: Vec<String>,
    /// Options of the camera.
    pub(super) camera: Vec<String>,
    /// Where streams and pictures go that are not the last.
    pub(super) folder: PathBuf,
    /// Photons of caustics in a map of their own; 0: there is none.
    pub(super) caustics: u64,
}

impl Recipe<'_> {
    /// Pipes that make the photon maps.
    pub(super) fn maps(&self) -> Vec<Pipe> {
        let mut pipes = vec![self.photons("map.pmp", self.args.photons, &[])];
        pipes.extend((self.caustics > 0).then(|| self.photons("caustics.pmp", self.caustics, &["--caustics"])));
        pipes
    }

    /// Pipes that make the picture of them, each to be run when those before it are done.
    pub(super) fn gathers(&self) -> Vec<Pipe> {
        let (map, base) = (self.file("map.pmp"), self.file("direct.exr"));
        let further: Vec<&str> = further(&self.args.gather).collect();
        if self.caustics > 0 {
            let soft = self.file("soft.exr");
            let seen = self.queries(self.args.samples.min(MOST_SEEN), &["--direct-visualisation"]);
            let sharp = self.gather("caustics.pmp", self.args.caustics_k.unwrap_or(CAUSTICS_K), &["--base", &soft]);
            let gathered =
                self.gather("map.pmp", self.args.k, &[&further[..], &["--base", &base, "--image", &soft]].concat());
            vec![
                self.soft(&map, &base, &["--no-caustics"]).then("pm-gather", gathered),
                seen.then("pm-gather", sharp.into_iter().chain(self.images())),
            ]
        } else {
            let gathered = self.gather("map.pmp", self.args.k, &[&further[..], &["--base", &base]].concat());
            vec![self.soft(&map, &base, &[]).then("pm-gather", gathered.into_iter().chain(self.images()))]
        }
    }

    /// Photons to a file. The first of the programs, and the only one to say what is odd about the scene.
    fn photons(&self, name: &str, number: u64, options: &[&str]) -> Pipe {
        let Args { seed, common, .. } = self.args;
        let quiet = common.quiet || !options.is_empty();
        let mut words = said(options);
        words.extend(said(&["-n", &number.to_string(), "--seed", &seed.to_string()]));
        words.extend(said(&["-t", &common.threads.to_string(), "-o", &self.file(name)]));
        words.extend(quiet.then(|| "-q".to_owned()));
        Pipe::new("pm-photons", words.into_iter().chain(self.scene.iter().cloned()))
    }

    /// Queries of the light that is soft, with direct light apart.
    fn soft(&self, map: &str, base: &str, options: &[&str]) -> Pipe {
        let Args { gathers, light_samples, .. } = self.args;
        let (gathers, light_samples) = (gathers.to_string(), light_samples.to_string());
        let mut words = vec!["--gathers", &gathers, "--light-samples", &light_samples, "--base", base];
        words.extend_from_slice(options);
        if self.args.guide {
            words.extend(["--guide", map]);
        }
        words.extend(further(&self.args.queries));
        self.queries(self.args.samples, &words)
    }

    fn queries(&self, samples: u32, options: &[&str]) -> Pipe {
        let Args { seed, common, .. } = self.args;
        let mut words = said(&["-q", "--samples", &samples.to_string()]);
        words.extend(said(options));
        words.extend(said(&["--seed", &seed.to_string(), "-t", &common.threads.to_string()]));
        Pipe::new("pm-queries", words.into_iter().chain(self.camera.iter().cloned()).chain(self.scene.iter().cloned()))
    }

    /// What a map answers queries from standard input with.
    fn gather(&self, photons: &str, k: u32, options: &[&str]) -> Vec<String> {
        let threads = self.args.common.threads.to_string();
        let mut words = said(&["-q", &self.file(photons), "-", "-k", &k.to_string()]);
        words.extend(self.args.map.into_iter().flat_map(|map| said(&["--map", map.word()])));
        words.extend(said(options));
        words.extend(said(&["--no-trace", "-t", &threads]));
        words
    }

    /// The pictures that were asked for.
    fn images(&self) -> impl Iterator<Item = String> {
        let exposure = self.args.exposure;
        let images = self.args.image.iter().flat_map(|image| ["--image".to_owned(), image.display().to_string()]);
        images.chain((exposure != 0.0).then(|| format!("--exposure={exposure}")))
    }

    fn file(&self, name: &str) -> String {
        if self.folder == Path::new(".") { name.to_owned() } else { self.folder.join(name).display().to_string() }
    }
}

fn further(options: &Option<Words>) -> impl Iterator<Item = &str> {
    options.iter().flat_map(|words| words.0.iter().map(String::as_str))
}

fn said(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}
