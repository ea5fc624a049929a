//! Dual numbers: a value with its derivative by one variable.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual {
    /// The value.
    pub value: f64,
    /// The derivative by the variable.
    pub slope: f64,
}

impl Dual {
    /// Returns a value that does not depend on the variable.
    pub(super) fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    /// Applies a function with the given value and derivative at this value.
    fn chain(self, value: f64, slope: f64) -> Self {
        // An infinite derivative of a function of a constant is none.
        let slope = if self.slope == 0.0 { 0.0 } else { slope * self.slope };
        Self { value, slope }
    }

    pub(super) fn sin(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.chain(sin, cos)
    }

    pub(super) fn cos(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.chain(cos, -sin)
    }

    pub(super) fn exp(self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp)
    }

    pub(super) fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }

    pub(super) fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }

    pub(super) fn asin(self) -> Self {
        let x = self.value;
        self.chain(x.asin(), 1.0 / ((1.0 - x) * (1.0 + x)).sqrt())
    }

    pub(super) fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.chain(tanh, 1.0 - tanh * tanh)
    }

    pub(super) fn atan2(self, other: Self) -> Self {
        let (y, x) = (self.value, other.value);
        let slope = (self.slope * x - other.slope * y) / (x * x + y * y);
        Self { value: y.atan2(x), slope }
    }

    pub(super) fn power(self, exponent: Self) -> Self {
        let (x, n) = (self.value, exponent.value);
        if exponent.slope == 0.0 {
            return self.chain(x.powf(n), if n == 0.0 { 0.0 } else { n * x.powf(n - 1.0) });
        }
        (exponent * self.ln()).exp()
    }
}

impl Add for Dual {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Self { value: self.value * other.value, slope }
    }
}

impl Div for Dual {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Neg for Dual {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}
