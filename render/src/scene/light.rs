//! Lights.

use crate::color::Color;
use glam::DVec3;

/// A light; neither kind has a size, so that shadows have sharp edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// At a point.
    Point(PointLight),
    /// Far away.
    Directional(DirectionalLight),
}

/// A light at a point. A surface exactly there is not lit by it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// Where it is.
    pub position: DVec3,
    /// How bright it is, where its fall-off is 1.
    pub color: Color,
    /// How it fades with distance; without one it is equally bright at every distance, since the
    /// thesis names no fall-off.
    pub falloff: Option<Falloff>,
}

/// A light as far away as the sun: the same direction and brightness everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction toward the light.
    pub toward: DVec3,
    /// How bright it is.
    pub color: Color,
}

/// How a light fades: `1 / (constant + linear x + quadratic x^2)` with `x = distance / reference`.
///
/// The inverse square is `quadratic` alone; the light's colour is then seen at the distance
/// `reference`. Nothing is made brighter than [`BRIGHTEST`] times the light's colour, so that a
/// light that lies on a surface leaves every colour finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Falloff {
    /// Not negative; of the three at least one is more than 0.
    pub constant: f64,
    /// Not negative.
    pub linear: f64,
    /// Not negative.
    pub quadratic: f64,
    /// Distance at which `x` is 1, in the scene's unit of length; positive.
    pub reference: f64,
}

/// How much brighter than its colour a light becomes near to it: as much as the inverse square has
/// at a thousandth of its reference distance, where a light without size is no picture of a lamp.
pub const BRIGHTEST: f64 = 1e6;

impl Light {
    /// How bright it is, where it has not faded.
    #[must_use]
    pub fn color(&self) -> Color {
        match self {
            Self::Point(light) => light.color,
            Self::Directional(light) => light.color,
        }
    }

    /// Unit direction from a point toward the light; no direction, zero, where the light is.
    #[must_use]
    pub fn toward(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Point(light) => (light.position - point).normalize_or_zero(),
            Self::Directional(light) => light.toward,
        }
    }

    /// How far it is from a point; infinitely for a directional light.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Point(light) => (light.position - point).length(),
            Self::Directional(_) => f64::INFINITY,
        }
    }

    /// What arrives at a point when nothing is on the way.
    #[must_use]
    pub fn arriving(&self, point: DVec3) -> Color {
        match self {
            Self::Point(PointLight { color, falloff: None, .. }) => *color,
            Self::Point(PointLight { color, falloff: Some(falloff), .. }) => {
                falloff.at(self.distance(point)) * *color
            }
            Self::Directional(light) => light.color,
        }
    }
}

impl Falloff {
    /// What a light is multiplied by at a distance, in `[0, BRIGHTEST]`.
    #[must_use]
    pub fn at(&self, distance: f64) -> f64 {
        let x = distance / self.reference;
        let faded = self.constant + x * (self.linear + x * self.quadratic);
        (1.0 / faded).min(BRIGHTEST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twice_as_far_is_a_quarter_as_bright() {
        let square = Falloff { constant: 0.0, linear: 0.0, quadratic: 1.0, reference: 4.0 };
        assert_eq!([4.0, 8.0, 2.0].map(|d| square.at(d)), [1.0, 0.25, 4.0]);
        assert_eq!([0.0, 1e-300, 1e300].map(|d| square.at(d)), [BRIGHTEST, BRIGHTEST, 0.0]);
        let all = Falloff { constant: 1.0, linear: 2.0, quadratic: 3.0, reference: 10.0 };
        assert_eq!([0.0, 10.0, 20.0].map(|d| all.at(d)), [1.0, 1.0 / 6.0, 1.0 / 17.0]);
    }
}
