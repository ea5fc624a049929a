//! An alphabet of strokes: capitals as a draughtsman letters them. Each capital consists of
//! straight lines and arcs of one width.
//!
//! A letter stands on the line y = 0 and is 1 high. Its strokes are chains of points. A chain is
//! rounded where `~` stands before a point: that point is then the control point of a quadratic
//! curve.

use glam::DVec2;

/// For each letter its width, with the space after it, and its strokes.
///
/// Points are in twelfths of the letter's height.
const LETTERS: [(char, f64, &str); 37] = [
    ('A', 11.0, "0,0 5,12 10,0|2,4 8,4"),
    ('B', 9.0, "0,0 0,12 4,12 ~8,12 8,9 ~8,6.4 4,6.4 0,6.4|4,6.4 ~9,6.4 9,3.2 ~9,0 4,0 0,0"),
    ('C', 11.0, "9.6,9.6 ~8.2,12 5.4,12 ~0,12 0,6 ~0,0 5.4,0 ~8.2,0 9.6,2.4"),
    ('D', 11.0, "0,0 0,12 4,12 ~10,12 10,6 ~10,0 4,0 0,0"),
    ('E', 8.5, "7.5,12 0,12 0,0 7.5,0|0,6.3 6.2,6.3"),
    ('F', 8.0, "7.2,12 0,12 0,0|0,6.3 6,6.3"),
    ('G', 11.5, "9.6,9.8 ~8.2,12 5.4,12 ~0,12 0,6 ~0,0 5.4,0 ~8.6,0 10,2 10,5.6 6,5.6"),
    ('H', 10.5, "0,0 0,12|9,0 9,12|0,6.3 9,6.3"),
    ('I', 2.6, "0.6,0 0.6,12"),
    ('J', 7.0, "5.4,12 5.4,3.4 ~5.4,0 2.6,0 ~0.4,0 0,2.2"),
    ('K', 9.5, "0,0 0,12|8.4,12 0,4.6|3,7.2 8.8,0"),
    ('L', 8.0, "0,12 0,0 7,0"),
    ('M', 12.5, "0,0 0.8,12 5.8,2.4 10.8,12 11.6,0"),
    ('N', 10.8, "0,0 0,12 9,0 9,12"),
    ('O', 12.5, "5.8,12 ~0,12 0,6 ~0,0 5.8,0 ~11.6,0 11.6,6 ~11.6,12 5.8,12"),
    ('P', 8.8, "0,0 0,12 4,12 ~8.2,12 8.2,8.8 ~8.2,5.6 4,5.6 0,5.6"),
    ('Q', 12.5, "5.8,12 ~0,12 0,6 ~0,0 5.8,0 ~11.6,0 11.6,6 ~11.6,12 5.8,12|7.4,3.4 11.4,-1.2"),
    ('R', 9.4, "0,0 0,12 4,12 ~8,12 8,9 ~8,6 4,6 0,6|4.4,6 8.6,0"),
    (
        'S',
        9.0,
        "7.4,10 ~6.4,12 4.2,12 ~0.6,12 0.6,9 ~0.6,7 4.2,6.3 ~8,5.4 8,3 ~8,0 4.2,0 ~1,0 0,2.4",
    ),
    ('T', 9.4, "0,12 8.8,12|4.4,12 4.4,0"),
    ('U', 10.6, "0,12 0,4.4 ~0,0 4.6,0 ~9.2,0 9.2,4.4 9.2,12"),
    ('V', 10.6, "0,12 5,0 10,12"),
    ('W', 14.5, "0,12 3.6,0 7,10.4 10.4,0 14,12"),
    ('X', 9.8, "0,12 8.8,0|8.8,12 0,0"),
    ('Y', 9.8, "0,12 4.6,6 9.2,12|4.6,6 4.6,0"),
    ('Z', 9.4, "0.4,12 8.4,12 0,0 8.6,0"),
    ('0', 9.4, "4.2,12 ~0,12 0,6 ~0,0 4.2,0 ~8.4,0 8.4,6 ~8.4,12 4.2,12"),
    ('1', 6.0, "0.6,9.6 3.4,12 3.4,0"),
    ('2', 8.6, "0.2,9 ~0.2,12 3.8,12 ~7.4,12 7.4,9 ~7.4,6.6 0,0 7.8,0"),
    ('3', 8.6, "0.6,12 7.2,12 3.4,7.2 ~7.8,7.2 7.8,3.6 ~7.8,0 3.8,0 ~0.6,0 0,2.6"),
    ('4', 9.0, "6,0 6,12 0,3.4 8.2,3.4"),
    ('5', 8.6, "7,12 1.2,12 0.6,6.6 ~2,7.4 3.6,7.4 ~7.8,7.4 7.8,3.7 ~7.8,0 3.6,0 ~0.8,0 0,2.2"),
    ('6', 8.6, "6.4,12 ~0,9 0,3.8 ~0,0 3.9,0 ~7.8,0 7.8,3.7 ~7.8,7.2 3.9,7.2 ~0.6,7.2 0,3.8"),
    ('7', 8.2, "0,12 7.6,12 2.4,0"),
    (
        '8',
        8.8,
        "4,12 ~0.8,12 0.8,9.2 ~0.8,6.6 4,6.4 ~7.2,6.6 7.2,9.2 ~7.2,12 4,12|4,6.4 ~0,6.2 0,3.2 ~0,0 4,0 ~8,0 8,3.2 ~8,6.2 4,6.4",
    ),
    ('9', 8.6, "1.4,0 ~7.8,3 7.8,8.2 ~7.8,12 3.9,12 ~0,12 0,8.3 ~0,4.8 3.9,4.8 ~7.2,4.8 7.8,8.2"),
    ('.', 3.4, "0.6,0 0.6,0.2"),
];
/// The width of a space, in twelfths of the height.
const SPACE: f64 = 6.0;
/// The width between letters, beside their own widths, in twelfths of the height.
const LETTER_SPACE: f64 = 2.6;
/// Number of straight pieces of a curve.
const PIECES: u32 = 8;

