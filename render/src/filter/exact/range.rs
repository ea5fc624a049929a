//! Smallest and largest codes of a texture in any rectangle, from blocks of ever larger size.

use super::octave;
use crate::texture::{Texture, Wrap};
use glam::DVec2;

/// Texels along each side of the smallest blocks.
///
/// Half as many find more constant parts and take four times the memory: a third of a byte for each
/// texel and channel instead of a twelfth.
const BLOCK: usize = 8;

/// The range of codes of each channel: the smallest and the largest.
pub type Range<const C: usize> = [[u16; 2]; C];

/// Ranges of the blocks of a texture.
#[derive(Debug)]
pub struct Ranges<const C: usize> {
    width: usize,
    height: usize,
    wrap: Wrap,
    /// Blocks of [`BLOCK`] texels, of twice as many, and so on up to a single block.
    grids: Vec<Grid<C>>,
}

#[derive(Debug)]
struct Grid<const C: usize> {
    /// Number of blocks across.
    across: usize,
    blocks: Vec<Range<C>>,
}

/// Lists the numbers of blocks across and down, of each size.
fn counts(texture: &Texture) -> impl Iterator<Item = (usize, usize)> {
    let first = (texture.width.div_ceil(BLOCK), texture.height.div_ceil(BLOCK));
    std::iter::successors(Some(first), |&(across, down)| {
        ((across, down) != (1, 1)).then(|| (across.div_ceil(2), down.div_ceil(2)))
    })
}

fn join<const C: usize>(range: &mut Range<C>, other: &Range<C>) {
    for (range, other) in range.iter_mut().zip(other) {
        *range = [range[0].min(other[0]), range[1].max(other[1])];
    }
}

impl<const C: usize> Ranges<C> {
    /// Finds the ranges of a texture. `channels` picks the channels of a texel.
    #[must_use]
    pub fn of(texture: &Texture, channels: impl Fn([u16; 3]) -> [u16; C]) -> Self {
        const NONE: [u16; 2] = [u16::MAX, 0];
        let mut grids: Vec<Grid<C>> = Vec::new();
        for (across, down) in counts(texture) {
            let mut blocks = vec![[NONE; C]; across * down];
            if let Some(Grid { across: finer_across, blocks: finer }) = grids.last() {
                for (k, range) in finer.iter().enumerate() {
                    let (i, j) = (k % finer_across, k / finer_across);
                    join(&mut blocks[j / 2 * across + i / 2], range);
                }
            } else {
                for (k, &texel) in texture.texels.iter().enumerate() {
                    let (i, j) = (k % texture.width, k / texture.width);
                    let range = channels(texel).map(|code| [code; 2]);
                    join(&mut blocks[j / BLOCK * across + i / BLOCK], &range);
                }
            }
            grids.push(Grid { across, blocks });
        }
        Self { width: texture.width, height: texture.height, wrap: texture.wrap, grids }
    }

    /// Memory of the ranges, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.grids.iter().map(|grid| size_of_val(grid.blocks.as_slice())).sum()
    }

    /// Returns the value of [`Self::bytes`] without building anything.
    #[must_use]
    pub fn bytes_for(texture: &Texture) -> u64 {
        counts(texture).map(|(across, down)| (across * down * size_of::<Range<C>>()) as u64).sum()
    }

    /// Returns a range that holds all codes in the rectangle from `low` to `high`, in texels. It may be
    /// larger than needed. Texels whose edge lies on the rectangle's border may count.
    #[must_use]
    pub fn around(&self, low: DVec2, high: DVec2) -> Range<C> {
        let extent = (high - low).max_element() / BLOCK as f64;
        // The smallest block that is at least as large.
        let size = if extent > 1.0 { octave(extent.next_down()) + 1 } else { 0 };
        let top = self.grids.len() - 1;
        if size >= top {
            return self.grids[top].blocks[0];
        }
        let grid = &self.grids[size];
        let block = BLOCK << size;
        let columns = blocks(low.x, high.x, self.width, block, self.wrap);
        let rows = blocks(low.y, high.y, self.height, block, self.wrap);
        let mut range = grid.blocks[rows[0] * grid.across + columns[0]];
        for &row in &rows {
            for &column in &columns {
                join(&mut range, &grid.blocks[row * grid.across + column]);
            }
        }
        range
    }
}

/// Returns the blocks that texels from `low` to `high` touch along one axis, at most a block apart.
/// Some of the four are equal.
fn blocks(low: f64, high: f64, size: usize, block: usize, wrap: Wrap) -> [usize; 4] {
    let (from, to) = (low.floor(), high.floor());
    let ends = [from, to].map(|at| wrap.index(at, size) / block);
    if from >= 0.0 && to < size as f64 || wrap == Wrap::Clamp {
        return [ends[0], ends[1], ends[0], ends[1]];
    }
    let last = (size - 1) / block;
    // An edge of the texture may be between both. All blocks up to it count, the last of which may be
    // narrow.
    [ends[0], ends[1], 0, last]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_range_holds_the_texels_of_its_rectangle(
            width in 1usize..70, height in 1usize..70, x in -150.0..150.0f64, y in -150.0..150.0f64,
            across in 0.0..90.0f64, down in 0.0..90.0f64,
            wrap in prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp), Just(Wrap::Mirror)],
        ) {
            let code = |k: usize| ((k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u16;
            let texels = (0..width * height).map(|k| [code(k), 0, 7]).collect();
            let texture = Texture { width, height, wrap, texels, ..Texture::default() };
            let ranges = Ranges::of(&texture, |texel| texel);
            prop_assert_eq!(ranges.bytes() as u64, Ranges::<3>::bytes_for(&texture));
            let (low, high) = (DVec2::new(x, y), DVec2::new(x + across, y + down));
            let [[least, most], zeros, sevens] = ranges.around(low, high);
            prop_assert_eq!((zeros, sevens), ([0, 0], [7, 7]));
            let all = texture.texels.iter().map(|texel| texel[0]);
            prop_assert!(all.clone().any(|code| code == least) && all.clone().any(|code| code == most));
            for j in y.floor() as i64..=(y + down).floor() as i64 {
                for i in x.floor() as i64..=(x + across).floor() as i64 {
                    let column = wrap.index(i as f64, width);
                    let texel = texture.texels[wrap.index(j as f64, height) * width + column][0];
                    prop_assert!(texel >= least && texel <= most, "{texel}: {least} to {most}");
                }
            }
        }
    }

    #[test]
    fn a_small_rectangle_sees_only_its_blocks() {
        // White from column 24 on.
        let texels = (0..64 * 64).map(|k| [u16::from(k % 64 >= 24); 3]).collect();
        let texture = Texture { width: 64, height: 64, texels, ..Texture::default() };
        let ranges = Ranges::of(&texture, |[grey, ..]| [grey]);
        let around = |x: f64, side: f64| {
            let low = DVec2::new(x, 20.0);
            ranges.around(low, low + side)[0]
        };
        assert_eq!(
            [around(17.0, 6.0), around(24.0, 8.0), around(20.0, 6.0)],
            [[0, 0], [1, 1], [0, 1]]
        );
    }
}
