//! The rectangle (any parallelogram) and the plane it lies in.

use super::{Placement, PlacementError, SurfacePoint};
use glam::{DVec2, DVec3};

/// A parallelogram `corner + a edge_u + b edge_v` with `a` and `b` in `[0, 1]`, or the whole plane.
///
/// Texture coordinates are `(a, b) * repeat`; the side that `edge_u x edge_v` points to is the
/// outside, and in a mirror the other one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quad {
    corner: DVec3,
    edge_u: DVec3,
    edge_v: DVec3,
    repeat: DVec2,
    bounded: bool,
    normal: DVec3,
    /// `a = (p - corner) . dual_u`, and so for `b`.
    dual_u: DVec3,
    dual_v: DVec3,
}

impl Quad {
    /// The parallelogram, or its plane when not `bounded`; nothing when the edges are parallel,
    /// zero or not finite.
    #[must_use]
    pub fn new(
        corner: DVec3,
        edge_u: DVec3,
        edge_v: DVec3,
        repeat: DVec2,
        bounded: bool,
    ) -> Option<Self> {
        // In units of their own, since the area of edges that are numbers may be none.
        let [size_u, size_v] = [edge_u, edge_v].map(|edge| edge.abs().max_element());
        let (u, v) = (edge_u / size_u, edge_v / size_v);
        let across = u.cross(v);
        let normal = across.try_normalize()?;
        let area = across.length();
        // Edges that differ in direction by less than this leave no digits to tell a from b.
        if area < 1e-9 * u.length() * v.length() {
            return None;
        }
        let dual_u = v.cross(normal) / area / size_u;
        let dual_v = normal.cross(u) / area / size_v;
        Some(Self { corner, edge_u, edge_v, repeat, bounded, normal, dual_u, dual_v })
    }

    /// It moved, in `f64`; its outside stays its outside.
    ///
    /// # Errors
    /// When its edges become parallel.
    pub fn placed(&self, placement: &Placement) -> Result<Self, PlacementError> {
        let way = placement.to_scene();
        let [edge_u, edge_v] = [self.edge_u, self.edge_v].map(|edge| way.transform_vector3(edge));
        let corner = way.transform_point3(self.corner);
        let moved = Self::new(corner, edge_u, edge_v, self.repeat, self.bounded);
        let mut moved = moved.ok_or(PlacementError::Parallel)?;
        if moved.normal.dot(placement.normal(self.normal)) < 0.0 {
            moved.normal = -moved.normal;
        }
        Ok(moved)
    }

    /// The distance above 0 at which the ray meets it; not at all when the ray starts within
    /// `skin` of its plane.
    #[must_use]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, skin: f64) -> Option<f64> {
        let height = (self.corner - origin).dot(self.normal);
        let t = height / direction.dot(self.normal);
        // A ray along the plane gives an infinity or NaN, and both are refused here.
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

    /// The surface point at a hit; `near` is the hit as found along the ray.
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

    /// The gradients of its texture coordinates.
    #[must_use]
    pub fn uv_gradients(&self) -> [DVec3; 2] {
        [self.dual_u * self.repeat.x, self.dual_v * self.repeat.y]
    }

    /// The corner at which both edges begin.
    #[must_use]
    pub fn corner(&self) -> DVec3 {
        self.corner
    }

    /// Its corners in their order around it; nothing for a whole plane.
    #[must_use]
    pub fn corners(&self) -> Option<[DVec3; 4]> {
        let edges = [DVec3::ZERO, self.edge_u, self.edge_u + self.edge_v, self.edge_v];
        self.bounded.then(|| edges.map(|edge| self.corner + edge))
    }

    /// The unit normal, on the side that is outside.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Lower and upper corner of its box; nothing for a whole plane.
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
