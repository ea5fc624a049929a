//! The panel of the surface: shaded cells drawn from far to near, with seams, creases, rims and folds.

use super::page::{Anchor, Area, Page, Pen, View, ink};
use crate::check::short;
use crate::grid::{GridMesh, Seam};
use crate::sampling::Sweep;
use glam::{DVec2, DVec3};

/// Largest number of cells drawn for all parts together; if there are more, rows and columns are skipped.
const MOST_CELLS: usize = 5000;

/// Direction of the light in the viewer's axes: right, up, toward the viewer.
const LIGHT: DVec3 = DVec3::new(-0.42, 0.6, 0.68);

/// Dark and light colour of each kind of cell: outside, inside, folded.
const SHADES: [[[f64; 3]; 2]; 3] = [
    [[72.0, 104.0, 138.0], [240.0, 245.0, 250.0]],
    [[176.0, 136.0, 92.0], [253.0, 246.0, 234.0]],
    [[172.0, 44.0, 40.0], [250.0, 205.0, 198.0]],
];

/// A line on an edge of a cell, by rising importance.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Line {
    Rim,
    Crease,
    Seam,
}

enum Item {
    Cell { corners: [DVec2; 4], kind: usize, light: f64 },
    Edge([DVec2; 2], Line),
}

/// The elements of the drawing that the legend explains, and the numbers of cells drawn and in all.
#[derive(Default)]
struct Seen {
    mirrored: bool,
    folds: bool,
    lines: Vec<Line>,
    cells: usize,
    all: usize,
}

pub fn draw(page: &mut Page, area: Area, parts: &[Sweep], grids: &[GridMesh]) {
    let points = grids.iter().flat_map(|grid| grid.positions.iter().copied());
    let points: Vec<DVec3> = points.collect();
    let view = View::of(&points, area.inside(34.0, 52.0, 78.0));
    let (mut items, mut seen) = (Vec::new(), Seen::default());
    for (sweep, grid) in parts.iter().zip(grids) {
        cells(&view, sweep, grid, MOST_CELLS / grids.len().max(1), &mut items, &mut seen);
    }
    items.sort_by(|a: &(f64, Item), b| a.0.total_cmp(&b.0));
    let (low, high) = points
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    let size = (high - low).to_array().map(short).join(" x ");
    page.panel(area, "Surface", &format!("{size} (x, y, z)"));
    // On a surface with one side, cells are transparent so that self-intersections are visible.
    page.open_group(if seen.mirrored { 0.8 } else { 1.0 });
    for (_, item) in &items {
        match item {
            Item::Cell { corners, kind, light } => {
                let [fill, edge] = [0.0, -0.28].map(|darker| color(*kind, light + darker));
                page.polygon(corners, &fill, Pen::new(&edge, 0.5));
            }
            Item::Edge(ends, line) => page.line(ends, false, pen(*line)),
        }
    }
    page.close_group();
    let corner = DVec2::new(area.x + 44.0, area.y + area.height - 56.0);
    view.axes(page, corner, 26.0);
    legend(page, area, &seen);
}

fn pen(line: Line) -> Pen<'static> {
    match line {
        Line::Rim => Pen::new("#56616b", 1.2),
        Line::Crease => Pen::new(ink::CREASE, 1.2),
        Line::Seam => Pen::new(ink::SEAM, 1.9),
    }
}

