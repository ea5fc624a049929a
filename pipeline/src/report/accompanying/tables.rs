//! Measures the numerical stability of prefiltered tables, by their order and by the number type of
//! their sums.
//!
//! A table of order n is a texture summed n times along both axes. An average is a difference of (n +
//! 1)^2 of its entries. The sums grow with the power 2n of the texture's side, so number types that
//! round the sums lose the texture. Integers that wrap lose nothing, as long as the *difference* fits.

use crate::report::measured::Table;

/// Side of the texture in texels.
const SIDE: usize = 512;

/// Number of averages along each side of the texture.
const PLACES: usize = 24;

/// Sides of the kernel's boxes in texels.
const STEPS: [usize; 3] = [4, 16, 64];

/// A number type of sums.
trait Word: Copy + Default {
    const NAME: &'static str;
    fn from_code(code: u16) -> Self;
    fn plus(self, other: Self) -> Self;
    fn times(self, factor: i32) -> Self;
    /// Returns a difference of entries as a number, which may be negative.
    fn value(self) -> f64;
}

macro_rules! integer {
    ($word:ty, $signed:ty, $name:literal) => {
        impl Word for $word {
            const NAME: &'static str = $name;
            fn from_code(code: u16) -> Self {
                Self::from(code)
            }
            fn plus(self, other: Self) -> Self {
                self.wrapping_add(other)
            }
            fn times(self, factor: i32) -> Self {
                self.wrapping_mul(factor as Self)
            }
            fn value(self) -> f64 {
                self as $signed as f64
            }
        }
    };
}

macro_rules! float {
    ($word:ty, $name:literal) => {
        impl Word for $word {
            const NAME: &'static str = $name;
            fn from_code(code: u16) -> Self {
                Self::from(code)
            }
            fn plus(self, other: Self) -> Self {
                self + other
            }
            fn times(self, factor: i32) -> Self {
                self * factor as Self
            }
            fn value(self) -> f64 {
                self.into()
            }
        }
    };
}

integer!(u32, i32, "u32, wrapping");
integer!(u64, i64, "u64, wrapping");
integer!(u128, i128, "u128, wrapping");
float!(f32, "f32");
float!(f64, "f64");

/// Coefficients of the difference along one axis, by order, from the last entry back.
const DIFFERENCES: [&[i32]; 4] = [&[1], &[1, -1], &[1, -2, 1], &[1, -3, 3, -1]];

/// Measures averages of a noise texture with tables of every order and number type.
#[must_use]
pub fn measure() -> Table {
    let codes = noise();
    let mut rows = Vec::new();
    for order in 1..=3 {
        let exact = Averages::<u128>::of(&codes, order);
        row(&mut rows, order, &exact, &Averages::<f32>::of(&codes, order));
        row(&mut rows, order, &exact, &Averages::<f64>::of(&codes, order));
        row(&mut rows, order, &exact, &Averages::<u32>::of(&codes, order));
        row(&mut rows, order, &exact, &Averages::<u64>::of(&codes, order));
        row(&mut rows, order, &exact, &exact);
    }
    let columns =
        ["order", "word", "box side in texels", "rms error", "largest error", "bits of the sums"];
    Table {
        name: "tables",
        title: "Prefiltered tables by order and by word".into(),
        about: format!(
            "Averages of a {SIDE} x {SIDE} texture of 16-bit noise under kernels of boxes one, two and three \
             times folded, as parts of white, against sums without any rounding. The renderer takes the \
             shortest wrapping word that holds every result."
        ),
        command: None,
        columns: columns.map(String::from).into(),
        rows,
        drawing: None,
    }
}

fn row<W: Word>(
    rows: &mut Vec<Vec<String>>,
    order: usize,
    exact: &Averages<u128>,
    word: &Averages<W>,
) {
    for (step, (exact, found)) in STEPS.iter().zip(exact.values.iter().zip(&word.values)) {
        let errors: Vec<f64> = exact.iter().zip(found).map(|(a, b)| (a - b).abs()).collect();
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        rows.push(vec![
            order.to_string(),
            W::NAME.into(),
            step.to_string(),
            format!("{:.2e}", (squares / errors.len() as f64).sqrt()),
            format!("{largest:.2e}"),
            bits(order).to_string(),
        ]);
    }
}

/// Returns the number of bits of the largest sum of a white texture, if nothing wrapped.
fn bits(order: usize) -> u32 {
    // Summed n times, N ones become N (N + 1) ... (N + n - 1) / n! along each axis.
    let along: f64 = (0..order).map(|k| (SIDE + k) as f64 / (k + 1) as f64).product();
    (f64::from(u16::MAX) * along * along).log2().ceil() as u32
}

