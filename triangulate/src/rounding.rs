//! Rounding of the points of an object to f32.

use glam::DVec3;

/// The box of an object and the rounding errors in it.
#[derive(Debug)]
pub struct Rounding {
    low: DVec3,
    high: DVec3,
    /// The largest distance by which a coordinate was moved, in the grid's unit.
    moved: f64,
    /// The square of the largest distance by which a point was moved.
    pub displacement_sq: f64,
}

impl Rounding {
    /// Returns the rounding of no points.
    pub fn none() -> Self {
        Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, moved: 0.0, displacement_sq: 0.0 }
    }

    /// Adds points and their rounded coordinates.
    pub fn add(&mut self, points: &[DVec3], rounded: &[[f32; 3]]) {
        for (&point, &rounded) in points.iter().zip(rounded) {
            self.low = self.low.min(point);
            self.high = self.high.max(point);
            let off = point - DVec3::from(rounded.map(f64::from));
            self.moved = self.moved.max(off.abs().max_element());
            self.displacement_sq = self.displacement_sq.max(off.length_squared());
        }
    }

    /// Returns the largest move of a coordinate as a fraction of the object's size.
    pub fn fraction(&self) -> f64 {
        if self.moved == 0.0 { 0.0 } else { self.moved / (self.high - self.low).length() }
    }
}
