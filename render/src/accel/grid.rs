//! The thesis's uniform grids (5.2, fig. 5.1 and 5.2). Each object has an axis-parallel box, which
//! is cut into equal voxels. Each voxel has a list of its pieces, and rays step from voxel to voxel
//! by 3DDDA.
//!
//! Amanatides, Woo: *A Fast Voxel Traversal Algorithm for Ray Tracing*, Eurographics 1987. A step
//! takes comparisons and one addition.
//!
//! **Each piece once.** A piece is listed in every voxel that its box meets, and a ray would try it
//! in each. Mailboxes would need memory for each ray; one bit suffices here. The voxels of a piece
//! form a box of voxels, and a ray that has left this box on an axis never returns to it. A ray
//! steps along an axis into a voxel. It has met the piece before, unless the piece's voxels begin
//! with this voxel on this axis and in this direction. Each entry of a list stores this in six
//! bits.
//!
//! **Nothing missed.** The hit function guarantees that a piece's hit lies where the ray crosses
//! its widened box. At that distance the walk's voxel differs from the ray's position only by
//! roundings: those of the planes, and those accumulated by the additions. The margin of the listed
//! boxes exceeds all of them together, for any ray that starts within [`Grid::reach`]. A ray from
//! farther away tries every piece.
//!
//! **Not too early.** A hit found in a voxel may lie in a later one, and an equal hit of an earlier
//! piece may be listed only there. The walk therefore continues until a voxel begins beyond the
//! nearest hit.

use super::slabs::SlabRay;
use glam::DVec3;

/// Voxels for each piece of an object.
///
/// The thesis asks for about one or two triangles in a voxel. A surface leaves most voxels empty,
/// so the others hold more. If larger, rays step through more empty voxels and triangles are listed
/// in more of them. If smaller, more triangles are tried. docs/acceleration.md has figures.
const DENSITY: f64 = 2.0;

/// Largest number of list entries per piece, averaged over an object. An object of long thin pieces
/// that would need more gets larger voxels.
const MOST_ENTRIES: usize = 64;

/// Margin of the listed boxes on each side, as a fraction of a voxel.
///
/// If larger, pieces are listed in voxels that they do not meet. If smaller, rays must start
/// nearer.
const SLACK: f64 = 1.0 / 1024.0;

/// The bit of the voxel in which a ray starts: no piece was met before.
const START: u8 = 1 << 6;

/// The grids of all objects.
#[derive(Debug)]
pub struct Grids {
    grids: Vec<Grid>,
}

/// One object's grid.
#[derive(Debug)]
pub struct Grid {
    bounds: [DVec3; 2],
    cut: Cut,
    /// Range of the object's pieces in the scene's numbering.
    pieces: std::ops::Range<u32>,
    /// Start of each voxel's list in `listed`, x fastest, and the end of the last list.
    starts: Vec<u32>,
    /// Pieces of all lists, one list after another.
    listed: Vec<u32>,
    /// For each entry the sides of the piece's box of voxels on which this voxel lies, as bits:
    /// those of [`side`], and always [`START`].
    sides: Vec<u8>,
    /// Largest [`SlabRay::scale`] of a ray that walks the grid; other rays try every piece.
    reach: f64,
    /// Number of boxes examined to build the grid; a box counts once for each voxel that lists it.
    looks: u64,
}

/// The division of a box into voxels.
#[derive(Debug, Clone, Copy)]
struct Cut {
    low: DVec3,
    /// Sides of a voxel, in scene units; not used on an axis that is not cut.
    voxel: DVec3,
    /// Voxels along each axis, at least 1.
    count: [u32; 3],
}

/// Returns the bit of the side through which rays enter a box of voxels: rays that go up or down an
/// axis.
const fn side(axis: usize, up: bool) -> u8 {
    1 << (2 * axis + up as usize)
}

impl Grids {
    /// Builds grids over boxes, given as lower and upper corners; `objects` are ranges of the
    /// boxes.
    #[must_use]
    pub fn build(boxes: &[[DVec3; 2]], objects: &[std::ops::Range<u32>]) -> Self {
        let grids =
            objects.iter().map(|object| Grid::build(boxes, object.clone(), DENSITY)).collect();
        Self { grids }
    }

