use super::coverage::Window;
use super::level::Level;
use super::*;
use crate::texture::Wrap;
use proptest::prelude::*;

/// Clips a polygon to the half plane in which `inside` is not negative. `inside` is linear.
fn clip(polygon: &[DVec2], inside: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut kept = Vec::new();
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (to_a, to_b) = (inside(a), inside(b));
        if to_a >= 0.0 {
            kept.push(a);
        }
        if (to_a < 0.0) != (to_b < 0.0) {
            kept.push(a + to_a / (to_a - to_b) * (b - a));
        }
    }
    kept
}

fn area(polygon: &[DVec2]) -> f64 {
    let next = |k: usize| polygon[(k + 1) % polygon.len()];
    0.5 * (0..polygon.len()).map(|k| polygon[k].perp_dot(next(k))).sum::<f64>().abs()
}

/// Averages a texture, constant on each texel, over a convex polygon: each texel by the area of the
/// part of the polygon that lies on it.
fn by_clipping(texture: &Texture, corners: &[DVec2; 4]) -> f64 {
    let low = corners.iter().fold(DVec2::INFINITY, |low, &corner| low.min(corner)).floor();
    let high = corners.iter().fold(DVec2::NEG_INFINITY, |high, &corner| high.max(corner));
    let mut sum = 0.0;
    let mut y = low.y;
    while y < high.y {
        let row = clip(&clip(corners, |at| at.y - y), |at| y + 1.0 - at.y);
        let mut x = low.x;
        while x < high.x {
            let part = clip(&clip(&row, |at| at.x - x), |at| x + 1.0 - at.x);
            let i = texture.wrap.index(x, texture.width);
            let j = texture.wrap.index(y, texture.height);
            sum += area(&part) * f64::from(texture.texels[j * texture.width + i][0]);
            x += 1.0;
        }
        y += 1.0;
    }
    sum / area(corners)
}

fn wraps() -> impl Strategy<Value = Wrap> {
    prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp), Just(Wrap::Mirror)]
}

/// Returns pairs of numbers from `-range` to `range`. Some are whole, where special cases lie.
fn places(range: f64) -> impl Strategy<Value = DVec2> {
    let number =
        move || prop_oneof![-range..range, (-range..range).prop_map(|x: f64| 0.5 * x.round())];
    (number(), number()).prop_map(DVec2::from)
}

fn texture(width: usize, height: usize, wrap: Wrap, code: impl Fn(usize) -> [u16; 3]) -> Texture {
    let texels = (0..width * height).map(code).collect();
    Texture { width, height, wrap, texels, white: u16::MAX, ..Texture::default() }
}

/// A level of the first channel.
fn level_of(texture: &Texture) -> Level<u16, 1> {
    let codes = texture.texels.iter().map(|texel| [texel[0]]).collect();
    Level::new(codes, texture.width, texture.wrap, ())
}

