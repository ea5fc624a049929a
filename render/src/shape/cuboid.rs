//! The axis-parallel box. It is called cuboid since `box` is a keyword of the language.
//!
//! The drawing shows the number of each face and the directions of its texture, across and up:
//!
//! ```text
//!              +-------+
//!              | 3  +y |   across +x, up -z
//!              |       |
//!      +-------+-------+-------+-------+
//!      | 0  -x | 5  +z | 1  +x | 4  -z |   up +y; across +z, +x, -z, -x
//!      |       |       |       |       |
//!      +-------+-------+-------+-------+
//!              | 2  -y |   across +x, up +z
//!              |       |
//!              +-------+
//! ```
//!
//! The drawing is the box unfolded, seen from outside. No face is mirrored, and the four sides
//! stand upright. Each face shows the whole texture and is a textured area of its own: a pixel that
//! sees two faces does not average their textures as one area.

use super::{Start, SurfacePoint};
use glam::{DVec2, DVec3};

/// Number of faces of a box.
pub const FACES: usize = 6;

/// An axis-parallel box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    low: DVec3,
    high: DVec3,
}

impl Cuboid {
    /// Creates the box between two corners. Returns `None` unless each coordinate of `low` is less
    /// than that of `high`.
    #[must_use]
    pub fn new(low: DVec3, high: DVec3) -> Option<Self> {
        low.cmplt(high).all().then_some(Self { low, high })
    }

