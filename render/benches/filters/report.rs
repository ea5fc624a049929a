//! Formats the measured lines as a table and as a drawing.

use super::{Line, Method};
use std::fmt::{self, Write};

/// Returns the table as CSV, with one row for each method.
pub fn csv(lines: &[Line]) -> String {
    let mut text = String::from(
        "method,ns,ratio,ratio thin,ratio middle,ratio far,rms box,rms tent,\
         rms checks,rms zones,rms clouds,rms letters,rms 0 deg,rms 15 deg,rms 45 deg,rms below 1 texel,rms 1 to 2 texels,rms from 2 texels,\
         rms anisotropy 1,rms anisotropy 4,rms anisotropy 16,rms anisotropy 40,largest box,bytes\n",
    );
    for line in lines {
        text += &format!("\"{}\",{:.1},{:.2}", line.method.name(), line.time, line.ratio);
        line.ratios.iter().for_each(|ratio| text += &format!(",{ratio:.2}"));
        let kinds = [&line.by_texture, &line.by_angle, &line.by_breadth, &line.by_stretch];
        let errors = line.error.iter().chain(kinds.into_iter().flatten()).chain([&line.largest]);
        errors.for_each(|error| text += &format!(",{error:.4}"));
        text += &format!(",{}\n", line.bytes);
    }
    text
}

const LEFT: f64 = 80.0;
const TOP: f64 = 30.0;
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
const RATIOS: [f64; 2] = [0.2, 500.0];
const ERRORS: [f64; 2] = [0.002, 0.5];

/// Draws errors against ratios, both axes logarithmic.
pub fn svg(lines: &[Line]) -> Result<String, fmt::Error> {
    let part = |value: f64, [low, high]: [f64; 2]| (value / low).ln() / (high / low).ln();
    let x = |ratio: f64| LEFT + WIDTH * part(ratio, RATIOS);
    let y = |error: f64| TOP + HEIGHT * (1.0 - part(error, ERRORS));
    let mut out = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 500\" font-family=\"sans-serif\" \
         font-size=\"13\">\n<rect width=\"760\" height=\"500\" fill=\"white\"/>\n",
    );
    for ratio in [0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0] {
        let (x, bottom) = (x(ratio), TOP + HEIGHT);
        writeln!(out, "<path d=\"M{x:.1} {TOP}V{bottom}\" stroke=\"#ddd\"/>")?;
        writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{ratio}</text>",
            bottom + 18.0
        )?;
    }
    for error in [0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5] {
        let (y, right) = (y(error), LEFT + WIDTH);
        writeln!(out, "<path d=\"M{LEFT} {y:.1}H{right}\" stroke=\"#ddd\"/>")?;
        writeln!(
            out,
            "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{error}</text>",
            LEFT - 8.0,
            y + 4.0
        )?;
    }
    writeln!(
        out,
        "<text x=\"{}\" y=\"480\" text-anchor=\"middle\">time of one average, by that of bilinear interpolation</text>",
        LEFT + 0.5 * WIDTH
    )?;
    let middle = TOP + 0.5 * HEIGHT;
    writeln!(
        out,
        "<text transform=\"translate(24 {middle}) rotate(-90)\" text-anchor=\"middle\">root mean square error, of white</text>",
    )?;
    for line in lines {
        let samples = matches!(line.method, Method::Samples(_));
        let color = if samples { "#888" } else { "#1b6ca8" };
        let x = x(line.ratio);
        // A full dot marks the error against the pixel's box, a ring the error against its tent.
        let [of_box, of_tent] = line.error.map(y);
        writeln!(
            out,
            "<path d=\"M{x:.1} {of_box:.1}V{of_tent:.1}\" stroke=\"{color}\" opacity=\"0.5\"/>"
        )?;
        writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{of_box:.1}\" r=\"5\" fill=\"{color}\"/>")?;
        writeln!(
            out,
            "<circle cx=\"{x:.1}\" cy=\"{of_tent:.1}\" r=\"5\" fill=\"white\" stroke=\"{color}\" stroke-width=\"2\"/>"
        )?;
        let name = line.method.name();
        // Labels stand to the right, or below where another label stands to the right.
        let (right, down) =
            if line.method == Method::BoxOfOnePixel { (-22.0, 20.0) } else { (9.0, 4.0) };
        let (x, y) = (x + right, of_box + down);
        writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{color}\">{name}</text>")?;
    }
    for (at, (fill, text)) in
        [("#1b6ca8", "against the pixel's box"), ("white", "against a tent of 2 pixels")]
            .iter()
            .enumerate()
    {
        let y = TOP + HEIGHT - 40.0 + 20.0 * at as f64;
        let x = LEFT + 14.0;
        writeln!(
            out,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"5\" fill=\"{fill}\" stroke=\"#1b6ca8\" stroke-width=\"2\"/>"
        )?;
        writeln!(out, "<text x=\"{}\" y=\"{}\">{text}</text>", x + 12.0, y + 4.0)?;
    }
    out += "</svg>\n";
    Ok(out)
}
