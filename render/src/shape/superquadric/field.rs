//! The function that is 1 on the surface of a superquadric, along rays and over pieces of rays.
//!
//! Let h be the norm of (x, z) of order 2/e2. The function is the norm of (h - ring, y) of order
//! 2/e1. Here "norm" means (|a|^p + |b|^p)^(1/p), also for p below 1. Barr's inside-outside
//! function is a power of it, with the same level 1. The norm itself grows evenly, like a distance,
//! and does not overflow.
//!
//! A norm increases with each of its two sizes. Its range over a box of sizes therefore lies
//! between its values at two corners. The same holds for the terms of its slope. Bounds over a
//! piece of a ray are thus exact for the box around that piece.

use glam::DVec3;

/// The function, in units of the radii and with the axis along y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Order 2/e1 of the sections through the axis, 0.5 to 40.
    pub section: f64,
    /// Order 2/e2 of the sections across the axis, 0.5 to 40.
    pub across: f64,
    /// Distance of the middle of the tube from the axis in units of the radii, 1 to 1000; 0 for a
    /// superellipsoid.
    pub ring: f64,
}

/// A line through the field: the points `from + t step`.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// The field.
    pub field: Field,
    /// Point of the line where `t` is 0.
    pub from: DVec3,
    /// Change of position per unit of `t`.
    pub step: DVec3,
}

/// A closed range of numbers: lower and upper bound.
pub type Range = [f64; 2];

/// Returns `(a^p + b^p)^(1/p)` of two numbers that are 0 or more.
fn norm(a: f64, b: f64, p: f64) -> f64 {
    let (small, large) = if a < b { (a, b) } else { (b, a) };
    if small == 0.0 {
        large
    } else if p == 2.0 {
        (a * a + b * b).sqrt()
    } else {
        large * (1.0 + (small / large).powf(p)).powf(1.0 / p)
    }
}

/// Returns the derivative of the norm by one of its sizes. The size is `ratio` times the norm.
fn slope(ratio: f64, p: f64) -> f64 {
    if p == 2.0 { ratio } else { ratio.powf(p - 1.0) }
}

/// The field's derivatives at a point.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// As [`Field::axis_norm`].
    pub axis_norm: f64,
    /// As [`Field::axis_gradient`].
    pub axis_gradient: DVec3,
    /// Changes of the axis gradient for two steps, as below.
    pub axis_changes: [DVec3; 2],
    /// As [`Field::gradient`].
    pub gradient: DVec3,
    /// Changes of the gradient for two steps, to first order. A part that is infinite, at a crease,
    /// is left out.
    pub changes: [DVec3; 2],
}

/// Returns the derivative of the norm by a signed size, and its own derivative by the ratio. The
/// size is `ratio` times the norm. Both results are 0 where they have no bound.
fn part(ratio: f64, p: f64) -> (f64, f64) {
    if p == 2.0 {
        return (ratio, 1.0);
    }
    if ratio == 0.0 {
        return (0.0, 0.0);
    }
    let size = ratio.abs();
    let slope = size.powf(p - 1.0);
    (slope.copysign(ratio), (p - 1.0) * slope / size)
}

/// Returns the product, or 0 if it has no bound.
fn times(curve: f64, change: f64) -> f64 {
    let product = curve * change;
    if product.is_finite() { product } else { 0.0 }
}

impl Field {
    /// Returns whether the surface is convex. If so, the function is convex too.
    pub fn is_convex(&self) -> bool {
        self.section >= 1.0 && self.across >= 1.0 && self.ring == 0.0
    }

    /// Largest absolute value of each coordinate on the surface.
    pub fn reach(&self) -> DVec3 {
        DVec3::new(self.ring + 1.0, 1.0, self.ring + 1.0)
    }

    /// Returns h, the distance from the axis measured by the norm of the sections across it.
    pub fn axis_norm(&self, point: DVec3) -> f64 {
        norm(point.x.abs(), point.z.abs(), self.across)
    }

    /// Returns the derivatives of h by each coordinate.
    pub fn axis_gradient(&self, point: DVec3) -> DVec3 {
        let h = self.axis_norm(point);
        let part = |signed: f64| {
            if signed == 0.0 { 0.0 } else { slope(signed.abs() / h, self.across).copysign(signed) }
        };
        DVec3::new(part(point.x), 0.0, part(point.z))
    }

