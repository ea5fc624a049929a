//! EXR files of every compression, in lines and in tiles.

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::LineOrder;
use exr::meta::header::LayerAttributes;
use exr::prelude::{Compression, SmallVec, Vec2, f16};
use std::io::Cursor;

/// Width and height of the seeds.
const SIZE: (usize, usize) = (7, 5);

/// Makes a small picture of every compression, of several sample types and layers.
#[must_use]
pub fn seeds() -> Vec<Vec<u8>> {
    let compressions = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ];
    let mut seeds = Vec::new();
    for (number, compression) in compressions.into_iter().enumerate() {
        let plain = Blocks::ScanLines;
        let tiles = Blocks::Tiles(Vec2(4, 4));
        seeds.extend(seed(compression, plain, &["B", "G", "R"], number % 2 == 0));
        seeds.extend(seed(compression, tiles, &["A", "B", "G", "R"], number % 2 == 1));
    }
    let layered = ["B", "G", "R", "depth.Z", "normal.X"];
    seeds.extend(seed(Compression::ZIP16, Blocks::ScanLines, &layered, false));
    seeds.extend(seed(Compression::RLE, Blocks::ScanLines, &["Y"], false));
    seeds
}

fn seed(compression: Compression, blocks: Blocks, names: &[&str], half: bool) -> Option<Vec<u8>> {
    let count = SIZE.0 * SIZE.1;
    let value = |k: usize, name: &str| if name == "A" { 1.0 } else { (k % 11) as f32 / 8.0 };
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = names
        .iter()
        .map(|name| {
            let values = (0..count).map(|k| value(k, name));
            let samples = if half {
                FlatSamples::F16(values.map(f16::from_f32).collect())
            } else {
                FlatSamples::F32(values.collect())
            };
            AnyChannel::new(*name, samples)
        })
        .collect();
    let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
    let layer = Layer::new(SIZE, LayerAttributes::default(), encoding, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).ok()?;
    Some(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_seeds_of_all_compressions_and_they_are_read() {
        let seeds = seeds();
        assert_eq!(seeds.len(), 18);
        let read = seeds.iter().filter(|seed| compare::read::decode("a", seed).is_ok());
        // The grey picture has no channels R, G and B.
        assert!(read.count() >= 15);
    }
}
