//! Colour ramps.

use super::blur::Blur;
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

    /// Returns the mean of the linear RGB colours at all positions of a distribution.
    #[must_use]
    pub(super) fn average(&self, positions: Blur) -> Color {
        if positions.variance == 0.0 {
            return self.color(positions.mean);
        }
        let Some(&(_, first)) = self.stops.first() else { return Color::ZERO };
        let tent = positions.tent();
        let average = self.stops.windows(2).fold(first, |sum, pair| {
            let [(low, from), (high, to)] = [pair[0], pair[1]];
            // The mean of a function that rises from 0 at `low` to 1 at `high`.
            let risen = if high > low {
                (tent.above(low) - tent.above(high)) / (high - low)
            } else {
                tent.beyond(low)
            };
            sum + risen * (to - from)
        });
        // Rises and falls of very bright colours leave roundings that exceed dark ones.
        let colors = || self.stops.iter().map(|(_, color)| *color);
        average.clamp(colors().fold(first, Color::min), colors().fold(first, Color::max))
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

    /// Each stop has its share of the tent. The sum is over the middles of 4000 intervals, and a
    /// step or a kink misplaces at most one.
    #[test]
    fn the_average_of_a_ramp_is_that_of_its_colours() {
        let stops = [(0.0, 0.25), (0.5, 0.75), (0.5, 0.0), (0.8, 1.0)];
        let ramp = Ramp::new(stops.map(|(at, grey)| (at, Color::splat(grey))).to_vec()).unwrap();
        let constant = Ramp::new(vec![(0.0, Color::X), (1.0, Color::X)]).unwrap();
        for mean in [-2.0, -0.1, 0.0, 0.3, 0.5, 0.75, 1.4] {
            assert_eq!(ramp.average(Blur::sharp(mean)), ramp.color(mean));
            for variance in [1e-6, 0.01, 0.1, 1.0_f64] {
                let reach = (6.0 * variance).sqrt();
                let sum: Color = (0..4000)
                    .map(|k| {
                        let place = (f64::from(k) + 0.5) / 2000.0 - 1.0;
                        (1.0 - place.abs()) / 2000.0 * ramp.color(mean + reach * place)
                    })
                    .sum();
                let average = ramp.average(Blur { mean, variance });
                assert!(average.abs_diff_eq(sum, 1e-3), "{mean} {variance}: {average} {sum}");
                assert_eq!(constant.average(Blur { mean, variance }), Color::X);
            }
        }
    }

    #[test]
    fn an_average_is_within_the_colours_however_bright_they_are() {
        let stops = [(0.0, 0.03), (0.1, 1e29), (0.24, 0.4), (0.5, 0.66), (1.0, 0.8)];
        let ramp = Ramp::new(stops.map(|(at, grey)| (at, Color::splat(grey))).to_vec()).unwrap();
        for k in 0..200 {
            let positions = Blur { mean: 0.01 * f64::from(k), variance: 1e-3 };
            let average = ramp.average(positions).x;
            assert!((0.03..=1e29).contains(&average), "{average} at {}", positions.mean);
        }
    }

    #[test]
    fn a_ramp_without_stops_or_with_falling_ones_is_none() {
        assert_eq!(Ramp::new(vec![]), None);
        assert_eq!(Ramp::new(vec![(0.5, Color::ONE), (0.2, Color::ONE)]), None);
        assert_eq!(Ramp::new(vec![(f64::NAN, Color::ONE)]), None);
    }
}
