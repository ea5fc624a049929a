//! Properties of noise, each checked against an independent computation.

use super::lattice::{Cell, MAXNOISE};
use super::*;
use glam::{DAffine3, DMat3, DQuat, DVec2, EulerRot};
use proptest::prelude::*;

const INTERPOLATIONS: [Interpolation; 3] =
    [Interpolation::Linear, Interpolation::Smooth, Interpolation::Smoother];

fn noise(interpolation: Interpolation) -> Noise {
    Noise { lattice: Arc::new(NoiseLattice::new()), interpolation }
}

fn any_point() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-100.0..100.0f64).prop_map(DVec3::from)
}

/// A point without texture coordinates.
fn at(point: DVec3, normal: DVec3) -> Place {
    Place { point, normal, uv: DVec2::ZERO, uv_gradients: [DVec3::ZERO; 2] }
}

/// Trilinear interpolation as one sum over corners, independent of the order of axes.
fn summed(noise: &Noise, point: DVec3, value: impl Fn([i64; 3]) -> f64) -> f64 {
    let cell = Cell::of(point);
    let mut sum = 0.0;
    for k in 0..8 {
        let step = [k & 1, k >> 1 & 1, k >> 2];
        let weights = (0..3).map(|axis| {
            let t = noise.interpolation.fade(cell.offset[axis]);
            if step[axis] == 1 { t } else { 1.0 - t }
        });
        sum += weights.product::<f64>() * value(cell.at(step));
    }
    sum
}

/// Returns central differences along the three axes.
fn slopes(of: impl Fn(DVec3) -> f64, point: DVec3, step: f64) -> DVec3 {
    let along = |axis: DVec3| (of(point + step * axis) - of(point - step * axis)) / (2.0 * step);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
}

proptest! {
    #[test]
    fn noise_is_the_weighted_sum_of_eight_corners(point in any_point()) {
        for interpolation in INTERPOLATIONS {
            let noise = noise(interpolation);
            let expected = summed(&noise, point, |corner| noise.lattice.value(corner));
            prop_assert!((noise.value(point) - expected).abs() < 1e-14);
            prop_assert!(noise.value(point).abs() <= 1.0);
        }
    }

    #[test]
    fn dnoise_is_the_direction_of_the_interpolated_differences(point in any_point()) {
        let noise = noise(Interpolation::Linear);
        let along = |axis: usize| summed(&noise, point, |corner| {
            let mut next = corner;
            next[axis] += 1;
            noise.lattice.value(next) - noise.lattice.value(corner)
        });
        let expected = DVec3::new(along(0), along(1), along(2));
        prop_assert!(noise.differences(point).abs_diff_eq(expected, 1e-14));
        prop_assert!(noise.dnoise(point).abs_diff_eq(expected.normalize(), 1e-12));
    }

    /// Inside a cell the error of a difference is the square of its step times a third derivative
    /// of at most 120, plus a rounding of 1e-16 divided by the step.
    #[test]
    fn gradients_agree_with_differences(
        corner in prop::array::uniform3(-70..70i32), offset in prop::array::uniform3(0.01..0.99f64),
    ) {
        let point = DVec3::from(corner.map(f64::from)) + DVec3::from(offset);
        for interpolation in INTERPOLATIONS {
            let noise = noise(interpolation);
            let expected = slopes(|p| noise.value(p), point, 1e-4);
            prop_assert!(noise.gradient(point).abs_diff_eq(expected, 1e-6), "{interpolation:?}");
        }
    }

    #[test]
    fn gradients_of_sums_agree_with_differences(point in any_point()) {
        let octaves = Octaves { noise: noise(Interpolation::Smoother), count: 4 };
        // The finest octave has 8 times the frequency, so its third derivative is 512 / 8 times as
        // large.
        let expected = slopes(|p| octaves.fractal(p), point, 1e-5);
        prop_assert!(octaves.fractal_gradient(point).abs_diff_eq(expected, 1e-5));
        // |noise| has a crease where the noise is 0. Differences across a crease are meaningless.
        let points: Vec<DVec3> = points_of(point, 4).collect();
        prop_assume!(points.iter().all(|&at| octaves.noise.value(at).abs() > 1e-3));
        let expected = slopes(|p| octaves.turbulence(p), point, 1e-5);
        prop_assert!(octaves.turbulence_gradient(point).abs_diff_eq(expected, 1e-5));
    }

    #[test]
    fn sums_are_those_of_their_octaves(point in any_point(), count in 1..=8u32) {
        let octaves = Octaves { noise: noise(Interpolation::Linear), count };
        let (mut fractal, mut turbulence) = (0.0, 0.0);
        for (k, at) in points_of(point, count).enumerate() {
            let value = octaves.noise.value(at) / f64::from(1u32 << k);
            fractal += value;
            turbulence += value.abs();
        }
        // Positions are computed in two orders; eight octaves magnify the rounding by 2^8.
        prop_assert!((octaves.fractal(point) - fractal).abs() < 1e-9);
        prop_assert!((octaves.turbulence(point) - turbulence).abs() < 1e-9);
        prop_assert!(turbulence <= octaves.weight());
        let weights: f64 = (0..count).map(|k| 0.5f64.powi(k as i32)).sum();
        prop_assert!((octaves.weight() - weights).abs() < 1e-15);
    }

    /// A point one period away lies in the same cell. Its offset has the rounding of its distance.
    #[test]
    fn noise_repeats_after_its_period(point in any_point(), periods in prop::array::uniform3(-9..9i32)) {
        let away = DVec3::from(periods.map(f64::from)) * MAXNOISE as f64;
        for interpolation in INTERPOLATIONS {
            let noise = noise(interpolation);
            prop_assert!((noise.value(point) - noise.value(point + away)).abs() < 1e-11);
        }
    }
}

