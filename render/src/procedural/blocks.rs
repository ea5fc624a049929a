//! Checker, stripes and bricks: exact patterns without noise in their faces.
//!
//! The colour of a point depends on the number of its cell and on its position within the cell. A
//! surface that lies in a face between cells, as a floor does at height 0, would see either side,
//! depending on the rounding of its coordinates. All faces therefore lie [`BELOW`] lower than
//! stated, so that the surface sees the upper side everywhere.

use super::lattice::{mixed_at, share};
use crate::color::Color;
use glam::DVec3;

/// Distance by which faces are moved down, in units of the texture. It is larger than the rounding
/// of coordinates up to a million units, and far too small to be seen.
pub const BELOW: f64 = 1.0 / (1u64 << 30) as f64;

/// Cubes of side 1 in two alternating colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checker {
    /// The cube from the origin to (1, 1, 1) has the first colour, and its neighbours have the
    /// second.
    pub colors: [Color; 2],
}

impl Checker {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let cube = (point + BELOW).floor();
        let odd = (cube.x + cube.y + cube.z).rem_euclid(2.0);
        self.colors[usize::from(odd == 1.0)]
    }
}

/// Layers along x that repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct Stripes {
    /// Thickness of each layer, more than 0, and its colour. The first layer begins at x = 0.
    pub layers: Vec<(f64, Color)>,
}

impl Stripes {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let period: f64 = self.layers.iter().map(|(thickness, _)| thickness).sum();
        let mut left = (point.x + BELOW).rem_euclid(period);
        for &(thickness, color) in &self.layers {
            if left < thickness {
                return color;
            }
            left -= thickness;
        }
        // rem_euclid rounds up to the period itself just below it.
        self.layers.first().map_or(Color::ZERO, |&(_, color)| color)
    }
}

/// Brickwork in running bond. Rows run along x, and each is half a brick off the row below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Brick {
    /// Distance from one brick to the next along x, y and z, joint included; more than 0.
    pub size: DVec3,
    /// Thickness of the joint at the upper end of each brick along each axis; 0 or more and less
    /// than `size`.
    pub joint: f64,
    /// Colours of the bricks and of the joint.
    pub colors: [Color; 2],
    /// Variation in tone between bricks, 0 to 1.
    pub vary: f64,
}

impl Brick {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let mut at = (point + BELOW) / self.size;
        let row = at.y.floor();
        at.x -= 0.5 * row.rem_euclid(2.0);
        let brick = at.floor();
        let inside = (at - brick) * self.size;
        if inside.cmpge(self.size - self.joint).any() {
            return self.colors[1];
        }
        let random = share(mixed_at(brick.to_array().map(|x| x as i64), 41));
        self.colors[0] * (1.0 + self.vary * (random - 0.5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK_WHITE: [Color; 2] = [Color::ZERO, Color::ONE];

    #[test]
    fn checkers_alternate_across_every_face_and_nowhere_else() {
        let checker = Checker { colors: BLACK_WHITE };
        for x in -3..3 {
            for y in -3..3 {
                for z in -3..3 {
                    let corner = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                    let expected = BLACK_WHITE[i32::rem_euclid(x + y + z, 2) as usize];
                    for part in [0.0, 1e-6, 0.5, 0.999_999] {
                        assert_eq!(checker.color(corner + part), expected, "{corner}");
                    }
                }
            }
        }
        // A floor at height 0, with coordinates rounded up and down.
        let rounded = [1e-15, 0.0, -1e-15].map(|y| checker.color(DVec3::new(0.5, y, 0.5)));
        assert_eq!(rounded, [Color::ZERO; 3]);
        assert!(checker.color(DVec3::new(1e9 + 0.5, -1e300, 0.5)).is_finite());
    }

    #[test]
    fn stripes_have_their_widths_and_repeat() {
        let layers = vec![(0.5, Color::ONE), (0.25, Color::X), (1.0, Color::Y)];
        let stripes = Stripes { layers };
        for period in -2..3 {
            let start = 1.75 * f64::from(period);
            for (x, color) in [
                (0.0, Color::ONE),
                (0.49, Color::ONE),
                (0.5, Color::X),
                (0.74, Color::X),
                (0.75, Color::Y),
                (1.74, Color::Y),
            ] {
                assert_eq!(stripes.color(DVec3::new(start + x, 5.0, -3.0)), color, "{period} {x}");
            }
        }
    }

    /// A wall of bricks shows as much brick as the sizes imply, and rows are offset by half a
    /// brick.
    #[test]
    fn bricks_and_joints_have_their_sizes() {
        let size = DVec3::new(2.0, 0.75, 1.0);
        let brick = Brick { size, joint: 0.25, colors: [Color::ONE, Color::ZERO], vary: 0.0 };
        // Samples the middles of cells of 1/16 over two bricks of two rows, so that edges fall
        // between them.
        let mut bricks = 0;
        for i in 0..64 {
            for j in 0..24 {
                let at = DVec3::new(f64::from(i) + 0.5, f64::from(j) + 0.5, 1.0) / 16.0;
                bricks += usize::from(brick.color(at) == Color::ONE);
            }
        }
        assert_eq!(bricks as f64 / (64.0 * 24.0), (1.75 * 0.5) / (2.0 * 0.75));
        let joint = |x: f64, y: f64| brick.color(DVec3::new(x, y, 0.1)) == Color::ZERO;
        assert!(joint(1.9, 0.1) && !joint(0.9, 0.1), "the first row");
        assert!(joint(0.9, 0.85) && !joint(1.9, 0.85), "the second row, half a brick off");
        assert!(joint(0.3, 0.6) && !joint(0.3, 0.4), "between rows");
    }
}
