//! The axis that points up in the mesh.
//!
//! In a grid y points up, as in scenes; slicers and many programs for solids take z. The mesh is turned by a quarter about
//! the x axis, which moves y to z and z to -y. No coordinate is rounded.

use crate::triangulator::Sink;
use crate::{Material, Triangle};
use clap::ValueEnum;
use std::io;
use sweep::grid::file::Header;

/// The axis that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Up {
    /// y, as in the grid
    #[default]
    Y,
    /// z, as for slicers: the mesh is turned by a quarter about x
    Z,
}

impl Up {
    /// Returns a point or a vector of the grid as it is in the mesh.
    #[must_use]
    pub fn turned(self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Y => [x, y, z],
            // Negating with -z would turn 0 into -0.
            Self::Z => [x, 0.0 - z, y],
        }
    }
}

/// A sink that receives a mesh with this axis up.
#[derive(Debug)]
pub struct Turned<S> {
    /// The sink.
    pub sink: S,
    /// The axis that points up in it.
    pub up: Up,
}

impl<S: Sink> Sink for Turned<S> {
    fn patch(&mut self, header: &Header) {
        self.sink.patch(header);
    }

    fn material(&mut self, material: Material) {
        self.sink.material(material);
    }

    fn position(&mut self, position: [f32; 3]) {
        self.sink.position(self.up.turned(position));
    }

    fn uv(&mut self, uv: [f32; 2]) {
        self.sink.uv(uv);
    }

    fn normal(&mut self, normal: [f32; 3]) {
        self.sink.normal(self.up.turned(normal));
    }

    fn triangle(&mut self, triangle: &Triangle) {
        self.sink.triangle(triangle);
    }

    fn row_done(&mut self) -> io::Result<()> {
        self.sink.row_done()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_moves_y_to_z() {
        let turned = |p| Up::Z.turned(p);
        assert_eq!(turned([1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]);
        assert_eq!(turned([0.0; 3]).map(f32::to_bits), [0; 3]);
        // A rotation keeps the hand: x cross y = z, also for the images.
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(turned);
        let cross =
            [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
        assert_eq!(cross, z);
        assert_eq!(Up::Y.turned([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    }
}
