//! Classes of triangles and hits, from easy to hard.

use super::dice::{Dice, Directions};
use super::{Sample, doubles};
use glam::DVec3;

/// A class of triangles and hits.
pub struct Class {
    /// Name of the class, which states its difficulty.
    pub name: &'static str,
    make: Box<dyn Fn(&mut Dice) -> Sample>,
}

impl Class {
    /// Returns `count` samples of the class, the same in every run.
    pub fn samples(&self, count: usize) -> Vec<Sample> {
        let mut dice = Dice::new(0);
        (0..count).map(|_| (self.make)(&mut dice)).collect()
    }
}

fn class(name: &'static str, make: impl Fn(&mut Dice) -> Sample + 'static) -> Class {
    Class { name, make: Box::new(make) }
}

/// Returns all classes.
pub fn classes() -> Vec<Class> {
    let mut all = vec![class("well shaped", |dice| inside(dice, well))];
    for (axis, name) in ["plane x = const", "plane y = const", "plane z = const"].iter().enumerate()
    {
        all.push(class(name, move |dice| inside(dice, |dice| flat(dice, axis, 0))));
    }
    let near = ["some ulps off x = const", "some ulps off y = const", "some ulps off z = const"];
    for (axis, name) in near.iter().enumerate() {
        all.push(class(name, move |dice| inside(dice, |dice| flat(dice, axis, 3))));
    }
    all.push(class("upright, y = x/2", |dice| inside(dice, |dice| upright(dice, 0))));
    all.push(class("some ulps off upright", |dice| inside(dice, |dice| upright(dice, 3))));
    for (name, aspect) in [("needle 1e3", 1e3), ("needle 1e6", 1e6), ("needle 1e9", 1e9)] {
        all.push(class(name, move |dice| inside(dice, |dice| needle(dice, aspect))));
    }
    for (name, aspect) in [("sliver 1e3", 1e3), ("sliver 1e6", 1e6), ("sliver 1e9", 1e9)] {
        all.push(class(name, move |dice| inside(dice, |dice| sliver(dice, aspect))));
    }
    for (name, size) in [("size 1e-9", 1e-9f32), ("size 1e9", 1e9)] {
        let make = move |dice: &mut Dice| well(dice).map(|corner| corner.map(|x| x * size));
        all.push(class(name, move |dice| inside(dice, make)));
    }
    all.push(class("coordinates 1e-9 to 1e9", |dice| inside(dice, mixed)));
    for (name, away) in [("1e3 sizes from the origin", 1e3f32), ("1e6 sizes away", 1e6)] {
        let make = move |dice: &mut Dice| {
            let to = dice.direction();
            well(dice).map(|corner| std::array::from_fn(|k| corner[k] + to[k] as f32 * away))
        };
        all.push(class(name, move |dice| inside(dice, make)));
    }
    for (name, graze) in [("grazing, 1e-3 rad", 1e-3), ("grazing, 1e-6 rad", 1e-6)] {
        all.push(class(name, move |dice| {
            let (corners, weights) = (well(dice), weights(dice));
            seen(dice, corners, weights, graze)
        }));
    }
    let sides =
        [("1e-3 to 1e-15 off AC", 1), ("1e-3 to 1e-15 off AB", 2), ("1e-3 to 1e-15 off BC", 0)];
    for (name, corner) in sides {
        all.push(class(name, move |dice| {
            let mut weights = weights(dice);
            weights[corner] = 10f64.powf(dice.between(-15.0, -3.0));
            let (corners, cosine) = (well(dice), dice.between(0.3, 1.0));
            seen(dice, corners, weights, cosine)
        }));
    }
    let sides = [("on AC but for rounding", 1), ("on AB but for rounding", 2)];
    for (name, corner) in sides {
        all.push(class(name, move |dice| {
            let mut weights = weights(dice);
            weights[corner] = 0.0;
            let (corners, cosine) = (well(dice), dice.between(0.3, 1.0));
            seen(dice, corners, weights, cosine)
        }));
    }
    // Weights in eighths of lattice points are exact, and so are rays along an axis.
    let places: [(&str, Weights); 7] = [
        ("exactly on AC", |dice| eighths(dice, 0, 2)),
        ("exactly on AB", |dice| eighths(dice, 0, 1)),
        ("exactly on BC", |dice| eighths(dice, 1, 2)),
        ("exactly at A", |_| [1.0, 0.0, 0.0]),
        ("exactly at B", |_| [0.0, 1.0, 0.0]),
        ("exactly at C", |_| [0.0, 0.0, 1.0]),
        ("centre of gravity", |_| [1.0; 3]),
    ];
    for (name, weights) in places {
        all.push(class(name, move |dice| {
            let weights = weights(dice);
            straight(dice, weights)
        }));
    }
    all
}

type Corners = [[f32; 3]; 3];

/// A function that draws weights of the corners.
type Weights = fn(&mut Dice) -> [f64; 3];

