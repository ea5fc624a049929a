//! Brute force: every ray tries every piece. Tests compare the structures with it.

/// All pieces, in the scene's order.
#[derive(Debug)]
pub struct Brute {
    /// Number of pieces.
    pub pieces: u32,
}

impl Brute {
    /// Calls `visit` with the index of every piece, until `visit` returns a `t_max` below 0.
    pub fn walk(&self, mut t_max: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        for piece in 0..self.pieces {
            if t_max < 0.0 {
                return;
            }
            t_max = visit(piece, t_max);
        }
    }
}
