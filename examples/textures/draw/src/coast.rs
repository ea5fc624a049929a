//! The coastlines of the world: the positions of land, and the distance to the nearest shore.
//!
//! A line of `coastlines.txt` is a ring: longitude and latitude of its first corner and then the
//! steps from corner to corner, in tenths of a degree. The rings are Natural Earth's land at 1:50
//! million (public domain), from `land-50m.json` of the package `world-atlas` 2.0.2. Rings of less
//! than a quarter of a square degree are left out. So are corners within 0.12 degrees of their
//! neighbours' line (Douglas and Peucker).

use glam::DVec2;

const CORNERS: &str = include_str!("coastlines.txt");
/// Degrees of one unit of the file.
const UNIT: f64 = 0.1;
/// Side of a cell, in degrees. Shores are looked up by cells.
const CELL: f64 = 2.0;
/// Number of cells around the globe.
const COLUMNS: usize = 180;
/// Number of cells from pole to pole.
const ROWS: usize = 90;

/// A stretch of shore, from corner to corner, in degrees.
#[derive(Debug, Clone, Copy)]
struct Shore {
    from: DVec2,
    to: DVec2,
}

/// The coastlines, sorted into cells.
#[derive(Debug)]
pub struct Coast {
    shores: Vec<Shore>,
    /// The shores that pass within `reach` of a cell, row by row from the south-west.
    near: Vec<Vec<u32>>,
    /// The shores that cross the parallels of a row of cells.
    across: Vec<Vec<u32>>,
}

impl Coast {
    /// Reads the coastlines, and sorts them for distances of up to `reach` degrees.
    pub fn within(reach: f64) -> Self {
        let shores: Vec<Shore> = CORNERS.lines().flat_map(ring).collect();
        let mut near = vec![Vec::new(); COLUMNS * ROWS];
        let mut across = vec![Vec::new(); ROWS];
        for (shore, number) in shores.iter().zip(0..) {
            let (low, high) = (shore.from.min(shore.to), shore.from.max(shore.to));
            let rows = |low: f64, high: f64| {
                let row =
                    |latitude: f64| (((latitude + 90.0) / CELL).max(0.0) as usize).min(ROWS - 1);
                row(low)..=row(high)
            };
            for row in rows(low.y, high.y) {
                across[row].push(number);
            }
            if is_cut(shore) {
                continue;
            }
            for row in rows(low.y - reach, high.y + reach) {
                // A degree of longitude is short near the poles, so the end of the cell that is
                // nearer to the pole counts.
                let polar = ((row as f64 - 45.0).abs() + 0.5) * CELL;
                let wide = reach / cosine(polar.min(89.0)).max(0.02);
                let column = |longitude: f64| ((longitude + 180.0) / CELL).floor() as i64;
                let columns = column(low.x - wide)..=column(high.x + wide);
                for column in columns.take(COLUMNS) {
                    near[row * COLUMNS + column.rem_euclid(COLUMNS as i64) as usize].push(number);
                }
            }
        }
        Self { shores, near, across }
    }

    /// Returns true if there is land at a longitude and latitude, in degrees: if an odd number of
    /// shores lies to the west.
    pub fn is_land(&self, p: DVec2) -> bool {
        let (_, row) = cell(p);
        let mut land = false;
        for &number in &self.across[row] {
            let Shore { from, to } = self.shores[number as usize];
            if (from.y > p.y) != (to.y > p.y) {
                let t = (p.y - from.y) / (to.y - from.y);
                land ^= from.x + t * (to.x - from.x) < p.x;
            }
        }
        land
    }

    /// Returns the distance to the nearest shore, in degrees of a great circle. Beyond the reach,
    /// the result is any number above the reach, or infinity.
    pub fn distance(&self, p: DVec2) -> f64 {
        let (column, row) = cell(p);
        let shrink = DVec2::new(cosine(p.y.abs()), 1.0);
        let mut least = f64::INFINITY;
        for &number in &self.near[row * COLUMNS + column] {
            let Shore { from, to } = self.shores[number as usize];
            let middle = 0.5 * (from.x + to.x);
            let around = 360.0 * ((p.x - middle) / 360.0).round();
            let p = (p - DVec2::new(around, 0.0)) * shrink;
            let (from, along) = (from * shrink, (to - from) * shrink);
            let t = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            least = least.min((p - from - t * along).length_squared());
        }
        least.sqrt()
    }
}

