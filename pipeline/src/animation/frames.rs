//! The frames that a command makes: `7`, `1-240`, `1-9,20,30-39` or `1-240x10`.

use std::str::FromStr;

/// Ranges of frames, each from its first to its last, in steps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frames(Vec<[u32; 3]>);

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = "expected frames from 1 on, such as 7, 1-240 or 1-240x10";
        let number =
            |text: &str| text.parse().ok().filter(|&number: &u32| number > 0).ok_or(expected);
        let mut ranges = Vec::new();
        for part in text.split(',') {
            let (range, step) = match part.split_once('x') {
                Some((range, step)) => (range, number(step)?),
                None => (part, 1),
            };
            let (first, last) = match range.split_once('-') {
                Some((first, last)) => (number(first)?, number(last)?),
                None => (number(range)?, number(range)?),
            };
            if last < first {
                return Err(format!("found {range}, expected the first frame before the last"));
            }
            ranges.push([first, last, step]);
        }
        Ok(Self(ranges))
    }
}

impl Frames {
    /// Returns the frames in ascending order, each once, of an animation with `count` frames.
    ///
    /// # Errors
    /// With a sentence if it has not all of them.
    pub fn of(&self, count: u32) -> Result<Vec<u32>, String> {
        let largest = self.0.iter().map(|[_, last, _]| *last).max().unwrap_or_default();
        if largest > count {
            return Err(format!("found frame {largest}, expected at most {count}, the last frame"));
        }
        let mut frames: Vec<u32> = self
            .0
            .iter()
            .flat_map(|&[first, last, step]| (first..=last).step_by(step as usize))
            .collect();
        frames.sort_unstable();
        frames.dedup();
        Ok(frames)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_numbers_and_ranges() {
        let of = |text: &str| text.parse::<Frames>().and_then(|frames| frames.of(20));
        assert_eq!(of("7"), Ok(vec![7]));
        assert_eq!(of("3-5,1,4-6"), Ok(vec![1, 3, 4, 5, 6]));
        assert_eq!(of("1-20x6"), Ok(vec![1, 7, 13, 19]));
        for text in ["", "0", "0-3", "5-3", "1-", "-3", "a", "1-3x0", "1,,2", "1.5"] {
            assert!(text.parse::<Frames>().is_err(), "{text}");
        }
        assert!(of("19-21").unwrap_err().contains("found frame 21, expected at most 20"));
    }
}
