//! Films of the frames of an animation.
//!
//! | extension | written by |
//! |---|---|
//! | `.png`, `.apng` | an animated PNG: all colours and the coverage, without loss |
//! | `.gif` | 256 colours in each frame; times are rounded to hundredths of a second |
//! | `.mp4`, `.mkv`, `.mov`, `.webm` | the program `ffmpeg`, if it is installed |
//!
//! A film plays without end where its format can say so.

use files::{Exit, Failure, FileError, Output};
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, DynamicImage, Frame};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use thiserror::Error;

/// The reason why a film cannot be made.
#[derive(Debug, Error)]
pub enum FilmError {
    /// The name has no extension of a film.
    #[error("--film {0}: expected a name that ends in .png, .gif, .mp4, .mkv, .mov or .webm")]
    Format(String),
    /// There is no `ffmpeg`.
    #[error(
        "--film {0} needs the program ffmpeg, which was not found: install it, or name a .png or .gif file"
    )]
    NoProgram(String),
    /// The program `ffmpeg` failed.
    #[error("--film {name}: ffmpeg failed: {said}")]
    Program {
        /// The film.
        name: String,
        /// The last line that it said.
        said: String,
    },
    /// A frame cannot be read.
    #[error("cannot read frame {name}: {source}")]
    Frame {
        /// The file of the frame.
        name: String,
        /// The reason.
        source: image::ImageError,
    },
    /// The frames differ in size.
    #[error(
        "frame {name} is {found:?} pixels, and the first one is {expected:?}: make all frames again"
    )]
    Size {
        /// The file of the frame.
        name: String,
        /// Its size.
        found: (u32, u32),
        /// The size of the first frame.
        expected: (u32, u32),
    },
    /// The film cannot be encoded.
    #[error("cannot write {name}: {said}")]
    Encode {
        /// The film.
        name: String,
        /// The reason.
        said: String,
    },
    /// The film cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl Failure for FilmError {
    fn exit(&self) -> Exit {
        match self {
            Self::Format(_) | Self::NoProgram(_) => Exit::Use,
            Self::Frame { .. } | Self::Program { .. } => Exit::ReadWrite,
            Self::Size { .. } => Exit::Malformed,
            Self::Encode { .. } => Exit::Resource,
            Self::File(error) => error.exit(),
        }
    }
}

/// The maker of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Maker {
    /// An animated PNG.
    Png,
    /// A GIF.
    Gif,
    /// The program `ffmpeg`.
    Program,
}

impl Maker {
    /// Returns the maker of a film by the extension of its file, and checks that it is there.
    ///
    /// # Errors
    /// If the extension is not that of a film, or the program is not installed.
    pub fn of(path: &Path) -> Result<Self, FilmError> {
        let name = || path.display().to_string();
        let extension = path.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("png" | "apng") => Ok(Self::Png),
            Some("gif") => Ok(Self::Gif),
            Some("mp4" | "mkv" | "mov" | "webm") => {
                let mut program = Command::new(PROGRAM);
                program.arg("-version").stdin(Stdio::null()).stdout(Stdio::null());
                match program.stderr(Stdio::null()).status() {
                    Ok(status) if status.success() => Ok(Self::Program),
                    _ => Err(FilmError::NoProgram(name())),
                }
            }
            _ => Err(FilmError::Format(name())),
        }
    }
}

const PROGRAM: &str = "ffmpeg";

/// Writes a film of frames, which are picture files, at `fps` frames per second. `output` is the open file at
/// `path`.
///
/// # Errors
/// If a frame cannot be read, or the film cannot be written.
pub fn write(
    maker: Maker,
    path: &Path,
    mut output: Output,
    frames: &[PathBuf],
    fps: f64,
) -> Result<(), FilmError> {
    match maker {
        Maker::Png => {
            let bytes = png(path, frames, fps)?;
            output.write_all(&bytes).map_err(|source| output.failed(source))?;
        }
        Maker::Gif => {
            let bytes = gif(path, frames, fps)?;
            output.write_all(&bytes).map_err(|source| output.failed(source))?;
        }
        Maker::Program => {
            let bytes = by_program(path, frames, fps)?;
            output.write_all(&bytes).map_err(|source| output.failed(source))?;
        }
    }
    Ok(output.commit()?)
}