/// Returns the positions at which octaves are evaluated. Each is the one before rotated by 60
/// degrees about (1, 1, 1) by Rodrigues' formula, doubled and moved.
fn points_of(point: DVec3, count: u32) -> impl Iterator<Item = DVec3> {
    let axis = DVec3::ONE.normalize();
    let turn = DMat3::from_axis_angle(axis, std::f64::consts::FRAC_PI_3);
    std::iter::successors(Some(point), move |&at| {
        Some(2.0 * (turn * at) + DVec3::new(0.371, 5.593, 11.817))
    })
    .take(count as usize)
}

#[test]
fn at_lattice_points_noise_is_the_lattice() {
    for interpolation in INTERPOLATIONS {
        let noise = noise(interpolation);
        for point in [[0, 0, 0], [5, -3, 70], [-64, 63, 1_000_000_000]] {
            let at = DVec3::from(point.map(|x| x as f64));
            assert_eq!(noise.value(at), noise.lattice.value(point), "{interpolation:?}");
        }
    }
}

/// Returns the jumps of the value, of the slope along x and of the curvature along x across faces x
/// = const, as root mean squares.
fn jumps(interpolation: Interpolation) -> [f64; 3] {
    let noise = noise(interpolation);
    let step = 1e-4;
    let mut sums = [0.0; 3];
    let count = 400;
    for k in 0..count {
        let at = DVec3::new(f64::from(k % 20), 0.37 * f64::from(k), 0.71 * f64::from(k));
        let value = |steps: f64| noise.value(at + steps * step * DVec3::X);
        let slope = |steps: f64| noise.gradient(at + steps * step * DVec3::X).x;
        let curvature = |side: f64| (slope(side * 2.0) - slope(side)) / (side * step);
        let found = [
            value(1e-6) - value(-1e-6),
            slope(1e-6) - slope(-1e-6),
            curvature(1.0) - curvature(-1.0),
        ];
        for (sum, jump) in sums.iter_mut().zip(found) {
            *sum += jump * jump;
        }
    }
    sums.map(|sum| (sum / f64::from(count)).sqrt())
}

