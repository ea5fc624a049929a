//! The sentence that states the accuracy of a picture.

use std::fmt;

/// The error of a picture, as an audit found it.
///
/// An error is the root mean square over all pixels and the three channels, in linear light with
/// white as 1. Light above white counts in full. A PNG cuts it off, which only makes an error
/// smaller. The rounding to the codes of a PNG is not included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statement {
    /// The estimated error.
    pub error: f64,
    /// A bound that the true error stays below with [`Statement::confidence`].
    pub bound: f64,
    /// The chance that the bound holds, for instance 0.95.
    pub confidence: f64,
    /// Rays from the eye for the picture, per pixel.
    pub rays: f64,
    /// Rays from the eye for the audit and for pixels that were tried alone, per pixel.
    pub audit: f64,
    /// The requested error, if it was not reached.
    pub missed: Option<f64>,
}

impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { error, bound, confidence, rays, audit, missed } = *self;
        let (error, percent) = (figures(error), confidence * 100.0);
        // Rounded up, so that the printed bound holds as well.
        let bound = upward(bound);
        write!(f, "error {error}, below {bound} with {percent:.0} % confidence; ")?;
        write!(f, "{rays:.2} rays per pixel, audit {audit:.2}")?;
        match missed {
            Some(wanted) => write!(f, "; the requested error of {wanted} was not reached"),
            None => Ok(()),
        }
    }
}

/// Returns a number with two significant figures, such as `0.0087`.
fn figures(number: f64) -> String {
    format!("{number:.*}", decimals(number))
}

/// Returns a number with two significant figures that is not below it.
fn upward(number: f64) -> String {
    let digits = decimals(number);
    let unit = 10.0_f64.powi(-(digits as i32));
    // A number with two figures stays itself, though its quotient may be rounded upward.
    // Adding 0 makes a negative zero positive.
    format!("{:.*}", digits, (number / unit - 1e-9).ceil() * unit + 0.0)
}

/// Returns the number of decimals that show two significant figures, at most 6.
fn decimals(number: f64) -> usize {
    if number <= 0.0 {
        return 1;
    }
    (1.0 - number.log10().floor()).clamp(1.0, 6.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_statement_is_one_line() {
        let statement = Statement {
            error: 0.00868,
            bound: 0.009_51,
            confidence: 0.95,
            rays: 1.309,
            audit: 0.221,
            missed: None,
        };
        let text =
            "error 0.0087, below 0.0096 with 95 % confidence; 1.31 rays per pixel, audit 0.22";
        assert_eq!(statement.to_string(), text);
        let missed = Statement { bound: 0.01, missed: Some(0.005), ..statement }.to_string();
        assert!(missed.contains("below 0.010 with"), "{missed}");
        assert!(missed.ends_with("; the requested error of 0.005 was not reached"), "{missed}");
    }

    #[test]
    fn numbers_have_two_figures() {
        let all = [0.0, 0.5, 0.051, 0.0123, 1.25, 0.000_012_6];
        let shown = all.map(|number| (figures(number), upward(number)));
        let [zero, half, hundredths, thousandths, _, tiny] = shown;
        assert_eq!(zero, ("0.0".into(), "0.0".into()));
        assert_eq!(half, ("0.50".into(), "0.50".into()));
        assert_eq!(hundredths, ("0.051".into(), "0.051".into()));
        assert_eq!(thousandths, ("0.012".into(), "0.013".into()));
        assert_eq!(tiny, ("0.000013".into(), "0.000013".into()));
    }
}
