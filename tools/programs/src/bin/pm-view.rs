//! Looks into streams: what they are about, where they came from, whether they are whole, what their records say.

use anyhow::Context as _;
use clap::Parser;
use pm_exchange::foreign::{Exporter, Form};
use pm_exchange::import::{self, Import, Imported};
use pm_formats::trace::TraceReader;
use pm_formats::{BlockReader, Record};
use pm_pictures::{
    self, Comparison, Description, PIXELS_PER_DEGREE, Picture, Preview, Region, RegionMean, contact_sheet, hdr_flip,
    ldr_flip,
};
use pm_programs::cli::choice;
use pm_programs::cli::{
    self, Input, OutputArgs, Progress, Typed, Voice, create_output, named, open_bytes, open_input, usage,
};
use pm_programs::setting::size;
use pm_programs::view::{self, Flips};
use pm_report::Format;
use pm_size::Bytes;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Look into a stream of photons, queries or memory accesses; compare pictures; import other renderers' points; export traces.
///
/// Without options: header, history, and, read to the end, counts, digest and what each stage measured. Two pictures,
/// a.exr b.exr: how far b is from a; ldr_flip and hdr_flip are the means of FLIP, 0 for the same to 1 for black and white,
/// of the previews at --exposure and of the radiance at all exposures that show it. With --import: the rows of a file as a stream. Columns of photons: x,y,z;
/// power_r,power_g,power_b, flux in watts times the emitted paths (1); from_x,from_y,from_z, towards where it came from
/// (the normal); n_x,n_y,n_z (the direction it came from, else 0,1,0). Of queries: x,y,z; n_x,n_y,n_z (0,1,0);
/// view_x,view_y,view_z, towards the viewer (the normal); pixel (number of the row, or one for all without --size);
/// sample (number of the row); weight_r,weight_g,weight_b (1); material (0); diffuse_r,diffuse_g,diffuse_b (0.5); batch
/// (0). In brackets is what holds where a column is missing.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Streams to look into, or .exr pictures: one, or two to compare; `-` is standard input
    #[arg(default_value = "-")]
    streams: Vec<PathBuf>,
    /// Print the commands that made the stream, as they could be typed again; reads the header only
    #[arg(long, group = "what")]
    history: bool,
    /// Read all of it and print a line if it is whole
    #[arg(long, group = "what")]
    check: bool,
    /// Print records as tab-separated text, the first N or all
    #[arg(long, value_name = "N", group = "what", num_args = 0..=1, require_equals = true, default_missing_value = "18446744073709551615")]
    records: Option<u64>,
    /// Make a stream of the rows of a file: CSV (commas, semicolons, tabs or blanks) or raw numbers
    #[arg(long, value_name = "KIND", group = "what")]
    import: Option<What>,
    /// Write a trace for another simulator: raw32, raw64, din, xdin, dinb, lackey, oracleGeneral, csv, dramsim3, ramulator2
    #[arg(long, value_name = "FORMAT", group = "what", hide_possible_values = true, value_parser = choice::<Form>())]
    export: Option<Form>,
    /// Cut exported accesses where lines of so many bytes end; formats without sizes then get lines
    #[arg(long, value_name = "BYTES", requires = "export", hide_short_help = true)]
    line: Option<Bytes>,
    /// Names of the columns where the file has none, such as x,y,z,_,power_r; `_` skips one
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "import")]
    columns: Option<Vec<String>>,
    /// The file holds little-endian numbers without a header, not text
    #[arg(long, value_name = "TYPE", requires = "import", requires = "columns")]
    raw: Option<Raw>,
    /// Photons: number of emitted paths, by which the powers are yet to be divided [default: 1]
    #[arg(long, value_name = "N", requires = "import", value_parser = clap::value_parser!(u64).range(1..))]
    emitted: Option<u64>,
    /// Queries: size of the picture
    #[arg(long, value_name = "WxH", requires = "import", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Print the mean radiance of a rectangle of pixels, the last column and row not included; may be repeated
    #[arg(long, value_name = "X0,Y0,X1,Y1|all", group = "what")]
    mean: Vec<Region>,
    /// Put .exr or .png pictures on a contact sheet with their names
    #[arg(long, value_name = "FILE.png", group = "what", conflicts_with = "output")]
    sheet: Option<PathBuf>,
    /// Stops by which a sheet's .exr pictures, and those compared by ldr_flip, are brightened
    #[arg(long, value_name = "STOPS", default_value = "0", allow_negative_numbers = true, value_parser = stops)]
    exposure: f32,
    /// Pixels to a degree of the field of view, for FLIP: 67 is a screen of 3840 pixels and 0.7 m, seen from 0.7 m
    #[arg(long, value_name = "PPD", default_value_t = PIXELS_PER_DEGREE, value_parser = pixels_per_degree, hide_short_help = true)]
    pixels_per_degree: f64,
    /// How a comparison or means are written
    #[arg(long, default_value = "table", value_parser = choice::<Format>())]
    format: Format,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    voice: Voice,
}

