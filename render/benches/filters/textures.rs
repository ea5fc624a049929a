//! Four textures of 16-bit codes, as read from sRGB pictures: edges, a chirp, nature and letters.

use render::texture::Texture;

/// Texels along each side.
pub const SIDES: [usize; 4] = [512, 1024, 1024, 512];

/// Returns the textures with their names.
pub fn all() -> Vec<(&'static str, Texture)> {
    let clouds = clouds(SIDES[2]);
    vec![
        ("checks", texture(SIDES[0], |i, j| f64::from(u8::from((i / 8 + j / 8) % 2 == 0)))),
        ("zones", texture(SIDES[1], zones)),
        ("clouds", texture(SIDES[2], |i, j| clouds[j * SIDES[2] + i])),
        ("letters", texture(SIDES[3], letters)),
    ]
}

fn texture(side: usize, value: impl Fn(usize, usize) -> f64) -> Texture {
    let texels = (0..side * side)
        .map(|k| [(value(k % side, k / side).clamp(0.0, 1.0) * 65535.0).round() as u16; 3])
        .collect();
    Texture { width: side, height: side, texels, white: u16::MAX, ..Texture::default() }
}

/// Returns the value of black and white rings that become finer outward, down to 1.5 texels.
fn zones(i: usize, j: usize) -> f64 {
    let [x, y] = [i, j].map(|k| (k as f64 + 0.5 - 512.0) / 512.0);
    f64::from(u8::from((512.0 * 0.35 * std::f64::consts::PI * (x * x + y * y)).cos() > 0.0))
}

/// Returns repeating octaves of interpolated random values, each with half the amplitude of the one
/// before.
fn clouds(side: usize) -> Vec<f64> {
    let mut sum = vec![0.5; side * side];
    let mut height = 0.35;
    for octave in 2..=9u32 {
        let cells = 1usize << octave;
        let value = |i: usize, j: usize| {
            let k = (u64::from(octave) << 40 | ((j % cells) as u64) << 20 | (i % cells) as u64) + 1;
            let mixed = (k ^ (k >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for (k, sum) in sum.iter_mut().enumerate() {
            let place = |k: usize| {
                let at = k as f64 * cells as f64 / side as f64;
                (at as usize, at.fract())
            };
            let ((i, x), (j, y)) = (place(k % side), place(k / side));
            let row = |j| value(i, j) * (1.0 - x) + value(i + 1, j) * x;
            *sum += height * (row(j) * (1.0 - y) + row(j + 1) * y);
        }
        height *= 0.5;
    }
    sum
}

/// Bitmaps of letters: rows of five bits, seven rows per letter, the topmost first.
const LETTERS: [[u8; 7]; 8] = [
    [0x0e, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11],
    [0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e],
    [0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f],
    [0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11],
    [0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11],
    [0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11],
    [0x0e, 0x11, 0x10, 0x0e, 0x01, 0x11, 0x0e],
    [0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04],
];

/// Returns the value of black letters on white, two texels for each bit.
fn letters(i: usize, j: usize) -> f64 {
    let (column, row) = (i / 2, j / 2);
    let letter = &LETTERS[(column / 6 * 5 + row / 9 * 3) % 8];
    let ink = column % 6 < 5 && row % 9 < 7 && letter[row % 9] >> (4 - column % 6) & 1 == 1;
    f64::from(u8::from(!ink))
}
