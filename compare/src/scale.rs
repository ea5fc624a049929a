//! Maps errors to colours.

use colorous::INFERNO;
use std::str::FromStr;

/// The range of errors that a map distinguishes, from the first colour to the last. Errors outside it
/// have the colours at its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Errors from 0 to `most`, in even steps.
    Linear {
        /// The error that has the last colour, above 0.
        most: f64,
    },
    /// Errors from `least` to `most`, in even ratios.
    Log {
        /// The error that has the first colour, above 0.
        least: f64,
        /// The error that has the last colour, above `least`.
        most: f64,
    },
}

/// Four decades up to an error of 1, the range of the codes. The least error is a third of the light of
/// the first 8-bit code above black, which no PNG shows.
impl Default for Scale {
    fn default() -> Self {
        Self::Log { least: 1e-4, most: 1.0 }
    }
}

impl Scale {
    /// Returns the position of an error between the first colour, 0, and the last, 1. Errors outside
    /// the scale have the position of the nearer end.
    #[must_use]
    pub fn position(self, error: f64) -> f64 {
        let position = match self {
            Self::Linear { most } => error / most,
            Self::Log { least, most } => (error / least).ln() / (most / least).ln(),
        };
        // The logarithm of 0 is minus infinity, which is clamped to 0.
        position.clamp(0.0, 1.0)
    }

    /// Returns the error at a position in [0, 1].
    #[must_use]
    pub fn error(self, position: f64) -> f64 {
        match self {
            Self::Linear { most } => position * most,
            Self::Log { least, most } => least * (most / least).powf(position),
        }
    }

    /// Returns the colour of an error, as sRGB codes. The colours run from black over violet, red and
    /// orange to a pale yellow. They get lighter with every step (inferno, by van der Walt and Smith),
    /// so the map can also be read in grey.
    #[must_use]
    pub fn color(self, error: f64) -> [u8; 3] {
        color_at(self.position(error))
    }

    /// Returns errors to label in a legend, in rising order: the ends and the decades between them of a
    /// logarithmic scale, or five even steps of a linear one.
    #[must_use]
    pub fn ticks(self) -> Vec<f64> {
        match self {
            Self::Linear { most } => (0..=4).map(|k| most * f64::from(k) / 4.0).collect(),
            Self::Log { least, most } => {
                // The offsets keep -4 a whole number here, in whichever direction the logarithm of 1e-4
                // is rounded.
                let [low, high] = [least.log10() + 1e-9, most.log10() - 1e-9];
                let decades = low.ceil() as i32..=high.floor() as i32;
                let between = decades.map(|power| format!("1e{power}").parse().unwrap_or(least));
                std::iter::once(least).chain(between).chain([most]).collect()
            }
        }
    }
}

/// Returns the colour at a position in [0, 1], as sRGB codes. Positions outside are clamped.
#[must_use]
pub fn color_at(position: f64) -> [u8; 3] {
    let color = INFERNO.eval_continuous(position.clamp(0.0, 1.0));
    [color.r, color.g, color.b]
}

impl FromStr for Scale {
    type Err = String;

    /// Reads `linear:MOST` or `log:LEAST:MOST`.
    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
        let parts: Vec<&str> = text.split(':').collect();
        let scale = match parts[..] {
            ["linear", most] => number(most).map(|most| Self::Linear { most }),
            ["log", least, most] => number(least)
                .zip(number(most))
                .filter(|(least, most)| least < most)
                .map(|(least, most)| Self::Log { least, most }),
            _ => None,
        };
        scale.ok_or_else(|| {
            "expected linear:MOST or log:LEAST:MOST with errors above 0 in rising order, such as log:1e-4:1".into()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: [Scale; 3] = [
        Scale::Linear { most: 0.5 },
        Scale::Log { least: 1e-4, most: 1.0 },
        Scale::Log { least: 3e-3, most: 0.5 },
    ];

    #[test]
    fn errors_and_positions_are_each_others_inverse() {
        for scale in SCALES {
            for k in 0..=100 {
                let position = f64::from(k) / 100.0;
                let back = scale.position(scale.error(position));
                assert!((back - position).abs() < 1e-12, "{scale:?}: {position} {back}");
            }
        }
    }

    #[test]
    fn beyond_the_ends_are_the_ends() {
        for scale in SCALES {
            assert_eq!((scale.position(0.0), scale.position(1e9)), (0.0, 1.0));
            assert_eq!(scale.color(0.0), color_at(0.0));
            assert_eq!(scale.color(1e9), color_at(1.0));
        }
    }

    #[test]
    fn a_larger_error_is_lighter() {
        use render::color::Encoding;
        let luminance = |k: u32| {
            let light = Scale::default().color(Scale::default().error(f64::from(k) / 64.0));
            let [r, g, b] = light.map(|code| Encoding::Srgb.decode(f64::from(code) / 255.0));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((0..64).all(|k| luminance(k) < luminance(k + 1)));
    }

    #[test]
    fn legends_name_decades() {
        assert_eq!(Scale::default().ticks(), [1e-4, 1e-3, 1e-2, 1e-1, 1.0]);
        assert_eq!(Scale::Log { least: 3e-3, most: 0.5 }.ticks(), [3e-3, 1e-2, 1e-1, 0.5]);
        assert_eq!(Scale::Linear { most: 2.0 }.ticks(), [0.0, 0.5, 1.0, 1.5, 2.0]);
    }

    #[test]
    fn scales_are_read() {
        assert_eq!("linear:0.25".parse(), Ok(Scale::Linear { most: 0.25 }));
        assert_eq!("log:1e-4:1".parse(), Ok(Scale::default()));
        for bad in
            ["", "log", "log:1", "log:1:1", "log:0:1", "linear:0", "linear:-1", "linear:inf", "x:1"]
        {
            let error = bad.parse::<Scale>().unwrap_err();
            assert!(error.contains("log:LEAST:MOST"), "{bad}");
        }
    }
}
