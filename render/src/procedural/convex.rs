//! Convex parts of the square on which a [`Form`] is defined.

use super::patch::Form;
use glam::DVec2;

/// Largest number of corners: the square's four, and one for each of two cuts along three axes.
/// Rounding can add a corner that splits no area; two more are kept for it.
const MOST_CORNERS: usize = 12;

/// A convex polygon inside the square of side 1 around the origin.
#[derive(Debug, Clone, Copy)]
pub struct Convex {
    corners: [DVec2; MOST_CORNERS],
    count: usize,
}

impl Convex {
    const EMPTY: Self = Self { corners: [DVec2::ZERO; MOST_CORNERS], count: 0 };

    /// Returns the whole square.
    #[must_use]
    pub fn square() -> Self {
        let mut square = Self::EMPTY;
        for (x, y) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
            square.push(DVec2::new(x, y));
        }
        square
    }

    fn push(&mut self, corner: DVec2) {
        if let Some(place) = self.corners.get_mut(self.count) {
            *place = corner;
            self.count += 1;
        }
    }

    fn corners(&self) -> &[DVec2] {
        &self.corners[..self.count]
    }

    /// Lists the edges, counterclockwise.
    pub fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> {
        let corners = self.corners();
        let mut from = corners.last().copied().unwrap_or_default();
        corners.iter().map(move |&to| [std::mem::replace(&mut from, to), to])
    }

    /// Returns the area, 0 to 1.
    #[must_use]
    pub fn area(&self) -> f64 {
        0.5 * self.edges().map(|[from, to]| from.perp_dot(to)).sum::<f64>()
    }

    /// Returns the smallest and the largest value of a form. Both are NaN if the polygon is empty.
    #[must_use]
    pub fn range(&self, form: &Form) -> [f64; 2] {
        self.corners()
            .iter()
            .map(|&corner| form.at(corner))
            .fold([f64::NAN; 2], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Splits the polygon where a form has the value `level`: the part below, and the part above.
    #[must_use]
    pub fn split(&self, form: &Form, level: f64) -> [Self; 2] {
        let mut parts = [Self::EMPTY; 2];
        let Some(&last) = self.corners().last() else { return parts };
        let (mut from, mut before) = (last, form.at(last) - level);
        for &to in self.corners() {
            let after = form.at(to) - level;
            if (before < 0.0) != (after < 0.0) {
                let crossing = from.lerp(to, before / (before - after));
                parts[0].push(crossing);
                parts[1].push(crossing);
            }
            parts[usize::from(after >= 0.0)].push(to);
            (from, before) = (to, after);
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Any three cuts leave eight parts that fill the square, each on its side of every line.
        #[test]
        fn parts_fill_the_whole(
            cuts in prop::array::uniform3((-1.0..1.0f64, -2.0..2.0f64, -2.0..2.0f64)),
        ) {
            let forms = cuts.map(|(middle, a, b)| Form { middle, slopes: DVec2::new(a, b) });
            let mut parts = vec![Convex::square()];
            for form in &forms {
                parts = parts.iter().flat_map(|part| part.split(form, 0.25)).collect();
            }
            let areas: Vec<f64> = parts.iter().map(Convex::area).collect();
            // Corners are rounded to 1e-16, and there are a few dozen of them.
            prop_assert!((areas.iter().sum::<f64>() - 1.0).abs() < 1e-13);
            for (k, part) in parts.iter().enumerate() {
                prop_assert!(areas[k] > -1e-15);
                for (bit, form) in forms.iter().enumerate() {
                    let [low, high] = part.range(form);
                    // A crossing is rounded; forms magnify its rounding at most by 4. The range of
                    // an empty part is NaN.
                    let fits = if k >> (2 - bit) & 1 == 0 { high < 0.25 + 1e-14 } else { low > 0.25 - 1e-14 };
                    prop_assert!(fits || low.is_nan(), "{k} {bit} {low} {high}");
                }
            }
        }
    }
}
