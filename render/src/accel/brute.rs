//! Brute force: every piece, every ray. What the structures are held against.

/// All pieces, in the scene's order.
#[derive(Debug)]
pub struct Brute {
    /// How many there are.
    pub pieces: u32,
}

impl Brute {
    /// Gives `visit` every piece, until it returns a `t_max` below 0.
    pub fn walk(&self, mut t_max: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        for piece in 0..self.pieces {
            if t_max < 0.0 {
                return;
            }
            t_max = visit(piece, t_max);
        }
    }
}
