//! Compares the map of texture coordinates on a triangle, in the thesis's form and in the form in
//! use, with exact fractions.
//!
//! `cargo run --release -p topobook-render --example mapping -- FOLDER` writes `mapping.csv` and
//! `mapping.svg` to that folder and prints the table of `docs/mapping.md`.

#![expect(clippy::print_stdout, reason = "it is a program")]

#[path = "../tests/exact/mod.rs"]
mod exact;

use exact::classes::classes;
use exact::{FORMS, Form};
use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Number of hits in each class.
const SAMPLES: usize = 1000;

/// Errors of one class, sorted, for each form.
struct Line {
    class: &'static str,
    missed: usize,
    errors: [Vec<f64>; 5],
}

impl Line {
    fn failures(&self, form: usize) -> usize {
        self.errors[form].iter().filter(|error| error.is_infinite()).count()
    }

    fn finite(&self, form: usize) -> &[f64] {
        &self.errors[form][..self.errors[form].len() - self.failures(form)]
    }

    /// Returns the median and the largest of the finite errors, or `None` if there are none.
    fn spread(&self, form: usize) -> Option<[f64; 2]> {
        let finite = self.finite(form);
        Some([*finite.get(finite.len() / 2)?, *finite.last()?])
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).unwrap_or_else(|| ".".into()).into();
    let lines: Vec<Line> = classes()
        .iter()
        .map(|class| {
            let all: Vec<_> = class.samples(SAMPLES).iter().map(exact::Sample::errors).collect();
            let hits: Vec<[f64; 5]> = all.iter().flatten().copied().collect();
            let mut errors: [Vec<f64>; 5] =
                std::array::from_fn(|form| hits.iter().map(|errors| errors[form]).collect());
            errors.iter_mut().for_each(|errors| errors.sort_by(f64::total_cmp));
            Line { class: class.name, missed: all.len() - hits.len(), errors }
        })
        .collect();
    let mut csv = String::from("class,form,hits,missed,no_number,median,max\n");
    for line in &lines {
        print!("| {} ", line.class);
        for (k, form) in FORMS.iter().enumerate() {
            let spread = line.spread(k);
            let [median, max] =
                spread.map_or(["".into(), "".into()], |s| s.map(|e| format!("{e:.1e}")));
            writeln!(
                csv,
                "\"{}\",\"{}\",{},{},{},{median},{max}",
                line.class,
                form.name(),
                line.errors[k].len(),
                line.missed,
                line.failures(k),
            )?;
            match (spread, line.failures(k)) {
                (None, _) => print!("| NaN "),
                (Some(_), 0) => print!("| {median}, {max} "),
                (Some(_), n) => {
                    print!("| {median}, {max}; {:.1} % NaN ", 100.0 * n as f64 / hits(line));
                }
            }
        }
        println!("|");
    }
    std::fs::write(folder.join("mapping.csv"), csv)?;
    std::fs::write(folder.join("mapping.svg"), svg(&lines)?)?;
    Ok(())
}

fn hits(line: &Line) -> f64 {
    line.errors[0].len() as f64
}

/// The forms in the picture, with their names: the form in use and the thesis's.
const SHOWN: [(Form, &str); 3] =
    [(Form::Weights, "#1b7837"), (Form::Areas, "#4393c3"), (Form::Thesis, "#b2182b")];

const LEFT: f64 = 190.0;
const WIDTH: f64 = 560.0;
const ROW: f64 = 24.0;
const TOP: f64 = 46.0;

/// Draws errors from 1e-17 to 1 to the right and classes downward. A bar reaches from the median to
/// the maximum.
fn svg(lines: &[Line]) -> Result<String, Box<dyn Error>> {
    let place = |error: f64| LEFT + WIDTH * (error.clamp(1e-17, 1.0).log10() + 17.0) / 17.0;
    let height = TOP + ROW * lines.len() as f64 + 48.0;
    let bottom = height - 44.0;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"860\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"860\" height=\"{height}\" \
         fill=\"white\"/>\n"
    );
    for (k, (form, color)) in SHOWN.iter().enumerate() {
        let x = LEFT + 190.0 * k as f64;
        let says = match form {
            Form::Weights => "weights of the hit (in use)",
            Form::Areas => "areas at the hit point",
            _ => "the thesis's form at the hit point",
        };
        writeln!(out, "<rect x=\"{x}\" y=\"12\" width=\"18\" height=\"5\" fill=\"{color}\"/>")?;
        writeln!(out, "<text x=\"{}\" y=\"18\">{says}</text>", x + 23.0)?;
    }
    for power in (-17..=0).step_by(2).chain([0]) {
        let x = place(10f64.powi(power));
        writeln!(
            out,
            "<line x1=\"{x:.1}\" y1=\"{}\" x2=\"{x:.1}\" y2=\"{bottom}\" stroke=\"#ddd\"/>\
             <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">1e{power}</text>",
            TOP - 8.0,
            bottom + 14.0,
        )?;
    }
    for (row, line) in lines.iter().enumerate() {
        let y = TOP + ROW * row as f64;
        writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
            LEFT - 8.0,
            y + 11.0,
            line.class
        )?;
        for (k, (form, color)) in SHOWN.iter().enumerate() {
            let index = FORMS.iter().position(|known| known == form).unwrap_or(0);
            let y = y + 6.0 * k as f64;
            if let Some([median, max]) = line.spread(index) {
                let (from, to) = (place(median), place(max));
                writeln!(
                    out,
                    "<rect x=\"{from:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"4\" \
                     fill=\"{color}\"/>",
                    (to - from).max(3.0)
                )?;
            }
            let failures = line.failures(index);
            if failures > 0 {
                writeln!(
                    out,
                    "<text x=\"{}\" y=\"{}\" fill=\"{color}\" font-size=\"10\">{:.1} % NaN</text>",
                    LEFT + WIDTH + 8.0,
                    y + 5.0,
                    100.0 * failures as f64 / hits(line)
                )?;
            }
        }
    }
    writeln!(
        out,
        "<text x=\"{LEFT}\" y=\"{}\">error of u or v, the larger one, for sides of length 1: from \
         the median to the largest; the left edge stands for none</text>\n</svg>",
        bottom + 34.0
    )?;
    Ok(out)
}