    /// Memory of all grids, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let lists =
            |grid: &Grid| size_of_val(&*grid.starts) + 4 * grid.listed.len() + grid.sides.len();
        size_of_val(&*self.grids) + self.grids.iter().map(lists).sum::<usize>()
    }

    /// Returns the number of voxels, the number of those that list a box, and the number of entries of
    /// all lists.
    #[must_use]
    pub fn cells(&self) -> [u64; 3] {
        self.grids.iter().fold([0; 3], |all, grid| {
            let lists = grid.starts.windows(2);
            let filled = lists.filter(|ends| ends[0] < ends[1]).count();
            [
                all[0] + grid.cut.all() as u64,
                all[1] + filled as u64,
                all[2] + grid.listed.len() as u64,
            ]
        })
    }

    /// Number of boxes examined to build the grids; a box counts each time it is examined.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.grids.iter().map(|grid| grid.looks).sum()
    }

    /// Calls `visit` once with every box that the ray may meet within `t_max`, the nearer ones of
    /// an object first. `visit` takes the current `t_max` and returns the next one.
    pub fn walk(&self, ray: &SlabRay, mut t_max: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        for grid in &self.grids {
            t_max = grid.walk(ray, t_max, &mut visit);
        }
    }
}

impl Grid {
    fn build(boxes: &[[DVec3; 2]], pieces: std::ops::Range<u32>, density: f64) -> Self {
        let own = &boxes[pieces.start as usize..pieces.end as usize];
        let bounds = own.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |all, piece| {
            [all[0].min(piece[0]), all[1].max(piece[1])]
        });
        let most = own.len().saturating_mul(MOST_ENTRIES).min(u32::MAX as usize);
        let mut wanted = density * own.len() as f64;
        let mut looks = 0;
        let cut = loop {
            let cut = Cut::new(bounds, wanted);
            looks += own.len() as u64;
            let entries = own.iter().fold(0usize, |sum, piece| {
                sum.saturating_add(
                    cut.voxels(piece).iter().map(|[a, b]| (b - a + 1) as usize).product(),
                )
            });
            if entries <= most || cut.count == [1; 3] {
                break cut;
            }
            wanted /= 8.0;
        };

        // A counting sort puts the pieces into voxels, in the pieces' order.
        let mut starts = vec![0u32; cut.all() + 1];
        for piece in own {
            cut.each(&cut.voxels(piece), |voxel, _| starts[voxel + 1] += 1);
        }
        for voxel in 1..starts.len() {
            starts[voxel] += starts[voxel - 1];
        }
        let entries = *starts.last().unwrap_or(&0) as usize;
        let (mut listed, mut sides) = (vec![0; entries], vec![0; entries]);
        let mut next = starts.clone();
        for (piece, number) in own.iter().zip(pieces.clone()) {
            cut.each(&cut.voxels(piece), |voxel, on_sides| {
                let entry = next[voxel] as usize;
                (listed[entry], sides[entry]) = (number, on_sides);
                next[voxel] += 1;
            });
        }
        looks += 2 * entries as u64;
        Self { bounds, cut, pieces, starts, listed, sides, reach: cut.reach(), looks }
    }

    fn walk(&self, ray: &SlabRay, mut t_max: f64, visit: &mut impl FnMut(u32, f64) -> f64) -> f64 {
        let Some([enter, leave]) = ray.crosses(self.bounds).filter(|[enter, _]| *enter <= t_max)
        else {
            return t_max;
        };
        if ray.scale > self.reach {
            return self.pieces.clone().fold(t_max, |t_max, piece| visit(piece, t_max));
        }

        let Cut { low, voxel, count } = self.cut;
        let strides = [1, count[0] as usize, count[0] as usize * count[1] as usize];
        let mut at = 0;
        // Along each axis: the number of planes ahead, the distance to the next one, and the
        // distance between two. Beyond the last plane a voxel has no end, so that nothing is lost
        // at the faces of the box. The walk ends where the ray leaves the widened box.
        let mut ahead = [0u32; 3];
        let mut next = [f64::INFINITY; 3];
        let mut delta = [0.0; 3];
        let up = [0, 1, 2].map(|axis| ray.direction[axis] > 0.0);
        for axis in 0..3 {
            let last = count[axis] - 1;
            if last == 0 {
                continue;
            }
            let place = ray.origin[axis] + enter * ray.direction[axis] - low[axis];
            let index = ((place / voxel[axis]) as u32).min(last);
            at += index as usize * strides[axis];
            if ray.direction[axis].abs() <= SlabRay::ZERO {
                continue;
            }
            ahead[axis] = if up[axis] { last - index } else { index };
            if ahead[axis] > 0 {
                let plane = low[axis] + f64::from(index + u32::from(up[axis])) * voxel[axis];
                next[axis] = (plane - ray.origin[axis]) * ray.inverse[axis];
                delta[axis] = voxel[axis] * ray.inverse[axis].abs();
            }
        }

        let mut arrived = START;
        loop {
            let list = self.starts[at] as usize..self.starts[at + 1] as usize;
            for (&piece, sides) in self.listed[list.clone()].iter().zip(&self.sides[list]) {
                if sides & arrived != 0 {
                    t_max = visit(piece, t_max);
                }
            }
            let axis = if next[0] < next[1] {
                if next[0] < next[2] { 0 } else { 2 }
            } else if next[1] < next[2] {
                1
            } else {
                2
            };
            if next[axis] > leave.min(t_max) {
                return t_max;
            }
            at = if up[axis] { at + strides[axis] } else { at - strides[axis] };
            arrived = side(axis, up[axis]);
            ahead[axis] -= 1;
            next[axis] = if ahead[axis] > 0 { next[axis] + delta[axis] } else { f64::INFINITY };
        }
    }
}