    /// Returns the nearest distance above 0 at which the ray meets the box, in units of
    /// `direction`, and the face that it meets.
    ///
    /// A ray that starts on a face, according to `start`, does not meet that face.
    #[must_use]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, start: Start) -> Option<(f64, u32)> {
        // The ray is inside all three pairs of planes between its last entry and its first exit.
        let mut enter = (f64::NEG_INFINITY, 0);
        let mut leave = (f64::INFINITY, 0);
        for axis in 0..3 {
            let [below, above] = [self.low[axis] - origin[axis], self.high[axis] - origin[axis]];
            if direction[axis] == 0.0 {
                if below > 0.0 || above < 0.0 {
                    return None;
                }
                continue;
            }
            let low = (below / direction[axis], 2 * axis as u32);
            let high = (above / direction[axis], 2 * axis as u32 + 1);
            let (near, far) = if direction[axis] > 0.0 { (low, high) } else { (high, low) };
            if near.0 > enter.0 {
                enter = near;
            }
            if far.0 < leave.0 {
                leave = far;
            }
        }
        if enter.0 > leave.0 {
            return None;
        }
        let counts = |(t, face): &(f64, u32)| {
            let off = self.plane(*face) - origin[*face as usize / 2];
            *t > 0.0
                && *t < f64::INFINITY
                && start.left_face != Some(*face)
                && off.abs() > start.skin
        };
        [enter, leave].into_iter().find(counts)
    }

    /// Returns the unit normal of a face, outward.
    #[must_use]
    pub fn normal(&self, face: u32) -> DVec3 {
        let mut normal = DVec3::ZERO;
        normal[face as usize / 2] = if face.is_multiple_of(2) { -1.0 } else { 1.0 };
        normal
    }

    /// Returns the surface point on a face. `near` is the hit as computed along the ray.
    #[must_use]
    pub fn surface_point(&self, face: u32, near: DVec3) -> SurfacePoint {
        let axis = face as usize / 2;
        let mut position = near.clamp(self.low, self.high);
        position[axis] = self.plane(face);
        let normal = self.normal(face);
        // Position along each axis as a part of the side, counted from both ends.
        let to = (position - self.low) / (self.high - self.low);
        let back = (self.high - position) / (self.high - self.low);
        let uv = match face {
            0 => DVec2::new(to.z, to.y),
            1 => DVec2::new(back.z, to.y),
            2 => DVec2::new(to.x, to.z),
            3 => DVec2::new(to.x, back.z),
            4 => DVec2::new(back.x, to.y),
            _ => DVec2::new(to.x, to.y),
        };
        SurfacePoint { position, geometric_normal: normal, shading_normal: normal, uv, part: face }
    }

    /// Returns gradients as [`Shape::uv_gradients`](super::Shape::uv_gradients) does.
    #[must_use]
    pub fn uv_gradients(&self, face: u32) -> [DVec3; 2] {
        let per_side = (self.high - self.low).recip();
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * per_side);
        match face {
            0 => [z, y],
            1 => [-z, y],
            2 => [x, z],
            3 => [x, -z],
            4 => [-x, y],
            _ => [x, y],
        }
    }

    /// Lower and upper corner of the box.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        [self.low, self.high]
    }

    /// Coordinate at which the plane of a face crosses its axis.
    fn plane(&self, face: u32) -> f64 {
        let corner = if face.is_multiple_of(2) { self.low } else { self.high };
        corner[face as usize / 2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FREE: Start = Start { left_face: None, skin: 0.0 };

    fn brick() -> Cuboid {
        Cuboid::new(DVec3::new(-1.0, -2.0, -3.0), DVec3::new(1.0, 2.0, 5.0)).unwrap()
    }

    #[test]
    fn no_texture_of_a_face_is_mirrored_seen_from_outside() {
        let brick = brick();
        let middle = 0.5 * (brick.low + brick.high);
        for face in 0..FACES as u32 {
            let at = brick.surface_point(face, middle);
            assert_eq!((at.uv, at.part), (DVec2::splat(0.5), face));
            let slope = |axis: DVec3| {
                let there = brick.surface_point(face, middle + axis);
                (there.uv - at.uv) / axis.length()
            };
            let slopes = DVec3::AXES.map(slope);
            let across = DVec3::from(slopes.map(|slope| slope.x));
            let up = DVec3::from(slopes.map(|slope| slope.y));
            let outward = across.cross(up).normalize();
            assert_eq!(outward, at.geometric_normal, "face {face}");
            assert_eq!(
                (at.position - middle).dot(outward).abs(),
                outward.abs().dot(brick.high - middle)
            );
            if face != 2 && face != 3 {
                assert!(up.y > 0.0 && up.x == 0.0 && up.z == 0.0, "face {face} stands upright");
            }
        }
    }

    #[test]
    fn a_box_without_thickness_is_none() {
        assert!(Cuboid::new(DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0)).is_none());
        assert!(Cuboid::new(DVec3::ONE, DVec3::ZERO).is_none());
        assert!(Cuboid::new(DVec3::ZERO, DVec3::new(1.0, f64::NAN, 1.0)).is_none());
    }

    #[test]
    fn a_ray_along_a_face_passes_and_one_beside_it_does_not_hit() {
        let along = |x: f64| brick().intersect(DVec3::new(x, 0.0, 9.0), DVec3::NEG_Z, FREE);
        assert_eq!(along(1.0), Some((4.0, 5)));
        assert_eq!(along(1.0f64.next_up()), None);
    }

    proptest! {
        /// A ray through two faces enters at the one and leaves at the other. It meets nothing
        /// before and after them.
        #[test]
        fn a_ray_through_two_faces_meets_both(
            from in 0u32..6, to in 0u32..6, a in prop::array::uniform3(0.01..0.99f64),
            b in prop::array::uniform3(0.01..0.99f64), before in 0.1..100.0f64,
        ) {
            prop_assume!(from != to);
            let brick = brick();
            let size = brick.high - brick.low;
            let enter = brick.surface_point(from, brick.low + size * DVec3::from(a)).position;
            let leave = brick.surface_point(to, brick.low + size * DVec3::from(b)).position;
            let direction = (leave - enter).normalize();
            let origin = enter - before * direction;
            let (t, face) = brick.intersect(origin, direction, FREE).unwrap();
            prop_assert!(face == from && (t - before).abs() < 1e-12, "{t} {face}");
            let skin = 1e-13;
            let inside = Start { left_face: Some(from), skin };
            let (t, face) = brick.intersect(enter, direction, inside).unwrap();
            prop_assert!(face == to && (t - enter.distance(leave)).abs() < 1e-12, "{t} {face}");
            let outside = Start { left_face: Some(to), skin };
            prop_assert_eq!(brick.intersect(leave, direction, outside), None);
            prop_assert_eq!(brick.intersect(leave, direction, Start { left_face: None, skin }), None);
        }
    }
}