fn rounded(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

/// Returns the smallest height of a triangle over its longest side.
fn shape([a, b, c]: [DVec3; 3]) -> f64 {
    let longest = [a - b, b - c, c - a].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
    (b - a).cross(c - a).length() / longest
}

/// Draws corners at most 1 from the origin.
fn well(dice: &mut Dice) -> Corners {
    loop {
        let corners = std::array::from_fn(|_| rounded(dice.direction() * dice.between(0.3, 1.0)));
        if shape(corners.map(doubles)) > 0.4 {
            return corners;
        }
    }
}

fn nudged(dice: &mut Dice, x: f32, ulps: usize) -> f32 {
    (0..dice.below(ulps + 1)).fold(x, |x, _| x.next_up())
}

/// Draws corners in a coordinate plane, or up to some ulps off it.
fn flat(dice: &mut Dice, axis: usize, ulps: usize) -> Corners {
    let level = dice.between(-1.0, 1.0) as f32;
    loop {
        let mut corners = well(dice);
        for corner in &mut corners {
            corner[axis] = nudged(dice, level, ulps);
        }
        let same = corners.iter().all(|corner| corner[axis] == corners[0][axis]);
        if shape(corners.map(doubles)) > 0.4 && same == (ulps == 0) {
            return corners;
        }
    }
}

/// Draws corners in the plane y = x/2, which is perpendicular to the x-y plane, or up to some ulps
/// off it.
fn upright(dice: &mut Dice, ulps: usize) -> Corners {
    loop {
        let mut corners = well(dice);
        for corner in &mut corners {
            corner[1] = nudged(dice, corner[0] / 2.0, ulps);
        }
        let off = corners.iter().any(|corner| corner[1] != corner[0] / 2.0);
        if shape(corners.map(doubles)) > 0.4 && off == (ulps > 0) {
            return corners;
        }
    }
}

/// Draws a triangle with one short side at the origin; each corner in turn is the sharp one.
fn needle(dice: &mut Dice, aspect: f64) -> Corners {
    let long = dice.direction();
    let across = long.any_orthonormal_vector();
    let middle = long + across * (0.5 / aspect);
    let mut corners = [DVec3::ZERO, across / aspect, middle].map(rounded);
    corners.rotate_left(dice.below(3));
    corners
}

/// Draws a triangle with one corner nearly on the opposite side; each corner in turn.
fn sliver(dice: &mut Dice, aspect: f64) -> Corners {
    let end = rounded(dice.direction());
    let across = doubles(end).any_orthonormal_vector();
    let mut corners = [end, rounded(across / aspect), end.map(|x| -x / 2.0)];
    corners.rotate_left(dice.below(3));
    corners
}

/// Draws corners whose coordinates have independent magnitudes.
fn mixed(dice: &mut Dice) -> Corners {
    loop {
        let corners = std::array::from_fn(|_| {
            std::array::from_fn(|_| {
                let size = 10f64.powf(dice.between(-9.0, 9.0));
                (if dice.below(2) == 0 { size } else { -size }) as f32
            })
        });
        if shape(corners.map(doubles)) > 1e-9 {
            return corners;
        }
    }
}

/// Draws weights that sum to about 1, none near 0.
fn weights(dice: &mut Dice) -> [f64; 3] {
    std::array::from_fn(|_| dice.between(0.1, 1.0))
}

fn eighths(dice: &mut Dice, from: usize, to: usize) -> [f64; 3] {
    let part = (1 + dice.below(7)) as f64 / 8.0;
    let mut weights = [0.0; 3];
    (weights[from], weights[to]) = (1.0 - part, part);
    weights
}

fn inside(dice: &mut Dice, corners: impl Fn(&mut Dice) -> Corners) -> Sample {
    let (corners, weights, cosine) = (corners(dice), weights(dice), dice.between(0.3, 1.0));
    seen(dice, corners, weights, cosine)
}

/// Returns a ray from four triangle sizes away to the point with these weights. `cosine` is that of
/// its angle to the normal.
fn seen(dice: &mut Dice, corners: Corners, weights: [f64; 3], cosine: f64) -> Sample {
    let [a, b, c] = corners.map(doubles);
    let sum: f64 = weights.iter().sum();
    let target = (weights[0] * a + weights[1] * b + weights[2] * c) / sum;
    let size = [a - b, b - c, c - a].map(DVec3::length).into_iter().fold(0.0, f64::max);
    // The square of a size of 1e-9 is far above the smallest `f64`.
    let normal = (b - a).cross(c - a).normalize();
    let along = dice.direction().reject_from(normal).normalize();
    let from = cosine * normal + (1.0 - cosine * cosine).sqrt() * along;
    let origin = target + 4.0 * size * from;
    Sample { corners, origin, direction: (target - origin).normalize() }
}

/// Returns a ray along the axis that the triangle faces most, to the point with these weights. The
/// corners are multiples of 3/16. The point is exact if the weights are eighths or all equal.
fn straight(dice: &mut Dice, weights: [f64; 3]) -> Sample {
    loop {
        let mut lattice = || (dice.below(129) as f32 - 64.0) * 3.0 / 16.0;
        let corners: Corners = std::array::from_fn(|_| std::array::from_fn(|_| lattice()));
        let [a, b, c] = corners.map(doubles);
        // Seen from here, every form has the coordinate planes that it needs; other positions are
        // classes of their own.
        let normal = (b - a).cross(c - a);
        if shape([a, b, c]) < 0.2 || normal.abs().max_element() > normal.z.abs() {
            continue;
        }
        let sum: f64 = weights.iter().sum();
        let target = (weights[0] * a + weights[1] * b + weights[2] * c) / sum;
        let origin = target + DVec3::new(0.0, 0.0, 32.0);
        return Sample { corners, origin, direction: DVec3::NEG_Z };
    }
}
