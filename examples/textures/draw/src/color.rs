//! Linear colours, and the sRGB bytes at the file's edge.
//!
//! The transfer curve needs the power 2.4. It is taken by squares and a fifth root, since a power
//! from the system's library may differ in its last bit from one machine to the next, and the
//! pictures must not.

use glam::DVec3;

/// A linear colour, red, green and blue in `[0, 1]`.
pub type Color = DVec3;

/// The colour that a style sheet writes as `#rrggbb`.
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
    /// Where, in linear light, byte `i` gives way to byte `i + 1`.
    ends: [f64; 255],
}

impl Encoder {
    /// Works out where each byte ends.
    pub fn new() -> Self {
        Self { ends: std::array::from_fn(|i| decode((i as f64 + 0.5) / 255.0)) }
    }

    /// The three bytes of a colour; values outside `[0, 1]` go to the nearer end.
    pub fn bytes(&self, color: Color) -> [u8; 3] {
        // At most 255 ends lie below a value.
        color.to_array().map(|value| self.ends.partition_point(|&end| end <= value) as u8)
    }
}

/// Linear light of an sRGB value, both in `[0, 1]` (IEC 61966-2-1).
fn decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        return encoded / 12.92;
    }
    // base^2.4 = base^2 · (base^2)^(1/5)
    let base_sq = ((encoded + 0.055) / 1.055) * ((encoded + 0.055) / 1.055);
    base_sq * fifth_root(base_sq)
}

/// The fifth root of a value in `(0, 1]`, by Newton's method from above.
fn fifth_root(value: f64) -> f64 {
    // The smallest value asked for is 0.008, the square of 0.0905: its root is 0.38, to which the
    // steps shrink by four fifths each before they converge. Twenty are more than enough.
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
