//! Checks each sentence with numbers for which it is true, and with numbers for which it is false.

use super::*;
use crate::report::fixture::{self, edges, floor};
use crate::report::measured::PageMeasured;
use render::filter::Filter;

fn said(pages: Vec<PageMeasured>) -> Vec<Claim> {
    claims(&fixture::measured(pages))
}

fn about(claims: &[Claim], topic: Topic) -> Vec<(Verdict, &str)> {
    let own = claims.iter().filter(|claim| claim.topic == topic);
    own.map(|claim| (claim.verdict, claim.text.as_str())).collect()
}

/// The only sentence about a topic.
fn one(claims: &[Claim], topic: Topic) -> (Verdict, &str) {
    let own = about(claims, topic);
    assert_eq!(own.len(), 1, "{own:?}");
    own[0]
}

#[test]
fn one_ray_is_worth_the_rays_that_are_as_near() {
    // The tent leaves 0.2 of the error of one bilinear ray. 8 x 8 bilinear rays, which leave 0.125, are
    // enough to be as near. The tent costs as much as two of these 64 rays.
    let claims = said(vec![fixture::page("floor", &floor, &[])]);
    let (verdict, text) = one(&claims, Topic::OneRay);
    assert_eq!(verdict, Verdict::Wins);
    let expected = "On floor the tent with one ray (0.040) is nearer to the truth than 4 x 4 bilinear \
                    rays (0.050), but not as near as 8 x 8 (0.025); it is done in 1/32 of the time of those.";
    assert_eq!(text, expected);
    // The tent is exactly as near as 4 x 4 bilinear rays.
    let law = |filter, n: f64| match filter {
        Filter::Tent => (0.05, 0.32 / 7.0 * n * n),
        filter => floor(filter, n),
    };
    let claims = said(vec![fixture::page("floor", &law, &[])]);
    let expected = "On floor the tent with one ray is as near to the truth as 4 x 4 bilinear rays \
                    (0.050 and 0.050), in a seventh of the time.";
    assert_eq!(one(&claims, Topic::OneRay), (Verdict::Wins, expected));
}

#[test]
fn one_ray_that_costs_more_than_it_is_worth_loses() {
    for (tent, price, verdict, words) in [
        (0.05, 10.0, Verdict::Loses, "as near to the truth as 4 x 4"),
        (0.05, 0.32, Verdict::Even, "as near to the truth as 4 x 4"),
        (0.2, 0.04, Verdict::Loses, "no nearer to the truth than one bilinear ray"),
        (
            0.3,
            0.02,
            Verdict::Loses,
            "one bilinear ray is nearer to the truth than one with the tent",
        ),
        (0.01, 0.04, Verdict::Wins, "nearer to the truth than any number of bilinear rays"),
    ] {
        let law = |filter, n: f64| match filter {
            Filter::Tent => (tent, price * n * n),
            filter => floor(filter, n),
        };
        let claims = said(vec![fixture::page("page", &law, &[])]);
        let (found, text) = one(&claims, Topic::OneRay);
        assert_eq!(found, verdict, "{text}");
        assert!(text.contains(words), "{text}");
    }
}

#[test]
fn a_method_without_tables_that_is_nearer_in_no_more_time_beats_it() {
    // With the fixture's laws, mip-mapping is cheaper but farther off, and no method is nearer in the
    // same time.
    let claims = said(vec![fixture::page("floor", &floor, &[])]);
    assert_eq!(about(&claims, Topic::Beaten), []);
    let law = |filter, n: f64| match filter {
        Filter::Mip => (0.03, floor(filter, n).1),
        filter => floor(filter, n),
    };
    let claims = said(vec![fixture::page("floor", &law, &[])]);
    let (verdict, text) = one(&claims, Topic::Beaten);
    assert_eq!(verdict, Verdict::Loses);
    let words = "beaten by mip, 1 ray: 0.030 against 0.040, in 0.85 of the time";
    assert!(text.contains(words), "{text}");
    // A method that costs the same and is nearer by less than 5 % does not beat the tent.
    let law = |filter, n: f64| match filter {
        Filter::Mip => (0.0395, 0.04),
        filter => floor(filter, n),
    };
    let claims = said(vec![fixture::page("floor", &law, &[])]);
    assert_eq!(about(&claims, Topic::Beaten), []);
}

#[test]
fn pages_are_counted_by_what_they_say() {
    let pages = || {
        let made = |name, law| fixture::page(name, law, &[]);
        vec![made("a", &floor), made("b", &edges), made("c", &floor)]
    };
    let claims = said(pages());
    let general: Vec<&Claim> = claims
        .iter()
        .filter(|claim| claim.topic == Topic::OneRay && claim.page.is_none())
        .collect();
    assert!(general[0].text.starts_with("On 2 of 3 pages"), "{}", general[0].text);
    assert!(general[1].text.starts_with("On b one ray"), "{}", general[1].text);
    assert_eq!(general[1].verdict, Verdict::Loses);
}

