//! Prefiltered tables: textures integrated up to three times, and averages from them at constant
//! cost.
//!
//! Order 1 is Crow's summed area table and averages under a box. Order 2 averages under a tent and
//! order 3 under a quadratic B-spline (thesis 3.3.2, 3.3.3). The sums are wrapping integers of the
//! shortest sufficient word. An average therefore equals the exact real weights applied to the
//! exact texels, up to the rounding of its last few operations in `f64`. One axis is described in
//! [`super::axis`].

use super::axis::{self, Axis, Part};
use super::direct;
use super::reduce::HIGHEST;
use super::reduce::plus;
use super::weigh::weigh;
use super::word::Word;
use crate::color::Color;
use crate::texture::Texture;
use glam::{DVec2, DVec3};

/// A texture integrated `order` times along both axes.
#[derive(Debug)]
pub struct PrefilteredTable {
    order: usize,
    sums: Sums,
}

#[derive(Debug)]
enum Sums {
    Short(Vec<[u32; 3]>),
    Long(Vec<[u64; 3]>),
    Huge(Vec<[u128; 3]>),
}

/// Returns the bits of the shortest word that holds every result for such a texture: 32, 64 or 128.
///
/// The sums themselves may overflow the word. Only the reduced integers of [`super::reduce`] must
/// fit, with a sign. Their bound is the largest code times [`axis::sum_bound`] of each axis.
fn word_bits(texture: &Texture, order: usize) -> u32 {
    let bound = |size| axis::sum_bound(order, size, texture.wrap);
    let largest = f64::from(texture.white) * bound(texture.width) * bound(texture.height);
    let fits = |bits: &u32| largest.log2() < f64::from(bits - 1);
    [u32::BITS, u64::BITS].into_iter().find(fits).unwrap_or(u128::BITS)
}

impl PrefilteredTable {
    /// Integrates a texture; `order` is 1, 2 or 3.
    ///
    /// # Panics
    /// If `order` is any other number.
    #[must_use]
    pub fn build(texture: &Texture, order: usize) -> Self {
        assert!((1..=HIGHEST).contains(&order), "tables of order 1, 2 and 3 exist");
        let sums = match word_bits(texture, order) {
            u32::BITS => Sums::Short(integrate(texture, order)),
            u64::BITS => Sums::Long(integrate(texture, order)),
            _ => Sums::Huge(integrate(texture, order)),
        };
        Self { order, sums }
    }

    /// Memory of the table, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match &self.sums {
            Sums::Short(sums) => size_of_val(sums.as_slice()),
            Sums::Long(sums) => size_of_val(sums.as_slice()),
            Sums::Huge(sums) => size_of_val(sums.as_slice()),
        }
    }

    /// Returns the value of [`Self::bytes`] without building anything.
    #[must_use]
    pub fn bytes_for(texture: &Texture, order: usize) -> u64 {
        let entries = (texture.width + order) as u64 * (texture.height + order) as u64;
        3 * entries * u64::from(word_bits(texture, order) / 8)
    }

    /// Returns the average of the texture under the filter, linear RGB. `center` is the filter's
    /// middle and `half` its half-support, both in texture coordinates. `texture` is the one from
    /// which the table was built.
    #[must_use]
    pub fn average(&self, texture: &Texture, center: DVec2, half: DVec2) -> Color {
        let at = texture.in_texels(center);
        let half = half.abs() * DVec2::new(texture.width as f64, texture.height as f64);
        if !(at.is_finite() && half.is_finite()) {
            return texture.point(center);
        }
        let at = DVec2::new(
            texture.wrap.nearer(at.x, texture.width),
            texture.wrap.nearer(at.y, texture.height),
        );
        let step = (2.0 / self.order as f64 * half).max(DVec2::ONE);
        if step.max_element() <= direct::WIDEST[self.order] {
            return direct::average(texture, self.order, at, step);
        }
        self.average_from_sums(texture, at, half)
    }

    /// Averages any footprint with the table's integers. Positions and sizes are in texels.
    fn average_from_sums(&self, texture: &Texture, at: DVec2, half: DVec2) -> Color {
        let columns = axis::parts(self.order, at.x, half.x, texture.width, texture.wrap);
        let rows = axis::parts(self.order, at.y, half.y, texture.height, texture.wrap);
        let stride = texture.width + self.order;
        let mut sum = DVec3::ZERO;
        for Part { axis: row, share: row_share } in rows.iter().flatten() {
            for Part { axis: column, share: column_share } in columns.iter().flatten() {
                let average = match &self.sums {
                    Sums::Short(sums) => of_order(self.order, sums, stride, column, row),
                    Sums::Long(sums) => of_order(self.order, sums, stride, column, row),
                    Sums::Huge(sums) => of_order(self.order, sums, stride, column, row),
                };
                sum += row_share * column_share * average;
            }
        }
        sum * texture.unit()
    }
}

fn of_order<W: Word>(
    order: usize,
    sums: &[[W; 3]],
    stride: usize,
    column: &Axis,
    row: &Axis,
) -> DVec3 {
    match order {
        1 => weigh::<W, 1, 4, 3>(sums, stride, column, row),
        2 => weigh::<W, 2, 9, 6>(sums, stride, column, row),
        _ => weigh::<W, 3, 16, 11>(sums, stride, column, row),
    }
}

/// Builds the table `D_n(i, j)`, `i` in `0..width + n`, `j` in `0..height + n`, row by row.
fn integrate<W: Word>(texture: &Texture, order: usize) -> Vec<[W; 3]> {
    let (width, height) = (texture.width, texture.height);
    let stride = width + order;
    let mut table = vec![[W::default(); 3]; stride * (height + order)];
    // Texel (i, j) is stored n entries further on, so that n inclusive sums equal n exclusive ones.
    for (j, texels) in texture.texels.chunks_exact(width).enumerate() {
        let row = &mut table[(j + order) * stride..][..stride];
        for (entry, texel) in row[order..].iter_mut().zip(texels) {
            *entry = texel.map(W::from_code);
        }
        for _ in 0..order {
            for i in 1..stride {
                row[i] = plus(row[i], row[i - 1]);
            }
        }
    }
    for _ in 0..order {
        for j in 1..height + order {
            let (above, below) = table.split_at_mut(j * stride);
            for (entry, &before) in below[..stride].iter_mut().zip(&above[(j - 1) * stride..]) {
                *entry = plus(*entry, before);
            }
        }
    }
    table
}

#[cfg(test)]
mod tests;