/// Differences of random values are about 0.5 after interpolation across the face. Slopes jump by
/// as much with linear interpolation, and curvatures jump by six times the difference with the
/// cubic.
#[test]
fn each_interpolation_is_as_smooth_as_it_says() {
    let [[c0, c1, _], [d0, d1, d2], [e0, e1, e2]] = INTERPOLATIONS.map(jumps);
    // Jumps are taken over 2e-10. Slopes and curvatures of at most 50 stay below 1e-8 there.
    for value in [c0, d0, e0] {
        assert!(value < 1e-8, "continuous, but for {value}");
    }
    assert!(c1 > 0.3, "linear interpolation has creases, found {c1}");
    assert!(d1 < 1e-8 && e1 < 1e-8, "continuous slopes, but for {d1} and {e1}");
    assert!(d2 > 2.0, "the cubic's curvature jumps, found {d2}");
    // The quintic's curvature grows from 0 by 60 times the step, on both sides.
    assert!(e2 < 0.05, "continuous curvature, but for {e2}");
}

/// Trilinear interpolation of values of variance 1/3 has variance (1/3)(2/3)^3 over a cell. Over
/// 64000 points of one period, whose spacing is 1.6 cells, the mean and the variance stay within a
/// hundredth.
#[test]
fn noise_has_the_mean_and_the_variance_of_its_interpolation() {
    let noise = noise(Interpolation::Linear);
    let (mut sum, mut square, count) = (0.0, 0.0, 40);
    for i in 0..count {
        for j in 0..count {
            for k in 0..count {
                let step = MAXNOISE as f64 / f64::from(count);
                let at = DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + 0.29;
                let value = noise.value(step * at);
                sum += value;
                square += value * value;
            }
        }
    }
    let count = f64::from(count).powi(3);
    assert!((sum / count).abs() < 0.01, "{}", sum / count);
    assert!((square / count - 8.0 / 81.0).abs() < 0.01, "{}", square / count);
}

#[test]
fn far_places_have_finite_noise() {
    for x in [1e9 + 0.25, -1e9 - 0.75, -0.25, 1e17, -1e300, f64::NAN, f64::INFINITY] {
        for interpolation in INTERPOLATIONS {
            let octaves = Octaves { noise: noise(interpolation), count: turbulence::MOST_OCTAVES };
            let at = DVec3::new(x, 0.3, -x);
            assert!(octaves.fractal(at).abs() <= 2.0 && octaves.turbulence(at) <= 2.0, "{x}");
            assert!(octaves.fractal_gradient(at).is_finite(), "{x}");
            assert!(octaves.noise.dnoise(at).is_finite(), "{x}");
        }
    }
}

/// The sphere of radius 1 displaced outward by `k h` has, to first order in `k`, the bumped normal.
/// A tenth of the strength leaves a hundredth of the difference.
#[test]
fn a_bump_is_the_normal_of_the_displaced_surface() {
    let octaves = Octaves { noise: noise(Interpolation::Smoother), count: 2 };
    // A place that also stretches directions differently.
    let turn = DQuat::from_euler(EulerRot::XYZ, 0.3, 1.0, -0.2);
    let shift = DVec3::new(0.1, 0.2, 0.3);
    let to_own = DAffine3::from_scale_rotation_translation(DVec3::new(0.7, 0.5, 0.9), turn, shift);
    let placement = Placement::new(to_own.inverse());
    let height = |p: DVec3| octaves.fractal(placement.to_texture(p));
    let worst = |k: f64| {
        let bump = Bump { relief: Relief::Noise(octaves.clone()), strength: k, placement };
        let mut worst: f64 = 0.0;
        for n in 0..50 {
            let n = f64::from(n);
            let normal =
                DVec3::new((1.7 * n).sin(), (2.3 * n).cos(), (0.9 * n).sin() + 0.1).normalize();
            // Tangents of the displaced surface, by differences along two great circles.
            let (a, b) = normal.any_orthonormal_pair();
            let displaced = |d: DVec3| (1.0 + k * height(d.normalize())) * d.normalize();
            let step = 1e-5;
            let along = |t: DVec3| displaced(normal + step * t) - displaced(normal - step * t);
            let truth = along(a).cross(along(b)).normalize();
            worst =
                worst.max(bump.normal(&DAffine3::IDENTITY, &at(normal, normal)).distance(truth));
        }
        worst
    };
    let [weak, weaker] = [0.01, 0.001].map(worst);
    assert!(weak < 0.02 && weaker < 0.02 * weak, "{weak} and {weaker}");
    assert_eq!(worst_of_none(&octaves, placement), 0.0);
}

