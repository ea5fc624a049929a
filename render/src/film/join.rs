//! Joins parts of a picture, which `render` made with `--tile` or `--crop`, to the whole picture.
//!
//! Each part states its place: a PNG by the command in its texts, an EXR by its data window. The whole is the file that
//! `render` writes without the crop, byte for byte, since the pixels of a part are those of the whole picture.
//! Pictures with a requested error are an exception: each part reaches the error by itself, so that the whole
//! reaches it too, but with other rays than a picture made at once.

mod part;

use super::Crop;
use super::encode::{Bits, Channels, Coding, write_channels, write_codes};
use crate::color::Encoding;
use exr::prelude::{AnyChannel, FlatSamples};
use files::{Exit, Failure};
use part::{Part, Pixels};
use std::io::Cursor;
use thiserror::Error;

/// The reason why parts cannot be joined.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum JoinError {
    /// A file is no part of a picture.
    #[error("{file}: found {found}, expected a PNG or EXR file that `render` made of a part")]
    Part {
        /// The file.
        file: String,
        /// A description of the file.
        found: String,
    },
    /// Two files are parts of different pictures.
    #[error("{file}: found {found}, expected {expected}, as in {first}: join parts of one picture")]
    Other {
        /// The file.
        file: String,
        /// The statement of this file.
        found: String,
        /// The statement of the first file.
        expected: String,
        /// The first file.
        first: String,
    },
    /// A pixel is in two parts.
    #[error("{file}: column {x}, row {y} is in another part too: leave one of the two out")]
    Twice {
        /// The second file with the pixel.
        file: String,
        /// Column of the pixel.
        x: u32,
        /// Row of the pixel.
        y: u32,
    },
    /// A pixel is in no part.
    #[error(
        "the parts leave out {count} pixels, the first at column {x}, row {y}: add the part that has it"
    )]
    Missing {
        /// The number of pixels.
        count: usize,
        /// Column of the first.
        x: u32,
        /// Row of the first.
        y: u32,
    },
    /// The whole picture cannot be encoded.
    #[error("cannot encode the whole picture: {0}")]
    Encode(String),
}

impl Failure for JoinError {
    fn exit(&self) -> Exit {
        match self {
            Self::Part { .. } | Self::Other { .. } => Exit::Malformed,
            Self::Twice { .. } | Self::Missing { .. } => Exit::Use,
            Self::Encode(_) => Exit::Resource,
        }
    }
}

