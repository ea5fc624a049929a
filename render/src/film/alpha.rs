//! The coverage of a picture's pixels, as its channel `A`.
//!
//! A pixel is covered by the part of its area, and of the light of each area, that is not open to the
//! background. The colours of such a picture are multiplied by the coverage: they are the light of the
//! scene before a black background.

use super::Picture;
use super::picture::Channel;

/// Name of the channel in a picture and in EXR files.
pub const NAME: &str = "A";

/// Adds the coverage to a picture. `open` is a picture of the same size with the part of the background
/// that shows in each pixel, [0, 1] per channel ([`crate::shade::View::Coverage`]). Coverage has one
/// value for all channels, so that the mean of coloured glass counts.
pub fn add(picture: &mut Picture, open: &Picture) {
    let covered = |[red, green, blue]: &[f32; 3]| {
        let open = (f64::from(*red) + f64::from(*green) + f64::from(*blue)) / 3.0;
        (1.0 - open).clamp(0.0, 1.0) as f32
    };
    let values = open.pixels.iter().map(covered).collect();
    picture.channels.push(Channel { name: NAME, values });
}

/// Returns the coverage of the pixels of a picture, if the picture has one.
#[must_use]
pub fn coverage(picture: &Picture) -> Option<&[f32]> {
    let channel = picture.channels.iter().find(|channel| channel.name == NAME);
    channel.map(|channel| channel.values.as_slice())
}

/// Returns the straight colour of a pixel, linear RGB, from the colour that is multiplied by `coverage`.
#[must_use]
pub fn straight(color: [f32; 3], coverage: Option<f32>) -> [f32; 3] {
    match coverage {
        None => color,
        Some(coverage) if coverage > 0.0 => color.map(|light| light / coverage),
        Some(_) => [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_is_what_the_background_leaves() {
        let mut picture = Picture::black(3, 1);
        let mut open = picture.clone();
        open.pixels = vec![[0.0; 3], [0.5, 0.25, 0.0], [1.0; 3]];
        add(&mut picture, &open);
        assert_eq!(coverage(&picture), Some(&[1.0, 0.75, 0.0][..]));
        assert_eq!(straight([0.25, 0.5, 0.0], Some(0.5)), [0.5, 1.0, 0.0]);
        assert_eq!(straight([0.25; 3], Some(0.0)), [0.0; 3]);
    }
}