/// A strength of 0 leaves every normal unchanged, up to the rounding of the normalisation.
fn worst_of_none(octaves: &Octaves, placement: Placement) -> f64 {
    let bump = Bump { relief: Relief::Noise(octaves.clone()), strength: 0.0, placement };
    bump.normal(&DAffine3::IDENTITY, &at(DVec3::X, DVec3::Y)).distance(DVec3::Y)
}

/// Eq. 2.1 and 2.2 with the vector of fig. 2.3, as in the thesis.
#[test]
fn dnoise_is_added_to_the_normal_as_it_is() {
    let noise = noise(Interpolation::Linear);
    let placement = Placement::default();
    let bump = Bump { relief: Relief::Dnoise(noise.clone()), strength: 0.4, placement };
    let point = DVec3::new(0.3, 5.1, -2.2);
    let expected = (DVec3::Z + 0.4 * noise.dnoise(point)).normalize();
    assert!(bump.normal(&DAffine3::IDENTITY, &at(point, DVec3::Z)).abs_diff_eq(expected, 1e-15));
}

/// A moved, rotated and stretched object takes its textures along. The bumped normal in own space,
/// transformed to the scene, equals the bumped normal computed in the scene.
#[test]
fn textures_move_with_their_object() {
    let octaves = Octaves { noise: noise(Interpolation::Smooth), count: 3 };
    let placement = Placement::new(DAffine3::from_scale(DVec3::splat(2.0)));
    let bump = Bump { relief: Relief::Noise(octaves), strength: 0.2, placement };
    let to_scene = DAffine3::from_translation(DVec3::new(3.0, -1.0, 2.0))
        * DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.8)
        * DAffine3::from_scale(DVec3::new(2.0, 0.5, 1.0));
    let to_own = to_scene.inverse();
    let (own, own_normal) = (DVec3::new(0.3, 0.4, 0.5), DVec3::new(0.6, 0.0, 0.8));
    let carried = |normal: DVec3| (to_own.matrix3.transpose() * normal).normalize();
    let expected = carried(bump.normal(&DAffine3::IDENTITY, &at(own, own_normal)));
    let found = bump.normal(&to_own, &at(to_scene.transform_point3(own), carried(own_normal)));
    assert!(found.abs_diff_eq(expected, 1e-12), "{found} and {expected}");
}

/// A picture of waves on a plane: the bump is the normal of the surface `z = k h(x, y)`.
#[test]
fn a_picture_bumps_as_its_heights_say() {
    let size = 64;
    let wave =
        |k: usize| 0.5 + 0.5 * ((k as f64 + 0.5) / size as f64 * std::f64::consts::TAU).sin();
    let values = (0..size * size).map(|k| wave(k % size) * wave(k / size)).collect();
    let heights = Heights::new(values, size, DVec2::ONE, false).unwrap();
    let placement = Placement::default();
    let bump = Bump { relief: Relief::Picture(heights.clone()), strength: 0.3, placement };
    // A plane of 4 by 2 that the picture fills once.
    let uv_gradients = [DVec3::X / 4.0, DVec3::Y / 2.0];
    for k in 0..40 {
        let uv = DVec2::new(0.137 * f64::from(k), 0.291 * f64::from(k));
        let point = DVec3::new(4.0 * uv.x, 2.0 * uv.y, 0.0);
        let at = Place { point, normal: DVec3::Z, uv, uv_gradients };
        let turn = std::f64::consts::TAU;
        let (s, t) = (turn * uv.x, turn * (1.0 - uv.y));
        let by_u = 0.5 * turn * s.cos() * (0.5 + 0.5 * t.sin());
        let by_v = -0.5 * turn * t.cos() * (0.5 + 0.5 * s.sin());
        let expected = DVec3::new(-0.3 * by_u / 4.0, -0.3 * by_v / 2.0, 1.0).normalize();
        // The splines with 64 texels to a wave are exact to a few millionths.
        assert!(bump.normal(&DAffine3::IDENTITY, &at).abs_diff_eq(expected, 1e-5), "{uv}");
    }
}

