//! Rays and hits.

use glam::DVec3;

/// A half line that starts in space or on a surface.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; unit, so that `t` is a distance.
    pub direction: DVec3,
    /// The piece of surface it leaves; [`crate::accel`] says what it cannot hit at its start.
    pub leaving: Option<Piece>,
}

impl Ray {
    /// A ray that starts in free space.
    #[must_use]
    pub fn from_eye(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, leaving: None }
    }

    /// A ray that leaves a surface at `origin`.
    #[must_use]
    pub fn leaving(piece: Piece, origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, leaving: Some(piece) }
    }

    /// The point at distance `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// A piece of surface: one shape of the scene, and for a mesh one of its triangles, for a box one of
/// its faces.
///
/// The order is the tie rule: of two hits at equal distance the smaller piece is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Piece {
    /// Index of the object in the scene.
    pub object: u32,
    /// Index of the triangle in its mesh, or of the face of a box; 0 for other shapes.
    pub triangle: u32,
}

/// Where a ray meets a surface.
#[derive(Debug, Clone, Copy)]
pub struct Hit {
    /// Distance along the ray.
    pub t: f64,
    /// What was hit.
    pub piece: Piece,
    /// For a triangle the barycentric weights of its second and third corner; else unused.
    pub barycentric: [f64; 2],
}

impl Hit {
    /// True when this hit is seen rather than `other`: nearer, or equally near and first.
    #[must_use]
    pub fn before(&self, other: &Self) -> bool {
        (self.t, self.piece) < (other.t, other.piece)
    }
}
