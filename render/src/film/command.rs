//! The command that makes a picture, for picture files.
//!
//! The command lists the flags on which the picture depends, always in the same order, so that files of
//! the same picture are equal. The command has no folders, threads, times or names of output files. A mesh that is given is written as
//! a file of its name.

use super::encode::Bits;
use super::{PixelFilter, Sampling, Settings, Supersample, THRESHOLD};
use crate::color::Encoding;
use crate::film::Pattern;
use clap::ValueEnum;

/// The names and flags of a command besides the settings of its picture.
#[derive(Debug, Clone, Copy)]
pub struct Named<'a> {
    /// File name of the scene, without folders.
    pub scene: &'a str,
    /// Names of the meshes that are given.
    pub meshes: &'a [&'a str],
    /// Values of the scene that the command line sets, each as `PATH=VALUE`.
    pub set: &'a [String],
    /// Flags that change how a mesh without a scene is shown.
    pub look: &'a [String],
    /// The requested error, which chooses the rays.
    pub error: Option<&'a str>,
    /// True if the background is transparent.
    pub alpha: bool,
    /// Encoding of a PNG.
    pub encoding: Encoding,
    /// Bits of a PNG.
    pub bits: Bits,
}

/// Returns the command that makes a picture with these settings.
#[must_use]
pub fn command(named: &Named<'_>, settings: &Settings) -> String {
    let mut words = vec!["render".to_string(), quoted(named.scene)];
    for name in named.meshes {
        words.extend(["--mesh".into(), quoted(&format!("{name}={name}.obj"))]);
    }
    for value in named.set {
        words.push(format!("-D {}", quoted(value)));
    }
    words.extend_from_slice(named.look);
    words.push(format!("--size {}x{}", settings.width, settings.height));
    if let Some(crop) = settings.crop {
        words.push(format!("--crop {},{},{}x{}", crop.x, crop.y, crop.width, crop.height));
    }
    match named.error {
        Some(error) => words.push(format!("--error {error}")),
        None => words.extend(sampling(settings.sampling)),
    }
    words.push(format!("--filter {}", settings.filter));
    if !settings.layers.is_empty() {
        let layers: Vec<&str> = settings.layers.iter().map(|layer| layer.name()).collect();
        words.push(format!("--layers {}", layers.join(",")));
    }
    if let Encoding::Gamma(gamma) = named.encoding {
        words.push(format!("--gamma {gamma}"));
    }
    if named.bits == Bits::Sixteen {
        words.push("--bits 16".into());
    }
    if named.alpha {
        words.push("--alpha".into());
    }
    words.join(" ")
}

/// Returns the flags of a sampling that differ from the defaults.
fn sampling(sampling: Sampling) -> Vec<String> {
    let mut words = Vec::new();
    let samples = |words: &mut Vec<String>, samples: u32| {
        if samples != 1 {
            words.push(format!("--samples {samples}"));
        }
    };
    let filter = match sampling {
        Sampling::Area { samples: count, pixel_filter, threshold } => {
            samples(&mut words, count);
            match threshold {
                None => words.push("--split none".into()),
                Some(THRESHOLD) => {}
                Some(threshold) => words.push(format!("--split {threshold}")),
            }
            pixel_filter
        }
        Sampling::Grid { samples: count, pattern, pixel_filter } => {
            words.push("--sampling thesis".into());
            samples(&mut words, count);
            if let Pattern::Jitter { seed } = pattern {
                words.push(format!("--pattern jitter --seed {seed}"));
            }
            pixel_filter
        }
        Sampling::Supersample(how) => {
            let how = match how {
                Supersample::Image => "image",
                Supersample::Rays => "rays",
            };
            words.push(format!("--sampling thesis --supersample={how}"));
            PixelFilter::Box
        }
    };
    if filter != PixelFilter::Box {
        let name = filter.to_possible_value();
        let name = name.as_ref().map_or("", |value| value.get_name());
        words.push(format!("--pixel-filter {name}"));
    }
    words
}

/// Returns a word as a shell reads it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_=.,/+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.into();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Crop, Layer};
    use crate::filter::Filter;

    #[test]
    fn a_command_has_the_flags_that_change_the_picture() {
        let named = Named {
            scene: "my scene.json",
            meshes: &["vase"],
            set: &["camera.up=[0, 0, 1]".into(), "camera.fov_deg=35".into()],
            look: &["--view 0,90".into()],
            error: None,
            alpha: true,
            encoding: Encoding::Gamma(2.2),
            bits: Bits::Sixteen,
        };
        let crop = Some(Crop { x: 1, y: 2, width: 3, height: 4 });
        let settings = Settings { crop, ..Settings::new(64, 48, Filter::Tent) };
        assert_eq!(
            command(&named, &settings),
            "render 'my scene.json' --mesh vase=vase.obj -D 'camera.up=[0, 0, 1]' \
             -D camera.fov_deg=35 --view 0,90 --size 64x48 --crop 1,2,3x4 --sampling thesis \
             --filter tent --gamma 2.2 --bits 16 --alpha"
        );
        let plain = Named {
            scene: "a.json",
            meshes: &[],
            set: &[],
            look: &[],
            alpha: false,
            encoding: Encoding::Srgb,
            bits: Bits::Eight,
            error: None,
        };
        let (samples, pixel_filter, threshold) = (2, PixelFilter::Tent, Some(0.02));
        let settings = Settings {
            layers: vec![Layer::Normal, Layer::Rays],
            sampling: Sampling::Area { samples, pixel_filter, threshold },
            ..Settings::new(8, 8, Filter::Exact)
        };
        assert_eq!(
            command(&plain, &settings),
            "render a.json --size 8x8 --samples 2 --split 0.02 --pixel-filter tent --filter exact \
             --layers normal,rays"
        );
        let error = Some("8bit");
        let settings = Settings::new(8, 8, Filter::Exact);
        assert_eq!(
            command(&Named { error, ..plain }, &settings),
            "render a.json --size 8x8 --error 8bit --filter exact"
        );
    }
}
