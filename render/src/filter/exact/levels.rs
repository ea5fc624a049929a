//! The levels of a texture, and the choice among them.

use super::level::Level;
use super::line::LONGEST;
use super::octave;
use super::outline::{Axes, Outline};
use super::palette::{self, Palette, palette};
use super::range::{Range, Ranges};
use crate::filter::pyramid::{self, Pyramid};
use crate::texture::{Texture, Wrap};
use glam::DVec2;

/// Fewest texels of a level across the shorter axis of a footprint, if the level is not the finest.
///
/// Texels of a coarser level are averages already, and a footprint takes them whole or in part. With
/// fewer texels its edges blur. More texels mean more lines, and time.
const TEXELS_ACROSS: f64 = 2.5;

/// Most lines of a level that a footprint crosses.
///
/// Long footprints at 45 degrees cross many lines. Fewer lines bound their cost, but blur their ends.
pub const MOST_LINES: f64 = 64.0;

/// Most lines of a level in the average of a pixel.
///
/// With four times as many, pictures of the scenes that we measured change by less than 0.0001, and
/// the averages take twice the time or more. A pixel where a blurred end matters splits.
pub const FEW_LINES: f64 = 16.0;

/// Longest footprint that is averaged over its area, in texels. The average of a longer one is the
/// mean of the texture. Positions on such a footprint are exact to a thousandth of a texel.
const LARGEST: f64 = (1u64 << 40) as f64;

/// Shorter axis in texels up to which several quadrilaterals stand for a footprint.
///
/// Broader ones hide the shape of a texel's box. With a larger limit, more footprints cost twice as
/// much.
const THIN: f64 = 2.5;

/// Longer axis in texels up to which these quadrilaterals are moved along both axes of the texture.
/// Longer ones are moved across only, and their ends blur less than a texel's box. Moving all of them
/// along both axes costs up to twice as much.
const SHORT: f64 = 8.0;

/// The levels of a texture of `C` channels, from the finest.
#[derive(Debug)]
pub struct Levels<const C: usize> {
    levels: Vec<Stored<C>>,
    scales: Vec<Scale<C>>,
    ranges: Ranges<C>,
    /// Amount of light of one code of the texture.
    unit: f64,
    /// Number of finer levels with a side longer than [`LONGEST`], which are not stored.
    skipped: usize,
    /// The coarsest level for footprints that leave a clamped texture.
    edged: usize,
}

/// A level with texels of 8 or of 16 bits.
#[derive(Debug)]
enum Stored<const C: usize> {
    Short(Level<u8, C>),
    Wide(Level<u16, C>),
}

/// The numbers of a level.
#[derive(Debug, Clone, Copy)]
struct Scale<const C: usize> {
    /// Amount of light of one code.
    unit: f64,
    /// Standard deviation of each channel over the level, in light.
    deviation: [f64; C],
}

impl<const C: usize> Scale<C> {
    fn of(level: &Texture, channels: impl Fn([u16; 3]) -> [u16; C]) -> Self {
        let (mut sum, mut squares) = ([0.0; C], [0.0; C]);
        for &texel in &level.texels {
            for (c, code) in channels(texel).into_iter().enumerate() {
                sum[c] += f64::from(code);
                squares[c] += f64::from(code) * f64::from(code);
            }
        }
        let (unit, count) = (level.unit(), level.texels.len() as f64);
        let deviation = std::array::from_fn(|c| {
            let mean = sum[c] / count;
            (squares[c] / count - mean * mean).max(0.0).sqrt() * unit
        });
        Self { unit, deviation }
    }
}

impl<const C: usize> Levels<C> {
    /// Prepares the levels of a texture. `channels` picks the channels of a texel.
    #[must_use]
    pub fn build(texture: &Texture, channels: impl Fn([u16; 3]) -> [u16; C]) -> Self {
        let (mut levels, mut scales) = (Vec::new(), Vec::new());
        let mut add = |level: &Texture, palette: Option<Palette>| {
            if level.width.max(level.height) > LONGEST {
                return;
            }
            let codes = level.texels.iter().map(|&texel| channels(texel));
            levels.push(if let Some(palette) = palette {
                let index = |code| palette::index(&palette, code);
                let codes = codes.map(|texel| texel.map(index)).collect();
                Stored::Short(Level::new(codes, level.width, level.wrap, palette))
            } else {
                Stored::Wide(Level::new(codes.collect(), level.width, level.wrap, ()))
            });
            scales.push(Scale::of(level, &channels));
        };
        add(texture, palette(texture));
        Pyramid::build(texture).levels().iter().for_each(|level| add(level, None));
        let sizes = || pyramid::all_sizes(texture);
        let skipped = sizes().filter(|&(width, height)| width.max(height) > LONGEST).count();
        let detailed = sizes().filter(|&(width, height)| width.min(height) as f64 > MOST_LINES);
        let edged = detailed.count().saturating_sub(skipped).min(levels.len() - 1);
        let ranges = Ranges::of(texture, channels);
        Self { levels, scales, ranges, unit: texture.unit(), skipped, edged }
    }

