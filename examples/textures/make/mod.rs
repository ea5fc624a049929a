//! The textures of the example scenes, drawn by program.
//!
//! | file               | drawn by         | what it shows                                     |
//! |--------------------|------------------|---------------------------------------------------|
//! | `checkerboard.png` | [`checkerboard`] | eight by eight checks, ivory and oxblood          |
//! | `vase-band.png`    | [`vase_band`]    | the painted bands of a blue and white vase        |
//! | `floor-tiles.png`  | [`floor_tiles`]  | octagons of stone with small squares between them |
//! | `granite.png`      | [`granite`]      | pink granite                                      |
//! | `scales.png`       | [`scales`]       | heights: rows of scales, each over the one above  |
//! | `drawing-board.png` | [`drawing_board`] | pale paper ruled in squares                      |
//! | `net.png`          | [`net`]          | light grey checks between dark lines              |
//! | `ribbon.png`       | [`ribbon`]       | slanting stripes of light grey                    |
//! | `graticule.png`    | [`graticule`]    | parallels and meridians of a globe                |
//! | `world-chart.png`  | [`world_chart`]  | an old chart of the world                         |
//! | `sea.png`          | [`sea`]          | the sea from above                                |
//! | `lettering.png`    | [`lettering`]    | a sheet of fine lettering                         |
//!
//! [`canvas`] samples a colour per point into a picture; [`shape`] has the outlines, [`noise`] the
//! irregularities and [`color`] the way between linear light and bytes. A picture depends on
//! nothing but this code: there is no clock, no entropy, and no arithmetic beyond `+ − × ÷ √` and
//! rounding, which every machine does alike.
//!
//! Both the example `make-textures` and the test `textures` include this folder by path.

mod alphabet;
mod canvas;
mod checkerboard;
mod coast;
mod color;
mod drawing_board;
mod floor_tiles;
mod granite;
mod graticule;
mod lettering;
mod net;
mod noise;
mod ribbon;
mod scales;
mod sea;
mod shape;
mod vase_band;
mod world_chart;

use image::RgbImage;

/// A texture of the example scenes.
#[derive(Debug, Clone, Copy)]
pub struct Texture {
    /// The name of its file in `examples/textures/`.
    pub file: &'static str,
    /// Draws it.
    pub draw: fn() -> RgbImage,
}

/// All textures that this folder draws.
pub const TEXTURES: [Texture; 12] = [
    Texture { file: "checkerboard.png", draw: checkerboard::draw },
    Texture { file: "vase-band.png", draw: vase_band::draw },
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
];
