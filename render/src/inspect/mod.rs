//! Prints one pixel: the intersection trees of its samples, node by node.
//!
//! The film exposes the pixel like any other, and the nodes are recorded while they are shaded. The
//! printed values are therefore the rendered ones.

mod node;

use crate::color::{Color, Encoding};
use crate::film::{Settings, Witness, expose_pixel};
use crate::prepared::Prepared;
use crate::scene::Scene;
use crate::shade::observer::{Observer, Seen, Way};
use glam::DVec3;
use std::fmt::Write;

/// Number of spaces by which a branch is indented against its parent node.
const STEP: usize = 2;

/// Returns the trees of a pixel as text, after the pixel's colour. All numbers are rounded to
/// `f32`; for the pixel's colour this loses nothing.
///
/// With `all`, the text lists every sample with a weight in the pixel, else only the middle one.
/// `encoding` gives the 8-bit codes of the colour. The pixel must lie in the whole picture, but may
/// lie outside its crop.
#[must_use]
pub fn pixel(
    prepared: &Prepared<'_>,
    settings: &Settings,
    (x, y): (u32, u32),
    encoding: Encoding,
    all: bool,
) -> String {
    let scene = prepared.scene();
    let settings = Settings { layers: Vec::new(), ..settings.clone() };
    let (picture, recorder) = expose_pixel(prepared, &settings, (x, y), |halo| Recorder {
        scene,
        settings: &settings,
        pixel: (x, y),
        all,
        halo,
        text: String::new(),
        wanted: false,
        open: Vec::new(),
        branches: Vec::new(),
    });
    let light = picture.pixels[0];
    let codes = light.map(|light| encoding.to_byte(f64::from(light)));
    let (width, height) = (settings.width, settings.height);
    let of = format!("pixel {x},{y} of {width}x{height}");
    let [r, g, b] = codes;
    format!("{of}: linear {}, as codes {r} {g} {b}\n{}", numbers(light), recorder.text)
}

/// Records the samples of a pixel while they are shaded.
struct Recorder<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    pixel: (u32, u32),
    all: bool,
    /// Whether the neighbours of each sample are traced.
    halo: bool,
    text: String,
    /// Whether the current sample is printed.
    wanted: bool,
    /// How each open branch continues its parent, from the root on; `None` for the root.
    open: Vec<Option<Way>>,
    /// For each open branch, the text of its finished children.
    branches: Vec<String>,
}

impl Recorder<'_> {
    fn heading(&self, x: i64, y: i64) -> String {
        let sampling = self.settings.sampling;
        let weight = sampling.weight(self.pixel.0, x) * sampling.weight(self.pixel.1, y);
        let whole = sampling.whole().pow(2);
        let place = sampling.place(x, y);
        let share = if weight == whole { "1".into() } else { format!("{weight}/{whole}") };
        format!("sample {x},{y} at {},{} on the film, weight {share}\n", place.x, place.y)
    }
}

impl Witness for Recorder<'_> {
    fn sample(&mut self, x: i64, y: i64) {
        let middle = [self.pixel.0, self.pixel.1].map(|pixel| self.settings.sampling.middle(pixel));
        self.wanted = self.all || [x, y] == middle;
        if self.wanted {
            let heading = self.heading(x, y);
            self.text.push_str(&heading);
            self.open.push(None);
            self.branches.push(String::new());
        }
    }
}

impl Observer for Recorder<'_> {
    fn follow(&mut self, way: Way) {
        if self.wanted {
            self.open.push(Some(way));
            self.branches.push(String::new());
        }
    }

    fn leave(&mut self, seen: &Seen<'_>) {
        if !self.wanted {
            return;
        }
        let (Some(way), Some(below)) = (self.open.pop(), self.branches.pop()) else { return };
        let depth = self.open.len();
        let way = match way {
            None => "from the eye",
            Some(Way::Reflected) => "reflected",
            Some(Way::Refracted) => "refracted",
        };
        let margin = " ".repeat(STEP * (depth + 1));
        let mut lines = node::lines(self.scene, self.halo, seen).into_iter();
        let first = lines.next().unwrap_or_default();
        let mut text = format!("{margin}{depth} {way}: {first}\n");
        for line in lines {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{margin}  {line}");
        }
        text.push_str(&below);
        match self.branches.last_mut() {
            Some(parent) => parent.push_str(&text),
            None => self.text.push_str(&text),
        }
    }
}

fn numbers(values: [f32; 3]) -> String {
    let [x, y, z] = values;
    format!("{x:?} {y:?} {z:?}")
}

fn vector(v: DVec3) -> String {
    numbers(v.as_vec3().to_array())
}

fn light(color: Color) -> String {
    numbers(color.to_array().map(|light| light as f32))
}
