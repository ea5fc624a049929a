//! The largest and smallest numbers of a scene file, which its schema states and its reader checks.

/// Largest absolute value of a number. Products of three such numbers are below the largest `f64`,
/// and such coordinates are below the largest `f32`.
pub const LARGEST: f64 = 1e30;

/// Smallest value where a number above 0 is expected.
pub const SMALLEST: f64 = 1e-30;

/// Largest `max_depth`. Deeper recursion would show nothing more and could exhaust the stack.
pub const DEEPEST: u32 = 64;