/// Averages computed with one number type: for each step the averages at all positions, where white is
/// 1.
struct Averages<W> {
    values: Vec<Vec<f64>>,
    word: std::marker::PhantomData<W>,
}

impl<W: Word> Averages<W> {
    fn of(codes: &[u16], order: usize) -> Self {
        let mut table: Vec<W> = codes.iter().map(|&code| W::from_code(code)).collect();
        for _ in 0..order {
            sum_up(&mut table);
        }
        let values = STEPS.map(|step| {
            let whole = (step as f64).powi(2 * order as i32) * f64::from(u16::MAX);
            let first = order * step;
            let place = |k: usize| first + k * (SIDE - 1 - first) / (PLACES - 1);
            let places = (0..PLACES * PLACES).map(|k| (place(k % PLACES), place(k / PLACES)));
            places.map(|at| difference(&table, order, step, at).value() / whole).collect()
        });
        Self { values: values.into(), word: std::marker::PhantomData }
    }
}

/// Sums the table along rows and then along columns, in place.
fn sum_up<W: Word>(table: &mut [W]) {
    for row in table.chunks_exact_mut(SIDE) {
        let mut sum = W::default();
        for entry in row {
            sum = sum.plus(*entry);
            *entry = sum;
        }
    }
    for k in SIDE..table.len() {
        table[k] = table[k].plus(table[k - SIDE]);
    }
}

/// Returns the sum under the kernel whose last texel is `(x, y)`, as a difference of table entries.
fn difference<W: Word>(table: &[W], order: usize, step: usize, (x, y): (usize, usize)) -> W {
    let mut sum = W::default();
    for (j, down) in DIFFERENCES[order].iter().enumerate() {
        for (i, across) in DIFFERENCES[order].iter().enumerate() {
            let entry = table[(y - j * step) * SIDE + x - i * step];
            sum = sum.plus(entry.times(down * across));
        }
    }
    sum
}

/// Returns 16-bit codes without a pattern, the same in every run.
fn noise() -> Vec<u16> {
    let mut state = 1_u64;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 48) as u16
    };
    (0..SIDE * SIDE).map(|_| next()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum under the kernel, texel by texel, with the coefficients of (1 + x + ... + x^(w-1))^n.
    fn direct(codes: &[u16], order: usize, step: usize, (x, y): (usize, usize)) -> u128 {
        let mut kernel = vec![1_u128];
        for _ in 0..order {
            let mut wider = vec![0; kernel.len() + step - 1];
            for (k, value) in kernel.iter().enumerate() {
                wider[k..k + step].iter_mut().for_each(|sum| *sum += value);
            }
            kernel = wider;
        }
        let texel = |i: usize, j: usize| u128::from(codes[(y - j) * SIDE + x - i]);
        let all = kernel.iter().enumerate();
        all.map(|(j, down)| {
            let row = kernel.iter().enumerate().map(|(i, across)| across * texel(i, j));
            down * row.sum::<u128>()
        })
        .sum()
    }

    #[test]
    fn the_exact_sums_are_those_under_the_kernel() {
        let codes = noise();
        for order in 1..=3 {
            let mut table: Vec<u128> = codes.iter().map(|&code| u128::from(code)).collect();
            (0..order).for_each(|_| sum_up(&mut table));
            for step in [1, 4, 16] {
                let place = (200, 300);
                let found = difference(&table, order, step, place);
                assert_eq!(found, direct(&codes, order, step, place), "order {order}, {step}");
            }
        }
    }

    #[test]
    fn floats_lose_what_wrapping_words_keep() {
        let table = measure();
        assert_eq!(table.rows.len(), 3 * 5 * STEPS.len());
        let rms = |order: &str, word: &str, step: &str| -> f64 {
            let row = |row: &&Vec<String>| row[..3] == [order, word, step];
            table.rows.iter().find(row).unwrap()[3].parse().unwrap()
        };
        // 2 * 3 * 6 + 16 bits fit 64, and every difference of the first order fits 32.
        assert_eq!(rms("3", "u64, wrapping", "64"), 0.0);
        assert_eq!(rms("1", "u32, wrapping", "64"), 0.0);
        // 40 bits do not fit 32; sums of 86 bits leave nothing of f64's 53 for small kernels.
        assert!(rms("2", "u32, wrapping", "64") > 1e-3);
        assert!(rms("3", "f64", "4") > 10.0 * rms("2", "f64", "4"));
        assert!(rms("2", "f32", "4") > 1.0);
    }
}