/// Reads a frame, which must have the size of the first one.
fn read(path: &Path, first: &mut Option<(u32, u32)>) -> Result<DynamicImage, FilmError> {
    let name = || path.display().to_string();
    let picture = image::open(path).map_err(|source| FilmError::Frame { name: name(), source })?;
    let found = (picture.width(), picture.height());
    let expected = *first.get_or_insert(found);
    if found != expected {
        return Err(FilmError::Size { name: name(), found, expected });
    }
    Ok(picture)
}

/// Returns the bytes of an animated PNG.
fn png(path: &Path, frames: &[PathBuf], fps: f64) -> Result<Vec<u8>, FilmError> {
    let failed = |error: png::EncodingError| {
        let name = path.display().to_string();
        FilmError::Encode { name, said: error.to_string() }
    };
    let mut bytes = Vec::new();
    let mut size = None;
    let Some(file) = frames.first() else { return Ok(bytes) };
    let first = read(file, &mut size)?;
    let has_alpha = first.color().has_alpha();
    let mut encoder = png::Encoder::new(&mut bytes, first.width(), first.height());
    encoder.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_animated(frames.len() as u32, 0).map_err(failed)?;
    let [over, under] = delay(fps);
    encoder.set_frame_delay(over, under).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for (k, file) in frames.iter().enumerate() {
        let picture = if k == 0 { first.clone() } else { read(file, &mut size)? };
        let data =
            if has_alpha { picture.to_rgba8().into_raw() } else { picture.to_rgb8().into_raw() };
        writer.write_image_data(&data).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Returns the time of a frame in seconds as a fraction of 16-bit numbers.
fn delay(fps: f64) -> [u16; 2] {
    let scales = [1.0, 1000.0, 10.0, 1.0];
    let fits = |scale: &f64| fps * scale <= f64::from(u16::MAX) && (fps * scale).fract() == 0.0;
    let near = |scale: &f64| fps * scale <= f64::from(u16::MAX);
    let scale = scales.iter().copied().find(|scale| fits(scale));
    let scale = scale.or(scales[1..].iter().copied().find(|scale| near(scale))).unwrap_or(1.0);
    [scale as u16, (fps * scale).round().max(1.0) as u16]
}

/// Returns the bytes of a GIF.
fn gif(path: &Path, frames: &[PathBuf], fps: f64) -> Result<Vec<u8>, FilmError> {
    let failed = |error: image::ImageError| {
        let name = path.display().to_string();
        FilmError::Encode { name, said: error.to_string() }
    };
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new_with_speed(&mut bytes, 10);
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    let mut size = None;
    // Each frame ends at its time, rounded, so that roundings do not add up.
    let end = |k: usize| (100.0 * k as f64 / fps).round() as u32;
    for (k, file) in frames.iter().enumerate() {
        let picture = read(file, &mut size)?.to_rgba8();
        let delay = Delay::from_numer_denom_ms(10 * (end(k + 1) - end(k)), 1);
        encoder.encode_frame(Frame::from_parts(picture, 0, 0, delay)).map_err(failed)?;
    }
    drop(encoder);
    Ok(bytes)
}

/// Returns the bytes of a film that `ffmpeg` makes of the frames.
fn by_program(path: &Path, frames: &[PathBuf], fps: f64) -> Result<Vec<u8>, FilmError> {
    let name = || path.display().to_string();
    let said = |said: String| FilmError::Program { name: name(), said };
    let folder = tempfile::tempdir().map_err(|source| said(source.to_string()))?;
    let film = folder.path().join(path.file_name().unwrap_or_default());
    let errors = folder.path().join("errors");
    let log = fs::File::create(&errors).map_err(|source| said(source.to_string()))?;
    let mut command = Command::new(PROGRAM);
    command.args(["-y", "-loglevel", "error", "-f", "image2pipe", "-c:v", "png", "-framerate"]);
    command.args([&fps.to_string(), "-i", "-"]);
    // Most players need even sizes and this layout of colours.
    command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]);
    if path.extension().is_some_and(|extension| !extension.eq_ignore_ascii_case("webm")) {
        command.args(["-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"]);
    }
    command.arg(&film).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(log);
    let mut child = command.spawn().map_err(|source| said(source.to_string()))?;
    let fed = feed(&mut child.stdin.take(), frames);
    let status = child.wait().map_err(|source| said(source.to_string()))?;
    if !status.success() {
        let text = fs::read_to_string(&errors).unwrap_or_default();
        let last = text.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("no message");
        return Err(said(files::words::shown(last).to_string()));
    }
    fed.map_err(|source| said(source.to_string()))?;
    fs::read(&film).map_err(|source| said(source.to_string()))
}

