//! Random directions.

pub use fixtures::Dice;
use glam::DVec3;

/// Random directions from dice.
pub trait Directions {
    /// Returns a vector of length 1.
    fn direction(&mut self) -> DVec3;
}

impl Directions for Dice {
    fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from(std::array::from_fn(|_| self.between(-1.0, 1.0)));
            if (0.1..=1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}
