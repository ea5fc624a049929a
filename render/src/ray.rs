//! Rays and hits.

use glam::DVec3;

/// A half line that starts in free space or on a surface.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Start of the ray, in scene space.
    pub origin: DVec3,
    /// Unit direction of the ray, so that `t` is a distance.
    pub direction: DVec3,
    /// The piece of surface on which the ray starts; [`crate::accel`] describes what the ray cannot
    /// hit at its start.
    pub leaving: Option<Piece>,
}

impl Ray {
    /// Creates a ray that starts in free space; `direction` is unit.
    #[must_use]
    pub fn from_eye(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, leaving: None }
    }

    /// Creates a ray that starts on a surface, at `origin`; `direction` is unit.
    #[must_use]
    pub fn leaving(piece: Piece, origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, leaving: Some(piece) }
    }

    /// Returns the point at distance `t`, in scene units.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// A piece of surface: an object of the scene, or a single triangle of a mesh, or a single face of
/// a box.
///
/// The order of pieces breaks ties: of two hits at equal distance the smaller piece is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Piece {
    /// Index of the object in the scene.
    pub object: u32,
    /// Index of the triangle in its mesh or of the face of a box; 0 for other shapes.
    pub triangle: u32,
}

/// A point where a ray meets a surface.
#[derive(Debug, Clone, Copy)]
pub struct Hit {
    /// Distance along the ray, in scene units.
    pub t: f64,
    /// The piece that the ray meets.
    pub piece: Piece,
    /// Barycentric weights of a triangle's second and third corner; unused for other shapes.
    pub barycentric: [f64; 2],
}

impl Hit {
    /// Returns whether this hit is seen rather than `other`: it is nearer, or equally near and its
    /// piece is smaller.
    #[must_use]
    pub fn before(&self, other: &Self) -> bool {
        (self.t, self.piece) < (other.t, other.piece)
    }
}
