//! Linear RGB, and the two encodings for 8-bit files.
//!
//! Inside the renderer a colour is three linear amounts of light. The white of an 8-bit file is 1.

use glam::DVec3;

/// Linear red, green and blue. 1 is the white of an 8-bit file; larger values are allowed.
pub type Color = DVec3;

/// The function from linear values to the codes of an 8-bit file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Encoding {
    /// The sRGB curve (IEC 61966-2-1).
    Srgb,
    /// A power with this positive exponent: `code = value^(1/gamma)`. This is our reading of the
    /// thesis's "gamma corrected" files (appendix B).
    Gamma(f64),
}

impl Encoding {
    /// Returns the code in `[0, 1]` of a linear value. Values outside `[0, 1]` are clamped.
    #[must_use]
    pub fn encode(self, linear: f64) -> f64 {
        let linear = linear.clamp(0.0, 1.0);
        match self {
            Self::Srgb if linear <= 0.003_130_8 => 12.92 * linear,
            Self::Srgb => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
            Self::Gamma(gamma) => linear.powf(1.0 / gamma),
        }
    }

    /// Returns the linear value in `[0, 1]` of a code in `[0, 1]`.
    #[must_use]
    pub fn decode(self, code: f64) -> f64 {
        match self {
            Self::Srgb if code <= 0.040_45 => code / 12.92,
            Self::Srgb => ((code + 0.055) / 1.055).powf(2.4),
            Self::Gamma(gamma) => code.powf(gamma),
        }
    }

    /// Returns the nearest 8-bit code of a linear value. Values outside `[0, 1]` are clamped.
    #[must_use]
    pub fn to_byte(self, linear: f64) -> u8 {
        (self.encode(linear) * 255.0).round() as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        for encoding in [Encoding::Srgb, Encoding::Gamma(2.2), Encoding::Gamma(1.0)] {
            for byte in 0..=255u8 {
                assert_eq!(encoding.to_byte(encoding.decode(f64::from(byte) / 255.0)), byte);
            }
        }
    }

    #[test]
    fn srgb_middle_grey_is_code_188() {
        assert_eq!(Encoding::Srgb.to_byte(0.5), 188);
        assert_eq!(Encoding::Srgb.to_byte(-1.0), 0);
        assert_eq!(Encoding::Srgb.to_byte(7.0), 255);
    }
}
