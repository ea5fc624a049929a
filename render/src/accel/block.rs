//! Triangles of a leaf, as rays read them.

use glam::Vec4;

/// Number of triangles of a block.
pub const LANES: usize = 4;

/// Stands for the number of an absent triangle.
pub const ABSENT: u32 = u32::MAX;

/// Up to four triangles in the frame of their tree.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(32))]
pub struct Block {
    /// Coordinates of the corners: first, second, third; along each axis; of each triangle. The
    /// corners of an absent triangle are NaN.
    pub corners: [[[f32; LANES]; 3]; 3],
    /// Numbers of the triangles in their mesh, or [`ABSENT`].
    pub numbers: [u32; LANES],
}

impl Block {
    /// A block of one to four triangles, each with its corners in the frame.
    #[must_use]
    pub fn new(triangles: &[(u32, [[f32; 3]; 3])]) -> Self {
        let mut block = Self { corners: [[[f32::NAN; LANES]; 3]; 3], numbers: [ABSENT; LANES] };
        for (lane, (number, corners)) in triangles.iter().enumerate() {
            block.numbers[lane] = *number;
            for (corner, place) in corners.iter().enumerate() {
                for (lanes, x) in block.corners[corner].iter_mut().zip(place) {
                    lanes[lane] = *x;
                }
            }
        }
        block
    }

    /// Returns the corners of a triangle in the frame, along each axis: first, second, third, and the
    /// first again.
    #[must_use]
    #[inline(always)]
    pub fn corners(&self, lane: usize) -> [Vec4; 3] {
        let lane = lane & (LANES - 1);
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = &self.corners;
        [
            Vec4::new(ax[lane], bx[lane], cx[lane], ax[lane]),
            Vec4::new(ay[lane], by[lane], cy[lane], ay[lane]),
            Vec4::new(az[lane], bz[lane], cz[lane], az[lane]),
        ]
    }
}