/// Writes the files of the frames one after another.
fn feed(input: &mut Option<impl Write>, frames: &[PathBuf]) -> io::Result<()> {
    let Some(input) = input else { return Ok(()) };
    for frame in frames {
        input.write_all(&fs::read(frame)?)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::png::PngDecoder;
    use image::{Rgb, RgbImage};
    use std::io::Cursor;
    use std::time::Duration;

    /// Five frames of one colour each.
    fn frames(folder: &Path) -> Vec<PathBuf> {
        let frames = (0..5).map(|k| {
            let path = folder.join(format!("a.{k:04}.png"));
            RgbImage::from_pixel(7, 5, Rgb([50 * k, 255 - 50 * k, 0])).save(&path).unwrap();
            path
        });
        frames.collect()
    }

    fn assert_frames(found: &[Frame], tolerance: u8) {
        assert_eq!(found.len(), 5);
        for (k, frame) in (0..5).zip(found) {
            let pixel = frame.buffer().get_pixel(3, 2).0;
            let truth = [50 * k, 255 - 50 * k, 0, 255];
            assert!(pixel.iter().zip(truth).all(|(a, b)| a.abs_diff(b) <= tolerance), "{pixel:?}");
        }
    }

    #[test]
    fn animated_pictures_hold_their_frames_and_times() {
        let folder = tempfile::tempdir().unwrap();
        let frames = frames(folder.path());
        let bytes = png(Path::new("a.png"), &frames, 12.5).unwrap();
        let decoder = PngDecoder::new(Cursor::new(&bytes)).unwrap();
        let found = decoder.apng().unwrap().into_frames().collect_frames().unwrap();
        assert_frames(&found, 0);
        assert_eq!(Duration::from(found[1].delay()), Duration::from_millis(80));
        let bytes = gif(Path::new("a.gif"), &frames, 24.0).unwrap();
        let decoder = GifDecoder::new(Cursor::new(&bytes)).unwrap();
        let found = decoder.into_frames().collect_frames().unwrap();
        // A table of 256 colours holds the one colour of a frame nearly.
        assert_frames(&found, 2);
        let times: Vec<u64> =
            found.iter().map(|frame| Duration::from(frame.delay()).as_millis() as u64).collect();
        assert_eq!(times, [40, 40, 50, 40, 40]);
    }

    #[test]
    fn frames_of_another_size_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let frames = frames(folder.path());
        RgbImage::new(6, 5).save(&frames[3]).unwrap();
        let said = png(Path::new("a.png"), &frames, 24.0).unwrap_err().to_string();
        assert!(
            said.contains("a.0003.png is (6, 5) pixels, and the first one is (7, 5)"),
            "{said}"
        );
        fs::remove_file(&frames[0]).unwrap();
        let said = gif(Path::new("a.gif"), &frames, 24.0).unwrap_err().to_string();
        assert!(said.starts_with("cannot read frame ") && said.contains("a.0000.png"), "{said}");
    }

    #[test]
    fn the_extension_names_the_maker() {
        let of = |name: &str| Maker::of(Path::new(name));
        assert!(matches!((of("a.PNG"), of("a.gif")), (Ok(Maker::Png), Ok(Maker::Gif))));
        for name in ["a", "a.jpg", "a.webp"] {
            let said = of(name).unwrap_err();
            assert_eq!(said.exit(), Exit::Use);
            assert!(said.to_string().contains("expected a name that ends in .png"), "{said}");
        }
        match of("a.mp4") {
            Ok(maker) => assert_eq!(maker, Maker::Program),
            Err(error) => assert!(error.to_string().contains("which was not found: install it")),
        }
    }
}
