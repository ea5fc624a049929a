//! Chooses the diagonal that cuts a cell into two triangles.
//!
//! A diagonal is a straight line between two points of the surface. The surface normals at its ends
//! determine how far from the diagonal the surface runs. Take a curve with end points `P`, `Q` and
//! unit normals `m`, `n` there. Cubic interpolation puts the middle of this curve
//! `(Q - P).(n - m) / 8` off the chord (positive where the surface bulges outward). The diagonal
//! with the smaller distance is taken, since it is nearer to the true surface in the middle of the
//! cell. No further point of the surface is needed.
//!
//! Where one diagonal lies outside the surface, the other inside, and both about equally far, the surface is a
//! saddle. On a thin body each saddle has a counterpart on the other side, whose columns run the other direction.
//! Both sides must take the same line in space, or the triangles of one side cut through those of the other. So
//! the diagonal is taken whose direction agrees best with a line that is fixed in space.
//!
//! On flat or symmetrical cells both distances are equal. Then the shorter diagonal is taken, which
//! gives the better shaped triangles. If the lengths are equal too, the diagonal from the cell's first
//! corner is taken. The answer depends on the cell alone, so it is the same in every run.
//!
//! Limits: the estimate is of second order. A cell that spans a whole wave of a relief is cut by
//! chance. Cells that are folded or bow-tied are cut like any other.

/// Corners of a cell, counter-clockwise seen from outside, in the order `A`, `B`, `C`, `D`.
///
/// ```text
///   D --- C     row + 1
///   |     |
///   A --- B     row
///  col  col + 1
/// ```
pub type Corners = [[f32; 3]; 4];

/// One of a cell's two diagonals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Diagonal {
    /// The diagonal from `A` to `C`: triangles `ABC` and `ACD`.
    Ac,
    /// The diagonal from `B` to `D`: triangles `ABD` and `BCD`.
    Bd,
}

impl Diagonal {
    /// Returns the corner numbers of the two triangles, 0 to 3 for `A` to `D`, counter-clockwise.
    #[must_use]
    pub fn triangles(self) -> [[usize; 3]; 2] {
        match self {
            Self::Ac => [[0, 1, 2], [0, 2, 3]],
            Self::Bd => [[0, 1, 3], [1, 2, 3]],
        }
    }

    /// Returns the other diagonal of the cell.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Ac => Self::Bd,
            Self::Bd => Self::Ac,
        }
    }
}

/// Amount by which the second diagonal must be nearer to the surface before it is taken, as a fraction
/// of its length. The compared estimates lack the factor 1/8. Normals of f32 carry errors of 1e-7, so a
/// smaller value would cut symmetrical cells at random. At 1e-6 the chosen diagonal is at most an
/// eighth of a millionth of its length farther from the surface than the other.
const NEARER: f64 = 1e-6;
/// Amount by which the second diagonal must be shorter, as a fraction of the squared length. Where a
/// cell is a hundredth of the object, rounding to f32 makes equal squared lengths differ by a part in
/// 1e5.
const SHORTER: f64 = 1e-5;

/// Distances of the two diagonals of a saddle that differ by less than this fraction are alike. On a thin body the
/// two sides of it differ by about its thickness over the width of a cell. With a larger number, the triangles of a
/// saddle would be further from the surface.
const ALIKE: f64 = 0.03;
/// The line in space that decides between the diagonals of a saddle. Its direction is along no axis and no plane of
/// axes, since bodies are.
const FIXED: [f64; 3] = [0.48, 0.61, 0.63];

/// Returns the diagonal that is nearer to the surface with the unit vectors `normals` at `corners`.
#[must_use]
pub fn choose(corners: &Corners, normals: &Corners) -> Diagonal {
    let chord = |from: usize, to: usize| {
        let chord = minus(corners[to], corners[from]);
        (dot(chord, minus(normals[to], normals[from])), dot(chord, chord))
    };
    let (bulge_ac, length_sq_ac) = chord(0, 2);
    let (bulge_bd, length_sq_bd) = chord(1, 3);
    let (off_ac, off_bd) = (bulge_ac.abs(), bulge_bd.abs());
    let slack = NEARER * length_sq_ac.max(length_sq_bd).sqrt();
    let saddle = bulge_ac * bulge_bd < 0.0 && off_ac.min(off_bd) > slack;
    let second = if saddle && (off_ac - off_bd).abs() <= ALIKE * off_ac.max(off_bd) {
        let along = |from: usize, to: usize| dot(minus(corners[to], corners[from]), FIXED).abs();
        along(1, 3) > along(0, 2)
    } else if (off_ac - off_bd).abs() > slack {
        off_bd < off_ac
    } else {
        length_sq_bd < length_sq_ac * (1.0 - SHORTER)
    };
    if second { Diagonal::Bd } else { Diagonal::Ac }
}