#[test]
fn in_silhouettes_no_filter_helps_unless_one_does() {
    let page = fixture::page("page", &floor, &[("silhouettes", &edges), ("far floor", &floor)]);
    let claims = said(vec![page]);
    let [silhouettes, far] = about(&claims, Topic::Region)[..] else { panic!("two regions") };
    let expected = "At silhouettes no filter helps: with one ray the error is 0.21 whatever the filter; \
                    samples are what counts: 4 x 4 bilinear rays are 0.053 off.";
    assert_eq!(silhouettes, (Verdict::Loses, expected));
    let expected = "On the far floor the tent with one ray is 5.0 times nearer: 0.040 where one bilinear \
                    ray is 0.20 off; it takes 8 x 8 of those (0.025) to be as near.";
    assert_eq!(far, (Verdict::Wins, expected));
    // The effect of a filter at an edge is reported, however small or bad it is.
    for (tent, mip, verdict, words) in [
        (0.1, 0.1, Verdict::Wins, "2.1 times nearer"),
        (0.18, 0.21, Verdict::Even, "helps little"),
        (0.3, 0.1, Verdict::Loses, "with one ray is farther off"),
        (0.3, 0.21, Verdict::Loses, "no filter helps: with one ray the error is 0.21 to 0.30"),
        (0.15, 0.1, Verdict::Wins, "with one ray the mip is nearer than the tent, 0.10 off"),
    ] {
        let law = |filter, n: f64| match filter {
            Filter::Tent => (tent / n, 0.1),
            Filter::Mip => (mip / n, 0.1),
            filter => edges(filter, n),
        };
        let claims = said(vec![fixture::page("page", &floor, &[("silhouettes", &law)])]);
        let (found, text) = one(&claims, Topic::Region);
        assert_eq!(found, verdict, "{text}");
        assert!(text.contains(words), "{text}");
    }
    // More samples are not praised where they do not help.
    let law = |_, _| (0.2, 1.0);
    let claims = said(vec![fixture::page("page", &floor, &[("silhouettes", &law)])]);
    assert!(one(&claims, Topic::Region).1.contains("nor do samples help much"));
}

#[test]
fn with_many_rays_the_filter_counts_as_long_as_it_does() {
    // 0.2 / n^0.8 against 1 / n: the tent stays ahead up to 8 x 8.
    let claims = said(vec![fixture::page("floor", &floor, &[])]);
    assert_eq!(one(&claims, Topic::ManyRays).0, Verdict::Wins);
    let law = |slope: f64, left: f64| {
        move |filter, n: f64| match filter {
            Filter::Tent => (left / n.powf(slope), floor(filter, n).1),
            filter => floor(filter, n),
        }
    };
    for (slope, left, verdict, words) in [
        // The tent stays at 0.1. Bilinear interpolation, 0.2 / n, is as near with n = 2 and nearer with
        // n = 8.
        (0.0, 0.1, Verdict::Loses, "From 2 x 2 rays in a pixel on bilinear"),
        (0.0, 0.1, Verdict::Loses, "with 8 x 8 the tent is farther off (0.10 against 0.025)"),
        (1.0, 0.2, Verdict::Loses, "With any number of rays that was measured bilinear"),
        // Equal from 4 x 4 on, which counts as a tie.
        (0.5, 0.098, Verdict::Even, "From 4 x 4"),
    ] {
        let law = law(slope, left);
        let even = |filter, n: f64| match filter {
            Filter::Tent if slope == 0.5 && n >= 4.0 => floor(Filter::Bilinear, n),
            filter => law(filter, n),
        };
        let claims = said(vec![fixture::page("floor", &even, &[])]);
        let (found, text) = one(&claims, Topic::ManyRays);
        assert_eq!(found, verdict, "{text}");
        assert!(text.contains(words), "{text}");
    }
}

#[test]
fn mip_mapping_is_held_against_the_tent() {
    for (error, price, verdict, words) in [
        (0.06, 0.034, Verdict::Wins, "farther from the truth than the tent (0.060 and 0.040"),
        (0.04, 0.034, Verdict::Loses, "as near to the truth as the tent"),
        (0.04, 0.04, Verdict::Even, "as near to the truth as the tent"),
        (0.03, 0.05, Verdict::Loses, "nearer to the truth than the tent"),
    ] {
        let law = |filter, n: f64| match filter {
            Filter::Mip => (error, price * n * n),
            filter => floor(filter, n),
        };
        let claims = said(vec![fixture::page("floor", &law, &[])]);
        let (found, text) = one(&claims, Topic::Mip);
        assert_eq!(found, verdict, "{text}");
        assert!(text.contains(words), "{text}");
    }
}