    /// Returns the value of the function: below 1 inside, 1 on the surface, above 1 outside.
    pub fn value(&self, point: DVec3) -> f64 {
        norm((self.axis_norm(point) - self.ring).abs(), point.y.abs(), self.section)
    }

    /// Returns the derivatives of the function by each coordinate. They are infinite at creases. A
    /// derivative is 0 where its coordinate is 0, since the two sides mirror each other there.
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        let h = self.axis_norm(point);
        let tube = h - self.ring;
        let value = norm(tube.abs(), point.y.abs(), self.section);
        let part = |signed: f64, norm: f64, p: f64| {
            if signed == 0.0 { 0.0 } else { slope(signed.abs() / norm, p).copysign(signed) }
        };
        let outward = part(tube, value, self.section);
        let times = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        DVec3::new(
            times(outward, part(point.x, h, self.across)),
            part(point.y, value, self.section),
            times(outward, part(point.z, h, self.across)),
        )
    }

    /// Returns the gradient at a point, and its changes for two small steps.
    pub fn bend(&self, point: DVec3, steps: [DVec3; 2]) -> Bend {
        let h = self.axis_norm(point);
        let [x, z] = if h > 0.0 { [point.x / h, point.z / h] } else { [0.0; 2] };
        let [(h_x, curve_x), (h_z, curve_z)] = [x, z].map(|ratio| part(ratio, self.across));
        let tube = h - self.ring;
        let value = norm(tube.abs(), point.y.abs(), self.section);
        let [tube, y] = [tube / value, point.y / value];
        let [(f_tube, curve_tube), (f_y, curve_y)] =
            [tube, y].map(|ratio| part(ratio, self.section));
        let axis_gradient = DVec3::new(h_x, 0.0, h_z);
        let axis_changes = steps.map(|step| {
            let of_h = axis_gradient.dot(step);
            let around = |ratio: f64, curve: f64, step: f64| {
                if h > 0.0 { times(curve, (step - ratio * of_h) / h) } else { 0.0 }
            };
            DVec3::new(around(x, curve_x, step.x), 0.0, around(z, curve_z, step.z))
        });
        let changes = [0, 1].map(|k| {
            let of_h = axis_gradient.dot(steps[k]);
            let of_value = f_tube * of_h + f_y * steps[k].y;
            let of_tube = times(curve_tube, (of_h - tube * of_value) / value);
            let of_y = times(curve_y, (steps[k].y - y * of_value) / value);
            of_tube * axis_gradient + f_tube * axis_changes[k] + of_y * DVec3::Y
        });
        let gradient = DVec3::new(f_tube * h_x, f_y, f_tube * h_z);
        Bend { axis_norm: h, axis_gradient, axis_changes, gradient, changes }
    }

    /// Returns the unit direction of the gradient, in a space whose coordinates are `radii` times
    /// as large.
    pub fn direction(&self, point: DVec3, radii: DVec3) -> DVec3 {
        let gradient = self.gradient(point) / radii;
        let most = gradient.abs().max_element();
        if most.is_finite() {
            return (gradient / most).normalize_or(DVec3::Y);
        }
        // Only the infinite components count.
        let endless = |x: f64| if x.is_infinite() { x.signum() } else { 0.0 };
        DVec3::from(gradient.to_array().map(endless)).normalize_or(DVec3::Y)
    }
}

impl Line {
    /// Returns the point of the line at `t`.
    fn at(&self, t: f64) -> DVec3 {
        self.from + t * self.step
    }

    /// Returns the field's value at `t` minus 1, which is negative inside.
    pub fn value(&self, t: f64) -> f64 {
        self.field.value(self.at(t)) - 1.0
    }

    /// Returns the derivative of [`Self::value`] along the line. It is NaN where two creases meet.
    pub fn slope(&self, t: f64) -> f64 {
        let gradient = self.field.gradient(self.at(t));
        let along = |k: usize| if self.step[k] == 0.0 { 0.0 } else { gradient[k] * self.step[k] };
        along(0) + along(1) + along(2)
    }