fn color(kind: usize, light: f64) -> String {
    let [dark, bright] = SHADES[kind];
    // Brightness has 48 steps, too fine to see, so that equal colours are equal text.
    let light = (light.clamp(0.0, 1.0) * 48.0).round() / 48.0;
    let [r, g, b] = [0, 1, 2].map(|i| (dark[i] + (bright[i] - dark[i]) * light).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Returns the pairs of rows or columns between which cells are drawn, about one for each `step` of each
/// smooth piece and more where `bends` are large. The flag says whether a crease lies on the first of a pair.
fn pairs(positions: &[f64], joins: bool, step: usize, bends: &[f64]) -> Vec<([usize; 2], bool)> {
    // Chords are equally far from the curve if the density of cells is the square root of the bend. A least
    // density everywhere keeps cells from becoming long.
    let mean = bends.iter().map(|bend| bend.sqrt()).sum::<f64>() / bends.len().max(1) as f64;
    let least = if mean > 0.0 { mean } else { 1.0 };
    let mut sum = 0.0;
    let weight = |bend: &f64| {
        sum += bend.sqrt() + least;
        sum
    };
    let sums: Vec<f64> = bends.iter().map(weight).collect();
    let mut pairs = Vec::new();
    let mut from = 0;
    for at in 1..=positions.len() {
        if at < positions.len() && positions[at] > positions[at - 1] {
            continue;
        }
        let last = at - 1;
        let steps = (last - from).div_ceil(step).max(1);
        let index_of = |i: usize| {
            let aim = sums[from] + (sums[last] - sums[from]) * (i as f64 / steps as f64);
            from + sums[from..=last].partition_point(|&sum| sum < aim).min(last - from)
        };
        let mut chosen: Vec<usize> = match step {
            1 => (from..=last).collect(),
            _ => (0..=steps).map(index_of).collect(),
        };
        chosen.dedup();
        let crease = |i: usize| i == from && from > 0;
        pairs.extend(chosen.windows(2).map(|pair| ([pair[0], pair[1]], crease(pair[0]))));
        from = at;
    }
    if joins {
        pairs.push(([positions.len() - 1, 0], false));
    }
    pairs
}

/// Returns the sum of second differences of the surface at each row and at each column.
fn bends(grid: &GridMesh) -> [Vec<f64>; 2] {
    let (rows, cols) = (grid.rows(), grid.cols());
    let at = |row: usize, col: usize| grid.positions[row * cols + col];
    let mut bends = [vec![0.0; rows], vec![0.0; cols]];
    for row in 1..rows.saturating_sub(1) {
        for col in 1..cols.saturating_sub(1) {
            let middle = 2.0 * at(row, col);
            bends[0][row] += (at(row - 1, col) + at(row + 1, col) - middle).length();
            bends[1][col] += (at(row, col - 1) + at(row, col + 1) - middle).length();
        }
    }
    bends
}

/// Returns the steps in rows and columns, according to how much the surface bends along each.
fn steps(bends: [f64; 2], rows: usize, cols: usize, most: usize) -> [usize; 2] {
    // Straight lines need no cells, but some cells make them look better.
    let least = 0.02 * bends[0].max(bends[1]);
    let error = |a: usize, b: usize| {
        (a * a) as f64 * (bends[0] + least) + (b * b) as f64 * (bends[1] + least)
    };
    let mut best = (f64::INFINITY, [rows, cols]);
    for a in 1..=rows.max(1) {
        let left = most / rows.div_ceil(a);
        if left == 0 {
            continue;
        }
        let b = cols.div_ceil(left).max(1);
        if error(a, b) < best.0 {
            best = (error(a, b), [a, b]);
        }
    }
    best.1
}

fn cells(
    view: &View,
    sweep: &Sweep,
    grid: &GridMesh,
    most: usize,
    items: &mut Vec<(f64, Item)>,
    seen: &mut Seen,
) {
    let cols = grid.cols();
    let survey = sweep.survey();
    let [row_bends, col_bends] = bends(grid);
    let sums = [&row_bends, &col_bends].map(|bends| bends.iter().sum());
    let [row_step, col_step] = steps(sums, grid.rows(), cols, most);
    let row_pairs = pairs(&grid.v, grid.seam_v.joins(), row_step, &row_bends);
    let col_pairs = pairs(&grid.u, grid.seam_u.joins(), col_step, &col_bends);
    seen.mirrored |= grid.seam_v == Seam::Mirror;
    seen.cells += row_pairs.len() * col_pairs.len();
    seen.all += grid.cells().iter().product::<usize>();
    let light = LIGHT.normalize();
    for (i, &([row, above], row_crease)) in row_pairs.iter().enumerate() {
        let wraps = above < row;
        let rows = if wraps { row..=grid.rows() - 1 } else { row..=above };
        let folded = rows.clone().any(|row| survey.folds(row)) || wraps && survey.folds(above);
        for (j, &([col, next], col_crease)) in col_pairs.iter().enumerate() {
            let led = |col: usize| match wraps {
                true => grid.seam_v.leads_to(col, grid.shift, cols),
                false => above * cols + col,
            };
            let corners = [row * cols + col, row * cols + next, led(next), led(col)];
            let corners = corners.map(|i| grid.positions[i]);
            let [a, b, c, d] = corners;
            // Half the cross product of the diagonals is the area vector, which points outward.
            let normal = view.seen((c - a).normalize_or_zero().cross((d - b).normalize_or_zero()));
            let normal = normal.normalize_or(DVec3::Z);
            let facing = if normal.z < 0.0 { -normal } else { normal };
            let kind = if folded { 2 } else { usize::from(normal.z < 0.0) };
            seen.folds |= folded;
            let flat = corners.map(|p| view.page(p));
            let across = flat[0].distance(flat[2]).max(flat[1].distance(flat[3]));
            // Where the surface turns away from the viewer, cells that face away are moved back.
            let away = if normal.z < 0.0 { 0.35 * across } else { 0.0 };
            let depth = view.depth(0.25 * (a + b + c + d)) - away;
            let light = 0.12 + 0.88 * (0.5 + 0.5 * facing.dot(light)).powi(2);
            items.push((depth, Item::Cell { corners: flat, kind, light }));
            // A line is drawn after the cells on both its sides, one of which may be nearer.
            let reach = 0.6 * across;
            let mut edge = |p: DVec3, q: DVec3, line: Line| {
                let ends = [view.page(p), view.page(q)];
                items.push((view.depth(0.5 * (p + q)) + reach, Item::Edge(ends, line)));
                if !seen.lines.contains(&line) {
                    seen.lines.push(line);
                }
            };
            let (last_row, last_col) = (i + 1 == row_pairs.len(), j + 1 == col_pairs.len());
            if row == 0 && grid.seam_v.joins() {
                edge(a, b, Line::Seam);
            } else if row_crease {
                edge(a, b, Line::Crease);
            } else if row == 0 && a != b {
                edge(a, b, Line::Rim);
            }
            if last_row && !grid.seam_v.joins() && c != d {
                edge(d, c, Line::Rim);
            }
            let crease_at_seam = grid.u.len() > 1 && grid.u[1] == 0.0;
            let starts = j == 0 && grid.seam_u.joins();
            if starts && !crease_at_seam {
                edge(a, d, Line::Seam);
            } else if col_crease || starts {
                edge(a, d, Line::Crease);
            } else if j == 0 && a != d {
                edge(a, d, Line::Rim);
            }
            if last_col && !grid.seam_u.joins() && b != c {
                edge(b, c, Line::Rim);
            }
        }
    }
}

fn legend(page: &mut Page, area: Area, seen: &Seen) {
    let y = area.y + area.height - 18.0;
    let mut x = area.x + 16.0;
    let mut swatch = |page: &mut Page, word: &str, kind: Option<usize>, line: Option<Line>| {
        let at = DVec2::new(x, y);
        if let Some(kind) = kind {
            let corners = [(0.0, 0.0), (16.0, 0.0), (16.0, -11.0), (0.0, -11.0)];
            let corners = corners.map(|(x, y)| at + DVec2::new(x, y));
            page.polygon(&corners, &color(kind, 0.62), Pen::new(&color(kind, 0.3), 0.8));
        }
        if let Some(line) = line {
            let ends = [at + DVec2::new(0.0, -5.0), at + DVec2::new(18.0, -5.0)];
            page.line(&ends, false, Pen { width: 2.2, ..pen(line) });
        }
        page.text(at + DVec2::new(24.0, -1.0), 11.0, ink::MUTED, Anchor::Start, word);
        x += 38.0 + 6.2 * word.chars().count() as f64;
    };
    let [front, back] =
        if seen.mirrored { ["one side", "the other side"] } else { ["outside", "inside"] };
    swatch(page, front, Some(0), None);
    // The inside of a surface without a rim is not visible.
    if seen.mirrored || seen.lines.contains(&Line::Rim) {
        swatch(page, back, Some(1), None);
    }
    if seen.folds {
        swatch(page, "folded rows", Some(2), None);
    }
    for (line, word) in [(Line::Seam, "seam"), (Line::Crease, "crease"), (Line::Rim, "rim")] {
        if seen.lines.contains(&line) {
            swatch(page, word, None, Some(line));
        }
    }
    if seen.cells < seen.all {
        let words = format!("{} of {} cells", seen.cells, seen.all);
        let at = DVec2::new(area.x + area.width - 14.0, y - 1.0);
        page.text(at, 11.0, ink::MUTED, Anchor::End, &words);
    }
}