impl Cut {
    /// Cuts the box into about `wanted` voxels, which are as close to cubes as possible. An axis
    /// along which the box is shorter than a voxel is not cut.
    fn new([low, high]: [DVec3; 2], wanted: f64) -> Self {
        let size = high - low;
        let mut cut = [0, 1, 2].map(|axis| size[axis] > 0.0);
        let mut edge = 0.0;
        // At most three rounds: each but the last removes an axis.
        loop {
            let axes = || (0..3).filter(|&axis| cut[axis]);
            if axes().count() == 0 {
                break;
            }
            let volume: f64 = axes().map(|axis| size[axis]).product();
            edge = (volume / wanted).powf(1.0 / axes().count() as f64);
            let short = axes().find(|&axis| size[axis] < edge);
            match short {
                Some(axis) => cut[axis] = false,
                None => break,
            }
        }
        let count = [0, 1, 2]
            .map(|axis| if cut[axis] { ((size[axis] / edge).round() as u32).max(1) } else { 1 });
        let voxel =
            size / DVec3::new(f64::from(count[0]), f64::from(count[1]), f64::from(count[2]));
        Self { low, voxel, count }
    }

    /// Number of voxels.
    fn all(&self) -> usize {
        self.count.iter().map(|&count| count as usize).product()
    }

    /// Returns the first and the last voxel along each axis that a box may meet.
    fn voxels(&self, [low, high]: &[DVec3; 2]) -> [[u32; 2]; 3] {
        [0, 1, 2].map(|axis| {
            let last = self.count[axis] - 1;
            if last == 0 {
                return [0, 0];
            }
            let place = |x: f64| (x - self.low[axis]) / self.voxel[axis];
            // The conversion turns negative values into 0.
            let [first, end] = [place(low[axis]) - SLACK, place(high[axis]) + SLACK];
            [(first as u32).min(last), (end as u32).min(last)]
        })
    }

    /// Calls `each` with the number of every voxel in a box of voxels, and the sides on which it
    /// lies.
    fn each(&self, [x, y, z]: &[[u32; 2]; 3], mut each: impl FnMut(usize, u8)) {
        let sides = |axis: usize, at: u32, [first, last]: [u32; 2]| {
            let upward = if at == first { side(axis, true) } else { 0 };
            let downward = if at == last { side(axis, false) } else { 0 };
            upward | downward
        };
        for k in z[0]..=z[1] {
            for j in y[0]..=y[1] {
                let row =
                    (k as usize * self.count[1] as usize + j as usize) * self.count[0] as usize;
                let on_row = START | sides(1, j, *y) | sides(2, k, *z);
                for i in x[0]..=x[1] {
                    each(row + i as usize, on_row | sides(0, i, *x));
                }
            }
        }
    }

