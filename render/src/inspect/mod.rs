//! Prints one pixel: the intersection trees of its samples, node by node.
//!
//! The film exposes the pixel like any other, and the nodes are recorded while they are shaded. The
//! printed values are therefore the rendered ones.

mod node;

use crate::color::{Color, Encoding};
use crate::film::{Sample, Settings, Witness, expose_pixel};
use crate::footprint::Sight;
use crate::prepared::Prepared;
use crate::scene::Scene;
use crate::shade::observer::{Observer, Seen};
use crate::trace::tree::{Child, Node};
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
    let settings = Settings { layers: Vec::new(), ..settings.clone() };
    let mut recorder = Recorder {
        scene: prepared.scene(),
        pixel: (x, y),
        all,
        text: String::new(),
        wanted: false,
        open: Vec::new(),
        branches: Vec::new(),
    };
    let picture = expose_pixel(prepared, &settings, (x, y), &mut recorder);
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
    pixel: (u32, u32),
    all: bool,
    text: String,
    /// True while the current sample is printed.
    wanted: bool,
    /// Role of each open branch in its parent, from the root on; `None` for the root.
    open: Vec<Option<Child>>,
    /// For each open branch, the text of its finished children.
    branches: Vec<String>,
}

impl Witness for Recorder<'_> {
    fn sample(&mut self, sample: &impl Sample) {
        self.wanted = self.all || sample.represents(self.pixel);
        if self.wanted {
            let (weight, whole) = sample.weight(self.pixel);
            let share = if weight == whole { "1".into() } else { format!("{weight}/{whole}") };
            let (name, at) = (sample.name(), sample.position());
            // Writing to a string does not fail.
            let _ = writeln!(
                self.text,
                "sample {name} at {},{} on the film, weight {share}",
                at.x, at.y
            );
            self.open.push(None);
            self.branches.push(String::new());
        }
    }
}

impl Observer for Recorder<'_> {
    fn follow(&mut self, _: &Node, child: Child, _: Color) {
        if self.wanted {
            self.open.push(Some(child));
            self.branches.push(String::new());
        }
    }

    fn leave<S: Sight>(&mut self, seen: &Seen<'_, S>) {
        if !self.wanted {
            return;
        }
        let (Some(role), Some(below)) = (self.open.pop(), self.branches.pop()) else { return };
        let depth = self.open.len();
        let role = match role {
            None => "from the eye",
            Some(Child::Reflected) => "reflected",
            Some(Child::Refracted) => "refracted",
        };
        let margin = " ".repeat(STEP * (depth + 1));
        let mut lines = node::lines(self.scene, seen).into_iter();
        let first = lines.next().unwrap_or_default();
        let mut text = format!("{margin}{depth} {role}: {first}\n");
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
