//! The outline of a footprint on a texture, and its growth by a texel.

use crate::footprint::Footprint;
use crate::texture::{Texture, Wrap, reduced};
use glam::DVec2;

/// Largest ratio between the perspective weights of two corners of an outline that is averaged as one.
///
/// The area of texture seen by equal parts of the film differs by up to the cube of this ratio. A smaller
/// ratio divides more outlines, at twice the cost. With a larger one the far part of a pixel counts too
/// much.
const UNEVEN: f64 = 1.06;

/// A quadrilateral on a texture, in texels, `y` downward.
///
/// A corner lies at `center + u * first + v * second + bend` for `u` and `v` of -1/2 or 1/2. The bend
/// changes its sign from corner to corner. It is 0 for a parallelogram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// Mean of the corners.
    pub center: DVec2,
    /// Mean of one pair of opposite sides, and of the other pair.
    pub sides: [DVec2; 2],
    /// Displacement of the first and third corner from those of a parallelogram.
    pub bend: DVec2,
    /// Axes of the ellipse that has the covariance of the parallelogram.
    pub axes: Axes,
}

/// Principal axes of a parallelogram: the singular value decomposition of its sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// Unit vector along the longer axis. The shorter axis is perpendicular, at +90 degrees.
    pub along: DVec2,
    /// Length of the longer axis, in texels: the side of a square of the same second moment.
    pub major: f64,
    /// Length of the shorter axis, in texels, 0 or more.
    pub minor: f64,
}

