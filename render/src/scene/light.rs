//! Lights, as one closed enum.

use crate::color::Color;
use glam::DVec3;

/// A light. Lights have no size, so that shadows have sharp edges.
///
/// A new light provides, and the compiler leads to each `match`:
///
/// - a struct in this file and answers of [`Light`]: colour, direction, distance and the light that
///   arrives at a point. The light that arrives is finite, also at the light's own position;
/// - its key in scene files: a variant of [`LightFile`](crate::scene::file::LightFile), and the check
///   of each range in `scene/read/lights.rs`;
/// - a line of `--check` (`scene/check/inventory.rs`), and a test whether an object encloses it
///   (`check/lights.rs`);
/// - the start of its shadow rays (`shade/shadow.rs`, `trace/volume.rs`). A light with a size also needs a
///   sample number in `Shader::shade`, which today has none;
/// - tests: a closed form of the light on a plane (`render/tests/light.rs`), and its complaints
///   (`render/tests/complaints.rs`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// A light at a point.
    Point(PointLight),
    /// A light at a point that shines into a cone.
    Spot(SpotLight),
    /// A light at infinite distance.
    Directional(DirectionalLight),
}

/// A light at a point that shines into a cone with a smooth edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpotLight {
    /// The light as it shines along its axis.
    pub point: PointLight,
    /// Unit direction of the axis, away from the light.
    pub axis: DVec3,
    /// Cosine of the angle from the axis up to which the light has its full brightness.
    pub inner: f64,
    /// Cosine of the angle from which on it is dark, at most `inner`.
    pub outer: f64,
}

/// A light at a point. A surface point at exactly this position is not lit by it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// Position of the light, in scene space.
    pub position: DVec3,
    /// Linear RGB where the fall-off is 1; each channel at least 0.
    pub color: Color,
    /// Fading with distance. Without a fall-off the light is equally bright at every distance, since
    /// the thesis names no fall-off.
    pub falloff: Option<Falloff>,
}

/// A light at infinite distance, such as the sun. Direction and brightness are equal everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction toward the light.
    pub toward: DVec3,
    /// Linear RGB; each channel at least 0.
    pub color: Color,
}

/// Fading of a light: the factor `1 / (constant + linear x + quadratic x^2)` with
/// `x = distance / reference`.
///
/// The inverse square has `quadratic` alone; the light then has its own colour at the distance
/// `reference`. The factor is at most [`BRIGHTEST`], so that a light on a surface leaves every colour
/// finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Falloff {
    /// Constant term, at least 0. At least one of the three terms is above 0.
    pub constant: f64,
    /// Coefficient of `x`, at least 0.
    pub linear: f64,
    /// Coefficient of `x^2`, at least 0.
    pub quadratic: f64,
    /// Distance at which `x` is 1, in scene units, positive.
    pub reference: f64,
}

/// Largest factor of a fall-off. The inverse square reaches this factor at a thousandth of its
/// reference distance. A larger factor would let one highlight outshine the picture. A smaller factor
/// would show as a flat spot around lights near a surface.
pub const BRIGHTEST: f64 = 1e6;

impl Light {
    /// Colour of the light before it fades, linear RGB.
    #[must_use]
    pub fn color(&self) -> Color {
        match self {
            Self::Point(light) | Self::Spot(SpotLight { point: light, .. }) => light.color,
            Self::Directional(light) => light.color,
        }
    }

    /// Returns the unit direction from a point toward the light, or zero at the light's position.
    #[must_use]
    pub fn toward(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Point(light) | Self::Spot(SpotLight { point: light, .. }) => {
                (light.position - point).normalize_or_zero()
            }
            Self::Directional(light) => light.toward,
        }
    }

    /// Returns the distance from a point to the light, in scene units; infinite for a directional
    /// light.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Point(light) | Self::Spot(SpotLight { point: light, .. }) => {
                (light.position - point).length()
            }
            Self::Directional(_) => f64::INFINITY,
        }
    }

    /// Returns the light that arrives at a point if nothing is between, linear RGB.
    #[must_use]
    pub fn arriving(&self, point: DVec3) -> Color {
        match self {
            Self::Point(light) => light.arriving(point),
            Self::Spot(light) => light.toward(point) * light.point.arriving(point),
            Self::Directional(light) => light.color,
        }
    }
}

impl PointLight {
    /// Returns the light that arrives at a point if nothing is between, linear RGB.
    #[must_use]
    pub fn arriving(&self, point: DVec3) -> Color {
        match &self.falloff {
            None => self.color,
            Some(falloff) => falloff.at((self.position - point).length()) * self.color,
        }
    }
}

impl SpotLight {
    /// Returns the part of the light that the cone lets pass toward a point, [0, 1]. Between the two
    /// angles it falls with the cosine along a cubic curve without steps in its slope.
    #[must_use]
    pub fn toward(&self, point: DVec3) -> f64 {
        let cosine = (point - self.point.position).normalize_or_zero().dot(self.axis);
        if cosine >= self.inner {
            return 1.0;
        }
        let part = ((cosine - self.outer) / (self.inner - self.outer)).max(0.0);
        if part > 0.0 { part * part * (3.0 - 2.0 * part) } else { 0.0 }
    }
}

impl Falloff {
    /// Returns the factor at a distance in scene units, in `[0, BRIGHTEST]`.
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
    fn a_spot_is_bright_inside_dark_outside_and_half_between() {
        let point = PointLight { position: DVec3::Y, color: Color::ONE, falloff: None };
        let spot = SpotLight { point, axis: DVec3::NEG_Y, inner: 0.9, outer: 0.7 };
        let at = |cosine: f64| {
            let down = DVec3::new((1.0 - cosine * cosine).sqrt(), -cosine, 0.0);
            Light::Spot(spot).arriving(DVec3::Y + 3.0 * down).x
        };
        assert_eq!([1.0, 0.91, 0.69, 0.0, -1.0].map(at), [1.0, 1.0, 0.0, 0.0, 0.0]);
        assert!((at(0.8) - 0.5).abs() < 1e-12);
        let hard = Light::Spot(SpotLight { inner: 0.9, outer: 0.9, ..spot });
        assert_eq!(hard.arriving(DVec3::new(5.0, 0.9, 0.0)), Color::ZERO);
        assert_eq!(hard.arriving(DVec3::ZERO), Color::ONE);
    }

    #[test]
    fn twice_as_far_is_a_quarter_as_bright() {
        let square = Falloff { constant: 0.0, linear: 0.0, quadratic: 1.0, reference: 4.0 };
        assert_eq!([4.0, 8.0, 2.0].map(|d| square.at(d)), [1.0, 0.25, 4.0]);
        assert_eq!([0.0, 1e-300, 1e300].map(|d| square.at(d)), [BRIGHTEST, BRIGHTEST, 0.0]);
        let all = Falloff { constant: 1.0, linear: 2.0, quadratic: 3.0, reference: 10.0 };
        assert_eq!([0.0, 10.0, 20.0].map(|d| all.at(d)), [1.0, 1.0 / 6.0, 1.0 / 17.0]);
    }
}