    /// Memory of the levels, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let levels = self.levels.iter().map(|level| match level {
            Stored::Short(level) => level.bytes(),
            Stored::Wide(level) => level.bytes(),
        });
        levels.sum::<usize>() + size_of_val(self.scales.as_slice()) + self.ranges.bytes()
    }

    /// Returns the value of [`Self::bytes`] without building anything.
    #[must_use]
    pub fn bytes_for(texture: &Texture) -> u64 {
        let short = palette(texture).is_some();
        let sizes = pyramid::all_sizes(texture).enumerate();
        let stored = sizes.filter(|&(_, (width, height))| width.max(height) <= LONGEST);
        let levels = stored.map(|(k, (width, height))| {
            let level = match k {
                0 if short => Level::<u8, C>::bytes_for(width, height),
                _ => Level::<u16, C>::bytes_for(width, height),
            };
            level + size_of::<Scale<C>>() as u64
        });
        levels.sum::<u64>() + Ranges::<C>::bytes_for(texture)
    }

    /// Returns the range of codes near an outline: of all texels that interpolation on it reads.
    #[must_use]
    pub fn range(&self, outline: &Outline) -> Range<C> {
        let (low, high) = outline.bounds();
        self.ranges.around(low - 0.5, high + 0.5)
    }

    /// Returns the contrast of the texture near an outline with this range, in light. It is the largest
    /// of any channel.
    #[must_use]
    pub fn contrast(&self, range: &Range<C>, axes: Axes) -> f64 {
        let level = self.stored_level(axes.minor);
        let deviations = self.scales[level].deviation;
        let channels = range
            .iter()
            .zip(deviations)
            .map(|([low, high], deviation)| deviation.min(0.5 * self.unit * f64::from(high - low)));
        channels.fold(0.0, f64::max)
    }

    /// Returns the mean of the texture in light: the only texel of the last level.
    #[must_use]
    pub fn mean(&self) -> [f64; C] {
        let last = self.levels.len() - 1;
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from);
        self.average_on(last, |_| [square])
    }

    /// Returns the average over an outline in light. The outline is longer than a texel and crosses
    /// about `most_lines` lines at most.
    #[must_use]
    pub fn average(&self, texture: &Texture, outline: &Outline, most_lines: f64) -> [f64; C] {
        let Axes { major, minor, .. } = outline.axes;
        let (thin, short) = (minor <= THIN, major <= SHORT);
        // Four places or two have the variance of three quarters of a texel's box, along both axes or
        // across only. The outline grows by the rest.
        let grown = match (thin, short) {
            (false, _) => outline.grown(1.0, 1.0),
            (true, false) => outline.grown(1.0, 0.25),
            (true, true) => outline.grown(0.25, 0.25),
        };
        let level = self.level(texture, &grown, most_lines);
        if level + 1 == self.levels.len() || major > LARGEST {
            return self.mean();
        }
        match (thin, short) {
            (false, _) => self.over(texture, level, &[grown]),
            (true, false) => {
                let apart = 0.25 * outline.axes.across();
                self.over(texture, level, &[grown.moved(apart), grown.moved(-apart)])
            }
            (true, true) => {
                let places = [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]];
                self.over(texture, level, &places.map(|by| grown.moved(by.into())))
            }
        }
    }

    /// Returns the index of the level on which an outline is averaged.
    fn level(&self, texture: &Texture, outline: &Outline, most_lines: f64) -> usize {
        let (low, high) = outline.bounds();
        let lines = (high - low).min_element();
        let texels = (outline.axes.minor / TEXELS_ACROSS).max(lines / most_lines);
        let level = self.stored_level(texels);
        let size = DVec2::new(texture.width as f64, texture.height as f64);
        let inside = low.min_element() >= 0.0 && (size - high).min_element() >= 0.0;
        // The edge texels of a coarse level are broad, and a clamped texture continues with them.
        if texture.wrap == Wrap::Clamp && !inside { level.min(self.edged) } else { level }
    }

    /// Returns the index of the coarsest level whose texels have at most this side, in texels of the
    /// texture.
    fn stored_level(&self, side: f64) -> usize {
        octave(side).saturating_sub(self.skipped).min(self.levels.len() - 1)
    }

    /// Returns the mean of the averages over outlines of equal area and orientation on a level.
    fn over<const N: usize>(
        &self,
        texture: &Texture,
        level: usize,
        outlines: &[Outline; N],
    ) -> [f64; C] {
        let size = DVec2::new(texture.width as f64, texture.height as f64);
        self.average_on(level, |level| {
            let scale = level / size;
            outlines.map(|outline| outline.corners().map(|corner| scale * corner))
        })
    }

    /// Returns the mean of the averages over quadrilaterals on a level, in light. Their corners are in
    /// texels of the level and depend on the level's size.
    fn average_on<const N: usize>(
        &self,
        level: usize,
        corners: impl Fn(DVec2) -> [[DVec2; 4]; N],
    ) -> [f64; C] {
        let unit = self.scales[level].unit;
        let average = match &self.levels[level] {
            Stored::Short(level) => level.average(&corners(level.size())),
            Stored::Wide(level) => level.average(&corners(level.size())),
        };
        average.map(|code| unit * code)
    }
}