/// Returns well mixed 16-bit codes.
fn mixed(k: usize) -> u16 {
    ((k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u16
}

proptest! {
    #[test]
    fn the_average_on_a_level_is_that_by_clipping(
        width in 1usize..90, height in 1usize..9, wrap in wraps(), center in places(60.0),
        a in places(40.0), b in places(6.0), swap in any::<bool>(),
    ) {
        let (width, height) = if swap { (height, width) } else { (width, height) };
        let [a, b] = if swap { [a, b].map(|side| DVec2::new(side.y, side.x)) } else { [a, b] };
        prop_assume!(a.perp_dot(b).abs() > 1e-3);
        let texture = texture(width, height, wrap, |k| [mixed(k); 3]);
        let corners = [center - a - b, center + a - b, center + a + b, center - a + b];
        let level = level_of(&texture);
        let truth = by_clipping(&texture, &corners);
        // Codes go up to 65535, positions to 100, areas down to 4e-3: 1e-16 of 65535 * 1e4 / 4e-3.
        for [found] in [level.by_sums(&corners), level.average(&[corners])] {
            prop_assert!((found - truth).abs() < 1e-4, "{found} {truth}");
        }
    }

    #[test]
    fn any_footprint_gives_a_finite_average_within_the_texture(
        corners in prop::array::uniform4(prop_oneof![
            places(3.0), Just(DVec2::NAN), Just(DVec2::INFINITY), places(1e9), places(1e300),
            places(1e-300),
        ]),
        center in places(2.0), sides in prop::array::uniform2(places(2.0)), fold in 0usize..4,
        width in 1usize..40, height in 1usize..40, wrap in wraps(),
    ) {
        let texture = texture(width, height, wrap, |k| [mixed(k) / 2 + 9000, 700, mixed(k + 9) / 4]);
        let exact = Exact::build(&texture);
        prop_assert_eq!(exact.bytes() as u64, Exact::bytes_for(&texture));
        let range = |c: usize| {
            let codes = texture.texels.iter().map(|texel| f64::from(texel[c]) / 65535.0);
            codes.fold((1.0, 0.0), |(low, high), code| (f64::min(low, code), f64::max(high, code)))
        };
        // Sides that are parallel, equal or zero.
        let [a, b] = match fold {
            0 => sides,
            1 => [sides[0], -2.0 * sides[0]],
            2 => [sides[0], DVec2::ZERO],
            _ => [DVec2::ZERO; 2],
        };
        let folded = [corners[0], corners[2], corners[1], corners[3]];
        for footprint in [
            Footprint::Quadrilateral(corners),
            Footprint::Quadrilateral(folded),
            Footprint::Parallelogram { center: corners[0], sides: [a, b] },
            Footprint::Parallelogram { center, sides: [corners[0], corners[1]] },
            Footprint::Rectangle { center, half: a.abs() },
            Footprint::Rectangle { center: corners[3], half: corners[0].abs() },
            Footprint::Point(corners[0]),
        ] {
            let found = exact.average(&texture, &footprint);
            for c in 0..3 {
                let (low, high) = range(c);
                // Far from the origin the shape has rounded corners, and its weights still sum to 1.
                let within = found[c] >= low - 1e-5 && found[c] <= high + 1e-5;
                prop_assert!(within, "channel {c} of {footprint:?}: {found}, {low} to {high}");
            }
        }
    }

    #[test]
    fn a_constant_texture_stays_constant(
        width in 1usize..70, height in 1usize..70, wrap in wraps(), center in places(3.0),
        a in places(2.0), b in places(0.3), code in any::<[u16; 3]>(),
    ) {
        let flat = texture(width, height, wrap, |_| code);
        let footprint = Footprint::Parallelogram { center, sides: [a, b] };
        let found = Exact::build(&flat).average(&flat, &footprint);
        let truth = DVec3::from(code.map(f64::from)) / 65535.0;
        prop_assert!((found - truth).abs().max_element() < 1e-6, "{found} {truth}");
    }

    /// A moved footprint differs only by the rounding of its coordinates.
    #[test]
    fn whole_periods_do_not_matter(
        center in places(0.9), a in places(0.3), b in places(0.05), mirror in any::<bool>(),
        periods in prop::array::uniform2(-40i32..40),
    ) {
        let wrap = if mirror { Wrap::Mirror } else { Wrap::Repeat };
        let texture = texture(37, 20, wrap, |k| [mixed(k), mixed(3 * k), 0]);
        let exact = Exact::build(&texture);
        let period = if mirror { 2.0 } else { 1.0 };
        let at = |center| exact.average(&texture, &Footprint::Parallelogram { center, sides: [a, b] });
        let moved = center + period * DVec2::from(periods.map(f64::from));
        prop_assert!((at(center) - at(moved)).abs().max_element() < 1e-9);
    }
}

/// Several quadrilaterals, whose windows are narrow, of middle width, wide, and too wide for coverage.
#[test]
fn the_average_over_several_is_the_mean_of_their_averages() {
    let texture = texture(61, 47, Wrap::Mirror, |k| [mixed(k); 3]);
    let level = level_of(&texture);
    for (length, widths) in [(3.0, 1..30), (20.0, 30..94), (90.0, 94..255), (200.0, 255..500)] {
        let (a, b) = (DVec2::new(length, 0.02 * length), DVec2::new(-1.5, 2.0));
        let outlines = [[0.0, 0.0], [0.5, -0.25], [-3.0, 1.75]].map(|by| {
            let center = DVec2::new(30.3, 21.6) + DVec2::from(by);
            [center - a - b, center + a - b, center + a + b, center - a + b]
        });
        let width = Window::around(&outlines).map_or(255, |window| window.width);
        assert!(widths.contains(&width), "{length}: {width} texels");
        let [found] = level.average(&outlines);
        let mean = outlines.iter().map(|outline| by_clipping(&texture, outline)).sum::<f64>() / 3.0;
        // As above, with areas from 12.
        assert!((found - mean).abs() < 1e-6, "{length}: {found} {mean}");
    }
}

/// The parts of a quadrilateral have together the integral of the whole, at any size of texture.
#[test]
fn a_quadrilateral_is_the_sum_of_its_parts() {
    for size in [512usize, 4096, 16384] {
        // Half of each row is black: the integrals along the rows are as large as can be.
        let code = |k: usize| [if k % size < size / 2 { mixed(k) / 8 } else { u16::MAX }; 3];
        let level = level_of(&texture(size, 32, Wrap::Repeat, code));
        for k in 0..200 {
            let random = |n: usize| f64::from(mixed(31 * k + n)) / 65536.0;
            let center = DVec2::new(size as f64 * random(1), 32.0 * random(2));
            let corner = |u: f64, v: f64, n: usize| {
                center + DVec2::new(6.0 * u + 2.0 * random(n), 3.0 * v + 2.0 * random(n + 1))
            };
            let [a, b, c, d] = [
                corner(-1.0, -1.0, 3),
                corner(1.0, -1.0, 5),
                corner(1.0, 1.0, 7),
                corner(-1.0, 1.0, 9),
            ];
            let [ab, bc, cd, da] = [(a, b), (b, c), (c, d), (d, a)].map(|(a, b)| 0.5 * (a + b));
            let middle = 0.5 * (ab + cd);
            let parts = [
                [a, ab, middle, da],
                [ab, b, bc, middle],
                [middle, bc, c, cd],
                [da, middle, cd, d],
            ];
            let [whole] = level.by_sums(&[a, b, c, d]);
            let sum: f64 = parts.iter().map(|part| area(part) * level.by_sums(part)[0]).sum();
            let difference = (whole - sum / area(&[a, b, c, d])).abs();
            // 1e-9 of full scale: sums of 1e9 in 53 bits, over areas from 1.
            assert!(difference / 65535.0 < 1e-9, "size {size}: {difference}");
        }
    }
}

#[test]
fn a_vanishing_footprint_is_bilinear() {
    let texture = texture(9, 7, Wrap::Clamp, |k| [mixed(k), 0, mixed(k + 1)]);
    let exact = Exact::build(&texture);
    for k in 0..50 {
        let at = DVec2::new(0.023 * f64::from(k), 0.5 - 0.017 * f64::from(k));
        let found = exact.average(&texture, &Footprint::Point(at));
        assert!(found.abs_diff_eq(texture.bilinear(at), 1e-12), "{found}");
    }
}

#[test]
fn eight_bits_take_five_bytes_for_each_texel_and_channel() {
    let bytes = |width: usize, height: usize, code: &dyn Fn(usize) -> [u16; 3], channels: usize| {
        let texture = texture(width, height, Wrap::Repeat, code);
        let exact = Exact::build(&texture);
        assert_eq!(exact.bytes() as u64, Exact::bytes_for(&texture));
        exact.bytes() as f64 / (width * height * channels) as f64
    };
    let short = |k: usize| mixed(k) & 255;
    for (width, height) in [(512, 512), (1000, 700)] {
        let color = |k| [short(k), short(k + 1), short(k + 2)];
        let found = bytes(width, height, &color, 3);
        assert!(found <= 5.0, "{found}");
        assert!(bytes(width, height, &|k| [short(k); 3], 1) <= 5.0);
        assert!(bytes(width, height, &|k| [mixed(k), mixed(k + 1), 0], 3) <= 8.0);
    }
}

/// The contrast is half the range of the texels near the footprint, or less, and 0 on a flat part.
#[test]
fn contrast_sees_the_texels_near_the_footprint() {
    // Black on the left, and bright, coloured stripes on the right.
    let code =
        |k: usize| if k % 256 < 128 { [0, 900, 0] } else { [0, 900, (k % 2) as u16 * 30000] };
    let texture = texture(256, 256, Wrap::Clamp, code);
    let exact = Exact::build(&texture);
    let look = |x: f64, side: f64| {
        let [a, b] = [DVec2::new(side, 0.1 * side), DVec2::new(0.0, side)];
        let footprint = Footprint::Parallelogram { center: DVec2::new(x, 0.5), sides: [a, b] };
        let (average, contrast) = exact.average_and_contrast(&texture, &footprint);
        assert_eq!(average, exact.average(&texture, &footprint));
        contrast
    };
    assert_eq!(look(0.2, 0.1), 0.0);
    // The deviation of the finest level: a quarter of all texels is bright.
    let deviation = (3.0f64 / 16.0).sqrt() * 30000.0 / 65535.0;
    assert!((look(0.7, 0.002) - deviation).abs() < 1e-9);
    // Stripes vanish from the level on whose texels hold two of them; both halves stay.
    let left = 0.5 * 15000.0 / 65535.0;
    assert!((look(0.7, 0.02) - left).abs() < 1e-4);
}

/// Rounding leaves no negative light, which a picture would show as a broken pixel.
#[test]
fn black_beside_white_is_never_below_black() {
    let texture = texture(9, 7, Wrap::Repeat, |k| [if k % 5 < 3 { 0 } else { u16::MAX }; 3]);
    let exact = Exact::build(&texture);
    for k in 0..5000 {
        let at = DVec2::new(0.0137 * f64::from(k), 0.0271 * f64::from(k));
        let [a, b] = [0.31, 0.17].map(|size| size * (1.0 + f64::from(k % 13)) / 9.0);
        let sides = [DVec2::new(a, 0.3 * b), DVec2::new(-0.2 * a, b)];
        let found = exact.average(&texture, &Footprint::Parallelogram { center: at, sides });
        assert!(found.min_element() >= 0.0 && found.max_element() <= 1.0, "{found}");
    }
}
