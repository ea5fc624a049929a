//! The thesis's uniform grids (5.2, fig. 5.1 and 5.2): each object in a box along the axes, the box
//! cut into equal voxels, each voxel with a list of the pieces in it, and rays that step from voxel
//! to voxel by 3DDDA.
//!
//! Amanatides, Woo: *A Fast Voxel Traversal Algorithm for Ray Tracing*, Eurographics 1987. A step
//! takes comparisons and one addition.
//!
//! **Each piece once.** A piece is listed in every voxel that its box meets, and a ray would try it
//! in each. Mailboxes would need memory for each ray; here a bit does. The voxels of a piece are a
//! box of voxels, and a ray that has left it on an axis never comes back. So a ray that stepped
//! along an axis has met the piece before unless the piece's voxels begin, on that axis and that
//! way, with the voxel it stepped into: six bits for each entry of a list.
//!
//! **Nothing missed.** A piece's hit lies where the ray crosses its widened box (the hit function
//! sees to it). At that distance the walk is in a voxel that is off the ray by roundings: those of
//! the planes, and those that additions have piled up. The boxes are listed wider than all of them
//! together, for any ray that starts within [`Grid::reach`]. A ray from farther away tries every piece.
//!
//! **Not too early.** A hit found in a voxel may lie in a later one, and an equal hit of an earlier
//! piece may be listed only there. So the walk goes on until a voxel begins beyond the nearest hit.

use super::slabs::SlabRay;
use glam::DVec3;

/// Voxels for each piece of an object.
///
/// The thesis wants about one or two triangles in a voxel. A surface leaves most voxels empty, so
/// that the filled ones hold more. Larger, and rays step through more empty voxels and triangles are
/// listed in more of them; smaller, and more triangles are tried. docs/acceleration.md has figures.
const DENSITY: f64 = 2.0;

/// List entries for each piece at most; an object of long thin pieces that would need more gets
/// larger voxels.
const MOST_ENTRIES: usize = 64;

/// By which part of a voxel boxes are listed wider than they are.
///
/// Larger, and pieces are listed where they are not; smaller, and rays must start nearer.
const SLACK: f64 = 1.0 / 1024.0;

/// For the voxel in which a ray starts: no piece was met before.
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
    /// The object's pieces are numbered from here.
    pieces: std::ops::Range<u32>,
    /// Where each voxel's list begins, x fastest, and where the last one ends.
    starts: Vec<u32>,
    /// The lists, one after another.
    listed: Vec<u32>,
    /// For each entry which of the six sides of the piece's box of voxels this voxel lies on:
    /// [`side`], and always [`START`].
    sides: Vec<u8>,
    /// Rays whose [`SlabRay::scale`] is larger try every piece.
    reach: f64,
    /// How many boxes were looked at, for each voxel that one is listed in.
    looks: u64,
}

/// How a box is cut into voxels.
#[derive(Debug, Clone, Copy)]
struct Cut {
    low: DVec3,
    /// Sides of a voxel; not used on an axis that is not cut.
    voxel: DVec3,
    /// Voxels along each axis, at least 1.
    count: [u32; 3],
}

/// The bit of a side of a box of voxels: where rays enter that go up or down an axis.
const fn side(axis: usize, up: bool) -> u8 {
    1 << (2 * axis + up as usize)
}

impl Grids {
    /// Grids over boxes, given as lower and upper corners; `objects` are ranges of them.
    #[must_use]
    pub fn build(boxes: &[[DVec3; 2]], objects: &[std::ops::Range<u32>]) -> Self {
        let grids =
            objects.iter().map(|object| Grid::build(boxes, object.clone(), DENSITY)).collect();
        Self { grids }
    }

    /// Memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let lists =
            |grid: &Grid| size_of_val(&*grid.starts) + 4 * grid.listed.len() + grid.sides.len();
        size_of_val(&*self.grids) + self.grids.iter().map(lists).sum::<usize>()
    }

    /// How many boxes were looked at to build the grids, each time counted.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.grids.iter().map(|grid| grid.looks).sum()
    }

    /// Gives `visit` every box that the ray may meet within `t_max`, each once, the nearer ones of
    /// an object first; `visit` takes the current `t_max` and returns the one to go on with.
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

        // A counting sort of the pieces into voxels, in the pieces' order.
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
        // Along each axis: planes still ahead, where the ray meets the next one and how far it is
        // from one to another. Beyond the last plane a voxel has no end, so that nothing is lost
        // at the faces of the box; the walk ends where the ray leaves the widened box.
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
    /// The box cut into about `wanted` voxels, as near to cubes as it goes. An axis along which the
    /// box is shorter than a voxel is not cut.
    fn new([low, high]: [DVec3; 2], wanted: f64) -> Self {
        let size = high - low;
        let mut cut = [0, 1, 2].map(|axis| size[axis] > 0.0);
        let mut edge = 0.0;
        // At most three rounds: each but the last takes an axis away.
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

    /// How many voxels there are.
    fn all(&self) -> usize {
        self.count.iter().map(|&count| count as usize).product()
    }

    /// The first and last voxel along each axis that a box may meet.
    fn voxels(&self, [low, high]: &[DVec3; 2]) -> [[u32; 2]; 3] {
        [0, 1, 2].map(|axis| {
            let last = self.count[axis] - 1;
            if last == 0 {
                return [0, 0];
            }
            let place = |x: f64| (x - self.low[axis]) / self.voxel[axis];
            // Conversion takes what is below 0 for 0.
            let [first, end] = [place(low[axis]) - SLACK, place(high[axis]) + SLACK];
            [(first as u32).min(last), (end as u32).min(last)]
        })
    }

    /// Gives `each` the number of every voxel in a box of voxels, with the sides that it lies on.
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

    /// The largest [`SlabRay::scale`] for which the slack is wider than all roundings together.
    ///
    /// As parts of the scale, in units of `f64::EPSILON`: the widening 16, where the ray crosses a
    /// box 3, the first plane 5, the place of entry 4, the distance between planes 4, the voxels
    /// of a box 4, and half for each addition.
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

    /// A ray passes a row of voxels and is given one piece from each, in order; then all at once
    /// from beyond the grid's reach.
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
