//! Linear colours, and the sRGB bytes of picture files.
//!
//! The transfer curve needs the power 2.4, which is computed by squares and a fifth root. A power
//! from the system's library may differ in its last bit from one machine to the next, and the
//! pictures must not.

use glam::DVec3;

/// A linear colour, red, green and blue in `[0, 1]`.
pub type Color = DVec3;

/// Returns the linear colour that a style sheet writes as `#rrggbb`.
pub fn srgb(rrggbb: u32) -> Color {
    let [_, r, g, b] = rrggbb.to_be_bytes();
    DVec3::new(
        decode(f64::from(r) / 255.0),
        decode(f64::from(g) / 255.0),
        decode(f64::from(b) / 255.0),
    )
}

/// Turns linear values into sRGB bytes, each to the nearest byte on the encoded scale.
#[derive(Debug)]
pub struct Encoder {
    /// The linear light, in [0, 1], from which on byte `i + 1` is nearer than byte `i`.
    ends: [f64; 255],
}

impl Encoder {
    /// Computes the end of each byte's range.
    pub fn new() -> Self {
        Self { ends: std::array::from_fn(|i| decode((i as f64 + 0.5) / 255.0)) }
    }

    /// Returns the three bytes of a colour. Values outside `[0, 1]` are clamped.
    pub fn bytes(&self, color: Color) -> [u8; 3] {
        // At most 255 ends lie below a value.
        color.to_array().map(|value| self.ends.partition_point(|&end| end <= value) as u8)
    }
}

/// Returns the linear light of an sRGB value, both in `[0, 1]` (IEC 61966-2-1).
fn decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        return encoded / 12.92;
    }
    // base^2.4 = base^2 · (base^2)^(1/5)
    let base_sq = ((encoded + 0.055) / 1.055) * ((encoded + 0.055) / 1.055);
    base_sq * fifth_root(base_sq)
}

/// Returns the fifth root of a value in `(0, 1]`, by Newton's method from above.
fn fifth_root(value: f64) -> f64 {
    // The smallest value passed is 0.008, the square of 0.0905. Its root is 0.38. From 1 on, each
    // step multiplies the estimate by about four fifths until the steps converge. Twenty steps are
    // more than enough.
    let mut root = 1.0_f64;
    for _ in 0..20 {
        let fourth = (root * root) * (root * root);
        root -= (root - value / fourth) / 5.0;
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decoding_is_the_curve_of_the_standard() {
        for byte in 0..=255_u8 {
            let encoded = f64::from(byte) / 255.0;
            let expected = match encoded {
                e if e <= 0.04045 => e / 12.92,
                e => ((e + 0.055) / 1.055).powf(2.4),
            };
            assert!((decode(encoded) - expected).abs() < 1e-15, "byte {byte}");
        }
    }

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        let encoder = Encoder::new();
        for byte in 0..=255_u32 {
            let grey = srgb(byte * 0x01_01_01);
            assert_eq!(encoder.bytes(grey), [byte as u8; 3]);
        }
    }

    #[test]
    fn values_beyond_the_ends_go_to_the_ends() {
        assert_eq!(Encoder::new().bytes(Color::new(-0.5, 2.0, 1.0)), [0, 255, 255]);
    }
}
