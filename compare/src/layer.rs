//! A layer or a single channel of an EXR file, as a picture.
//!
//! `normal` is the layer of the channels `normal.X`, `normal.Y` and `normal.Z`, and `normal.X` is one channel. A channel
//! alone, or a layer of one channel, becomes three equal channels, so that all measures are those of the channel. Of a
//! layer of two channels the third is their mean, so that the squares are not diluted by zeros.

use crate::read::ReadError;
use files::memory::of_process;
use files::picture::layers::{self, Channels};
use files::picture::{Format, PictureError};
use files::words::{LONGEST_LIST, cut};
use render::Picture;

/// Reads a layer from the bytes of a file, which messages call `name`. Values may be infinite.
///
/// # Errors
/// When the bytes are no EXR file, it has no such layer or channel, or the layer has more than three channels.
pub(crate) fn decode(name: &str, bytes: &[u8], layer: &str) -> Result<Picture, ReadError> {
    let no_picture = |found: String| ReadError::NoPicture { name: name.into(), found };
    if image::guess_format(bytes).ok() != Some(Format::OpenExr) {
        return Err(no_picture("no EXR file, which alone has layers".into()));
    }
    let (channels, _reserved) =
        layers::channels(bytes, of_process(), || name.into()).map_err(|error| match error {
            PictureError::Memory(error) => ReadError::Memory(error),
            error => no_picture(error.to_string()),
        })?;
    let Channels { width, height, list } = channels;
    let prefix = format!("{layer}.");
    let of_layer = |one: &&(String, Vec<f32>)| one.0 == layer || one.0.starts_with(&prefix);
    let own: Vec<&Vec<f32>> = list.iter().filter(of_layer).map(|one| &one.1).collect();
    let light = |k: usize| match own.as_slice() {
        [one] => Some([one[k]; 3]),
        [one, two] => Some([one[k], two[k], 0.5 * (one[k] + two[k])]),
        [one, two, three] => Some([one[k], two[k], three[k]]),
        _ => None,
    };
    let pixels: Option<Vec<[f32; 3]>> = (0..width as usize * height as usize).map(light).collect();
    pixels.map(|pixels| Picture { pixels, ..Picture::black(width, height) }).ok_or_else(|| {
        let known: Vec<&str> = list.iter().map(|one| one.0.as_str()).collect();
        let known = cut(&known.join(", "), LONGEST_LIST).to_string();
        ReadError::Layer { name: name.into(), layer: layer.into(), known }
    })
}

/// Makes values that are not finite and equal in both pictures 0 in both: the depth of a ray that hits nothing is
/// infinite.
pub(crate) fn level([a, b]: &mut [Picture; 2]) {
    let values = a.pixels.as_flattened_mut().iter_mut().zip(b.pixels.as_flattened_mut());
    for (a, b) in values.filter(|(a, b)| !a.is_finite() && a.to_bits() == b.to_bits()) {
        (*a, *b) = (0.0, 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Difference;
    use render::color::Encoding;
    use render::film::encode;
    use render::film::picture::Channel;

    fn file(depth: [f32; 2]) -> Vec<u8> {
        let channel = |name, values: [f32; 2]| Channel { name, values: values.into() };
        let channels = vec![
            channel("depth.Z", depth),
            channel("uv.U", [0.0, 1.0]),
            channel("uv.V", [0.5, 0.5]),
        ];
        let picture = Picture { channels, ..Picture::black(2, 1) };
        encode::encode(&picture, encode::Format::Exr, Encoding::Srgb).unwrap()
    }

    #[test]
    fn the_error_of_a_channel_is_that_of_its_numbers() {
        let both = [[1.0, f32::INFINITY], [1.5, f32::INFINITY]];
        for layer in ["depth", "depth.Z"] {
            let mut pair = both.map(|depth| decode("a.exr", &file(depth), layer).unwrap());
            level(&mut pair);
            let found = Difference::between(&pair[0], &pair[1], None).unwrap();
            assert_eq!((found.max, found.bias), (0.5, -0.25));
            assert!((found.rmse - (0.25f64 / 2.0).sqrt()).abs() < 1e-12, "{}", found.rmse);
        }
    }

    #[test]
    fn a_layer_that_is_missing_is_told_with_those_that_exist() {
        let error = decode("a.exr", &file([0.0; 2]), "normal").unwrap_err().to_string();
        assert!(error.contains("B, G, R, depth.Z, uv.U, uv.V"), "{error}");
        let uv = decode("a.exr", &file([0.0; 2]), "uv").unwrap();
        assert_eq!(uv.pixels, [[0.0, 0.5, 0.25], [1.0, 0.5, 0.75]]);
        let error = decode("a.exr", b"\x89PNG\r\n\x1a\n", "uv").unwrap_err().to_string();
        assert!(error.contains("no EXR file"), "{error}");
    }
}
