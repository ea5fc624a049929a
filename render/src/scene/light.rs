//! Lights.

use crate::color::Color;
use glam::DVec3;

/// A light at a point, equally bright at every distance (the thesis names no fall-off).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// Where it is.
    pub position: DVec3,
    /// How bright it is.
    pub color: Color,
}
