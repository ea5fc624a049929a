//! Continues the entries of a table beyond its ends.
//!
//! Filters need `D_n(i)`, the n-fold sum of the texels before `i`, for any whole `i`. Its
//! differences are `D_{n-1}`. Beyond the texture it therefore continues as a polynomial of entries
//! near the end, plus at most one other entry. Below, `W` is the size and `P` the period. `D_m(W)`
//! for `m < n` is the (n-m)-th difference of the stored `D_n(W)`, `D_n(W+1)`, ...
//!
//! ```text
//!   repeat   D_n(i + qP) = D_n(i) + sum_{j<n} C(i,j) D_{n-j}(qP)
//!            D_1(qP) = q D_1(P)
//!            D_2(qP) = q D_2(P) + C(q,2) P D_1(P)
//!            D_3(qP) = q D_3(P) + C(q,2) P D_2(P) + (C(q,3) P^2 + C(q,2) C(P,2)) D_1(P)
//!   mirror   the same with P = 2W, and between W and 2W
//!            D_1(W + d) = -D_1(W - d)     + 2 D_1(W)
//!            D_2(W + d) =  D_2(W - d + 1) + (2d - 1) D_1(W)
//!            D_3(W + d) = -D_3(W - d + 2) + D_3(W) + D_3(W + 2) + (d(d-1) - d) D_1(W)
//!   clamp    D_n(i)     = C(i,n) T(0)                            for i < 0
//!            D_n(W + d) = sum_{j<n} C(d,j) D_{n-j}(W) + C(d,n) T(W-1)
//! ```
//!
//! The binomial coefficients hold for any whole `i`, of either sign: `i (i-1) (i-2) / 6` and so on.

use crate::texture::Wrap;

/// Largest number of entries at the ends that continue a table.
pub const MOST_ENDS: usize = 5;

/// One axis of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// Order of the table, 1 to 3.
    pub n: usize,
    /// Number of texels along the axis. The table has `n` entries more.
    pub size: i64,
    /// Continuation of the texture beyond its edges.
    pub wrap: Wrap,
}

/// A table entry at any index, as a sum of stored entries.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Entry {
    /// Index of a stored entry, which is multiplied by `sign`.
    pub index: usize,
    /// 1, -1, or 0.
    pub sign: i8,
    /// True if the entries at the ends contribute too.
    pub goes_on: bool,
    /// Factor of each of the entries [`Line::ends`].
    pub factors: [i128; MOST_ENDS],
}

impl Line {
    /// Returns the indices of the stored entries at the ends, and their number.
    #[must_use]
    pub fn ends(self) -> ([usize; MOST_ENDS], usize) {
        let (n, size) = (self.n, self.size as usize);
        match self.wrap {
            Wrap::Repeat | Wrap::Mirror => (std::array::from_fn(|k| size + k), n),
            // D_n(n) is the first texel.
            Wrap::Clamp => (std::array::from_fn(|k| if k == 0 { n } else { size + k - 2 }), n + 2),
        }
    }

    /// Returns `D_n(i)` for any `i`, in terms of the entries `0..size + n` of the table.
    #[must_use]
    pub fn entry(self, i: i64) -> Entry {
        if (0..self.size + self.n as i64).contains(&i) {
            return Entry { index: i as usize, sign: 1, ..Entry::default() };
        }
        match self.wrap {
            Wrap::Repeat => self.repeated(i),
            Wrap::Mirror => self.mirrored(i),
            Wrap::Clamp => self.clamped(i),
        }
    }

    /// Returns `D_1(size)`, the sum of all texels.
    #[must_use]
    pub fn sum(self) -> Entry {
        let mut entry = Entry { goes_on: true, ..Entry::default() };
        self.add(&mut entry, 1, 1);
        entry
    }

    /// Adds `factor` times `D_m(W)` to `entry`.
    fn add(self, entry: &mut Entry, m: usize, factor: i128) {
        // Under Wrap::Clamp the list of ends starts with the first texel and the entry before W.
        let first = if self.wrap == Wrap::Clamp { 2 } else { 0 };
        self.add_from(entry, first, self.n - m, factor);
    }

    /// Adds `factor` times the j-th difference of the end entries, starting at end `first`.
    fn add_from(self, entry: &mut Entry, first: usize, j: usize, factor: i128) {
        for k in 0..=j {
            let sign = if (j - k).is_multiple_of(2) { 1 } else { -1 };
            entry.factors[first + k] += sign * binomial(j as i64, k) * factor;
        }
    }

    fn repeated(self, i: i64) -> Entry {
        let (q, i) = (i.div_euclid(self.size), i.rem_euclid(self.size));
        let mut entry = Entry { index: i as usize, sign: 1, goes_on: true, ..Entry::default() };
        self.periods(&mut entry, i, q, self.size, |entry, m, factor| self.add(entry, m, factor));
        entry
    }

    /// Adds to `entry` what `q` periods before `i` contribute to `D_n(i)`. `whole` adds a multiple
    /// of `D_m(P)`.
    fn periods(
        self,
        entry: &mut Entry,
        i: i64,
        q: i64,
        period: i64,
        whole: impl Fn(&mut Entry, usize, i128),
    ) {
        let p = i128::from(period);
        for j in 0..self.n {
            let count = binomial(i, j);
            let m = self.n - j;
            whole(entry, m, count * i128::from(q));
            if m >= 2 {
                whole(entry, m - 1, count * binomial(q, 2) * p);
            }
            if m == 3 {
                let both = binomial(q, 3) * p * p + binomial(q, 2) * binomial(period, 2);
                whole(entry, 1, count * both);
            }
        }
    }

