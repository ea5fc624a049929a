//! The highlight of a surface whose normal varies within a footprint.

/// A highlight in Phong's model: its strength, and the exponent of the cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lobe {
    /// Phong's exponent, 0 or more.
    pub exponent: f64,
    /// Factor of the highlight, in `[0, 1]`.
    pub strength: f64,
}

impl Lobe {
    /// Returns the mean of highlights with this exponent over normals of this variance along each
    /// tangent (M. Toksvig, "Mipmapping Normal Maps", 2005). Without a variance it is the highlight
    /// itself, to the last bit.
    ///
    /// Near its middle `cos^s` is a normal distribution of variance `1/s`. A tilt of the normal in the
    /// plane of incidence turns the mirrored ray by twice the tilt, and a tilt across this plane by
    /// `2 cosine`, where `cosine` is that of the angle of incidence. The lobe has the mean of both
    /// variances, since Phong's lobes are round. Light is neither added nor lost: a highlight that
    /// becomes wider becomes weaker by the same factor.
    #[must_use]
    pub fn over(shininess: f64, variance: f64, cosine: f64) -> Self {
        if variance == 0.0 {
            return Self { exponent: shininess, strength: 1.0 };
        }
        let exponent = 1.0 / (1.0 / shininess + 2.0 * (1.0 + cosine * cosine) * variance);
        Self { exponent, strength: exponent / shininess }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of highlights over tilted mirrors that are seen straight on, by quadrature over a normal distribution of tilts
    /// in two directions.
    #[test]
    fn the_lobe_is_the_mean_over_tilted_mirrors() {
        let (shininess, deviation) = (200.0, 0.03);
        let Lobe { exponent, strength } = Lobe::over(shininess, deviation * deviation, 1.0);
        for angle in [0.0, 0.05, 0.1, 0.2f64] {
            let (mut sum, mut weights) = (0.0, 0.0);
            for i in -40..=40 {
                for j in -40..=40 {
                    let [x, y] = [i, j].map(|k| f64::from(k) * 0.1);
                    let weight = f64::exp(-0.5 * (x * x + y * y));
                    let off = f64::hypot(angle - 2.0 * deviation * x, 2.0 * deviation * y);
                    sum += weight * off.cos().powf(shininess);
                    weights += weight;
                }
            }
            let found = strength * angle.cos().powf(exponent);
            // The powers of cosines differ from normal distributions by a few hundredths here.
            assert!((found - sum / weights).abs() < 0.01, "{angle}: {found} {}", sum / weights);
        }
        assert_eq!(Lobe::over(50.0, f64::INFINITY, 0.5), Lobe { exponent: 0.0, strength: 0.0 });
    }
}