impl Axes {
    /// Returns the axes of a parallelogram with these sides.
    #[must_use]
    pub fn of([a, b]: [DVec2; 2]) -> Self {
        let (xx, xy, yy) = (a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
        let (half, difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let root = (difference * difference + xy * xy).sqrt();
        let square = half + root;
        // The longer of the two columns of S - (smaller eigenvalue) is the better direction.
        let along = if difference > 0.0 {
            DVec2::new(root + difference, xy)
        } else {
            DVec2::new(xy, root - difference)
        };
        let major = square.sqrt();
        // Rounding must not make the shorter axis the longer one.
        let minor = if major > 0.0 { (a.perp_dot(b).abs() / major).min(major) } else { 0.0 };
        Self { along: along.try_normalize().unwrap_or(DVec2::X), major, minor }
    }

    /// Unit vector along the shorter axis.
    #[must_use]
    pub fn across(&self) -> DVec2 {
        self.along.perp()
    }
}

impl Outline {
    /// Returns the outline of a footprint on a texture. Returns `None` if a coordinate is not
    /// finite.
    ///
    /// A footprint far from the origin is replaced by an equal one near it: by whole periods of the
    /// texture, or up to a clamped texture's edge. Its position is rounded as its coordinates are.
    #[must_use]
    pub fn of(footprint: &Footprint, texture: &Texture) -> Option<Self> {
        let size = DVec2::new(texture.width as f64, texture.height as f64);
        let scale = DVec2::new(size.x, -size.y);
        let (center, sides, bend) = match *footprint {
            Footprint::Point(at) => (at, [DVec2::ZERO; 2], DVec2::ZERO),
            Footprint::Rectangle { center, half } => {
                (center, [2.0 * half.x * DVec2::X, 2.0 * half.y * DVec2::Y], DVec2::ZERO)
            }
            Footprint::Parallelogram { center, sides } => (center, sides, DVec2::ZERO),
            Footprint::Quadrilateral(corners) => split(corners),
        };
        let (sides, bend) = (sides.map(|side| side * scale), bend * scale);
        let center = texture.in_texels(center);
        let axes = Axes::of(sides);
        if !(center.is_finite() && axes.major.is_finite() && bend.is_finite()) {
            return None;
        }
        let reach = 0.5 * (sides[0].abs() + sides[1].abs()) + bend.abs() + 2.0;
        let near = |at: f64, size: f64, reach: f64| match texture.wrap {
            Wrap::Repeat if at < 0.0 || at >= size => reduced(at, size),
            Wrap::Mirror if at < 0.0 || at >= 2.0 * size => reduced(at, 2.0 * size),
            Wrap::Clamp => at.clamp(-reach, size + reach),
            _ => at,
        };
        let center = DVec2::new(near(center.x, size.x, reach.x), near(center.y, size.y, reach.y));
        Some(Self { center, sides, bend, axes })
    }

    /// Returns the corners, in order.
    #[must_use]
    pub fn corners(&self) -> [DVec2; 4] {
        let [half_a, half_b] = self.sides.map(|side| 0.5 * side);
        let (sum, difference) = (half_a + half_b, half_a - half_b);
        [
            self.center - sum + self.bend,
            self.center + difference - self.bend,
            self.center + sum + self.bend,
            self.center - difference - self.bend,
        ]
    }

    /// Returns the outline, grown so that the squares of the longer and of the shorter axis are larger
    /// by these numbers, in square texels.
    ///
    /// The shape under a box of one texel has the covariance of the shape grown by 1.
    ///
    /// The formula holds for a shape without area too. A quadrilateral that is folded, or not convex,
    /// becomes the parallelogram of its mean sides.
    #[must_use]
    pub fn grown(&self, along_by: f64, across_by: f64) -> Self {
        let Axes { along, major, minor } = self.axes;
        let across = self.axes.across();
        let [a, b] = self.sides;
        // The sides in units of the major axis: a unit vector. The rest of the decomposition is
        // perpendicular to it, and orientation is kept.
        let unit = DVec2::new(a.dot(along), b.dot(along)).try_normalize().unwrap_or(DVec2::X);
        let turn = if a.perp_dot(b) < 0.0 { -1.0 } else { 1.0 };
        let grow = |axis: f64, by: f64| (axis * axis + by).sqrt();
        let (major, minor) = (grow(major, along_by), grow(minor, across_by));
        let side = |u: f64, v: f64| major * u * along + minor * v * turn * across;
        let sides = [side(unit.x, -unit.y), side(unit.y, unit.x)];
        let mut grown = Self { sides, axes: Axes { along, major, minor }, ..*self };
        if !grown.is_convex() {
            grown.bend = DVec2::ZERO;
        }
        grown
    }

    /// Returns the two halves of the outline if they belong to equal parts of the film but to areas of
    /// the texture that differ; otherwise `None`.
    ///
    /// A pixel sees a plane in perspective. Four corners determine the perspective map of a square: the
    /// weight of a corner is the area of the triangle of the other three. The two sides that are longer
    /// are divided where the middle of the square is seen.
    #[must_use]
    pub fn halves(&self) -> Option<[Self; 2]> {
        if self.bend == DVec2::ZERO || !self.is_convex() {
            return None;
        }
        let corners = self.corners();
        let weights = [0, 1, 2, 3].map(|k| {
            let [a, b, c] = [k + 1, k + 2, k + 3].map(|k| corners[k % 4]);
            (b - a).perp_dot(c - a).abs()
        });
        let (least, most) = weights.iter().fold((f64::INFINITY, 0.0), |(least, most), &weight| {
            (f64::min(least, weight), f64::max(most, weight))
        });
        if most <= UNEVEN * least {
            return None;
        }
        let [first, second] = self.sides.map(DVec2::length_squared);
        // The longer sides are those from corner 0 to 1, or those from 1 to 2.
        let k = usize::from(second > first);
        let [a, b, c, d] = [0, 1, 2, 3].map(|n| (k + n) % 4);
        let middle = |from: usize, to: usize| {
            let sum = weights[from] + weights[to];
            (weights[from] * corners[from] + weights[to] * corners[to]) / sum
        };
        let (near, far) = (middle(a, b), middle(d, c));
        let half = |corners: [DVec2; 4]| {
            let (center, sides, bend) = split(corners);
            Self { center, sides, bend, axes: Axes::of(sides) }
        };
        Some([half([corners[a], near, far, corners[d]]), half([near, corners[b], corners[c], far])])
    }

    /// Returns whether the outline turns in one direction at all corners.
    fn is_convex(&self) -> bool {
        if self.bend == DVec2::ZERO {
            return true;
        }
        let corners = self.corners();
        let turn = |k: usize| {
            let [a, b, c] = [k, k + 1, k + 2].map(|k| corners[k % 4]);
            (b - a).perp_dot(c - b)
        };
        let turns = [turn(0), turn(1), turn(2), turn(3)];
        turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0)
    }

    /// Returns the lowest and the highest coordinates of the corners.
    #[must_use]
    pub fn bounds(&self) -> (DVec2, DVec2) {
        bounds(&self.corners())
    }

    /// Returns the outline, moved.
    #[must_use]
    pub fn moved(&self, by: DVec2) -> Self {
        Self { center: self.center + by, ..*self }
    }
}

/// Returns the mean of four corners, the mean sides between them, and the bend.
fn split([a, b, c, d]: [DVec2; 4]) -> (DVec2, [DVec2; 2], DVec2) {
    let sides = [0.5 * (b - a + c - d), 0.5 * (d - a + c - b)];
    (0.25 * (a + b + c + d), sides, 0.25 * (a - b + c - d))
}

/// Returns the lowest and the highest coordinates of four corners.
#[must_use]
pub fn bounds([a, b, c, d]: &[DVec2; 4]) -> (DVec2, DVec2) {
    (a.min(*b).min(c.min(*d)), a.max(*b).max(c.max(*d)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat2;
    use proptest::prelude::*;

    fn vectors() -> impl Strategy<Value = DVec2> {
        (-9.0..9.0f64, -9.0..9.0f64).prop_map(DVec2::from)
    }

    fn outline(center: DVec2, sides: [DVec2; 2], bend: DVec2) -> Outline {
        Outline { center, sides, bend, axes: Axes::of(sides) }
    }

    /// Twelve times the covariance of a parallelogram.
    fn square([a, b]: [DVec2; 2]) -> DMat2 {
        let sides = DMat2::from_cols(a, b);
        sides * sides.transpose()
    }

    proptest! {
        #[test]
        fn axes_have_the_covariance_of_the_sides(a in vectors(), b in vectors(), kind in 0..4u8) {
            let b = match kind { 0 => b, 1 => a, 2 => a.perp(), _ => DVec2::ZERO };
            let axes = Axes::of([a, b]);
            let same = square([axes.major * axes.along, axes.minor * axes.across()]);
            prop_assert!(same.abs_diff_eq(square([a, b]), 1e-10), "{same} {axes:?}");
            prop_assert!(axes.major >= axes.minor);
        }

        /// The growth adds to the covariance, keeps the orientation, and needs no area.
        #[test]
        fn growth_adds_to_the_covariance(a in vectors(), b in vectors(), kind in 0..3u8) {
            let b = match kind { 0 => b, 1 => -2.0 * a, _ => DVec2::ZERO };
            let before = outline(DVec2::ZERO, [a, b], DVec2::ZERO);
            let grown = before.grown(1.0, 1.0);
            let found = square(grown.sides);
            prop_assert!(found.abs_diff_eq(square([a, b]) + DMat2::IDENTITY, 1e-9), "{found}");
            let (turn, turned) = (a.perp_dot(b), grown.sides[0].perp_dot(grown.sides[1]));
            prop_assert!(turned.abs() >= 1.0 - 1e-9 && (turn.abs() < 1e-9 || turn * turned > 0.0));
        }

        #[test]
        fn corners_are_those_of_the_quadrilateral(corners in prop::array::uniform4(vectors())) {
            let texture =
                Texture { width: 16, height: 16, texels: vec![[0; 3]; 256], ..Texture::default() };
            let found = Outline::of(&Footprint::Quadrilateral(corners), &texture);
            let found = found.map(|outline| outline.corners()).unwrap_or_default();
            // Whole periods of 16 texels may differ, but the same for all corners.
            let moved = found[0] - texture.in_texels(corners[0]);
            prop_assert!((moved / 16.0 - (moved / 16.0).round()).length() < 1e-9, "{moved}");
            for (found, corner) in found.into_iter().zip(corners) {
                prop_assert!(found.abs_diff_eq(texture.in_texels(corner) + moved, 1e-9), "{found}");
            }
        }
    }

    /// The halves of a square seen in perspective are its halves on the film.
    #[test]
    fn halves_are_those_of_the_film() {
        let seen =
            |x: f64, y: f64| DVec2::new(3.0 + 40.0 * x, 5.0 + 9.0 * y) / (1.0 + 0.2 * x + 0.1 * y);
        let rectangle = |low: f64, high: f64| {
            [seen(low, 0.0), seen(high, 0.0), seen(high, 1.0), seen(low, 1.0)]
        };
        for turn in 0..4 {
            let mut corners = rectangle(0.0, 1.0);
            corners.rotate_left(turn);
            let (center, sides, bend) = split(corners);
            let halves = outline(center, sides, bend).halves().unwrap();
            let mut found: Vec<DVec2> = halves.iter().map(|half| half.center).collect();
            found.sort_by(|a, b| a.x.total_cmp(&b.x));
            let truth = [rectangle(0.0, 0.5), rectangle(0.5, 1.0)].map(|half| split(half).0);
            assert!(found[0].abs_diff_eq(truth[0], 1e-12), "{found:?} {truth:?}");
            assert!(found[1].abs_diff_eq(truth[1], 1e-12), "{found:?} {truth:?}");
        }
        let even = outline(DVec2::ZERO, [DVec2::X, DVec2::Y], DVec2::new(0.001, 0.0));
        assert_eq!(even.halves(), None);
    }

    #[test]
    fn a_folded_quadrilateral_becomes_a_parallelogram() {
        let (a, b) = (DVec2::new(4.0, 0.0), DVec2::new(0.0, 3.0));
        let kept = outline(DVec2::ZERO, [a, b], DVec2::new(0.5, 0.0)).grown(1.0, 1.0);
        assert_eq!(kept.bend, DVec2::new(0.5, 0.0));
        let folded = outline(DVec2::ZERO, [a, b], DVec2::new(9.0, 0.0)).grown(1.0, 1.0);
        assert_eq!(folded.bend, DVec2::ZERO);
    }
}
