use super::*;
use crate::filter::kernel;
use crate::texture::Wrap;
use proptest::prelude::*;

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror];

/// A texture of pseudo-random codes.
fn texture(width: usize, height: usize, white: u16, wrap: Wrap) -> Texture {
    let code = |k: usize| ((k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u16;
    let texels = (0..width * height)
        .map(|k| [0, 1, 2].map(|c| code(3 * k + c) % (white.saturating_add(1)).max(2)))
        .collect();
    Texture { width, height, wrap, texels, white, ..Texture::default() }
}

/// Computes the average from the kernel's weight of each texel.
fn brute_force(texture: &Texture, order: usize, center: DVec2, half: DVec2) -> DVec3 {
    let at = texture.in_texels(center);
    let weights = |x: f64, half: f64, size: usize| {
        let mut weights = vec![0.0; size];
        let step = (2.0 * half / order as f64).max(1.0);
        for (i, weight) in kernel::weights(order, x, step) {
            weights[texture.wrap.index(i as f64, size)] += weight;
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
    for (x, y, w, h) in [(0, 0, 300, 200), (17, 3, 1, 1), (290, 150, 9, 50), (280, 190, 60, 25)] {
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

/// Compares averages from the table's own word with those from 128-bit sums, at many positions.
fn words_agree(texture: &Texture, order: usize, bits: u32, overflows: bool) {
    assert_eq!(word_bits(texture, order), bits, "order {order}");
    let table = PrefilteredTable::build(texture, order);
    let exact = PrefilteredTable { order, sums: Sums::Huge(integrate(texture, order)) };
    // The bottom right sum, the largest, does not fit the word and its sign. With order 1 this sum
    // is a result itself and fits.
    if let Sums::Huge(sums) = &exact.sums {
        assert_eq!(sums.last().is_some_and(|sum| sum[0] >> (bits - 1) > 0), overflows);
    }
    for k in 0..300 {
        let k = f64::from(k);
        let center = DVec2::new(0.37 * k, -0.11 * k);
        let half = DVec2::new((0.013 * k) % 0.9, (0.007 * k) % 0.6);
        let [short, long] =
            [&table, &exact].map(|table| table.average(texture, center, half).to_array());
        assert_eq!(short.map(f64::to_bits), long.map(f64::to_bits), "order {order}, {k}");
    }
}

#[test]
fn the_short_word_gives_the_same_average_though_it_overflows() {
    // Codes are bright, so that sums overflow.
    let bright = |width, height, white: u16| {
        let mut texture = texture(width, height, white, Wrap::Repeat);
        texture.texels.iter_mut().flatten().for_each(|code| *code = white - *code % 2);
        texture
    };
    words_agree(&bright(170, 170, u16::MAX), 1, 32, false);
    words_agree(&bright(128, 76, 255), 2, 32, true);
    words_agree(&bright(1500, 1500, u16::MAX), 2, 64, false);
    words_agree(&bright(22, 22, 255), 3, 32, false);
    words_agree(&bright(440, 440, u16::MAX), 3, 64, true);
}

#[test]
fn long_strips_of_16_bits_are_exact() {
    for (width, height) in [(16384, 64), (64, 16384)] {
        for (order, bits) in [(1, 64), (2, 64), (3, 128)] {
            let texture = texture(width, height, u16::MAX, Wrap::Repeat);
            let table = PrefilteredTable::build(&texture, order);
            assert_eq!(word_bits(&texture, order), bits);
            let exact = PrefilteredTable { order, sums: Sums::Huge(integrate(&texture, order)) };
            for (k, share) in [0.001, 0.02, 0.3, 0.7].into_iter().enumerate() {
                let center = DVec2::new(0.9 + 0.001 * k as f64, 0.013 * k as f64);
                let half = DVec2::new(share, 0.7 * share);
                let average = table.average(&texture, center, half);
                let bits = |color: DVec3| color.to_array().map(f64::to_bits);
                assert_eq!(bits(average), bits(exact.average(&texture, center, half)));
                let truth = brute_force(&texture, order, center, half);
                assert!(average.abs_diff_eq(truth, 1e-11), "order {order}: {average} {truth}");
            }
        }
    }
}

#[test]
fn the_shortest_sufficient_word_is_taken() {
    let bits = |width, height, white, order| {
        let texture = Texture { width, height, white, wrap: Wrap::Repeat, ..Texture::default() };
        word_bits(&texture, order)
    };
    assert_eq!(bits(512, 512, 255, 1), 32);
    assert_eq!(bits(512, 512, u16::MAX, 1), 64);
    assert_eq!(bits(512, 512, 255, 2), 64);
    assert_eq!(bits(512, 512, u16::MAX, 2), 64);
    assert_eq!(bits(512, 512, u16::MAX, 3), 128);
    assert_eq!(bits(128, 128, u16::MAX, 3), 64);
}

#[test]
fn a_word_shorter_than_the_rule_allows_goes_wrong() {
    let mut texture = texture(256, 256, u16::MAX, Wrap::Repeat);
    texture.texels.fill([u16::MAX; 3]);
    for order in 1..=3 {
        let short = PrefilteredTable { order, sums: Sums::Short(integrate(&texture, order)) };
        let wide = short.average(&texture, DVec2::splat(0.3), DVec2::splat(0.25 * order as f64));
        assert_eq!((wide.x - 1.0).abs() > 1e-3, order > 1, "order {order}: {wide}");
    }
}

#[test]
fn memory_is_known_before_it_is_taken() {
    for order in 1..=3 {
        for (width, height, white) in [(1, 1, 255), (40, 3, 65535), (300, 301, 65535)] {
            let texture = texture(width, height, white, Wrap::Mirror);
            let bytes = PrefilteredTable::build(&texture, order).bytes() as u64;
            assert_eq!(PrefilteredTable::bytes_for(&texture, order), bytes);
        }
    }
}

#[test]
fn footprints_without_size_or_place_stay_finite() {
    for (order, wrap) in (1..=3).flat_map(|order| WRAPS.map(|wrap| (order, wrap))) {
        for (width, height) in [(5, 3), (1, 1), (1, 7), (513, 2)] {
            let texture = texture(width, height, 255, wrap);
            let table = PrefilteredTable::build(&texture, order);
            let bads =
                [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300, -1e300, 1e6, 0.0, -0.3, 1e-320];
            for bad in bads {
                let far = table.average(&texture, DVec2::splat(bad), DVec2::splat(0.1));
                let wide = table.average(&texture, DVec2::splat(0.5), DVec2::splat(bad));
                let both = table.average(&texture, DVec2::new(bad, 0.2), DVec2::new(0.01, bad));
                for color in [far, wide, both] {
                    assert!(
                        color.min_element() >= -1e-9 && color.max_element() <= 1.0 + 1e-9,
                        "order {order}, {wrap:?}, {width} x {height}, {bad}: {color}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_huge_footprint_is_the_mean_of_what_repeats() {
    for (order, wrap) in
        (1..=3).flat_map(|order| [Wrap::Repeat, Wrap::Mirror].map(|wrap| (order, wrap)))
    {
        let texture = texture(37, 21, u16::MAX, wrap);
        let table = PrefilteredTable::build(&texture, order);
        let mean = texture.texels.iter().map(|texel| f64::from(texel[0])).sum::<f64>()
            / (37.0 * 21.0 * 65535.0);
        // A million texels along each axis: the part beyond whole periods counts below 1e-4.
        let half = DVec2::new(1e6 / 37.0, 1e6 / 21.0);
        let average = table.average(&texture, DVec2::new(0.123, -7.7), half).x;
        assert!((average - mean).abs() < 1e-4, "order {order}, {wrap:?}: {average} {mean}");
    }
}

proptest! {
    #[test]
    fn averages_are_those_of_the_kernel(
        width in 1usize..20, height in 1usize..20, order in 1usize..=3,
        wrap in prop::sample::select(&WRAPS), center in prop::array::uniform2(-3.0..3.0f64),
        half in prop::array::uniform2(prop_oneof![0.0..0.2f64, 0.0..3.0f64]),
    ) {
        let texture = texture(width, height, u16::MAX, wrap);
        let (center, mut half) = (DVec2::from(center), DVec2::from(half));
        if wrap == Wrap::Clamp {
            // Clamped footprints are exact up to this width.
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
        order in 1usize..=3, wrap in prop::sample::select(&WRAPS),
        center in prop::array::uniform2(prop_oneof![-1e3..1e3f64, -1e60..1e60f64, 9e15..9e16]),
        half in prop::array::uniform2(prop_oneof![0.0..0.2f64, 0.0..40.0f64]),
    ) {
        let mut texture = texture(7, 11, u16::MAX, wrap);
        texture.texels.fill([12345; 3]);
        let table = PrefilteredTable::build(&texture, order);
        let average = table.average(&texture, center.into(), half.into()).x * 65535.0;
        prop_assert!((average - 12345.0).abs() < 1e-8, "{average}");
    }

    /// A mirrored texture equals a repeated texture of itself beside its mirror image.
    #[test]
    fn mirroring_is_the_repetition_of_twice_the_texture(
        width in 1usize..9, height in 1usize..9, order in 1usize..=3,
        at in prop::array::uniform2(-40.0..40.0f64),
        half in prop::array::uniform2(0.0..40.0f64),
    ) {
        let mirrored = texture(width, height, 255, Wrap::Mirror);
        let mut twice = texture(2 * width, 2 * height, 255, Wrap::Repeat);
        for (k, texel) in twice.texels.iter_mut().enumerate() {
            let (i, j) = (k % (2 * width), k / (2 * width));
            let (i, j) = (i.min(2 * width - 1 - i), j.min(2 * height - 1 - j));
            *texel = mirrored.texels[j * width + i];
        }
        let [one, other] = [&mirrored, &twice].map(|texture| {
            PrefilteredTable::build(texture, order).average_from_sums(texture, at.into(), half.into())
        });
        prop_assert!(one.abs_diff_eq(other, 1e-11), "{one} {other}");
    }
}
