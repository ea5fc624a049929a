//! Texture coordinates on a triangle: exact values, and the forms that are compared with them.

#![allow(dead_code, reason = "the test and the measurement each use their part")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

pub mod classes;
pub mod dice;
pub mod right_triangle;

use glam::{DVec2, DVec3};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use render::shape::Mesh;
use render::shape::mesh::{NONE, Triangle};
use render::shape::triangle::{self, ShearedRay};

/// A ray and a triangle that it meets.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Corners `A`, `B` and `C`. The texture's right angle is at `B`, and its legs have length 1.
    pub corners: [[f32; 3]; 3],
    /// Start of the ray.
    pub origin: DVec3,
    /// Direction of the ray.
    pub direction: DVec3,
}

/// A form of the map from a hit to texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Barycentric weights as the intersection returns them: the form in use.
    Weights,
    /// Barycentric weights of the hit point, by areas in the best coordinate plane.
    Areas,
    /// The thesis's formula for the hit point.
    Thesis,
    /// Areas, for the exact hit point rounded to `f64`.
    AreasBest,
    /// The thesis's formula, for the exact hit point rounded to `f64`.
    ThesisBest,
}

pub const FORMS: [Form; 5] =
    [Form::Weights, Form::Areas, Form::Thesis, Form::AreasBest, Form::ThesisBest];

impl Form {
    /// Returns the name of the form in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Weights => "weights",
            Self::Areas => "areas",
            Self::Thesis => "thesis",
            Self::AreasBest => "areas, best point",
            Self::ThesisBest => "thesis, best point",
        }
    }
}

/// Converts a number to a fraction.
fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

/// Returns a vector times a power of two that makes all its components whole numbers.
fn whole(v: DVec3) -> [BigRational; 3] {
    let scale = exact(2f64.powi(200));
    v.to_array().map(|x| exact(x) * &scale)
}

fn difference(a: &[BigRational; 3], b: &[BigRational; 3]) -> [BigRational; 3] {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn determinant(a: &[BigRational; 3], b: &[BigRational; 3], c: &[BigRational; 3]) -> BigRational {
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1)
}

pub fn doubles(corner: [f32; 3]) -> DVec3 {
    DVec3::from(corner.map(f64::from))
}

impl Sample {
    /// Returns the exact weights of the corners at the point where the exact ray meets the exact
    /// plane.
    pub fn truth(&self) -> [BigRational; 3] {
        let direction = whole(self.direction);
        let origin = whole(self.origin);
        let [a, b, c] = self.corners.map(|corner| difference(&whole(doubles(corner)), &origin));
        // t d = w_a a + w_b b + w_c c, by Cramer's rule.
        let parts = [
            determinant(&direction, &b, &c),
            determinant(&direction, &c, &a),
            determinant(&direction, &a, &b),
        ];
        let sum = &parts[0] + &parts[1] + &parts[2];
        parts.map(|part| part / &sum)
    }

    /// Returns the exact hit point, each coordinate rounded once.
    pub fn best_point(&self, truth: &[BigRational; 3]) -> DVec3 {
        let coordinate = |k: usize| {
            let terms = (0..3).map(|i| &truth[i] * exact(f64::from(self.corners[i][k])));
            terms.fold(BigRational::zero(), |sum, term| sum + term).to_f64().unwrap()
        };
        DVec3::new(coordinate(0), coordinate(1), coordinate(2))
    }

    /// Returns the errors of all forms, in the order of [`FORMS`]. An error is the larger one of
    /// both coordinates, for a texture whose sides are 1. It is infinite where a form gives no
    /// number. Returns `None` if the rounded ray misses the triangle.
    pub fn errors(&self) -> Option<[f64; 5]> {
        let ray = ShearedRay::new(self.origin, self.direction);
        let corners = triangle::by_axis(&self.corners, DVec3::ZERO);
        let ((t, weights), _) = ray.intersect(&corners, f64::INFINITY)?;
        let truth = self.truth();
        let (hit, best) = (self.origin + t * self.direction, self.best_point(&truth));
        let corners = self.corners.map(doubles);
        let places = [
            self.mesh().surface_point(0, weights).uv,
            areas(corners, hit),
            right_triangle::map(corners, hit, DVec2::ONE).place,
            areas(corners, best),
            right_triangle::map(corners, best, DVec2::ONE).place,
        ];
        Some(places.map(|place| {
            let error = |found: f64, truth: &BigRational| {
                let found = BigRational::from_float(found)?;
                (found - truth).abs().to_f64()
            };
            match (error(place.x, &truth[0]), error(place.y, &truth[2])) {
                (Some(u), Some(v)) => u.max(v),
                _ => f64::INFINITY,
            }
        }))
    }

    /// Returns the factor by which the triangle magnifies a rounding of the coordinates: the
    /// distance of the farthest corner from the eye over the smallest height of the triangle as
    /// seen along the ray.
    pub fn condition(&self) -> f64 {
        let [a, b, c] = self.corners.map(|corner| doubles(corner) - self.origin);
        let far = [a, b, c].map(DVec3::length).into_iter().fold(0.0, f64::max);
        let area = (b - a).cross(c - a).dot(self.direction).abs();
        let longest = [a - b, b - c, c - a].map(DVec3::length).into_iter().fold(0.0, f64::max);
        far * longest / area
    }

    /// Returns the triangle as a mesh whose texture coordinates are the right triangle.
    fn mesh(&self) -> Mesh {
        let corners = [0, 1, 2];
        let triangle = Triangle { position: corners, uv: corners, normal: [NONE; 3], surface: 0 };
        Mesh {
            positions: self.corners.to_vec(),
            uvs: vec![[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]],
            triangles: vec![triangle],
            surfaces: vec![String::new()],
            ..Mesh::default()
        }
    }
}

/// Returns the weights of the first and third corner for a point, by areas in the coordinate plane
/// in which the triangle is largest.
fn areas([a, b, c]: [DVec3; 3], point: DVec3) -> DVec2 {
    let normal = (b - a).cross(c - a).abs();
    let [i, j] = if normal.x >= normal.y && normal.x >= normal.z {
        [1, 2]
    } else if normal.y >= normal.z {
        [2, 0]
    } else {
        [0, 1]
    };
    let area = |p: DVec3, q: DVec3| p[i] * q[j] - p[j] * q[i];
    let whole = area(b - a, c - a);
    DVec2::new(area(b - point, c - point), area(a - point, b - point)) / whole
}