    /// Returns the largest [`SlabRay::scale`] for which the margin exceeds the sum of all
    /// roundings.
    ///
    /// The roundings are parts of the scale. In units of `f64::EPSILON` they are 16 for the widening,
    /// 3 for the crossing of a box, 5 for the first plane and 4 for the point of entry. They are 4
    /// for the distance between planes, 4 for the voxels of a box, and 1/2 for each addition.
    fn reach(&self) -> f64 {
        let cut = (0..3).filter(|&axis| self.count[axis] > 1);
        let most = f64::from(self.count.into_iter().max().unwrap_or(1));
        let slack = cut.map(|axis| SLACK * self.voxel[axis]).fold(f64::INFINITY, f64::min);
        slack / ((64.0 + most) * f64::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(size: [f64; 3], wanted: f64) -> [u32; 3] {
        let low = DVec3::new(5.0, -3.0, 0.1);
        Cut::new([low, low + DVec3::from(size)], wanted).count
    }

    #[test]
    fn voxels_are_nearly_cubes_and_flat_boxes_are_not_cut_across() {
        assert_eq!(cut([1.0, 1.0, 1.0], 1000.0), [10, 10, 10]);
        assert_eq!(cut([4.0, 2.0, 1.0], 512.0), [16, 8, 4]);
        assert_eq!(cut([1.0, 0.0, 1.0], 100.0), [10, 1, 10]);
        assert_eq!(cut([1.0, 1e-30, 1.0], 100.0), [10, 1, 10]);
        assert_eq!(cut([0.0, 3.0, 0.0], 7.0), [1, 7, 1]);
        assert_eq!(cut([0.0; 3], 50.0), [1, 1, 1]);
        assert_eq!(cut([3.0, 1.0, 2.0], 1.0), [1, 1, 1]);
    }

    /// Long diagonal pieces would be listed in every voxel.
    #[test]
    fn lists_stay_short_when_every_piece_is_as_large_as_the_object() {
        let boxes = vec![[DVec3::ZERO, DVec3::ONE]; 5000];
        let grid = Grid::build(&boxes, 0..5000, DENSITY);
        assert!(grid.listed.len() <= MOST_ENTRIES * 5000);
        assert!(grid.starts.len() > 10, "it is still cut");
    }

    /// A ray passes a row of voxels and gets one piece from each, in order. From beyond the grid's
    /// reach it gets all pieces at once.
    #[test]
    fn the_walk_goes_from_voxel_to_voxel() {
        let at = |k: u32| DVec3::new(f64::from(k) + 0.5, 0.5, 0.5);
        let boxes: Vec<_> = (0..10).map(|k| [at(k) - 0.4, at(k) + 0.4]).collect();
        let grid = Grid::build(&boxes, 0..10, 1.0);
        assert_eq!(grid.cut.count, [10, 1, 1]);
        let given = |origin: DVec3, direction: DVec3, t_max: f64| {
            let mut given = Vec::new();
            let ray = SlabRay::new(origin, direction, 10.0);
            grid.walk(&ray, t_max, &mut |piece, t_max| {
                given.push(piece);
                t_max
            });
            given
        };
        let beside = DVec3::new(-1.0, 0.5, 0.5);
        assert_eq!(given(beside, DVec3::X, f64::INFINITY), (0..10).collect::<Vec<_>>());
        assert_eq!(given(at(7), DVec3::NEG_X, f64::INFINITY), [7, 6, 5, 4, 3, 2, 1, 0]);
        assert_eq!(given(at(2), DVec3::X, 2.0), [2, 3, 4]);
        assert!(grid.reach > 1e9);
        let far = DVec3::new(1e30, 0.5, 0.5);
        assert_eq!(given(far, DVec3::NEG_X, f64::INFINITY), (0..10).collect::<Vec<_>>());
    }
}
