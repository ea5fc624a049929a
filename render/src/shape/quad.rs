//! The rectangle (any parallelogram) and the plane that contains it.

use super::{Placement, PlacementError, SurfacePoint};
use glam::{DVec2, DVec3};

/// A parallelogram `corner + a edge_u + b edge_v` with `a` and `b` in `[0, 1]`, or its whole plane.
///
/// Texture coordinates are `(a, b) * repeat`. The outside is the side to which `edge_u x edge_v`
/// points, or the opposite side if a placement has mirrored the shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quad {
    corner: DVec3,
    edge_u: DVec3,
    edge_v: DVec3,
    repeat: DVec2,
    bounded: bool,
    normal: DVec3,
    /// Dual vectors of the edges: `a = (p - corner) . dual_u`, and `b` likewise with `dual_v`.
    dual_u: DVec3,
    dual_v: DVec3,
}

impl Quad {
    /// Creates the parallelogram, or its plane if not `bounded`. Returns `None` if the edges are
    /// parallel, zero or not finite.
    #[must_use]
    pub fn new(
        corner: DVec3,
        edge_u: DVec3,
        edge_v: DVec3,
        repeat: DVec2,
        bounded: bool,
    ) -> Option<Self> {
        // Edges are scaled to unit size, since the area of large or small ones may leave the range
        // of numbers.
        let [size_u, size_v] = [edge_u, edge_v].map(|edge| edge.abs().max_element());
        let (u, v) = (edge_u / size_u, edge_v / size_v);
        let across = u.cross(v);
        let normal = across.try_normalize()?;
        let area = across.length();
        // Edges closer in direction than this leave too few digits to distinguish a from b.
        if area < 1e-9 * u.length() * v.length() {
            return None;
        }
        let dual_u = v.cross(normal) / area / size_u;
        let dual_v = normal.cross(u) / area / size_v;
        Some(Self { corner, edge_u, edge_v, repeat, bounded, normal, dual_u, dual_v })
    }

    /// Returns the shape, moved in `f64`. Its outside stays its outside.
    ///
    /// # Errors
    /// If the edges become parallel.
    pub fn placed(&self, placement: &Placement) -> Result<Self, PlacementError> {
        let map = placement.to_scene();
        let [edge_u, edge_v] = [self.edge_u, self.edge_v].map(|edge| map.transform_vector3(edge));
        let corner = map.transform_point3(self.corner);
        let moved = Self::new(corner, edge_u, edge_v, self.repeat, self.bounded);
        let mut moved = moved.ok_or(PlacementError::Parallel)?;
        if moved.normal.dot(placement.normal(self.normal)) < 0.0 {
            moved.normal = -moved.normal;
        }
        Ok(moved)
    }

    /// Returns the distance above 0 at which the ray meets the shape, in units of `direction`. A
    /// ray that starts within `skin` of the plane does not meet it.
    #[must_use]
    #[inline]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, skin: f64) -> Option<f64> {
        let height = (self.corner - origin).dot(self.normal);
        let t = height / direction.dot(self.normal);
        // A ray along the plane gives an infinity or NaN; both are rejected here.
        if !(t > 0.0 && t < f64::INFINITY) || height.abs() <= skin {
            return None;
        }
        if self.bounded {
            let [a, b] = self.coordinates(origin + t * direction);
            if !(0.0..=1.0).contains(&a) || !(0.0..=1.0).contains(&b) {
                return None;
            }
        }
        Some(t)
    }

    /// Returns the surface point at a hit. `near` is the hit as computed along the ray.
    #[must_use]
    pub fn surface_point(&self, near: DVec3) -> SurfacePoint {
        let [a, b] = self.coordinates(near);
        SurfacePoint {
            position: near - (near - self.corner).dot(self.normal) * self.normal,
            geometric_normal: self.normal,
            shading_normal: self.normal,
            uv: DVec2::new(a, b) * self.repeat,
            part: 0,
        }
    }

    /// Returns the gradients of the texture coordinates.
    #[must_use]
    pub fn uv_gradients(&self) -> [DVec3; 2] {
        [self.dual_u * self.repeat.x, self.dual_v * self.repeat.y]
    }

    /// The corner at which both edges start.
    #[must_use]
    pub fn corner(&self) -> DVec3 {
        self.corner
    }

    /// The corners in order around the parallelogram; `None` for a whole plane.
    #[must_use]
    pub fn corners(&self) -> Option<[DVec3; 4]> {
        let edges = [DVec3::ZERO, self.edge_u, self.edge_u + self.edge_v, self.edge_v];
        self.bounded.then(|| edges.map(|edge| self.corner + edge))
    }

    /// The unit normal on the outer side.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Lower and upper corner of the bounding box; `None` for a whole plane.
    #[must_use]
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        if !self.bounded {
            return None;
        }
        let corners = [self.edge_u, self.edge_v, self.edge_u + self.edge_v];
        let mut bounds = [self.corner; 2];
        for corner in corners.map(|edge| self.corner + edge) {
            bounds = [bounds[0].min(corner), bounds[1].max(corner)];
        }
        Some(bounds)
    }

    fn coordinates(&self, point: DVec3) -> [f64; 2] {
        let from_corner = point - self.corner;
        [from_corner.dot(self.dual_u), from_corner.dot(self.dual_v)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn skew(bounded: bool) -> Quad {
        let edges = [DVec3::new(2.0, 0.0, 0.0), DVec3::new(1.0, 3.0, 0.0)];
        Quad::new(DVec3::ZERO, edges[0], edges[1], DVec2::new(1.0, 10.0), bounded).unwrap()
    }

    #[test]
    fn coordinates_follow_the_edges() {
        let uv = skew(true).surface_point(DVec3::new(2.0, 1.5, 0.0)).uv;
        assert!(uv.abs_diff_eq(DVec2::new(0.75, 5.0), 1e-15), "{uv}");
    }

    #[test]
    fn a_plane_goes_on_where_the_rectangle_ends() {
        let eye = DVec3::new(100.0, 1.0, 5.0);
        assert_eq!(skew(true).intersect(eye, DVec3::NEG_Z, 0.0), None);
        assert_eq!(skew(false).intersect(eye, DVec3::NEG_Z, 0.0), Some(5.0));
        assert_eq!(skew(false).intersect(eye, DVec3::X, 0.0), None);
    }

    #[test]
    fn parallel_edges_make_no_rectangle() {
        let quad = |edge_v| Quad::new(DVec3::ZERO, DVec3::X, edge_v, DVec2::ONE, true);
        assert!(quad(DVec3::X).is_none() && quad(DVec3::ZERO).is_none());
        assert!(quad(DVec3::new(1.0, 1e-12, 0.0)).is_none());
    }
}
