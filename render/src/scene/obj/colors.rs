//! The colours that some programs write behind the coordinates of a vertex.
//!
//! Three numbers from 0 to 1, or from 0 to 255 if one of them is above 1. They are codes of sRGB, as the
//! programs show them, and become linear. A fourth number, the opacity, is passed over. A vertex without
//! a colour is white.

use crate::color::Encoding;

/// Turns codes into linear RGB. A colour of NaN stands for none, and becomes white.
pub(super) fn decode(colors: &mut [[f32; 3]]) {
    // A comparison with NaN is false.
    let is_of_bytes = colors.iter().flatten().any(|&code| code > 1.0);
    let white = if is_of_bytes { 255.0 } else { 1.0 };
    for color in colors {
        *color = if color[0].is_nan() {
            [1.0; 3]
        } else {
            let linear = |code: f32| Encoding::Srgb.decode(f64::from(code / white).clamp(0.0, 1.0));
            color.map(|code| linear(code) as f32)
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_of_both_ranges_become_linear() {
        let mut parts = [[0.0, 1.0, 0.5], [f32::NAN; 3], [-0.25, 0.0, 0.0]];
        decode(&mut parts);
        assert_eq!((parts[0][0], parts[0][1], parts[1], parts[2]), (0.0, 1.0, [1.0; 3], [0.0; 3]));
        assert!((parts[0][2] - 0.214_041).abs() < 1e-6, "{parts:?}");
        let mut bytes = [[0.0, 255.0, 127.5], [1.0, 0.0, 300.0]];
        decode(&mut bytes);
        assert_eq!((bytes[0], bytes[1][2]), (parts[0], 1.0));
    }
}
