//! The direction from which a mesh is seen, and the axis that points up.

use clap::ValueEnum;
use glam::DVec3;
use std::str::FromStr;

/// The axis that points up in a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Up {
    /// x
    X,
    /// y, as in scenes and grids
    Y,
    /// z, as in programs for solids and printers
    Z,
    /// Opposite to x
    #[value(name = "-x")]
    NegX,
    /// Opposite to y
    #[value(name = "-y")]
    NegY,
    /// Opposite to z
    #[value(name = "-z")]
    NegZ,
}

impl Up {
    /// Returns the axes of a viewer in front of the mesh: to the right, upwards, and towards the viewer. They are
    /// right-handed.
    #[must_use]
    pub fn axes(self) -> [DVec3; 3] {
        let (right, up) = match self {
            Self::X => (DVec3::NEG_Y, DVec3::X),
            Self::Y => (DVec3::X, DVec3::Y),
            Self::Z => (DVec3::X, DVec3::Z),
            Self::NegX => (DVec3::Y, DVec3::NEG_X),
            Self::NegY => (DVec3::NEG_X, DVec3::NEG_Y),
            Self::NegZ => (DVec3::X, DVec3::NEG_Z),
        };
        [right, up, right.cross(up)]
    }

    /// Returns the direction upwards, of unit length.
    #[must_use]
    pub fn axis(self) -> DVec3 {
        self.axes()[1]
    }
}

/// The direction from a mesh to its camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Angle from the front towards the right, in degrees.
    pub azimuth_deg: f64,
    /// Angle above the horizon, in degrees, -90 to 90.
    pub elevation_deg: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { azimuth_deg: 30.0, elevation_deg: 20.0 }
    }
}

/// The views with names, and their angles in degrees.
const NAMED: [(&str, f64, f64); 6] = [
    ("front", 0.0, 0.0),
    ("right", 90.0, 0.0),
    ("back", 180.0, 0.0),
    ("left", -90.0, 0.0),
    ("top", 0.0, 90.0),
    ("bottom", 0.0, -90.0),
];

impl FromStr for View {
    type Err = String;

    /// Reads a name, or `AZ,EL` in degrees.
    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, azimuth_deg, elevation_deg)) = NAMED.iter().find(|(name, ..)| *name == text)
        {
            return Ok(Self { azimuth_deg: *azimuth_deg, elevation_deg: *elevation_deg });
        }
        let angles = text.split_once(',').and_then(|(azimuth, elevation)| {
            let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
            Some((number(azimuth)?, number(elevation)?))
        });
        match angles {
            Some((azimuth_deg, elevation_deg)) if elevation_deg.abs() <= 90.0 => {
                Ok(Self { azimuth_deg, elevation_deg })
            }
            _ => {
                let names = NAMED.map(|(name, ..)| name).join(", ");
                Err(format!(
                    "expected {names}, or AZ,EL in degrees: from the front towards the right, and -90 to \
                     90 above the horizon"
                ))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axes_of_a_viewer_are_right_handed_and_of_unit_length() {
        for up in Up::value_variants() {
            let [right, above, front] = up.axes();
            assert_eq!(right.cross(above), front);
            assert_eq!(front.cross(right), above);
            assert_eq!(above.length(), 1.0);
        }
        assert_eq!(Up::Y.axes()[2], DVec3::Z);
        assert_eq!(Up::Z.axes()[2], DVec3::NEG_Y);
    }

    #[test]
    fn a_view_is_a_name_or_two_angles() {
        let view = |text: &str| text.parse::<View>();
        assert_eq!(view("left"), view("-90, 0"));
        assert_eq!(view("top"), view("0,90"));
        for bad in ["", "up", "1", "1,2,3", "0,91", "nan,0"] {
            assert!(view(bad).unwrap_err().contains("AZ,EL"), "{bad}");
        }
    }
}
