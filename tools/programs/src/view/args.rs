//! What pm-view may be asked.

use crate::cli::{OutputArgs, Voice, choice, entry};
use crate::foreign_args::ForeignArgs;
use crate::setting::size;
use clap::Parser;
use pm_exchange::traces::{TraceExport, exports};
use pm_pictures::{PIXELS_PER_DEGREE, Region};
use pm_report::Format;
use pm_size::Bytes;
use std::path::PathBuf;

/// Look into a stream of photons, queries or memory accesses; compare pictures; import other renderers' points; export traces.
///
/// Without options: header, history, and, read to the end, counts, digest and what each stage measured. Two pictures,
/// a.exr b.exr: how far b is from a; ldr_flip and hdr_flip are the means of FLIP, 0 for the same to 1 for black and white,
/// of the previews at --exposure and of the radiance at all exposures that show it. If they differ in their seeds alone, half of
/// rel_mse is the noise of each, as is said then. With --import: the rows of a file as a stream. Columns of photons: x,y,z;
/// power_r,power_g,power_b, flux in watts times the emitted paths (1); from_x,from_y,from_z, towards where it came from
/// (the normal); n_x,n_y,n_z (the direction it came from, else 0,1,0). Of queries: x,y,z; n_x,n_y,n_z (0,1,0);
/// view_x,view_y,view_z, towards the viewer (the normal); pixel (number of the row, or one for all without --size);
/// sample (number of the row); weight_r,weight_g,weight_b (1); material (0); diffuse_r,diffuse_g,diffuse_b (0.5); batch
/// (0). In brackets is what holds where a column is missing.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Streams to look into, or .exr pictures: one, or two to compare (`-o` x.png then shows where, by FLIP, x.exr how much);
    /// `-` is standard input
    #[arg(default_value = "-")]
    pub(super) streams: Vec<PathBuf>,
    /// Print the commands that made the stream, as they could be typed again; reads the header only
    #[arg(long, group = "what")]
    pub(super) history: bool,
    /// Read all of it and print a line if it is whole
    #[arg(long, group = "what")]
    pub(super) check: bool,
    /// Print records as tab-separated text, the first N or all
    #[arg(long, value_name = "N", group = "what", num_args = 0..=1, require_equals = true, default_missing_value = "18446744073709551615")]
    pub(super) records: Option<u64>,
    /// Put together all parts of a stream or picture, made by --part
    ///
    /// Every part is needed, once. What is written is, byte for byte, what one machine would have made. The history is that of the whole; where files on the way had different names it reads as one
    /// pipe.
    #[arg(long, group = "what")]
    pub(super) merge: bool,
    /// Write a trace for keeping, in fewer bytes: slow to write, and read as any other
    ///
    /// Its searches, digest and history are the same. A trace of kd in Hilbert order becomes half as long, a scattered one two thirds,
    /// those of other maps 3 to 14 % shorter.
    #[arg(long, group = "what", hide_short_help = true)]
    pub(super) archive: bool,
    /// Make a stream of the rows of a file, CSV (commas, semicolons, tabs or blanks) or raw numbers, or of another simulator's
    /// trace
    #[arg(long, value_name = "KIND", group = "what")]
    pub(super) import: Option<Rows>,
    /// Write a trace for another simulator
    #[arg(long, value_name = "FORMAT", group = "what", value_parser = entry(&exports()))]
    pub(super) export: Option<&'static dyn TraceExport>,
    /// Cut exported accesses where lines of so many bytes end; formats without sizes then get lines
    #[arg(long, value_name = "BYTES", requires = "export", hide_short_help = true)]
    pub(super) line: Option<Bytes>,
    #[command(flatten)]
    pub(super) foreign: ForeignArgs,
    /// Names of the columns where the file has none, such as x,y,z,_,power_r; `_` skips one
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "import")]
    pub(super) columns: Option<Vec<String>>,
    /// The file holds little-endian numbers without a header, not text
    #[arg(long, value_name = "TYPE", requires = "import", requires = "columns")]
    pub(super) raw: Option<Raw>,
    /// Photons: number of emitted paths, by which the powers are yet to be divided [default: 1]
    #[arg(long, value_name = "N", requires = "import", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) emitted: Option<u64>,
    /// Queries: size of the picture
    #[arg(long, value_name = "WxH", requires = "import", value_parser = size)]
    pub(super) size: Option<[u32; 2]>,
    /// Print the mean radiance of a rectangle of pixels of the display window, the last column and row not included; may be
    /// repeated
    #[arg(long, value_name = "X0,Y0,X1,Y1|all", group = "what")]
    pub(super) mean: Vec<Region>,
    /// Put .exr or .png pictures on a contact sheet with their names
    #[arg(long, value_name = "FILE.png", group = "what", conflicts_with = "output")]
    pub(super) sheet: Option<PathBuf>,
    /// Stops by which a sheet's .exr pictures, and those compared by ldr_flip, are brightened
    #[arg(long, value_name = "STOPS", default_value = "0", allow_negative_numbers = true, value_parser = stops)]
    pub(super) exposure: f32,
    /// Pixels to a degree of the field of view, for FLIP: 67 is a screen of 3840 pixels and 0.7 m, seen from 0.7 m
    #[arg(long, value_name = "PPD", default_value_t = PIXELS_PER_DEGREE, value_parser = pixels_per_degree, hide_short_help = true)]
    pub(super) pixels_per_degree: f64,
    /// How a comparison or means are written
    #[arg(long, default_value = "table", value_parser = choice::<Format>())]
    pub(super) format: Format,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    #[command(flatten)]
    pub(super) voice: Voice,
}

/// What the rows of a file are.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
pub(super) enum Rows {
    /// Photons
    Photons,
    /// Gather queries
    Queries,
    /// Memory accesses, in any format that pm-cachesim reads
    Trace,
}

#[derive(Clone, Copy, clap::ValueEnum)]
pub(super) enum Raw {
    /// 32-bit floats
    F32,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-view --records=10
  pm-view --check out/map.pmp out/hilbert.pmq
  pm-view --export dramsim3 --line 64 out/hilbert.pmt -o hilbert.txt
  pm-view --import photons photons.csv --emitted 100000 -o map.pmp";

fn stops(text: &str) -> Result<f32, String> {
    text.parse()
        .ok()
        .filter(|stops: &f32| stops.is_finite())
        .ok_or_else(|| "a finite number of stops is expected".into())
}

fn pixels_per_degree(text: &str) -> Result<f64, String> {
    let parsed = text.parse().ok().filter(|ppd| (1.0..=1000.0).contains(ppd));
    parsed.ok_or_else(|| "a number of pixels from 1 to 1000 is expected".into())
}
