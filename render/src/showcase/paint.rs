//! A colour as a command line states it.

use crate::color::Encoding;
use std::str::FromStr;

/// A colour in linear RGB, each channel from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint(pub [f64; 3]);

/// The colours with names, as sRGB codes.
const NAMED: [(&str, u32); 12] = [
    ("white", 0xf2f0eb),
    ("grey", 0x9a9a96),
    ("gray", 0x9a9a96),
    ("black", 0x26262a),
    ("red", 0xb8352d),
    ("orange", 0xd9822b),
    ("yellow", 0xe0b93c),
    ("green", 0x4f8f4a),
    ("teal", 0x2f8f8a),
    ("blue", 0x3568b0),
    ("purple", 0x7a4f9e),
    ("brown", 0x8a5a3b),
];

impl FromStr for Paint {
    type Err = String;

    /// Reads a name, the six digits of sRGB codes behind `#`, or three linear numbers.
    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, codes)) = NAMED.iter().find(|(name, _)| *name == text) {
            return Ok(Self::of_codes(*codes));
        }
        if let Some(digits) = text.strip_prefix('#')
            && digits.len() == 6
            && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
            && let Ok(codes) = u32::from_str_radix(digits, 16)
        {
            return Ok(Self::of_codes(codes));
        }
        let channels: Option<Vec<f64>> = text
            .split(',')
            .map(|word| word.trim().parse().ok().filter(|x| (0.0..=1.0).contains(x)))
            .collect();
        if let Some([red, green, blue]) = channels.as_deref() {
            return Ok(Self([*red, *green, *blue]));
        }
        let names: Vec<&str> = NAMED.iter().map(|(name, _)| *name).collect();
        let names = names.join(", ");
        Err(format!("expected #RRGGBB in sRGB, R,G,B from 0 to 1 in linear light, or {names}"))
    }
}

impl Paint {
    fn of_codes(codes: u32) -> Self {
        let channel = |shift: u32| Encoding::Srgb.decode(f64::from((codes >> shift) & 255) / 255.0);
        // Four digits are finer than the codes.
        Self([16, 8, 0].map(|shift| (1e4 * channel(shift)).round() / 1e4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_a_name_codes_or_numbers() {
        let paint = |text: &str| text.parse::<Paint>();
        assert_eq!(paint("#ffffff"), Ok(Paint([1.0; 3])));
        assert_eq!(paint("1, 0.5,0"), Ok(Paint([1.0, 0.5, 0.0])));
        assert_eq!(paint("grey"), paint("gray"));
        // The code 188 is the nearest to half the light.
        let Paint([half, ..]) = paint("#bc0000").unwrap();
        assert!((half - 0.5).abs() < 0.005, "{half}");
        for bad in ["", "#fff", "#gggggg", "#+12345", "1,2,3", "1,1", "pink"] {
            assert!(paint(bad).is_err(), "{bad}");
        }
    }
}
