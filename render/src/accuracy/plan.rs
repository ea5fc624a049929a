//! Predicts the work that remains until a sampling is known to suffice.
//!
//! A bound is wider than the error because few pixels were drawn. More draws narrow the bound, and a
//! finer sampling lowers the error. The search takes the cheaper of the two.

/// Part of the requested squared error that a bound should reach by more draws. With a larger part,
/// too few pixels are drawn half of the time. With a smaller one, more are drawn than are needed.
const AIM: f64 = 0.85;

/// Rays of a picture that cost as much as a ray of the audit, times two. A ray of a picture averages
/// textures over areas and takes about 1.5 times as long as one of an audit. More draws may also fail to
/// narrow the bound, where a finer sampling mostly lowers the error.
const POINT: f64 = 1.3;

/// A sampling as the pixels drawn so far show it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prospect {
    /// Estimated mean squared error.
    pub mean: f64,
    /// Upper bound of the mean squared error.
    pub bound: f64,
    /// Growth of the squared distance from mean to bound at the next look, whose risk is smaller.
    pub wider: f64,
    /// Rays that the whole picture still takes.
    pub rays: f64,
}

/// The work until a picture with a sampling is known to have the requested error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlook {
    /// Draws that are needed, as a multiple of those so far; 1 if they suffice.
    pub growth: f64,
    /// Rays of picture and audit, in rays of a picture.
    pub work: f64,
}

impl Prospect {
    /// Returns the work until the bound is below `limit`. `audit` is the number of rays of the audit so
    /// far. `None` if more than `most` times as many draws would be needed.
    #[must_use]
    pub fn outlook(&self, limit: f64, audit: f64, most: f64) -> Option<Outlook> {
        if self.bound < limit {
            return Some(Outlook { growth: 1.0, work: self.rays });
        }
        let room = AIM * limit - self.mean;
        if room <= 0.0 {
            return None;
        }
        // The distance from mean to bound falls with the square root of the number of draws.
        let growth = (self.wider * ((self.bound - self.mean) / room).powi(2)).max(1.0);
        (growth <= most)
            .then_some(Outlook { growth, work: self.rays + POINT * audit * (growth - 1.0) })
    }
}

/// Returns the number of rungs from a sampling with this mean squared error to one that may suffice for
/// `limit`, at least 1. From one rung to the next, errors fall by a fifth to a third.
#[must_use]
pub fn jump(mean: f64, limit: f64) -> usize {
    let rungs = (mean / (AIM * limit)).max(1.0).log2().round();
    (rungs as usize).clamp(1, 4)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: f64 = 1e-4;

    fn outlook(mean: f64, bound: f64) -> Option<Outlook> {
        Prospect { mean, bound, wider: 1.0, rays: 5000.0 }.outlook(LIMIT, 1000.0, 16.0)
    }

    #[test]
    fn a_bound_below_the_limit_needs_no_more_draws() {
        let found = outlook(0.5e-4, 0.9e-4);
        assert_eq!(found, Some(Outlook { growth: 1.0, work: 5000.0 }));
    }

    /// From a mean of 0.5 and a bound of 1.2 limits, the distance of 0.7 must fall to 0.35: by half,
    /// with four times as many draws.
    #[test]
    fn draws_narrow_a_bound() {
        let found = outlook(0.5e-4, 1.2e-4).unwrap();
        assert!((found.growth - 4.0).abs() < 1e-9);
        assert!((found.work - (5000.0 + 1.3 * 1000.0 * 3.0)).abs() < 1e-6);
    }

    #[test]
    fn a_mean_near_the_limit_needs_a_finer_sampling() {
        assert_eq!(outlook(0.95e-4, 1.3e-4), None);
        assert_eq!(outlook(0.75e-4, 1.3e-4), None, "30 times as many draws");
        assert_eq!(jump(0.95e-4, LIMIT), 1);
        assert_eq!(jump(4e-4, LIMIT), 2);
        assert_eq!(jump(1.0, LIMIT), 4);
    }
}
