//! Texture coordinates on hard triangles against exact fractions: the results that
//! `docs/mapping.md` states.

use crate::exact;

use exact::classes::classes;
use exact::{FORMS, Form, Sample};
use glam::DVec3;
use num_rational::BigRational;

/// Number of hits in each class; `docs/mapping.md` uses more.
const SAMPLES: usize = 48;

/// Returns the sorted errors of each form over one class; infinite where a form gives no number.
fn errors(name: &str) -> impl Fn(Form) -> Vec<f64> {
    let all = classes();
    let class = all.iter().find(|class| class.name == name).expect("a class");
    let hits: Vec<[f64; 5]> = class.samples(SAMPLES).iter().filter_map(Sample::errors).collect();
    assert!(hits.len() > SAMPLES / 4, "{name}: only {} rays hit", hits.len());
    move |form| {
        let index = FORMS.iter().position(|known| *known == form).expect("a form");
        let mut errors: Vec<f64> = hits.iter().map(|errors| errors[index]).collect();
        errors.sort_by(f64::total_cmp);
        errors
    }
}

fn median(errors: &[f64]) -> f64 {
    errors[errors.len() / 2]
}

fn largest(errors: &[f64]) -> f64 {
    errors[errors.len() - 1]
}

#[test]
fn the_truth_is_the_truth() {
    let sample = Sample {
        corners: [[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 3.0, 1.0]],
        origin: DVec3::new(1.0, 0.5, 3.0),
        direction: DVec3::NEG_Z,
    };
    let fraction = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    assert_eq!(sample.truth(), [fraction(1, 2), fraction(1, 3), fraction(1, 6)]);
    // One third is no number of f64; the error is half an ulp.
    let [weights, ..] = sample.errors().expect("it hits");
    assert!(weights > 0.0 && weights < f64::EPSILON, "{weights}");
}

#[test]
fn the_weights_of_a_hit_are_as_good_as_the_triangle_allows() {
    for class in classes() {
        for sample in class.samples(SAMPLES) {
            let Some([weights, ..]) = sample.errors() else { continue };
            // Shearing rounds a coordinate three times, and an edge function three times more. Each
            // rounding moves a side by an ulp of the distance, relative to the height.
            let bound = 8.0 * f64::EPSILON * sample.condition();
            assert!(weights <= bound, "{}: {weights:e} > {bound:e} {sample:?}", class.name);
        }
    }
}

#[test]
fn on_easy_triangles_all_forms_agree() {
    for name in ["well shaped", "plane x = const", "plane y = const", "plane z = const"] {
        let of = errors(name);
        for form in FORMS {
            assert!(median(&of(form)) < 1e-15, "{name} {form:?}");
            // Triangles that stand nearly upright cost the thesis's form three digits.
            assert!(largest(&of(form)) < 1e-11, "{name} {form:?}");
        }
    }
}

#[test]
fn the_thesis_form_has_no_number_on_the_side_ab_and_on_upright_triangles() {
    for name in ["exactly on AB", "exactly at B"] {
        let of = errors(name);
        assert!(of(Form::Thesis).iter().all(|error| error.is_infinite()), "{name}");
        assert_eq!(largest(&of(Form::Weights)), 0.0, "{name}");
    }
    let of = errors("upright, y = x/2");
    assert!(of(Form::ThesisBest).iter().all(|error| error.is_infinite()));
    // Roundings of the hit point turn 0/0 into a number, which is worse.
    assert!(of(Form::Thesis).iter().all(|&error| error > 1e-2));
    assert!(largest(&of(Form::Weights)) < 1e-14);
}

#[test]
fn the_cases_that_the_thesis_names_are_right() {
    for name in ["exactly on AC", "exactly on BC", "exactly at A", "exactly at C"] {
        let of = errors(name);
        for form in FORMS {
            assert_eq!(largest(&of(form)), 0.0, "{name} {form:?}");
        }
    }
    let of = errors("centre of gravity");
    for form in FORMS {
        assert!(largest(&of(form)) < f64::EPSILON, "{form:?}");
    }
}

#[test]
fn near_its_cases_the_thesis_form_loses_digits_that_the_weights_keep() {
    // Near AC both ratios approach 1, and eq. 3.8 divides two differences that vanish there. A
    // triangle tilted by some ulps against a coordinate plane is a line in the x and y of eq. 3.14.
    for (name, lost) in [
        ("1e-3 to 1e-15 off AC", 1e4),
        ("on AC but for rounding", 1e10),
        ("some ulps off x = const", 1e5),
        ("some ulps off y = const", 1e5),
        ("some ulps off upright", 1e5),
    ] {
        let of = errors(name);
        assert!(largest(&of(Form::Weights)) < 1e-14, "{name}");
        assert!(median(&of(Form::Thesis)) > lost * median(&of(Form::Weights)), "{name}");
        // Even the best possible hit point does not help.
        assert!(median(&of(Form::ThesisBest)) > 1e5 * median(&of(Form::AreasBest)), "{name}");
    }
    // Eq. 3.14 uses x and y, so this tilt does not affect it.
    let of = errors("some ulps off z = const");
    assert!(largest(&of(Form::Thesis)) < 1e-13);
}

#[test]
fn what_is_computed_from_the_hit_point_suffers_from_its_rounding() {
    // Far away the hit point has few digits relative to the triangle. On needles the distance along
    // the ray is uncertain, which moves the point across them. Neither affects the weights.
    for (name, lost) in [
        ("1e3 sizes from the origin", 20.0),
        ("1e6 sizes away", 1e4),
        ("needle 1e6", 100.0),
        ("needle 1e9", 1e5),
        ("sliver 1e6", 100.0),
        ("sliver 1e9", 1e5),
    ] {
        let of = errors(name);
        let weights = median(&of(Form::Weights));
        for form in [Form::Areas, Form::Thesis] {
            assert!(median(&of(form)) > lost * weights, "{name} {form:?}");
        }
    }
}

#[test]
fn the_thesis_form_never_does_much_better() {
    for class in classes() {
        let of = errors(class.name);
        let [weights, thesis] = [Form::Weights, Form::Thesis].map(|form| median(&of(form)));
        // Below an ulp of 1 both errors are noise.
        assert!(weights <= f64::EPSILON + 1.1 * thesis, "{}: {weights} {thesis}", class.name);
    }
}