/// Returns the shores of a ring.
fn ring(line: &str) -> Vec<Shore> {
    let mut at = DVec2::ZERO;
    let mut steps = line.split(' ').map(|word| word.parse().unwrap_or(0.0));
    let mut corners = Vec::new();
    while let (Some(x), Some(y)) = (steps.next(), steps.next()) {
        at += DVec2::new(x, y);
        corners.push(at * UNIT);
    }
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&from, &to)| shore(from, to)).collect()
}

/// Returns the shore between two corners of a ring. A step over the date line becomes a cut along
/// the date line to the south pole.
///
/// Two cuts of a land overlap from the southern start to the pole, where they cancel. Between the
/// two starts one cut counts. A land that goes around the world has one cut, and so contains the
/// pole.
fn shore(from: DVec2, to: DVec2) -> Shore {
    if (to.x - from.x).abs() < 180.0 {
        return Shore { from, to };
    }
    let cut = |y| DVec2::new(-180.0, y);
    Shore { from: cut(0.5 * (from.y + to.y)), to: cut(-90.0) }
}

/// Returns true for a cut at the date line, which is no shore.
fn is_cut(shore: &Shore) -> bool {
    shore.from.x.abs() > 179.95 && shore.to.x.abs() > 179.95
}

fn cell(p: DVec2) -> (usize, usize) {
    let column = ((p.x + 180.0).rem_euclid(360.0) / CELL) as usize;
    let row = ((p.y + 90.0).max(0.0) / CELL) as usize;
    (column.min(COLUMNS - 1), row.min(ROWS - 1))
}

/// Returns the cosine of an angle of up to 90 degrees, to two thousandths. Bhaskara's fraction
/// gives the same bits on every machine.
pub fn cosine(degrees: f64) -> f64 {
    let square = degrees * degrees;
    (32_400.0 - 4.0 * square) / (32_400.0 + square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bhaskara_was_right_to_two_thousandths() {
        for degrees in 0..=90 {
            let degrees = f64::from(degrees);
            assert!((cosine(degrees) - degrees.to_radians().cos()).abs() < 2e-3, "{degrees}");
        }
    }

    #[test]
    fn cities_are_on_land_and_ships_at_sea() {
        let coast = Coast::within(2.0);
        let inland = [
            [32.85, 39.93],
            [-99.1, 19.4],
            [133.9, -23.7],
            [37.6, 55.8],
            [-0.1, 51.5],
            [0.0, -85.0],
        ];
        let at_sea =
            [[-30.0, 30.0], [-150.0, 0.0], [80.0, -10.0], [179.9, 30.0], [0.0, 89.0], [51.0, 42.0]];
        for p in inland.map(DVec2::from) {
            assert!(coast.is_land(p), "{p}");
        }
        for p in at_sea.map(DVec2::from) {
            assert!(!coast.is_land(p), "{p}");
        }
    }

    #[test]
    fn a_third_of_the_globe_is_land() {
        let coast = Coast::within(0.5);
        let (mut land, mut all) = (0.0, 0.0);
        for row in 0..180 {
            for column in 0..360 {
                let p = DVec2::new(f64::from(column) - 179.5, f64::from(row) - 89.5);
                let weight = p.y.to_radians().cos();
                all += weight;
                land += if coast.is_land(p) { weight } else { 0.0 };
            }
        }
        // Land covers 29 in a hundred, and ice shelves a little more.
        assert!((0.28..0.31).contains(&(land / all)), "{}", land / all);
    }

    #[test]
    fn the_shore_is_as_far_as_every_shore_tried_says() {
        let reach = 3.0;
        let coast = Coast::within(reach);
        let shores = coast.shores.clone();
        let numbers = (0..shores.len() as u32).filter(|&n| !is_cut(&shores[n as usize]));
        let everywhere = vec![numbers.collect(); COLUMNS * ROWS];
        let all = Coast { near: everywhere, shores, across: Vec::new() };
        for k in 0..400 {
            let k = f64::from(k);
            let p = DVec2::new((k * 137.508) % 360.0 - 180.0, (k * 43.7) % 170.0 - 85.0);
            let (found, truth) = (coast.distance(p), all.distance(p));
            assert!(found == truth || (truth > reach && found > reach), "{p}: {found} {truth}");
        }
    }
}