/// The gradient is 0 where the wall is clamped, and elsewhere it is the height's.
#[test]
fn a_wall_is_level_where_its_slow_noise_is_clamped() {
    let noise = noise(Interpolation::Smoother);
    let wall =
        |rough| wall::Wall { clamp: [-0.1, 0.2], rough, frequency: 5.0, noise: noise.clone() };
    let (level, rough) = (wall(0.0), wall(0.3));
    let mut seen = [0; 3];
    for k in 0..500 {
        let point = DVec3::new(0.373, 0.719, 0.537) * f64::from(k) + 0.11;
        let slow = noise.value(point);
        let kind = if slow < -0.1 {
            0
        } else if slow > 0.2 {
            2
        } else {
            1
        };
        seen[kind] += 1;
        let height = level.height(point);
        assert_eq!(height, [-0.1, slow, 0.2][kind]);
        assert_eq!(level.gradient(point) == DVec3::ZERO, kind != 1);
        assert_eq!(rough.height(point), height + 0.3 * noise.value(5.0 * point));
        // Differences across the edge of a plain are meaningless.
        if (slow + 0.1).abs().min((slow - 0.2).abs()) > 1e-3 {
            let expected = slopes(|p| rough.height(p), point, 1e-5);
            // The square of the step times a third derivative of some thousands.
            assert!(rough.gradient(point).abs_diff_eq(expected, 1e-6));
        }
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}

/// Colours of a ramp between black and white stay within it everywhere, and they vary.
#[test]
fn every_solid_is_finite_and_has_the_colours_of_its_ramp() {
    let colors = Ramp::new(vec![(0.0, Color::ZERO), (1.0, Color::ONE)]).unwrap();
    let noise = noise(Interpolation::Smooth);
    let octaves = Octaves { noise: noise.clone(), count: 5 };
    let wall = wall::Wall { clamp: [-0.2, 0.2], rough: 0.1, frequency: 9.0, noise: noise.clone() };
    let clouds = |sum| Clouds { colors: colors.clone(), octaves: octaves.clone(), sum };
    let patterns = [
        Pattern::Marble(Marble {
            colors: colors.clone(),
            octaves: octaves.clone(),
            folds: 2.0,
            net: 0.5,
        }),
        Pattern::Granite(Granite {
            minerals: vec![(1.0, Color::splat(0.3)), (2.0, Color::splat(0.6))],
            flakes: 0.3,
            flake: Color::ZERO,
            vary: 1.0,
            noise: noise.clone(),
        }),
        Pattern::Wood(Wood { colors: colors.clone(), waver: 1.0, grain: 1.0, noise }),
        Pattern::Wall(WallPaint { wall, colors: colors.clone() }),
        Pattern::Clouds(clouds(clouds::Sum::Fractal)),
        Pattern::Clouds(clouds(clouds::Sum::Turbulence)),
    ];
    let placement = Placement::default();
    for pattern in patterns {
        let solid = Solid { pattern, placement };
        let (mut low, mut high) = (1.0f64, 0.0f64);
        for k in 0..2000 {
            let far = [1.0, 1e9, -1e15][k % 3];
            let point = far * DVec3::new(0.137, 0.071, -0.053) * k as f64;
            let color = solid.color(&DAffine3::IDENTITY, point);
            assert!(color.is_finite() && color.min_element() >= 0.0, "{color} of {solid:?}");
            assert!(color.max_element() <= 1.0, "{color} of {solid:?}");
            (low, high) = (low.min(color.x), high.max(color.x));
        }
        assert!(high - low > 0.2, "from {low} to {high}: {solid:?}");
    }
}
