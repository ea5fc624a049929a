//! Prefiltered tables: textures integrated once or twice, and averages from them at constant cost.
//!
//! Order 1 is Crow's summed area table and averages under a box, order 2 under a tent
//! (thesis 3.3.2, 3.3.3). The sums are wrapping integers of the shortest sufficient word, so
//! every average is that of the exact real weights on the exact texels, up to the rounding of its
//! last few operations in `f64`. What one axis does is told in [`super::axis`].
//!
//! Entries are first reduced, along each axis, to integers as small as the footprint; only those
//! meet real weights.

use super::axis::{self, Axis, Entry, MOST, MOST_REDUCED, Part, Reduce};
use super::direct;
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

impl PrefilteredTable {
    /// Integrates a texture; `order` is 1 or 2.
    ///
    /// # Panics
    /// On any other order.
    #[must_use]
    pub fn build(texture: &Texture, order: usize) -> Self {
        assert!(order == 1 || order == 2, "tables of order 1 and 2 exist");
        let bound = |size| axis::sum_bound(order, size, texture.wrap);
        let largest = f64::from(texture.white) * bound(texture.width) * bound(texture.height);
        let bits = largest.log2();
        let sums = if bits < f64::from(<u32 as Word>::BITS - 1) {
            Sums::Short(integrate(texture, order))
        } else if bits < f64::from(<u64 as Word>::BITS - 1) {
            Sums::Long(integrate(texture, order))
        } else {
            Sums::Huge(integrate(texture, order))
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

    /// The average of the texture under the filter with the given middle and half-support, in
    /// texture coordinates. `texture` is the one the table was built from.
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
        let step = half.max(DVec2::ONE);
        if self.order == 2 && step.max_element() <= direct::WIDEST {
            return direct::tent(texture, at, step);
        }
        self.average_from_sums(texture, at, half)
    }

    /// The same for any footprint, from the integers; places and sizes in texels.
    fn average_from_sums(&self, texture: &Texture, at: DVec2, half: DVec2) -> Color {
        let columns = axis::parts(self.order, at.x, half.x, texture.width, texture.wrap);
        let rows = axis::parts(self.order, at.y, half.y, texture.height, texture.wrap);
        let stride = texture.width + self.order;
        let mut sum = DVec3::ZERO;
        for Part { axis: row, share: row_share } in rows.iter().flatten() {
            for Part { axis: column, share: column_share } in columns.iter().flatten() {
                let average = match &self.sums {
                    Sums::Short(sums) => weigh(sums, stride, column, row),
                    Sums::Long(sums) => weigh(sums, stride, column, row),
                    Sums::Huge(sums) => weigh(sums, stride, column, row),
                };
                sum += row_share * column_share * average;
            }
        }
        sum * texture.unit()
    }
}

/// The table `D_n(i, j)`, `i` in `0..width + n`, `j` in `0..height + n`, row by row.
fn integrate<W: Word>(texture: &Texture, order: usize) -> Vec<[W; 3]> {
    let (width, height) = (texture.width, texture.height);
    let stride = width + order;
    let mut table = vec![[W::default(); 3]; stride * (height + order)];
    // The texel (i, j) starts n entries further on, so that n exclusive sums bring it home.
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

/// Applies both axes to the table.
fn weigh<W: Word>(table: &[[W; 3]], stride: usize, column: &Axis, row: &Axis) -> DVec3 {
    let mut lines = [[[W::default(); 3]; MOST_REDUCED]; MOST];
    if column.plain && row.plain {
        // The usual case, in which every entry is a stored one.
        let per_point = if column.reduce == Reduce::Box { 2 } else { 3 };
        for (slot, line) in lines.iter_mut().enumerate().take(row.reduce.entries()) {
            let j = row.points[slot / per_point] as usize + slot % per_point;
            let stored = &table[j * stride..][..stride];
            let mut values = [[W::default(); 3]; MOST];
            for (values, &i) in values.chunks_exact_mut(per_point).zip(&column.points[..per_point])
            {
                values.copy_from_slice(&stored[i as usize..][..per_point]);
            }
            *line = reduced(column.reduce, &values);
        }
    } else {
        let entries: [Entry; MOST] = std::array::from_fn(|slot| column.entry(slot));
        let entries = &entries[..column.reduce.entries()];
        for (slot, line) in lines.iter_mut().enumerate().take(row.reduce.entries()) {
            let mut values = [[W::default(); 3]; MOST];
            for (j, row_factor) in row.entry(slot).used() {
                let stored = &table[j * stride..][..stride];
                for (value, entry) in values.iter_mut().zip(entries) {
                    let mut at = [W::default(); 3];
                    for (i, factor) in entry.used() {
                        at = plus(
                            at,
                            if factor == 1 { stored[i] } else { times(stored[i], factor) },
                        );
                    }
                    *value = plus(*value, if row_factor == 1 { at } else { times(at, row_factor) });
                }
            }
            *line = reduced(column.reduce, &values);
        }
    }
    let mut sum = DVec3::ZERO;
    for (i, &column_weight) in column.weights.iter().enumerate().take(column.reduce.reduced()) {
        let along = reduced(row.reduce, &std::array::from_fn(|slot| lines[slot][i]));
        let mut average = DVec3::ZERO;
        for (value, &weight) in along.iter().zip(&row.weights).take(row.reduce.reduced()) {
            average += weight * DVec3::from(value.map(W::to_f64));
        }
        sum += column_weight * average;
    }
    sum
}

/// The small integers of an axis from its entries; see [`super::axis`] for the formulas.
#[inline(always)]
pub(super) fn reduced<W: Word>(reduce: Reduce, d: &[[W; 3]; MOST]) -> [[W; 3]; MOST_REDUCED] {
    let mut small = [[W::default(); 3]; MOST_REDUCED];
    match reduce {
        Reduce::Mean => small[0] = d[0],
        Reduce::Box => {
            small[0] = minus(d[2], d[0]);
            small[1] = minus(d[3], d[2]);
            small[2] = minus(d[1], d[0]);
        }
        Reduce::Tent { m } => {
            let slope = [minus(d[1], d[0]), minus(d[4], d[3]), minus(d[7], d[6])];
            let bend = minus(minus(d[6], d[3]), minus(d[3], d[0]));
            small[0] = plus(bend, times(slope[1], m));
            small[1] = minus(slope[0], slope[1]);
            small[2] = minus(slope[2], slope[1]);
            for k in 0..3 {
                small[3 + k] = minus(minus(d[3 * k + 2], d[3 * k + 1]), slope[k]);
            }
        }
    }
    small
}

fn plus<W: Word>(a: [W; 3], b: [W; 3]) -> [W; 3] {
    [a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])]
}

