//! Pixels that see a textured floor: near and far, from above and at a slant.

use glam::{DVec2, DVec3};
use render::texture::Texture;

/// Texels across the short side of a pixel's footprint, divided by the anisotropy: thin, middle and
/// far.
pub const SCALES: [f64; 3] = [1.0 / 32.0, 1.0 / 8.0, 1.0 / 2.0];

/// Texels from which the short side of a pixel's footprint is thin, middling and broad.
pub const BREADTHS: [f64; 3] = [0.0, 1.0, 2.0];

/// Degrees between the texture's axes and the view.
pub const ANGLES: [f64; 3] = [0.0, 15.0, 45.0];

/// Anisotropies at which the bins of the error by anisotropy begin.
pub const STRETCHES: [f64; 4] = [1.0, 4.0, 16.0, 40.0];

/// A set of pixels on four textures.
#[derive(Debug, Clone, Copy)]
pub struct Set {
    /// Number of anisotropies from 1 to 64, at equal logarithmic steps.
    pub anisotropies: usize,
    /// Number of positions on the texture for each anisotropy.
    pub places: usize,
    /// Fewest samples of the truth along each side of a pixel.
    pub samples: u32,
    /// True if the truth against the tent is wanted. It takes four times as long; otherwise it is NaN.
    pub tent: bool,
}

/// The set whose times are measured.
pub const SMALL: Set = Set { anisotropies: 32, places: 8, samples: 32, tent: true };

/// The set of 110 592 pixels. Its truth is precise enough for errors of a thousandth.
pub const FULL: Set = Set { anisotropies: 96, places: 32, samples: 96, tent: false };

/// Side of a pixel over the distance of the film: 512 pixels see 60 degrees.
const PITCH: f64 = 0.002_255;

/// A pixel and its footprint on a textured floor.
#[derive(Debug)]
pub struct Pixel {
    /// Index of the texture.
    pub texture: usize,
    /// Index into [`SCALES`].
    pub scale: usize,
    /// Index into [`ANGLES`].
    pub angle: usize,
    /// Length of the footprint by its breadth.
    anisotropy: f64,
    /// Middle of the box around nine hits, in texture coordinates.
    pub center: DVec2,
    /// Half the width and height of this box, in texture coordinates.
    pub half: DVec2,
    /// Tangent of the angle by which the pixel's middle lies below the horizon.
    below: f64,
    /// First axis of the map from the floor to the texture, which rotates and scales.
    turned: DVec2,
    place: DVec2,
}

impl Pixel {
    /// Returns the texture coordinates seen at the position (x, y) in the pixel, which covers
    /// [-1/2, 1/2] along each axis.
    pub fn uv(&self, x: f64, y: f64) -> DVec2 {
        // The eye is one unit above the floor; positions lower on the film are nearer.
        let far = 1.0 / (self.below + PITCH * y);
        self.place + self.turned.rotate(DVec2::new(PITCH * x * far, far))
    }

    /// Returns the index into [`BREADTHS`] of the footprint's short side.
    pub fn breadth(&self, texture: &Texture) -> usize {
        let size = DVec2::new(texture.width as f64, texture.height as f64);
        let span = |a: DVec2, b: DVec2| ((a - b) * size).length();
        let across = span(self.uv(-0.5, 0.0), self.uv(0.5, 0.0));
        let short = across.min(span(self.uv(0.0, -0.5), self.uv(0.0, 0.5)));
        BREADTHS.iter().filter(|&&from| short >= from).count() - 1
    }

    /// Returns the index into [`STRETCHES`] of the footprint's anisotropy.
    pub fn stretch(&self) -> usize {
        STRETCHES.iter().filter(|&&from| self.anisotropy >= from).count() - 1
    }