/// Joins parts to a whole picture. Each part is the name and the bytes of a file. Returns the bytes of the whole
/// picture's file.
///
/// # Errors
/// If a file is no part of the same picture as the first one, or the parts do not cover the picture exactly once.
pub fn join(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, JoinError> {
    joined(files)?.encoded()
}

/// Joins parts as [`join`] does. The whole picture does not state the digest of its inputs.
///
/// # Errors
/// See [`join`].
pub fn join_without_digest(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, JoinError> {
    Part { inputs: None, ..joined(files)? }.encoded()
}

/// Joins parts to a whole picture that is not encoded yet.
fn joined(files: &[(String, Vec<u8>)]) -> Result<Part, JoinError> {
    let mut whole: Option<(&str, Part)> = None;
    let mut covered: Vec<bool> = Vec::new();
    for (file, bytes) in files {
        let part =
            Part::read(bytes).map_err(|found| JoinError::Part { file: file.clone(), found })?;
        if whole.is_none() {
            covered = vec![false; part.whole.0 as usize * part.whole.1 as usize];
            whole = Some((file, part.empty_whole()));
        }
        let Some((first, whole)) = &mut whole else { continue };
        let other = |found: String, expected: String| {
            let (file, first) = (file.clone(), (*first).to_string());
            Err(JoinError::Other { file, found, expected, first })
        };
        for (found, expected) in [
            (part.kind(), whole.kind()),
            (format!("the command `{}`", part.command), format!("`{}`", whole.command)),
            (part.digest(), whole.digest()),
        ] {
            if found.trim_start_matches("the command ") != expected {
                return other(found, expected);
            }
        }
        let width = part.whole.0 as usize;
        for y in part.crop.rows() {
            for x in part.crop.columns() {
                if std::mem::replace(&mut covered[y as usize * width + x as usize], true) {
                    return Err(JoinError::Twice { file: file.clone(), x, y });
                }
            }
        }
        whole.pixels.place(&part.pixels, &part.crop, width);
    }
    let Some((_, whole)) = whole else {
        return Err(JoinError::Missing { count: 0, x: 0, y: 0 });
    };
    if let Some(first) = covered.iter().position(|covered| !covered) {
        let count = covered.iter().filter(|covered| !**covered).count();
        let width = whole.whole.0 as usize;
        let [x, y] = [first % width, first / width].map(|at| at as u32);
        return Err(JoinError::Missing { count, x, y });
    }
    Ok(whole)
}

impl Part {
    /// A whole picture of the kind of this part, without values.
    fn empty_whole(&self) -> Self {
        let (width, height) = self.whole;
        let pixels = width as usize * height as usize;
        let pixels = match &self.pixels {
            Pixels::Png { bytes, has_coverage, bits, .. } => Pixels::Png {
                codes: vec![0; pixels * bytes],
                bytes: *bytes,
                has_coverage: *has_coverage,
                bits: *bits,
            },
            Pixels::Exr(channels) => Pixels::Exr(
                channels.iter().map(|(name, _)| (name.clone(), vec![0.0; pixels])).collect(),
            ),
        };
        let crop = Crop::whole(width, height);
        let (command, inputs) = (self.command.clone(), self.inputs.clone());
        Self { crop, whole: self.whole, command, inputs, pixels }
    }

    /// Describes the inputs of the picture.
    fn digest(&self) -> String {
        self.inputs
            .as_ref()
            .map_or("no digest".into(), |inputs| format!("inputs of digest {inputs}"))
    }

    /// Describes the file besides its command.
    fn kind(&self) -> String {
        let (width, height) = self.whole;
        let kind = match &self.pixels {
            Pixels::Png { has_coverage, bits, .. } => {
                let bits = if *bits == Bits::Eight { 8 } else { 16 };
                let coverage = if *has_coverage { " with coverage" } else { "" };
                format!("a PNG of {bits} bits{coverage}")
            }
            Pixels::Exr(channels) => {
                let names: Vec<&str> = channels.iter().map(|(name, _)| name.as_str()).collect();
                format!("an EXR of {}", names.join(", "))
            }
        };
        format!("{kind}, whole {width}x{height}")
    }

    /// Returns the bytes of the file.
    fn encoded(self) -> Result<Vec<u8>, JoinError> {
        let (width, height) = self.whole;
        let mut bytes = Cursor::new(Vec::new());
        let gamma = self.command.split(" --gamma ").nth(1);
        let gamma = gamma.and_then(|rest| rest.split(' ').next()?.parse().ok());
        let encoding = gamma.map_or(Encoding::Srgb, Encoding::Gamma);
        let (command, inputs) = (Some(self.command), self.inputs);
        let coding = Coding { command, inputs, ..Coding::new(encoding) };
        match self.pixels {
            Pixels::Png { codes, has_coverage, bits, .. } => {
                let coding = Coding { bits, ..coding };
                write_codes([width, height], has_coverage, &codes, &coding, &mut bytes)
                    .map_err(|error| JoinError::Encode(error.to_string()))?;
            }
            Pixels::Exr(channels) => {
                let channel = |(name, values): (String, Vec<f32>)| {
                    AnyChannel::new(name.as_str(), FlatSamples::F32(values))
                };
                let channels: Channels = channels.into_iter().map(channel).collect();
                write_channels([width, height], channels, &coding, &mut bytes)
                    .map_err(|error| JoinError::Encode(error.to_string()))?;
            }
        }
        Ok(bytes.into_inner())
    }
}

impl Pixels {
    /// Copies a part into a whole picture of the same kind and of this width.
    fn place(&mut self, part: &Self, crop: &Crop, width: usize) {
        let rows = || {
            crop.rows()
                .enumerate()
                .map(|(k, y)| (k * crop.width as usize, y as usize * width + crop.x as usize))
        };
        let across = crop.width as usize;
        match (self, part) {
            (Self::Png { codes, bytes, .. }, Self::Png { codes: part, .. }) => {
                for (from, to) in rows() {
                    let own = &part[from * *bytes..][..across * *bytes];
                    codes[to * *bytes..][..across * *bytes].copy_from_slice(own);
                }
            }
            (Self::Exr(channels), Self::Exr(part)) => {
                for ((_, values), (_, part)) in channels.iter_mut().zip(part) {
                    for (from, to) in rows() {
                        values[to..to + across].copy_from_slice(&part[from..from + across]);
                    }
                }
            }
            // Parts of different kinds were refused.
            (Self::Png { .. }, Self::Exr(_)) | (Self::Exr(_), Self::Png { .. }) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Picture;
    use crate::film::encode::{Format, encode_as};
    use crate::film::picture::Channel;

    /// A picture of 5 x 4 pixels without two equal values, with a layer.
    fn whole() -> Picture {
        let value = |k: usize| (k as f32 * 0.37).sin();
        let channel = |name, from: usize| Channel {
            name,
            values: (0..20).map(|k| value(from + k)).collect(),
        };
        Picture {
            pixels: (0..20).map(|k| [value(k), value(100 + k), value(200 + k)]).collect(),
            channels: vec![channel("depth.Z", 300), channel("object.id", 400)],
            ..Picture::black(5, 4)
        }
    }

    /// The file of a part, or of the whole.
    fn file(crop: Option<Crop>, format: Format, bits: Bits) -> Vec<u8> {
        file_of("abc", crop, format, bits)
    }

    /// The file of a part, or of the whole, of inputs with this digest.
    fn file_of(inputs: &str, crop: Option<Crop>, format: Format, bits: Bits) -> Vec<u8> {
        let all = whole();
        let own = crop.unwrap_or(Crop::whole(5, 4));
        let cut = |at: &dyn Fn(usize) -> f32| -> Vec<f32> {
            own.rows()
                .flat_map(|y| own.columns().map(move |x| (y * 5 + x) as usize))
                .map(at)
                .collect()
        };
        let channels = all
            .channels
            .iter()
            .map(|channel| Channel { name: channel.name, values: cut(&|k| channel.values[k]) });
        let colors: Vec<Vec<f32>> = (0..3).map(|c| cut(&|k| all.pixels[k][c])).collect();
        let picture = Picture {
            pixels: (0..colors[0].len())
                .map(|k| [colors[0][k], colors[1][k], colors[2][k]])
                .collect(),
            channels: channels.collect(),
            ..Picture::black(own.width, own.height)
        };
        let part = crop.map(|c| format!(" --crop {},{},{}x{}", c.x, c.y, c.width, c.height));
        let command = format!(
            "render a.json -D 'b= --size 1x1' --size 5x4{} --filter exact",
            part.unwrap_or_default()
        );
        let coding = Coding {
            bits,
            part: crop.map(|crop| (crop, [5, 4])),
            command: Some(command),
            inputs: Some(inputs.into()),
            ..Coding::new(Encoding::Srgb)
        };
        encode_as(&picture, format, &coding).unwrap()
    }

    /// Three parts that are no bands.
    fn crops() -> [Crop; 3] {
        [[0, 0, 5, 1], [0, 1, 2, 3], [2, 1, 3, 3]].map(|[x, y, width, height]| Crop {
            x,
            y,
            width,
            height,
        })
    }

    fn parts(format: Format, bits: Bits) -> Vec<(String, Vec<u8>)> {
        let file = |(k, crop): (usize, Crop)| (k.to_string(), file(Some(crop), format, bits));
        crops().into_iter().enumerate().map(file).collect()
    }

    #[test]
    fn parts_are_joined_to_the_file_of_the_whole() {
        for (format, bits) in
            [(Format::Png, Bits::Eight), (Format::Png, Bits::Sixteen), (Format::Exr, Bits::Eight)]
        {
            let mut parts = parts(format, bits);
            let truth = file(None, format, bits);
            assert!(join(&parts).unwrap() == truth, "{format:?}");
            parts.reverse();
            assert!(join(&parts).unwrap() == truth, "in any order");
            assert!(join(&[("whole".into(), truth.clone())]).unwrap() == truth);
            let undigested = join_without_digest(&parts).unwrap();
            let has = |bytes: &[u8]| bytes.windows(10).any(|own| own == b"Inputs\0abc");
            assert!(!has(&undigested) && has(&truth) == (format == Format::Png));
        }
    }

    #[test]
    fn parts_that_do_not_fit_are_named() {
        let good = parts(Format::Png, Bits::Eight);
        let said = |files: Vec<(String, Vec<u8>)>| join(&files).unwrap_err().to_string();
        assert!(
            said(good[..2].to_vec()).contains("leave out 9 pixels, the first at column 2, row 1")
        );
        let twice = [good.clone(), vec![("again".into(), good[1].1.clone())]].concat();
        assert!(said(twice).starts_with("again: column 0, row 1 is in another part too"));
        let other = [good[..2].to_vec(), parts(Format::Exr, Bits::Eight)[2..].to_vec()].concat();
        assert!(said(other).contains("2: found an EXR of"), "kinds differ");
        let other = [good[..2].to_vec(), parts(Format::Png, Bits::Sixteen)[2..].to_vec()].concat();
        assert!(said(other).contains("2: found a PNG of 16 bits"), "bits differ");
        let stale = file_of("abd", Some(crops()[2]), Format::Png, Bits::Eight);
        let other = [good[..2].to_vec(), vec![("stale".into(), stale)]].concat();
        assert!(
            said(other)
                .contains("stale: found inputs of digest abd, expected inputs of digest abc")
        );
        let cut = vec![("cut".to_string(), good[0].1[..60].to_vec())];
        assert!(said(cut).starts_with("cut: found a PNG that is broken"));
        assert!(said(vec![("text".into(), b"hello".to_vec())]).contains("another kind of file"));
        let plain = encode_as(&whole(), Format::Png, &Coding::new(Encoding::Srgb)).unwrap();
        assert!(said(vec![("plain".into(), plain)]).contains("without the command that made it"));
    }
}
