//! Interference colours of a thin film, such as soap, oil on water or the oxide on steel.
//!
//! Both faces of the film reflect light, and light from the second face has travelled a little
//! further. Airy's formula sums all reflections between the faces, for each wavelength and each
//! polarization. The sum over wavelengths is the colour.

use glam::DVec3;

/// Wavelengths that are summed, in nanometres: first, last and step.
///
/// The thickest film that a scene may have shows fringes 8 nm apart at the blue end, so that each
/// has four steps.
const WAVELENGTHS: (u32, u32, usize) = (380, 780, 2);

/// A film of one transparent material on another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinFilm {
    /// Thickness in nanometres, 0 or more.
    pub thickness_nm: f64,
    /// Index of refraction of the film, positive. The medium in front of the film is air, of index
    /// 1.
    pub index: f64,
    /// Index of refraction of the medium behind the film, positive; 1 for a film in air.
    pub base_index: f64,
}

impl ThinFilm {
    /// Returns the reflectance for unpolarized light of one wavelength, in `[0, 1]`. `c1` is the
    /// cosine of the angle of incidence, [0, 1]. `wavelength` is in nanometres, in air, and
    /// positive.
    #[must_use]
    pub fn reflectance(&self, c1: f64, wavelength: f64) -> f64 {
        let cosine = |index: f64| super::transmitted_cosine(c1, 1.0 / index);
        // Beyond a critical angle all light is reflected.
        let (Some(c2), Some(c3)) = (cosine(self.index), cosine(self.base_index)) else {
            return 1.0;
        };
        let (n2, n3) = (self.index, self.base_index);
        // Phase lag of one more passage through the film and back, in radians.
        let phase = 2.0 * std::f64::consts::TAU * n2 * c2 * self.thickness_nm / wavelength;
        // Amplitude ratios at both faces. Unpolarized light is the average of the two
        // polarizations.
        let perpendicular = airy(ratio(c1, n2 * c2), ratio(n2 * c2, n3 * c3), phase);
        let parallel = airy(ratio(n2 * c1, c2), ratio(n3 * c2, n2 * c3), phase);
        (0.5 * (perpendicular + parallel)).clamp(0.0, 1.0)
    }

    /// Returns the colour of white light that the film reflects, in linear sRGB. A film that
    /// reflects all light gives `[1, 1, 1]`. Values that a screen cannot show are clipped at 0 from
    /// below. `c1` is the cosine of the angle of incidence, [0, 1].
    #[must_use]
    pub fn color(&self, c1: f64) -> DVec3 {
        let (mut sum, mut white) = (DVec3::ZERO, DVec3::ZERO);
        let (from, to, step) = WAVELENGTHS;
        for wavelength in (from..=to).step_by(step).map(f64::from) {
            let seen = linear_srgb(observer(wavelength));
            sum += self.reflectance(c1, wavelength) * seen;
            white += seen;
        }
        (sum / white).max(DVec3::ZERO)
    }
}

/// Returns `(a - b) / (a + b)`, or 1 where both are 0, since grazing light is reflected.
fn ratio(a: f64, b: f64) -> f64 {
    let ratio = (a - b) / (a + b);
    if ratio.is_finite() { ratio } else { 1.0 }
}

/// Returns the reflectance by Airy's sum, from the amplitude ratios of both faces and the phase
/// between them in radians.
fn airy(first: f64, second: f64, phase: f64) -> f64 {
    let both = 2.0 * first * second * phase.cos();
    let (near, far) = (first * first, second * second);
    let share = (near + far + both) / (1.0 + near * far + both);
    // 0/0 where both faces reflect everything.
    if share.is_finite() { share } else { 1.0 }
}

/// Returns the CIE 1931 colour matching functions at a wavelength in nanometres. They are
/// approximated by the lobes of Wyman, Sloan and Shirley, "Simple Analytic Approximations to the
/// CIE XYZ Color Matching Functions" (JCGT 2013), which are within 1 % of the largest value.
fn observer(wavelength: f64) -> DVec3 {
    let lobe = |height: f64, middle: f64, left: f64, right: f64| {
        let width = if wavelength < middle { left } else { right };
        height * (-0.5 * ((wavelength - middle) * width).powi(2)).exp()
    };
    DVec3::new(
        lobe(0.362, 442.0, 0.0624, 0.0374)
            + lobe(1.056, 599.8, 0.0264, 0.0323)
            + lobe(-0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    )
}

/// Converts CIE XYZ to linear sRGB (IEC 61966-2-1).
fn linear_srgb(xyz: DVec3) -> DVec3 {
    DVec3::new(
        DVec3::new(3.2406, -1.5372, -0.4986).dot(xyz),
        DVec3::new(-0.9689, 1.8758, 0.0415).dot(xyz),
        DVec3::new(0.0557, -0.2040, 1.0570).dot(xyz),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::fresnel;
    use proptest::prelude::*;

    proptest! {
        /// A film of no thickness, and a film of the base's own material, do not change the
        /// reflectance.
        #[test]
        fn a_film_of_nothing_leaves_fresnels_share(
            angle in 0.0..1.55, index in 1.0..3.0, base_index in 1.0..3.0, wavelength in 380.0..780.0,
            thickness_nm in 0.0..5000.0,
        ) {
            let c1 = f64::cos(angle);
            let share = fresnel(c1, 1.0 / base_index);
            let none = ThinFilm { thickness_nm: 0.0, index, base_index };
            prop_assert!((none.reflectance(c1, wavelength) - share).abs() < 1e-12);
            let same = ThinFilm { thickness_nm, index: base_index, base_index };
            prop_assert!((same.reflectance(c1, wavelength) - share).abs() < 1e-12);
        }

        #[test]
        fn a_film_reflects_a_share(
            angle in 0.0..=90f64, index in 0.5..3.0, base_index in 0.5..3.0,
            thickness_nm in 0.0..5000.0,
        ) {
            let film = ThinFilm { thickness_nm, index, base_index };
            let c1 = angle.to_radians().cos();
            prop_assert!((0.0..=1.0).contains(&film.reflectance(c1, 550.0)));
            let color = film.color(c1);
            prop_assert!(color.is_finite() && color.min_element() >= 0.0 && color.max_element() < 1.6);
        }
    }

    #[test]
    fn a_quarter_of_a_wave_in_between_takes_the_reflection_away() {
        // The classic coating: its index is sqrt(n) and its thickness a quarter of the wavelength
        // inside it.
        let index = 1.5f64.sqrt();
        let coat = ThinFilm { thickness_nm: 550.0 / (4.0 * index), index, base_index: 1.5 };
        assert!(coat.reflectance(1.0, 550.0) < 1e-12);
        assert!(coat.reflectance(1.0, 400.0) > 1e-3);
        // The reflected rest is purple, since green is removed.
        let rest = coat.color(1.0);
        assert!(rest.y < rest.x && rest.y < rest.z, "{rest}");
    }

    #[test]
    fn the_thinnest_soap_is_black_and_a_thick_one_has_no_color() {
        let soap =
            |thickness_nm| ThinFilm { thickness_nm, index: 1.33, base_index: 1.0 }.color(1.0);
        assert!(soap(5.0).max_element() < 0.002, "{}", soap(5.0));
        let thick = soap(5000.0);
        assert!(thick.max_element() / thick.min_element() < 1.1, "{thick}");
        let colored = soap(450.0);
        assert!(colored.max_element() / colored.min_element() > 2.0, "{colored}");
    }
}
