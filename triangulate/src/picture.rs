//! Converts surface parameters of the grid to picture coordinates.

use sweep::grid::{Across, UvLayout};

/// Returns the picture coordinates `[s, t]` of the surface parameters `u` and `v`, both in [0, 1],
/// rounded to f32.
///
/// Coordinates are not wrapped. With two repeats they run from 0 to 2, so that a triangle over the end
/// of a repeat is not torn.
pub fn coordinates(layout: &UvLayout, u: f64, v: f64) -> [f32; 2] {
    let [s, t] = match layout.across {
        Across::Contour => [u, v],
        Across::Trajectory => [1.0 - v, u],
    };
    // Adding zero makes -0 into +0.
    [(s * layout.repeat[0]) as f32 + 0.0, (t * layout.repeat[1]) as f32 + 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn across_the_trajectory_the_picture_is_turned_and_not_mirrored() {
        let layout =
            UvLayout { across: Across::Trajectory, repeat: [3.0, 2.0], ..UvLayout::default() };
        assert_eq!(coordinates(&layout, 0.0, 0.0), [3.0, 0.0]);
        assert_eq!(coordinates(&layout, 1.0, 1.0), [0.0, 2.0]);
        // Turned counter-clockwise: u x v and s x t have the same sign.
        let origin = coordinates(&layout, 0.5, 0.5);
        let along_u = coordinates(&layout, 0.6, 0.5);
        let along_v = coordinates(&layout, 0.5, 0.6);
        let of_u = [along_u[0] - origin[0], along_u[1] - origin[1]];
        let of_v = [along_v[0] - origin[0], along_v[1] - origin[1]];
        assert!(of_u[0] * of_v[1] - of_u[1] * of_v[0] > 0.0);
    }
}
