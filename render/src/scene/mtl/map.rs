//! A picture that a material library names, with its options.

use crate::scene::text::words;
use crate::texture::Wrap;
use glam::DVec2;

/// The picture of a `map_` statement.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Path of the picture, as in the file, but with `/` between folders.
    pub path: String,
    /// Factors of the texture coordinates, from `-s`.
    pub scale: DVec2,
    /// Offset that is added to them afterwards, from `-o`.
    pub offset: DVec2,
    /// Continuation of the picture: `Repeat`, or `Clamp` by `-clamp on`.
    pub wrap: Wrap,
    /// Strength of a relief, from `-bm`.
    pub strength: f64,
}

impl Map {
    /// Returns a picture that lies once on the unit square.
    #[must_use]
    pub fn of(path: String, wrap: Wrap) -> Self {
        Self { path, scale: DVec2::ONE, offset: DVec2::ZERO, wrap, strength: 1.0 }
    }

    /// Reads the options and the path of a statement. Options without a meaning here are passed over.
    /// Returns `None` if there is no path.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let mut map = Self::of(String::new(), Wrap::Repeat);
        let rest = map.options(text.trim(), true);
        // Some programs write options behind the path.
        let starts = rest.match_indices(char::is_whitespace).map(|(at, _)| at);
        let path = starts
            .filter(|&at| option(rest[at..].trim_start()).is_some())
            .find(|&at| map.clone().options(rest[at..].trim_start(), false).is_empty())
            .map_or(rest, |at| {
                map.options(rest[at..].trim_start(), false);
                rest[..at].trim_end()
            });
        let path = path.strip_prefix('"').and_then(|path| path.strip_suffix('"')).unwrap_or(path);
        map.path = path.replace('\\', "/");
        (!map.path.is_empty()).then_some(map)
    }

    /// Reads the options with which a text begins. Returns the rest of the text, which is a path if the options
    /// stand before one.
    fn options<'t>(&mut self, text: &'t str, before_path: bool) -> &'t str {
        let mut rest = text;
        while let Some((option, after)) = option(rest) {
            rest = match option {
                "-s" | "-o" | "-t" => {
                    let (numbers, after) = numbers(after, before_path);
                    let vector = |other: f64| {
                        DVec2::new(
                            *numbers.first().unwrap_or(&other),
                            *numbers.get(1).unwrap_or(&other),
                        )
                    };
                    match option {
                        "-s" => self.scale = vector(1.0),
                        "-o" => self.offset = vector(0.0),
                        _ => {}
                    }
                    after
                }
                "-mm" => numbers(after, before_path).1,
                "-clamp" => {
                    let (value, after) = word(after);
                    self.wrap = if value == "on" { Wrap::Clamp } else { Wrap::Repeat };
                    after
                }
                "-bm" => {
                    let (value, after) = word(after);
                    let value = value.parse().ok().filter(|x: &f64| (-1e6..=1e6).contains(x));
                    self.strength = value.unwrap_or(self.strength);
                    after
                }
                // All others have one value.
                _ => word(after).1,
            };
        }
        rest
    }

    /// Returns texture coordinates of a corner as the picture is to be read there.
    #[must_use]
    pub fn moved(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let at = self.scale * DVec2::new(f64::from(u), f64::from(v)) + self.offset;
        at.as_vec2().into()
    }

    /// Returns whether texture coordinates stay as they are.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.scale == DVec2::ONE && self.offset == DVec2::ZERO
    }
}

/// Splits an option from the text behind it.
fn option(text: &str) -> Option<(&str, &str)> {
    const OPTIONS: [&str; 13] = [
        "-s", "-o", "-t", "-mm", "-clamp", "-blendu", "-blendv", "-boost", "-texres", "-cc", "-bm",
        "-imfchan", "-type",
    ];
    let (first, rest) = word(text);
    OPTIONS.contains(&first).then_some((first, rest))
}

/// Splits the first word from the text behind it.
fn word(text: &str) -> (&str, &str) {
    let (first, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (first, rest.trim_start())
}

/// Splits up to three numbers from the text behind them. Before the path, the last word is a path and never a
/// number.
fn numbers(mut text: &str, before_path: bool) -> (Vec<f64>, &str) {
    let mut found = Vec::new();
    while found.len() < 3 {
        let (first, rest) = word(text);
        let Some(number) = first.parse().ok().filter(|x: &f64| x.is_finite()) else { break };
        if before_path && words(rest).next().is_none() {
            break;
        }
        found.push(number);
        text = rest;
    }
    (found, text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_before_the_path() {
        for (text, path, scale, offset, wrap) in [
            ("a.png", "a.png", [1.0, 1.0], [0.0, 0.0], Wrap::Repeat),
            (
                "-s 3 2 1 -o 0.25 0 0 two halves.png",
                "two halves.png",
                [3.0, 2.0],
                [0.25, 0.0],
                Wrap::Repeat,
            ),
            ("-s 3 a.png", "a.png", [3.0, 1.0], [0.0, 0.0], Wrap::Repeat),
            (
                "-clamp on -bm 0.5 -mm 0 1 c:\\a\\b.png",
                "c:/a/b.png",
                [1.0, 1.0],
                [0.0, 0.0],
                Wrap::Clamp,
            ),
            ("-clamp off -s 2 2 2 7", "7", [2.0, 2.0], [0.0, 0.0], Wrap::Repeat),
            ("-o 1 2 3", "3", [1.0, 1.0], [1.0, 2.0], Wrap::Repeat),
            ("\"a b.png\"", "a b.png", [1.0, 1.0], [0.0, 0.0], Wrap::Repeat),
            ("a b.png -bm 0.5 -s 2 3 1", "a b.png", [2.0, 3.0], [0.0, 0.0], Wrap::Repeat),
            ("a -s b.png", "a -s b.png", [1.0, 1.0], [0.0, 0.0], Wrap::Repeat),
            ("-x.png", "-x.png", [1.0, 1.0], [0.0, 0.0], Wrap::Repeat),
        ] {
            let found = Map::read(text);
            let (scale, offset) = (scale.into(), offset.into());
            let strength = if text.contains("-bm") { 0.5 } else { 1.0 };
            let truth = Map { scale, offset, strength, ..Map::of(path.into(), wrap) };
            assert_eq!(found, Some(truth), "{text}");
        }
        assert_eq!(Map::read("  "), None);
        assert_eq!(Map::read("-s 1 1 1").map(|map| map.path).as_deref(), Some("1"));
    }

    #[test]
    fn coordinates_are_scaled_and_then_moved() {
        let map = Map::read("-s 3 2 -o 0.25 -1 a.png").unwrap();
        assert_eq!(map.moved([0.5, 0.25]), [1.75, -0.5]);
        assert!(!map.is_plain() && Map::read("a.png").unwrap().is_plain());
    }
}