#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum What {
    /// Photons
    Photons,
    /// Gather queries
    Queries,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Raw {
    /// 32-bit floats
    F32,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-view --records=10
  pm-view --check out/map.pmp out/hilbert.pmq
  pm-view --export dramsim3 --line 64 out/hilbert.pmt -o hilbert.txt
  pm-view --import photons photons.csv --emitted 100000 -o map.pmp";

fn main() -> ExitCode {
    cli::main("pm-view", run)
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    if let Some(what) = args.import {
        return import(what, &args, typed);
    }
    if let Some(sheet) = &args.sheet {
        return make_sheet(sheet, &args);
    }
    if let Some(form) = args.export {
        return export(form, &args);
    }
    let pictures = args.streams.iter().filter(|path| is_picture(path)).count();
    if !args.mean.is_empty() {
        if pictures < args.streams.len() {
            return Err(usage("--mean measures .exr pictures"));
        }
        return measure(&args);
    }
    if pictures > 0
        && (pictures > 2 || pictures < args.streams.len() || args.history || args.check || args.records.is_some())
    {
        return Err(usage(
            "pictures are described one at a time or compared two at a time, without other options; --mean and --sheet take more",
        ));
    }
    let mut output = create_output(args.output.output.as_deref().unwrap_or(Path::new("-")))?;
    match &args.streams[..] {
        [picture] if pictures == 1 => view::picture(&Description::read(picture)?, &mut output)?,
        [a, b] if pictures == 2 => {
            let [x, y] = [Picture::read_exr(a)?, Picture::read_exr(b)?];
            let comparison = Comparison::new(&x, &y)?;
            if comparison.differing == 0 {
                args.voice.remark("the pictures are the same to the last bit");
            }
            let flips = Flips {
                ldr: ldr_flip(&x.exposed(args.exposure), &y.exposed(args.exposure), args.pixels_per_degree),
                exposure: args.exposure,
                hdr: hdr_flip(&x, &y, args.pixels_per_degree).mean,
                pixels_per_degree: args.pixels_per_degree,
            };
            view::comparison(&named(a), &named(b), &comparison, &flips).write(args.format, &mut output)?;
        }
        streams => {
            for path in streams {
                let name = named(path);
                let stream = open_input(path)?;
                look(&args, &name, stream, &mut output).with_context(|| name.clone())?;
            }
        }
    }
    output.commit()
}

fn is_picture(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"))
}

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

fn measure(args: &Args) -> anyhow::Result<()> {
    let mut output = create_output(args.output.output.as_deref().unwrap_or(Path::new("-")))?;
    let mut found = vec![];
    for path in &args.streams {
        let picture = Picture::read_exr(path)?;
        for &region in &args.mean {
            found.push((named(path), RegionMean::new(&picture, region).with_context(|| named(path))?));
        }
    }
    view::regions(&found).write(args.format, &mut output)?;
    output.commit()
}

fn make_sheet(sheet: &Path, args: &Args) -> anyhow::Result<()> {
    if pm_pictures::Format::of(sheet)? != pm_pictures::Format::Png {
        return Err(usage("a contact sheet's name ends in .png"));
    }
    let named = |path: &PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok((name, Preview::read(path, args.exposure)?))
    };
    let previews = args.streams.iter().map(named).collect::<anyhow::Result<Vec<_>>>()?;
    let mut output = create_output(sheet)?;
    output.write_all(&contact_sheet(&previews)?)?;
    output.commit()
}

fn export(form: Form, args: &Args) -> anyhow::Result<()> {
    let [path] = &args.streams[..] else {
        return Err(usage("--export reads one trace"));
    };
    let line = args.line.map(|line| line.0);
    if line.is_some_and(|line| !line.is_power_of_two() || line > 1 << 31) {
        return Err(usage("--line: a power of two up to 2147483648 is needed"));
    }
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).context(name.clone())?;
    let regions = trace.header().regions.clone();
    let output = if form.is_text() {
        create_output(args.output.output.as_deref().unwrap_or(Path::new("-")))?
    } else {
        args.output.create()?
    };
    let mut exporter = Exporter::new(form, line, &regions, output)?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(&mut exporter).with_context(|| name.clone())? {
        exporter.check().with_context(|| name.clone())?;
        progress.add(block.records.into());
    }
    exporter.finish()?.commit()
}

fn import(what: What, args: &Args, typed: &Typed) -> anyhow::Result<()> {
    let [path] = &args.streams[..] else {
        return Err(usage("--import reads one file"));
    };
    match what {
        What::Photons if args.size.is_some() => {
            return Err(usage("--size belongs to queries; photons have no picture"));
        }
        What::Queries if args.emitted.is_some() => return Err(usage("--emitted belongs to photons")),
        _ => {}
    }
    let import = Import {
        columns: args.columns.clone(),
        raw: args.raw.is_some(),
        emitted: args.emitted.unwrap_or(1),
        size: args.size,
    };
    let name = named(path);
    let step = typed.step_from(path, None);
    let input = BufReader::with_capacity(1 << 18, open_bytes(path)?);
    match what {
        What::Photons => write(import::photons(input, &import, step).context(name)?, args),
        What::Queries => write(import::queries(input, &import, step).context(name)?, args),
    }
}

fn write<T: Record>(imported: Imported<T>, args: &Args) -> anyhow::Result<()> {
    if !imported.unused.is_empty() {
        args.voice.remark(format!("columns that are not used: {}", imported.unused.join(", ")));
    }
    imported.write(args.output.create()?)?.commit()
}

fn look(args: &Args, name: &str, stream: BlockReader<Input>, output: &mut impl Write) -> anyhow::Result<()> {
    if args.history {
        write!(output, "{}", pm_formats::as_commands(&stream.header().history))?;
    } else if args.check {
        let kind = stream.kind();
        let whole = view::read_to_end(stream, args.voice.quiet)?;
        let tally = whole.end.tally;
        writeln!(output, "{name}: whole, {} {}, digest {}", tally.records, kind.plural(), tally.digest)?;
    } else if let Some(limit) = args.records {
        pm_exchange::records(stream, limit, output)?;
    } else {
        if args.streams.len() > 1 {
            writeln!(output, "== {name}")?;
        }
        view::header(stream.kind(), stream.header(), output)?;
        view::end(&view::read_to_end(stream, args.voice.quiet)?, output)?;
    }
    Ok(())
}