#[test]
fn orders_and_supersampling_are_judged_by_their_errors() {
    let claims = said(vec![fixture::page("floor", &floor, &[])]);
    let (verdict, text) = one(&claims, Topic::Orders);
    assert_eq!(verdict, Verdict::Wins);
    assert!(text.contains("n = 3 gains nothing over it (0.040), in 3.0 times the time"), "{text}");
    let law = |filter, n: f64| match filter {
        Filter::Box => (0.02, 0.01),
        Filter::Quadratic => (0.03, 0.01),
        filter => floor(filter, n),
    };
    let claims = said(vec![fixture::page("floor", &law, &[])]);
    let (verdict, text) = one(&claims, Topic::Orders);
    assert_eq!(verdict, Verdict::Loses);
    assert!(text.contains("farther off than the box") && text.contains("nearer still"), "{text}");

    let mut page = fixture::page("floor", &floor, &[]);
    assert_eq!(one(&said(vec![page]), Topic::Supersampling).0, Verdict::Even);
    for (factor, price, verdict) in
        [(0.5, 1.0, Verdict::Wins), (2.0, 1.0, Verdict::Loses), (1.0, 1.5, Verdict::Loses)]
    {
        page = fixture::page("floor", &floor, &[]);
        for trial in page.trials.iter_mut().filter(|trial| trial.method.evenly().is_none()) {
            trial.whole.rmse *= factor;
            trial.cost.cpu *= price;
        }
        assert_eq!(one(&said(vec![page]), Topic::Supersampling).0, verdict, "{factor} {price}");
    }
}

#[test]
fn what_is_advised_keeps_the_time_and_reaches_the_error() {
    let claims = said(vec![fixture::page("floor", &floor, &[])]);
    let budgets = about(&claims, Topic::Budget);
    // The tent costs twice as much as one bilinear ray; 2 x 2 rays with the tent cost eight times as
    // much.
    assert!(budgets[0].1.starts_with("Use tent, 1 ray where up to 5 times"), "{budgets:?}");
    assert!(budgets[1].1.starts_with("Use tent, 3 x 3 rays where up to 20 times"), "{budgets:?}");
    assert!(budgets.iter().all(|(verdict, _)| *verdict == Verdict::Use));
    let aims = about(&claims, Topic::Aim);
    // Mip-mapping, 0.3, is the cheapest below a half. The box is as fast and nearer.
    let expected = "Use box, 1 ray where the error is to be at most half of that of one bilinear ray: nothing \
                    faster gets there, and it takes 1.8 times the time of one bilinear ray; with bilinear rays \
                    alone it takes 2 x 2 rays, in 2.2 times the time.";
    assert_eq!(aims[0].1, expected);
    assert!(aims[1].1.starts_with("Use tent, 1 ray where the error is to be at most a quarter"));
    // Where filters have no effect, unfiltered rays are advised.
    let claims = said(vec![fixture::page("edges", &edges, &[])]);
    for (_, text) in about(&claims, Topic::Aim) {
        assert!(text.starts_with("Use point") || text.starts_with("Use bilinear"), "{text}");
    }
}

#[test]
fn slanted_footprints_are_judged_by_the_filters_own_table() {
    let mut measured = fixture::measured(Vec::new());
    let expected = "Where footprints lie along the texture the tent is 0.038 off, where they lie at 45 degrees \
                    to it 0.096, 2.5 times as far; of what has no tables nothing is nearer there. (One \
                    average each, on a floor in perspective; see the filters by themselves.)";
    assert_eq!(one(&claims(&measured), Topic::Rotated), (Verdict::Loses, expected));
    for (row, verdict, words) in [
        (
            "mip,67,0.079,0.080",
            Verdict::Loses,
            "there mip (0.080, and 0.079 on the others) is nearer",
        ),
        ("tent,352,0.038,0.038", Verdict::Wins, "no farther (0.038)"),
    ] {
        let name = row.split(',').next().unwrap();
        measured = fixture::measured(Vec::new());
        let cells = row.split(',').map(str::to_string).collect();
        let rows = &mut measured.tables[0].rows;
        let at = rows.iter().position(|row| row[0] == name).unwrap();
        rows[at] = cells;
        let claims = claims(&measured);
        let (found, text) = one(&claims, Topic::Rotated);
        assert_eq!(found, verdict);
        assert!(text.contains(words), "{text}");
    }
    measured.tables.clear();
    assert_eq!(claims(&measured), []);
}

#[test]
fn a_truth_that_is_too_noisy_is_said_to_be() {
    let mut page = fixture::page("floor", &floor, &[("far floor", &floor)]);
    assert_eq!(about(&said(vec![page]), Topic::Noise), []);
    page = fixture::page("floor", &floor, &[("far floor", &floor)]);
    page.truth.noise_by_region[0] = 0.01;
    let claims = said(vec![page]);
    let (verdict, text) = one(&claims, Topic::Noise);
    assert_eq!(verdict, Verdict::Doubt);
    assert!(text.contains("far floor (0.020 of 0.0075)") && !text.contains("whole"), "{text}");
}

#[test]
fn of_few_methods_little_is_said_and_nothing_false() {
    let mut page = fixture::page("floor", &floor, &[("silhouettes", &edges)]);
    page.trials.retain(|trial| trial.method.filter == Filter::Point);
    assert_eq!(said(vec![page]).len(), 1, "only that of slanted footprints");
    let mut page = fixture::page("floor", &floor, &[]);
    for trial in &mut page.trials {
        trial.whole.rmse = 0.0;
    }
    // Errors of 0 have no ratios. The remaining sentences must not contain NaN.
    let claims = said(vec![page]);
    assert!(claims.iter().all(|claim| !claim.text.contains("NaN") && !claim.text.contains("inf")));
}
