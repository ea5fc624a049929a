//! The Pareto front of trials: those that no other trial beats in both cost and error.

/// Returns the indices of the points `(cost, error)` on the front, cheapest first.
///
/// A point is off the front if another point is no worse in both numbers, and better in one. Points
/// equal in both numbers are on the front together or off it together. A point with a number that is
/// NaN or infinite is never on the front, and keeps no other point off it.
#[must_use]
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    // Adding 0 makes -0 into 0. The two are equal, but the total order would distinguish them.
    let points: Vec<(f64, f64)> = points.iter().map(|&(a, b)| (a + 0.0, b + 0.0)).collect();
    let mut order: Vec<usize> =
        (0..points.len()).filter(|&k| points[k].0.is_finite() && points[k].1.is_finite()).collect();
    order.sort_by(|&a, &b| {
        let by_cost = points[a].0.total_cmp(&points[b].0);
        by_cost.then(points[a].1.total_cmp(&points[b].1)).then(a.cmp(&b))
    });
    let mut front: Vec<usize> = Vec::new();
    for k in order {
        // All points before cost no more. The last point of the front has the smallest error among
        // them.
        let stays = front
            .last()
            .is_none_or(|&last| points[k].1 < points[last].1 || points[k] == points[last]);
        if stays {
            front.push(k);
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns the front by its definition, word by word.
    fn by_definition(points: &[(f64, f64)]) -> Vec<usize> {
        let sound = |p: (f64, f64)| p.0.is_finite() && p.1.is_finite();
        let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
        (0..points.len())
            .filter(|&k| {
                sound(points[k]) && !points.iter().any(|&p| sound(p) && beats(p, points[k]))
            })
            .collect()
    }

    #[test]
    fn ties_stay_together_and_what_is_no_number_stays_off() {
        let nan = f64::NAN;
        let points = [
            (1.0, 3.0),
            (1.0, 2.0),
            (2.0, 2.0),
            (1.0, 2.0),
            (nan, 0.0),
            (0.0, nan),
            (5.0, 0.5),
            (f64::NEG_INFINITY, 0.1),
            (4.0, 0.5),
        ];
        assert_eq!(front(&points), [1, 3, 8]);
        assert_eq!(front(&[]), [0; 0]);
        assert_eq!(front(&[(nan, nan)]), [0; 0]);
    }

    #[test]
    fn zeros_of_both_signs_are_equal() {
        // `total_cmp` distinguishes the two zeros, which must not affect the front.
        assert_eq!(front(&[(0.0, 1.0), (-0.0, 1.0), (-0.0, 2.0), (0.0, 0.5)]), [3]);
        assert_eq!(front(&[(1.0, -0.0), (1.0, 0.0)]), [0, 1]);
    }

    proptest! {
        #[test]
        fn the_front_is_what_its_definition_says(
            // Few values, so that ties are common; the last two stand for numbers that are not finite.
            points in prop::collection::vec((0_u8..9, 0_u8..9), 0..40)
        ) {
            let value = |k: u8| match k {
                7 => f64::NAN,
                8 => f64::INFINITY,
                k => f64::from(k) - 2.0,
            };
            let points: Vec<(f64, f64)> =
                points.into_iter().map(|(a, b)| (value(a), value(b))).collect();
            let mut found = front(&points);
            prop_assert!(found.windows(2).all(|w| points[w[0]].0 <= points[w[1]].0));
            found.sort_unstable();
            prop_assert_eq!(found, by_definition(&points));
        }
    }
}
