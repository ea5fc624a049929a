//! Programs that draw the textures of the example scenes.
//!
//! | file               | drawn by         | what it shows                                     |
//! |--------------------|------------------|---------------------------------------------------|
//! | `checkerboard.png` | `checkerboard` | eight by eight checks, ivory and oxblood          |
//! | `vase-band.png`    | `vase_band`    | the painted bands of a blue and white vase        |
//! | `cup-band.png`     | `cup_band`       | stripes of a cream cup                            |
//! | `floor-tiles.png`  | `floor_tiles`  | octagons of stone with small squares between them |
//! | `granite.png`      | `granite`      | pink granite                                      |
//! | `scales.png`       | `scales`       | heights: rows of scales, each over the one above  |
//! | `drawing-board.png` | `drawing_board` | pale paper ruled in squares                      |
//! | `net.png`          | `net`          | light grey checks between dark lines              |
//! | `ribbon.png`       | `ribbon`       | slanting stripes of light grey                    |
//! | `graticule.png`    | `graticule`    | parallels and meridians of a globe                |
//! | `world-chart.png`  | `world_chart`  | an old chart of the world                         |
//! | `sea.png`          | `sea`          | the sea from above                                |
//! | `lettering.png`    | `lettering`    | a sheet of fine lettering                         |
//! | `hatching.png`     | `hatching`     | a fine net, its own mirror image                  |
//! | `plate.png`        | `plate`        | a page of a book of specimens                     |
//!
//! `canvas` samples the colour of points into a picture. `shape` has the outlines, `noise` the
//! irregularities and `color` the conversion between linear light and bytes. A picture depends on
//! this code alone. There is no clock and no entropy, and the only arithmetic is `+ − × ÷ √` and
//! rounding, which all machines compute alike.
//!
//! The program `draw-textures` writes all of them. Its bytes stay the same as long as the PNG encoder does.

mod alphabet;
mod canvas;
mod checkerboard;
mod coast;
mod color;
mod cup_band;
mod drawing_board;
mod floor_tiles;
mod granite;
mod graticule;
mod hatching;
mod lettering;
mod net;
mod noise;
mod plate;
mod ribbon;
mod scales;
mod sea;
mod shape;
mod vase_band;
mod world_chart;

use files::{Exit, Failure};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use thiserror::Error;

/// The PNG encoder refused a texture.
#[derive(Debug, Error)]
#[error("cannot encode {file}: {source}")]
pub struct EncodeError {
    file: &'static str,
    source: image::ImageError,
}

impl Failure for EncodeError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

/// A texture of the example scenes.
#[derive(Debug, Clone, Copy)]
pub struct Texture {
    /// The name of the texture's file in `examples/textures/`.
    pub file: &'static str,
    /// The function that draws the texture.
    pub draw: fn() -> RgbImage,
}

impl Texture {
    /// Returns the picture as PNG, with the row filter that makes the smallest file.
    ///
    /// # Errors
    /// When the encoder refuses the picture.
    pub fn png(&self) -> Result<Vec<u8>, EncodeError> {
        let picture = (self.draw)();
        let encode = |filter| {
            let mut bytes = Vec::new();
            PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, filter)
                .write_image(&picture, picture.width(), picture.height(), ExtendedColorType::Rgb8)
                .map_err(|source| EncodeError { file: self.file, source })?;
            Ok::<_, EncodeError>(bytes)
        };
        let mut smallest = encode(FilterType::NoFilter)?;
        for filter in [FilterType::Sub, FilterType::Up, FilterType::Paeth, FilterType::Adaptive] {
            let bytes = encode(filter)?;
            if bytes.len() < smallest.len() {
                smallest = bytes;
            }
        }
        Ok(smallest)
    }
}

/// All textures that this folder draws.
pub const TEXTURES: [Texture; 15] = [
    Texture { file: "checkerboard.png", draw: checkerboard::draw },
    Texture { file: "vase-band.png", draw: vase_band::draw },
    Texture { file: "cup-band.png", draw: cup_band::draw },
    Texture { file: "floor-tiles.png", draw: floor_tiles::draw },
    Texture { file: "granite.png", draw: granite::draw },
    Texture { file: "scales.png", draw: scales::draw },
    Texture { file: "drawing-board.png", draw: drawing_board::draw },
    Texture { file: "net.png", draw: net::draw },
    Texture { file: "ribbon.png", draw: ribbon::draw },
    Texture { file: "graticule.png", draw: graticule::draw },
    Texture { file: "world-chart.png", draw: world_chart::draw },
    Texture { file: "sea.png", draw: sea::draw },
    Texture { file: "lettering.png", draw: lettering::draw },
    Texture { file: "hatching.png", draw: hatching::draw },
    Texture { file: "plate.png", draw: plate::draw },
];
