//! Prints what a pixel is made of: the intersection trees of its samples, node by node.
//!
//! The pixel is exposed by the film like any other, and the nodes are written down as they are
//! shaded: what is printed is what is rendered.

mod node;

use crate::color::{Color, Encoding};
use crate::film::{Settings, Witness, expose_pixel};
use crate::prepared::Prepared;
use crate::scene::Scene;
use crate::shade::observer::{Observer, Seen, Way};
use glam::DVec3;
use std::fmt::Write;

/// Spaces that a branch stands further right than the node it leaves.
const STEP: usize = 2;

/// The trees of a pixel as text, the pixel's colour first. Numbers are rounded to `f32`, the
/// pixel's own is exactly that.
///
/// With `all`, every sample that counts in the pixel is printed, else the one in its middle.
/// `encoding` is how the codes of the pixel are made. The pixel lies in the picture, which need
/// not be cropped to hold it.
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

/// Writes down what is shaded.
struct Recorder<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    pixel: (u32, u32),
    all: bool,
    /// Whether neighbours are looked at.
    halo: bool,
    text: String,
    /// Whether the sample at hand is to be printed.
    wanted: bool,
    /// The ways of the branches that are followed, from the eye on.
    open: Vec<Option<Way>>,
    /// For each branch on the way, the text of those that left it.
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