    /// Returns the values of `t` at which each coordinate changes its sign. The coordinate keeps
    /// its sign elsewhere.
    pub fn crossings(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| -self.from[k] / self.step[k])
    }

    /// Returns bounds of the value minus 1 and of the slope between `a` and `b`. No coordinate may
    /// change its sign between them. A bound of the slope may be infinite, or NaN where nothing is
    /// known.
    pub fn ranges(&self, a: f64, b: f64) -> [Range; 2] {
        let Field { section, across, ring } = self.field;
        let (begin, end) = (self.at(a), self.at(b));
        // The size of each coordinate, and the growth of this size along the line.
        let size = |k: usize| {
            let (begin, end) = (begin[k], end[k]);
            // Different signs here are a rounding beside a crossing.
            let low = if begin * end < 0.0 { 0.0 } else { begin.abs().min(end.abs()) };
            let sign = if begin + end < 0.0 { -1.0 } else { 1.0 };
            let growth = if begin == 0.0 && end == 0.0 { 0.0 } else { sign * self.step[k] };
            ([low, begin.abs().max(end.abs())], [growth; 2])
        };
        let ((x, dx), (y, dy), (z, dz)) = (size(0), size(1), size(2));
        let (h, dh) = joined([x, z], [dx, dz], across);
        let (tube, dtube) = if ring == 0.0 {
            (h, dh)
        } else if h[0] >= ring {
            ([h[0] - ring, h[1] - ring], dh)
        } else if h[1] <= ring {
            ([ring - h[1], ring - h[0]], [-dh[1], -dh[0]])
        } else {
            let most = dh[0].abs().max(dh[1].abs());
            ([0.0, (ring - h[0]).max(h[1] - ring)], [-most, most])
        };
        let (value, slope) = joined([tube, y], [dtube, dy], section);
        [value.map(|value| value - 1.0), slope]
    }
}

/// Returns the ranges of a norm and of its growth from the ranges of its two sizes and their
/// growths.
fn joined(sizes: [Range; 2], growths: [Range; 2], p: f64) -> (Range, Range) {
    // In units of the largest size, so that its powers stay in range.
    let unit = sizes[0][1].max(sizes[1][1]);
    if unit == 0.0 {
        // Both sizes are 0 along the whole piece.
        return ([0.0; 2], [0.0; 2]);
    }
    let [a, b] = sizes.map(|size| size.map(|x| x / unit));
    let power = |x: f64| if p == 2.0 { x * x } else { x.powf(p) };
    let root = |x: f64| if p == 2.0 { x.sqrt() } else { x.powf(1.0 / p) };
    let [a_p, b_p] = [a, b].map(|size| size.map(power));
    // Powers of the norms at the four corners of the box; `corner[i][j]` belongs to a[i] and b[j].
    let corner_p = [0, 1].map(|i| [0, 1].map(|j| a_p[i] + b_p[j]));
    let corner = corner_p.map(|row| row.map(root));
    let slope = |x: f64, x_p: f64, norm: f64, norm_p: f64| {
        if x > 0.0 && norm > 0.0 {
            (x_p / x) * (norm / norm_p)
        } else if p > 1.0 {
            0.0
        } else if p < 1.0 {
            f64::INFINITY
        } else {
            1.0
        }
    };
    let at = |i: usize, j: usize| (corner[i][j], corner_p[i][j]);
    let mut growth = [0.0; 2];
    // The share of a size in the norm is least when the size is least and the other size is
    // largest.
    let parts = [(a, a_p, at(0, 1), at(1, 0)), (b, b_p, at(1, 0), at(0, 1))];
    for ((own, own_p, least, most), its) in parts.into_iter().zip(growths) {
        let slopes =
            [slope(own[0], own_p[0], least.0, least.1), slope(own[1], own_p[1], most.0, most.1)];
        let [low, high] = if p < 1.0 { [slopes[1], slopes[0]] } else { slopes };
        let times = |growth: f64, slope: f64| if growth == 0.0 { 0.0 } else { growth * slope };
        growth[0] += times(its[0], if its[0] < 0.0 { high } else { low });
        growth[1] += times(its[1], if its[1] < 0.0 { low } else { high });
    }
    ([unit * corner[0][0], unit * corner[1][1]], growth)
}
