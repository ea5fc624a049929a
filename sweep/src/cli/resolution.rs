//! The flags that replace the resolution of a spec.

use clap::Args;
use sweep::spec::Resolution;

#[derive(Debug, Args)]
pub struct ResolutionArguments {
    /// Number of cells along the trajectory; replaces the number in the spec
    #[arg(long, value_name = "N")]
    rows: Option<usize>,

    /// Number of cells along the contour; replaces the number in the spec
    #[arg(long, value_name = "N")]
    cols: Option<usize>,

    /// The largest distance between triangles and surface; replaces the spec's resolution
    #[arg(long, value_name = "LENGTH", conflicts_with_all = ["rows", "cols", "pixels"])]
    tol: Option<f64>,

    /// The largest angle between triangles and surface, in degrees
    #[arg(long, value_name = "DEGREES", conflicts_with_all = ["rows", "cols"])]
    angle: Option<f64>,

    /// The largest distance between triangles and surface, in pixels of the spec's camera
    #[arg(long, value_name = "N", conflicts_with_all = ["rows", "cols"])]
    pixels: Option<f64>,

    /// Largest number of cells if a tolerance is given [default: 2000000]
    #[arg(long, value_name = "N", conflicts_with_all = ["rows", "cols"])]
    max_quads: Option<usize>,
}

impl ResolutionArguments {
    /// Returns the keys of `mesh` that replace those of the spec.
    pub fn overrides(&self) -> Resolution {
        Resolution {
            rows: self.rows,
            cols: self.cols,
            tol: self.tol,
            angle_deg: self.angle,
            pixels: self.pixels,
            camera: None,
            max_quads: self.max_quads,
        }
    }
}