/// A line of text as straight strokes. Letters are 1 high. The line starts at x = 0 and stands on y
/// = 0, with y up.
#[derive(Debug, Clone)]
pub struct Line {
    /// The ends of each stroke.
    pub strokes: Vec<[DVec2; 2]>,
    /// The x at which the next letter would begin.
    pub width: f64,
}

/// Returns the strokes of a text. A character that the alphabet lacks becomes a space.
pub fn line(text: &str) -> Line {
    let mut at = 0.0;
    let mut strokes = Vec::new();
    for letter in text.chars() {
        let Some((_, width, chains)) = LETTERS.iter().find(|(name, _, _)| *name == letter) else {
            at += SPACE;
            continue;
        };
        for chain in chains.split('|') {
            let from = DVec2::new(at, 0.0);
            let points = rounded(chain);
            strokes.extend(
                points.windows(2).map(|ends| [ends[0], ends[1]].map(|p| (p + from) / 12.0)),
            );
        }
        at += width + LETTER_SPACE;
    }
    Line { strokes, width: at / 12.0 }
}

/// Returns the points of a chain with its curves cut into pieces.
fn rounded(chain: &str) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = Vec::new();
    let mut control = None;
    for word in chain.split(' ') {
        let (curved, word) = word.strip_prefix('~').map_or((false, word), |word| (true, word));
        let mut numbers = word.split(',').map(|number| number.parse().unwrap_or(0.0));
        let point = DVec2::new(numbers.next().unwrap_or(0.0), numbers.next().unwrap_or(0.0));
        if curved {
            control = Some(point);
            continue;
        }
        if let (Some(control), Some(&from)) = (control.take(), points.last()) {
            points.extend((1..PIECES).map(|k| {
                let t = f64::from(k) / f64::from(PIECES);
                from.lerp(control, t).lerp(control.lerp(point, t), t)
            }));
        }
        points.push(point);
    }
    points
}

/// Returns the distance of a point from a stroke.
pub fn distance(p: DVec2, [from, to]: [DVec2; 2]) -> f64 {
    let along = to - from;
    let t = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (p - from).distance(t * along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_stand_on_the_line_one_behind_the_other() {
        for (letter, width, _) in LETTERS {
            let drawn = line(&letter.to_string());
            let points = drawn.strokes.iter().flatten();
            for p in points {
                assert!(p.y > -0.11 && p.y < 1.001, "{letter}: {p}");
                assert!(p.x > -1e-9 && p.x < width / 12.0 + 0.01, "{letter}: {p}");
            }
            assert!(!drawn.strokes.is_empty());
        }
        let (one, two) = (line("A").width, line("AA").width);
        assert!((two - 2.0 * one).abs() < 1e-12);
    }

    #[test]
    fn a_distance_is_measured_to_the_nearest_point_of_a_stroke() {
        let stroke = [DVec2::ZERO, DVec2::new(2.0, 0.0)];
        assert_eq!(distance(DVec2::new(1.0, 3.0), stroke), 3.0);
        assert_eq!(distance(DVec2::new(5.0, 4.0), stroke), 5.0);
    }
}