    fn mirrored(self, i: i64) -> Entry {
        let Self { n, size, .. } = self;
        let (q, i) = (i.div_euclid(2 * size), i.rem_euclid(2 * size));
        let mut entry = Entry { index: i as usize, sign: 1, goes_on: true, ..Entry::default() };
        let beyond = i - size;
        if beyond >= n as i64 {
            entry.index = (size - beyond) as usize + n - 1;
            entry.sign = if n.is_multiple_of(2) { 1 } else { -1 };
            self.reflect(&mut entry, n, beyond, 1);
        }
        // D_m(2W) is the reflection of D_m(m - 1), which is 0.
        let whole = |entry: &mut Entry, m, factor| self.reflect(entry, m, size, factor);
        self.periods(&mut entry, i, q, 2 * size, whole);
        entry
    }

    /// Adds `factor` times the part of `D_m(W + d)` that the ends contribute.
    fn reflect(self, entry: &mut Entry, m: usize, d: i64, factor: i128) {
        let far = i128::from(d);
        match m {
            1 => self.add(entry, 1, 2 * factor),
            2 => self.add(entry, 1, (2 * far - 1) * factor),
            _ => {
                self.add(entry, 1, (far * (far - 1) - far) * factor);
                entry.factors[0] += factor;
                entry.factors[2] += factor;
            }
        }
    }

    fn clamped(self, i: i64) -> Entry {
        let mut entry = Entry { goes_on: true, ..Entry::default() };
        if i < 0 {
            entry.factors[0] = binomial(i, self.n);
            return entry;
        }
        let beyond = i - self.size;
        for j in 0..self.n {
            self.add(&mut entry, self.n - j, binomial(beyond, j));
        }
        self.add_from(&mut entry, 1, self.n, binomial(beyond, self.n));
        entry
    }
}

/// Returns `C(i, k)` for any whole `i`, of either sign, and `k` up to 3.
#[must_use]
pub fn binomial(i: i64, k: usize) -> i128 {
    let wide = i128::from(i);
    match k {
        0 => 1,
        1 => wide,
        2 => wide * (wide - 1) / 2,
        // 64-bit division is fast and suffices for all but the widest textures.
        _ if i.unsigned_abs() < 1 << 20 => i128::from(i * (i - 1) * (i - 2) / 6),
        _ => wide * (wide - 1) * (wide - 2) / 6,
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use proptest::prelude::*;

    impl Line {
        /// Evaluates an entry in a table of plain integers.
        pub fn value(self, entry: &Entry, table: &[i64]) -> i64 {
            let (ends, count) = self.ends();
            let beyond: i128 = (0..count)
                .map(|k| entry.factors[k] * i128::from(*table.get(ends[k]).unwrap_or(&0)))
                .sum();
            i64::from(entry.sign) * table[entry.index] + beyond as i64
        }
    }

    /// Computes `D_n` of a wrapped row by counting, for `i` of either sign.
    pub fn direct(n: usize, i: i64, row: &[i64], wrap: Wrap) -> i64 {
        // Sums the texels between 0 and i, n times.
        let texel = |k: i64| row[wrap.index(k as f64, row.len())];
        let mut sums: Vec<i64> =
            if i >= 0 { (0..i).map(texel).collect() } else { (i..0).rev().map(texel).collect() };
        if i >= 0 {
            // The sums are exclusive: each value is replaced by the sum of the values before it.
            for _ in 1..n {
                let mut before = 0;
                for value in &mut sums {
                    before += std::mem::replace(value, before);
                }
            }
            return sums.iter().sum();
        }
        // Downward the sums are inclusive and change their sign each time.
        for _ in 1..n {
            let mut up_to = 0;
            for value in &mut sums {
                up_to -= *value;
                *value = up_to;
            }
        }
        -sums.iter().sum::<i64>()
    }

    pub fn wraps() -> impl Strategy<Value = Wrap> {
        prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp), Just(Wrap::Mirror)]
    }

    #[test]
    fn sums_by_counting_have_the_right_differences() {
        let row = [3, 1, 4];
        for n in 2..=3 {
            for i in -9..9 {
                let [here, next] = [i, i + 1].map(|i| direct(n, i, &row, Wrap::Mirror));
                assert_eq!(next - here, direct(n - 1, i, &row, Wrap::Mirror), "{n} {i}");
            }
        }
    }

    proptest! {
        #[test]
        fn entries_beyond_the_table_are_exact(
            row in prop::collection::vec(-9i64..9, 1..6), i in -40i64..40, n in 1usize..=3,
            wrap in wraps(),
        ) {
            let table: Vec<i64> =
                (0..(row.len() + n) as i64).map(|k| direct(n, k, &row, wrap)).collect();
            let line = Line { n, size: row.len() as i64, wrap };
            prop_assert_eq!(line.value(&line.entry(i), &table), direct(n, i, &row, wrap));
        }
    }

    #[test]
    fn binomials_of_wide_textures_do_not_overflow() {
        let i = 1i64 << 40;
        let wide = i128::from(i);
        assert_eq!(binomial(i, 3) * 6, wide * (wide - 1) * (wide - 2));
        assert_eq!(binomial(-2, 3), -4);
    }
}