/// Returns true when a triangle has no area: two corners are one point, or all three lie on a line.
///
/// The products of f32 differences are taken in f64, where almost all of them are exact.
#[must_use]
pub fn is_flat(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> bool {
    let (p, q) = (minus(b, a), minus(c, a));
    p[1] * q[2] == p[2] * q[1] && p[2] * q[0] == p[0] * q[2] && p[0] * q[1] == p[1] * q[0]
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| f64::from(a[i]) - f64::from(b[i]))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Returns a point of a wavy sheet `z = f(x, y)` and the unit normal there.
    fn sheet(x: f64, y: f64) -> ([f64; 3], [f32; 3]) {
        let (a, b) = (TAU * (x + 0.4 * y), TAU * (0.3 * x - y));
        let z = 0.1 * a.sin() + 0.05 * b.cos();
        let z_x = TAU * (0.1 * a.cos() - 0.3 * 0.05 * b.sin());
        let z_y = TAU * (0.4 * 0.1 * a.cos() + 0.05 * b.sin());
        let length = (1.0 + z_x * z_x + z_y * z_y).sqrt();
        ([x, y, z], [-z_x / length, -z_y / length, 1.0 / length].map(|n| n as f32))
    }

    #[test]
    fn the_chosen_diagonal_is_almost_always_the_nearer_one() {
        let (n, mut chosen, mut nearest, mut fixed) = (40, 0.0, 0.0, 0.0);
        for cell in 0..n * n {
            let at = |i: usize, j: usize| sheet(i as f64 / n as f64, j as f64 / n as f64);
            let (i, j) = (cell % n, cell / n);
            let all = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let corners = all.map(|(p, _)| p.map(|x| x as f32));
            // Truth: the height of the surface over the middle of the cell.
            let middle = sheet((i as f64 + 0.5) / n as f64, (j as f64 + 0.5) / n as f64).0[2];
            let off = |a: usize, b: usize| (0.5 * (all[a].0[2] + all[b].0[2]) - middle).powi(2);
            let both = [off(0, 2), off(1, 3)];
            nearest += both[0].min(both[1]);
            fixed += both[0];
            chosen += match choose(&corners, &all.map(|(_, normal)| normal)) {
                Diagonal::Ac => both[0],
                Diagonal::Bd => both[1],
            };
        }
        assert!(chosen <= 1.01 * nearest, "{chosen} against {nearest}");
        assert!(chosen <= 0.5 * fixed, "{chosen} against {fixed}");
    }

    #[test]
    fn a_symmetrical_cell_is_cut_from_its_first_corner() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let mut nearly = corners;
        nearly[2][0] = 1.000_000_1;
        for cell in [corners, nearly] {
            assert_eq!(choose(&cell, &[[0.0, 0.0, 1.0]; 4]), Diagonal::Ac);
        }
    }

    #[test]
    fn a_flat_skewed_cell_is_cut_along_its_shorter_diagonal() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        assert_eq!(choose(&corners, &[[0.0, 0.0, 1.0]; 4]), Diagonal::Bd);
    }

    #[test]
    fn points_on_a_line_have_no_area() {
        let (a, b, c) = ([0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.4, 0.8, 1.2]);
        assert!(is_flat(a, b, c) && is_flat(a, a, c) && is_flat(a, c, c));
        assert!(!is_flat([0.0; 3], [1e-38, 0.0, 0.0], [0.0, 1e-38, 0.0]));
        assert!(!is_flat([0.0; 3], [3e38, 0.0, 0.0], [-3e38, 3e38, 0.0]));
    }
}
