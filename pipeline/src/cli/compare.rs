//! `pipeline compare`: measures the difference between two pictures.

use clap::Args;
use compare::{CompareError, Difference, Scale, difference, map, read, ssim};
use files::exit::wrote;
use files::{CommonArguments, Exit, Failure, Output, Report, input};
use render::Picture;
use render::film::Crop;
use render::film::encode::Format;
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;
use thiserror::Error;

const MEASURES: &str = "\
Measures, in linear light where white is 1:
  rmse  root mean square difference over all pixels and channels
  max   largest difference in any channel, and the pixel where it is
  p999  what 99.9 % of the pixels do not exceed in any channel
  bias  mean of A minus B: above 0 where A is brighter
  ssim  structural similarity of luma as a screen shows it (Wang and others 2004); 1 if equal

The exit code is 1 if a measure exceeds its limit, or ssim is below its limit. A PNG is read as
sRGB, an EXR as linear. A layer is read as it is.";

/// Arguments of `pipeline compare`.
#[derive(Debug, Args)]
#[command(after_help = MEASURES)]
pub struct CompareArguments {
    /// A picture, PNG or EXR; - for standard input
    #[arg(value_name = "A")]
    first: PathBuf,
    /// The picture to compare it with, of the same size
    #[arg(value_name = "B")]
    second: PathBuf,
    /// Draw a map of the differences
    #[arg(long, value_name = "FILE.png")]
    map: Option<PathBuf>,
    /// Range of the errors in the map, linear:MOST or log:LEAST:MOST
    #[arg(long, value_name = "SCALE", default_value = "log:1e-4:1", requires = "map")]
    map_scale: Scale,
    /// The largest RMSE that is allowed
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = limit)]
    rmse: Option<f64>,
    /// The largest difference that is allowed
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = limit)]
    max: Option<f64>,
    /// The largest difference that is allowed in 99.9 % of the pixels
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = limit)]
    p999: Option<f64>,
    /// The least structural similarity that is allowed, up to 1
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = similarity)]
    ssim: Option<f64>,
    /// Compare only this part: column and row of its upper left pixel, and its size
    #[arg(long, value_name = "X,Y,WxH", value_parser = Crop::parse)]
    crop: Option<Crop>,
    /// Compare this layer or channel of two EXR files, such as normal or depth.Z, instead of their colours
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,
    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    common: CommonArguments,
}

/// Reads a limit of a difference: a finite number of at least 0.
fn limit(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| "expected a number of at least 0".into())
}

/// Reads a limit of the similarity: a number in [-1, 1].
fn similarity(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x| (-1.0..=1.0).contains(x));
    number.ok_or_else(|| "expected a number from -1 to 1".into())
}

/// A reason why a comparison fails.
#[derive(Debug, Error)]
enum Unequal {
    #[error("{first} differs from {second} by more than is allowed: {passed}")]
    Limits { first: String, second: String, passed: String },
    #[error("a map is a PNG file: found {0}, expected a name that ends in .png")]
    MapName(String),
    #[error("standard input was named twice, expected one of the pictures there")]
    TwiceStdin,
    #[error("pictures of {0}x{1} pixels have no structural similarity: expected 11x11 at least")]
    NoSimilarity(u32, u32),
    #[error("cannot encode {name}: {source}")]
    Encode { name: String, source: image::ImageError },
}

impl Failure for Unequal {
    fn exit(&self) -> Exit {
        match self {
            Self::Limits { .. } => Exit::Differ,
            Self::MapName(_) | Self::TwiceStdin | Self::NoSimilarity(..) => Exit::Use,
            Self::Encode { .. } => Exit::Resource,
        }
    }
}

/// Bytes for each pixel while two pictures are compared: both pictures, their differences, and the sums of
/// the similarity.
const OF_PIXEL: u64 = 2 * 12 + 2 * 8 + 10 * 8;

/// The measures, in the order in which they are printed.
#[derive(Debug, Serialize)]
struct Measures {
    width: u32,
    height: u32,
    rmse: f64,
    max: f64,
    /// Column and row of the largest difference in the whole picture, if there is one.
    max_at: Option<(u32, u32)>,
    p999: f64,
    bias: f64,
    ssim: Option<f64>,
}