fn times<W: Word>(a: [W; 3], factor: i64) -> [W; 3] {
    a.map(|word| word.times(factor))
}

fn minus<W: Word>(a: [W; 3], b: [W; 3]) -> [W; 3] {
    [a[0].minus(b[0]), a[1].minus(b[1]), a[2].minus(b[2])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;
    use proptest::prelude::*;

    /// A texture of codes from a counter that leaves no pattern.
    fn texture(width: usize, height: usize, white: u16, wrap: Wrap) -> Texture {
        let code = |k: usize| ((k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u16;
        let texels = (0..width * height)
            .map(|k| [0, 1, 2].map(|c| code(3 * k + c) % (white.saturating_add(1)).max(2)))
            .collect();
        Texture { width, height, wrap, texels, white }
    }

    /// The average by integer or real weights of each texel, worked out from the kernel.
    fn brute_force(texture: &Texture, order: usize, center: DVec2, half: DVec2) -> DVec3 {
        let at = texture.in_texels(center);
        let weights = |x: f64, half: f64, size: usize| {
            let mut weights = vec![0.0; size];
            let step = (2.0 * half / order as f64).max(1.0);
            let reach = (order as f64 * step) as i64 + 2;
            let integral = |z: f64| {
                let z = (z / step).clamp(-0.5 * order as f64, 0.5 * order as f64);
                match order {
                    1 => z + 0.5,
                    _ if z < 0.0 => 0.5 * (z + 1.0) * (z + 1.0),
                    _ => 1.0 - 0.5 * (1.0 - z) * (1.0 - z),
                }
            };
            for i in x as i64 - reach..=x as i64 + reach {
                let k = match texture.wrap {
                    Wrap::Repeat => i.rem_euclid(size as i64),
                    Wrap::Clamp => i.clamp(0, size as i64 - 1),
                };
                weights[k as usize] += integral((i + 1) as f64 - x) - integral(i as f64 - x);
            }
            weights
        };
        let columns = weights(at.x, half.x * texture.width as f64, texture.width);
        let rows = weights(at.y, half.y * texture.height as f64, texture.height);
        let mut sum = DVec3::ZERO;
        for (j, row) in rows.iter().enumerate() {
            for (i, column) in columns.iter().enumerate() {
                let texel = texture.texels[j * texture.width + i].map(f64::from);
                sum += row * column * DVec3::from(texel);
            }
        }
        sum * texture.unit()
    }

    #[test]
    fn a_whole_rectangle_is_the_exact_integer_sum() {
        // 16-bit texels and sums that wrap a 32-bit word many times over.
        let texture = texture(300, 200, u16::MAX, Wrap::Repeat);
        let table = PrefilteredTable::build(&texture, 1);
        for (x, y, w, h) in [(0, 0, 300, 200), (17, 3, 1, 1), (290, 150, 9, 50), (280, 190, 60, 25)]
        {
            let exact: u64 = (y..y + h)
                .flat_map(|j| (x..x + w).map(move |i| (i % 300, j % 200)))
                .map(|(i, j)| u64::from(texture.texels[j * 300 + i][1]))
                .sum();
            let size = DVec2::new(w as f64 / 300.0, h as f64 / 200.0);
            let corner = DVec2::new(x as f64 / 300.0, 1.0 - y as f64 / 200.0);
            let center = corner + DVec2::new(0.5, -0.5) * size;
            let sum = table.average(&texture, center, 0.5 * size).y * 65535.0 * (w * h) as f64;
            assert!((sum - exact as f64).abs() <= 1e-9 * exact as f64, "{sum} {exact}");
        }
    }

    #[test]
    fn every_word_gives_the_same_average_though_the_short_one_overflows() {
        let mut texture = texture(128, 64, 255, Wrap::Repeat);
        texture.texels.iter_mut().flatten().for_each(|code| *code = 254 + *code % 2);
        let tables = [
            Sums::Short(integrate(&texture, 2)),
            Sums::Long(integrate(&texture, 2)),
            Sums::Huge(integrate(&texture, 2)),
        ]
        .map(|sums| PrefilteredTable { order: 2, sums });
        let Sums::Long(long) = &tables[1].sums else { unreachable!() };
        assert!(long.iter().flatten().any(|&sum| sum > u64::from(u32::MAX)), "the test is idle");
        for k in 0..500 {
            let k = f64::from(k);
            let center = DVec2::new(0.37 * k, -0.11 * k);
            let half = DVec2::new((0.013 * k) % 0.9, (0.007 * k) % 0.6);
            let averages = tables.each_ref().map(|table| table.average(&texture, center, half));
            assert_eq!(averages[0], averages[1]);
            assert_eq!(averages[1], averages[2]);
        }
    }

    #[test]
    fn the_shortest_sufficient_word_is_taken() {
        let bytes = |width, height, white, order| {
            let texture = texture(width, height, white, Wrap::Repeat);
            let entries = (width + order) * (height + order);
            PrefilteredTable::build(&texture, order).bytes() / (3 * entries)
        };
        assert_eq!(bytes(512, 512, 255, 1), 4);
        assert_eq!(bytes(512, 512, 255, 2), 8);
        assert_eq!(bytes(512, 512, u16::MAX, 2), 8);
    }

    #[test]
    fn footprints_without_size_or_place_stay_finite() {
        let ways = [(1, Wrap::Repeat), (1, Wrap::Clamp), (2, Wrap::Repeat), (2, Wrap::Clamp)];
        for (order, wrap) in ways {
            let texture = texture(5, 3, 255, wrap);
            let table = PrefilteredTable::build(&texture, order);
            for bad in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
                let far = table.average(&texture, DVec2::splat(bad), DVec2::splat(0.1));
                let wide = table.average(&texture, DVec2::splat(0.5), DVec2::splat(bad));
                for color in [far, wide] {
                    assert!(color.min_element() >= -1e-9 && color.max_element() <= 1.0 + 1e-9);
                }
            }
        }
    }

    proptest! {
        #[test]
        fn averages_are_those_of_the_kernel(
            width in 1usize..20, height in 1usize..20, order in 1usize..=2,
            clamp in any::<bool>(), center in prop::array::uniform2(-3.0..3.0f64),
            half in prop::array::uniform2(prop_oneof![0.0..0.2f64, 0.0..3.0f64]),
        ) {
            let wrap = if clamp { Wrap::Clamp } else { Wrap::Repeat };
            let texture = texture(width, height, u16::MAX, wrap);
            let (center, mut half) = (DVec2::from(center), DVec2::from(half));
            if clamp {
                // Within the width up to which clamped footprints are exact.
                half = half.min(DVec2::splat(2.0));
            }
            let table = PrefilteredTable::build(&texture, order);
            let truth = brute_force(&texture, order, center, half);
            let average = table.average(&texture, center, half);
            prop_assert!(average.abs_diff_eq(truth, 1e-11), "{average} {truth}");
            let size = DVec2::new(width as f64, height as f64);
            let sums = table.average_from_sums(&texture, texture.in_texels(center), half * size);
            prop_assert!(sums.abs_diff_eq(truth, 1e-11), "{sums} {truth}");
        }

        #[test]
        fn a_constant_texture_stays_constant(
            order in 1usize..=2, clamp in any::<bool>(),
            center in prop::array::uniform2(prop_oneof![-1e3..1e3f64, -1e60..1e60f64, 9e15..9e16]),
            half in prop::array::uniform2(prop_oneof![0.0..0.2f64, 0.0..40.0f64]),
        ) {
            let wrap = if clamp { Wrap::Clamp } else { Wrap::Repeat };
            let mut texture = texture(7, 11, u16::MAX, wrap);
            texture.texels.fill([12345; 3]);
            let table = PrefilteredTable::build(&texture, order);
            let average = table.average(&texture, center.into(), half.into()).x * 65535.0;
            prop_assert!((average - 12345.0).abs() < 1e-8, "{average}");
        }
    }
}