    /// Returns the texture coordinates of the corners of a part of the pixel. The part covers the
    /// positions from `low` to `high` in the pixel.
    pub fn corners(&self, low: DVec2, high: DVec2) -> [DVec2; 4] {
        [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)]
            .map(|(x, y)| self.uv(x, y))
    }

    /// Returns the two derivatives of the texture coordinates in the middle of the pixel, across and
    /// down.
    pub fn sides(&self) -> [DVec2; 2] {
        let far = 1.0 / self.below;
        let turn = |x: f64, y: f64| self.turned.rotate(PITCH * DVec2::new(x, y));
        [turn(far, 0.0), turn(0.0, -far * far)]
    }

    /// Returns the mean of n x n bilinear samples, evenly spread over the pixel.
    pub fn samples(&self, texture: &Texture, n: u32) -> DVec3 {
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
        let mut sum = DVec3::ZERO;
        for j in 0..n {
            for i in 0..n {
                sum += texture.bilinear(self.uv(at(i), at(j)));
            }
        }
        sum / f64::from(n * n)
    }

    /// Returns the averages of the bilinear texture under the pixel's box, and under the tent of
    /// twice its width. They are computed by brute force: samples are jittered in cells of at most
    /// a quarter of a texel.
    pub fn truth(&self, texture: &Texture, set: Set) -> [DVec3; 2] {
        self.brute_force(texture, set, 1)
    }

    fn brute_force(&self, texture: &Texture, set: Set, seed: u64) -> [DVec3; 2] {
        let size = DVec2::new(texture.width as f64, texture.height as f64);
        let span = |a: DVec2, b: DVec2| ((a - b) * size).length();
        // The number is even, so that the box ends between cells.
        let cells = |texels: f64| 2 * ((2.0 * texels).ceil() as u32).max(set.samples / 2);
        let across = cells(span(self.uv(-0.5, -0.5), self.uv(0.5, -0.5)));
        // The upper half of the tent's support is the longer one; cells below it are smaller still.
        let down = cells(span(self.uv(0.0, -0.5), self.uv(0.0, 0.5)));
        let (mut sums, mut weights) = ([DVec3::ZERO; 2], [0.0; 2]);
        let mut state = seed;
        let mut jitter = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let range = |cells: u32| if set.tent { 0..2 * cells } else { cells / 2..cells / 2 * 3 };
        for j in range(down) {
            let y = (f64::from(j) + jitter()) / f64::from(down) - 1.0;
            for i in range(across) {
                let x = (f64::from(i) + jitter()) / f64::from(across) - 1.0;
                let color = texture.bilinear(self.uv(x, y));
                let inside = x.abs().max(y.abs()) <= 0.5;
                let both = [f64::from(u8::from(inside)), (1.0 - x.abs()) * (1.0 - y.abs())];
                for k in 0..2 {
                    sums[k] += both[k] * color;
                    weights[k] += both[k];
                }
            }
        }
        let tent = if set.tent { sums[1] / weights[1] } else { DVec3::NAN };
        [sums[0] / weights[0], tent]
    }
}

/// Returns the root mean square error of the truth against the box. It is found from the difference
/// between two independent truths of every 37th pixel.
pub fn noise(
    pixels: &[Pixel],
    textures: &[(&str, Texture)],
    truths: &[[DVec3; 2]],
    set: Set,
) -> f64 {
    let some = || pixels.iter().zip(truths).step_by(37);
    let squares: f64 = some()
        .map(|(pixel, truth)| {
            let again = pixel.brute_force(&textures[pixel.texture].1, set, 2);
            (again[0].x - truth[0].x).powi(2)
        })
        .sum();
    // Each of the two truths contributes half of the mean square.
    (0.5 * squares / some().count() as f64).sqrt()
}

/// Returns all pixels of a set, texture by texture.
pub fn pixels(textures: usize, set: Set) -> Vec<Pixel> {
    let mut pixels = Vec::new();
    let mut state = 1u64;
    let mut random = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for texture in 0..textures {
        for (scale, texels) in SCALES.iter().enumerate() {
            for (angle, degrees) in ANGLES.iter().enumerate() {
                for step in 0..set.anisotropies {
                    // The range ends half a step from the anisotropies 64 and 1, since the tangent
                    // is infinite straight down.
                    let a = 64f64.powf((step as f64 + 0.5) / set.anisotropies as f64);
                    let below = 1.0 / (a * a - 1.0).sqrt();
                    for _ in 0..set.places {
                        let place = DVec2::new(random(), random());
                        pixels.push(pixel(
                            texture,
                            scale,
                            angle,
                            below,
                            [a, a * texels],
                            *degrees,
                            place,
                        ));
                    }
                }
            }
        }
    }
    pixels
}

fn pixel(
    texture: usize,
    scale: usize,
    angle: usize,
    below: f64,
    [anisotropy, short]: [f64; 2],
    degrees: f64,
    place: DVec2,
) -> Pixel {
    // On the floor straight ahead, the short side is the pixel's side times the distance.
    let width = PITCH / below;
    // Texture coordinates per unit of floor; textures are square, and their sizes enter below.
    let side = super::textures::SIDES[texture] as f64;
    let turned = DVec2::from_angle(degrees.to_radians()) * (short / width / side);
    let mut pixel = Pixel {
        texture,
        scale,
        angle,
        anisotropy,
        center: DVec2::ZERO,
        half: DVec2::ZERO,
        below,
        turned,
        place: DVec2::ZERO,
    };
    pixel.place = place - pixel.uv(0.0, 0.0);
    let places = [-1.0, 0.0, 1.0];
    let hits = places.map(|y| places.map(|x| pixel.uv(x, y)));
    let (mut low, mut high) = (hits[1][1], hits[1][1]);
    for hit in hits.into_iter().flatten() {
        low = low.min(hit);
        high = high.max(hit);
    }
    pixel.center = 0.5 * (low + high);
    pixel.half = 0.5 * (high - low);
    pixel
}
