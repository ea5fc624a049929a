//! Colours that depend on an angle: the one-dimensional texture that the thesis mentions for thin
//! films (chapter 2, after Watt).

use crate::color::Color;
use crate::optics::thin_film::ThinFilm;

/// Steps of a film's ramp between 0 and 90 degrees.
///
/// The thickest film of a scene shows about ten interference orders over these angles, so that each
/// order has 18 steps. Fewer steps would flatten the orders, and more steps would take memory.
const STEPS: u32 = 180;

/// Colours at angles, linear RGB. Between two angles the colour is linear in the angle.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleRamp {
    /// Angles in degrees, ascending, and their colours; at least one.
    stops: Vec<(f64, Color)>,
}

impl AngleRamp {
    /// Creates the ramp through `stops`, which are angles in degrees and colours. The colour is
    /// constant before the first and after the last stop. Returns `None` if there are no stops, or if
    /// their angles do not ascend.
    #[must_use]
    pub fn new(stops: Vec<(f64, Color)>) -> Option<Self> {
        let ascend = stops.windows(2).all(|pair| pair[0].0 < pair[1].0);
        (!stops.is_empty() && ascend).then_some(Self { stops })
    }

    /// Computes the colours of a film at all angles of incidence. They are scaled so that the largest
    /// channel up to 60 degrees is 1, since the material's other weights set the brightness. At more
    /// grazing angles any film is nearly a mirror, and channels are clipped at 1.
    #[must_use]
    pub fn of_film(film: &ThinFilm) -> Self {
        let color = |k: u32| {
            let angle = 90.0 * f64::from(k) / f64::from(STEPS);
            (angle, film.color(angle.to_radians().cos()))
        };
        let mut stops: Vec<(f64, Color)> = (0..=STEPS).map(color).collect();
        let steep = stops.iter().take_while(|(angle, _)| *angle <= 60.0);
        let brightest = steep.map(|(_, color)| color.max_element()).fold(0.0, f64::max);
        if brightest > 0.0 {
            stops.iter_mut().for_each(|(_, color)| *color = (*color / brightest).min(Color::ONE));
        }
        Self { stops }
    }

    /// Returns the colour at the angle with this cosine.
    #[must_use]
    pub fn at(&self, cosine: f64) -> Color {
        self.at_degrees(cosine.clamp(-1.0, 1.0).acos().to_degrees())
    }

    /// Returns the colour at an angle in degrees.
    #[must_use]
    pub fn at_degrees(&self, angle: f64) -> Color {
        let next = self.stops.partition_point(|(stop, _)| *stop <= angle);
        match (next.checked_sub(1).map(|before| self.stops[before]), self.stops.get(next)) {
            (Some((low, from)), Some(&(high, to))) => {
                from + (angle - low) / (high - low) * (to - from)
            }
            (Some((_, color)), None) => color,
            (None, Some(&(_, color))) => color,
            (None, None) => Color::ONE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_stops_a_ramp_is_linear_in_the_angle_and_beyond_them_it_stays() {
        let stops = vec![(30.0, Color::X), (60.0, Color::Y), (80.0, Color::Z)];
        let ramp = AngleRamp::new(stops).unwrap();
        let at = |angle: f64| ramp.at(angle.to_radians().cos());
        assert_eq!((at(0.0), at(90.0)), (Color::X, Color::Z));
        assert!(at(45.0).abs_diff_eq(0.5 * (Color::X + Color::Y), 1e-12));
        assert!(at(65.0).abs_diff_eq(0.75 * Color::Y + 0.25 * Color::Z, 1e-12));
        assert!(AngleRamp::new(vec![]).is_none());
        assert!(AngleRamp::new(vec![(3.0, Color::X), (3.0, Color::Y)]).is_none());
    }

    #[test]
    fn a_films_ramp_has_the_hues_of_the_film() {
        let film = ThinFilm { thickness_nm: 450.0, index: 1.33, base_index: 1.0 };
        let ramp = AngleRamp::of_film(&film);
        for angle in [0.0f64, 20.5, 55.25] {
            let (shown, truth) =
                (ramp.at(angle.to_radians().cos()), film.color(angle.to_radians().cos()));
            let scale = shown.element_sum() / truth.element_sum();
            // Linear between steps of half a degree.
            assert!(shown.abs_diff_eq(scale * truth, 1e-3), "{angle}: {shown} {truth}");
        }
    }
}