/// Compares two pictures, draws the map, prints the measures and checks the limits.
pub fn compare(arguments: &CompareArguments) -> Result<(), Report> {
    let start = Instant::now();
    arguments.common.begin();
    let (first, second) = (&arguments.first, &arguments.second);
    if input::is_stdin(first) && input::is_stdin(second) {
        return Err(Unequal::TwiceStdin.into());
    }
    let ledger = arguments.common.ledger();
    if let Some(path) = &arguments.map {
        if Format::of(path) != Some(Format::Png) {
            return Err(Unequal::MapName(path.display().to_string()).into());
        }
        ledger.claim(path, "name another file with --map")?;
    }
    let [a, b] = read::pair(&ledger, first, second, arguments.crop, arguments.layer.as_deref())?;
    let pixels = a.pixels.len() as u64;
    let (width, height) = (a.width, a.height);
    let what = || format!("comparing pictures of {width}x{height} pixels");
    let _reserved = files::memory::of_process().reserve(pixels.saturating_mul(OF_PIXEL), what)?;
    let measures = Measures::of(&a, &b, arguments.crop)?;
    if arguments.ssim.is_some() && measures.ssim.is_none() {
        return Err(Unequal::NoSimilarity(a.width, a.height).into());
    }
    if let Some(path) = &arguments.map {
        let name = path.display().to_string();
        let bytes = map::png(&map::map(&a, &b, arguments.map_scale)?)
            .map_err(|source| Unequal::Encode { name, source })?;
        ledger.create(path)?.commit_all(&bytes)?;
        if !arguments.common.quiet && !input::is_stdin(path) {
            wrote(path, Some((width, height)), start.elapsed());
        }
    }
    let mut out = Output::create(Path::new("-"), true)?;
    measures.write(arguments.json, &mut out).map_err(|source| out.failed(source))?;
    out.commit()?;
    let passed = measures.passed(arguments);
    if passed.is_empty() {
        return Ok(());
    }
    let [first, second] = [first, second].map(|path| input::name_of(path));
    Err(Unequal::Limits { first, second, passed: passed.join(", ") }.into())
}

impl Measures {
    /// Measures two pictures. With `crop`, they are this part of two larger pictures.
    fn of(a: &Picture, b: &Picture, crop: Option<Crop>) -> Result<Self, CompareError> {
        let corner = crop.map_or((0, 0), |crop| (crop.x, crop.y));
        let Difference { pixels: _, rmse, max, p999, bias } = Difference::between(a, b, None)?;
        Ok(Self {
            width: a.width,
            height: a.height,
            rmse,
            max,
            max_at: difference::farthest(a, b)?.map(|(x, y)| (corner.0 + x, corner.1 + y)),
            p999,
            bias,
            ssim: ssim::ssim(a, b)?,
        })
    }

    /// Prints the measures: as lines with the digits of an `f32`, or as JSON in full precision.
    fn write(&self, json: bool, out: &mut impl Write) -> io::Result<()> {
        if json {
            serde_json::to_writer(&mut *out, self)?;
            return writeln!(out);
        }
        writeln!(out, "size  {}x{}", self.width, self.height)?;
        writeln!(out, "rmse  {}", number(self.rmse))?;
        match self.max_at {
            Some((x, y)) => writeln!(out, "max   {} at {x},{y}", number(self.max))?,
            None => writeln!(out, "max   {}", number(self.max))?,
        }
        writeln!(out, "p999  {}", number(self.p999))?;
        writeln!(out, "bias  {}", number(self.bias))?;
        match self.ssim {
            Some(ssim) => writeln!(out, "ssim  {}", number(ssim)),
            None => writeln!(out, "ssim  none, smaller than 11x11"),
        }
    }

    /// Returns a sentence for each limit that a measure exceeds or falls short of.
    fn passed(&self, limits: &CompareArguments) -> Vec<String> {
        let above = [
            ("rmse", self.rmse, limits.rmse),
            ("max", self.max, limits.max),
            ("p999", self.p999, limits.p999),
        ]
        .into_iter()
        .filter_map(|(name, found, limit)| Some((name, found, limit?)))
        .filter(|(_, found, limit)| found > limit)
        .map(|(name, found, limit)| format!("{name} {} is above {limit}", number(found)));
        let below = self.ssim.zip(limits.ssim).filter(|(found, limit)| found < limit);
        let below = below.map(|(found, limit)| format!("ssim {} is below {limit}", number(found)));
        above.chain(below).collect()
    }
}

/// Formats a number with the digits of an `f32`. More digits would be rounding errors.
fn number(x: f64) -> String {
    format!("{:?}", x as f32)
}
