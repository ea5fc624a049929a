//! Colour ramps.

use crate::color::Color;

/// Colours at rising positions. Between positions the ramp is linear, and beyond the ends constant.
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    stops: Vec<(f64, Color)>,
}

impl Ramp {
    /// Creates a ramp through these positions and colours (linear RGB). Returns `None` without any
    /// colour, or if a position is not finite or less than the one before. Two colours at one
    /// position make a step.
    #[must_use]
    pub fn new(stops: Vec<(f64, Color)>) -> Option<Self> {
        let rising = stops.windows(2).all(|pair| pair[0].0 <= pair[1].0);
        let finite = stops.iter().all(|(position, _)| position.is_finite());
        (!stops.is_empty() && rising && finite).then_some(Self { stops })
    }

    /// Returns the linear RGB colour at a position. On a step it returns the upper side's colour.
    #[must_use]
    pub fn color(&self, position: f64) -> Color {
        let above = self.stops.partition_point(|(at, _)| *at <= position);
        match (above.checked_sub(1).map(|k| self.stops[k]), self.stops.get(above)) {
            (Some((_, last)), None) => last,
            (None, Some((_, first))) => *first,
            (Some((low, from)), Some((high, to))) => {
                from.lerp(*to, (position - low) / (high - low))
            }
            (None, None) => Color::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_linear_between_its_stops_and_constant_beyond() {
        let grey = Color::splat;
        let ramp = Ramp::new(vec![
            (0.0, grey(0.25)),
            (0.5, grey(0.75)),
            (0.5, grey(0.0)),
            (1.0, grey(1.0)),
        ])
        .unwrap();
        for (position, expected) in [
            (-3.0, 0.25),
            (0.0, 0.25),
            (0.25, 0.5),
            (0.5, 0.0),
            (0.75, 0.5),
            (1.0, 1.0),
            (9.0, 1.0),
        ] {
            assert_eq!(ramp.color(position), grey(expected), "{position}");
        }
    }

    #[test]
    fn a_ramp_without_stops_or_with_falling_ones_is_none() {
        assert_eq!(Ramp::new(vec![]), None);
        assert_eq!(Ramp::new(vec![(0.5, Color::ONE), (0.2, Color::ONE)]), None);
        assert_eq!(Ramp::new(vec![(f64::NAN, Color::ONE)]), None);
    }
}
