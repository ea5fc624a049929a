//! A page that shows a sweep: contour, trajectory, laws and surface.
//!
//! ```text
//!   +-----------------------------------+
//!   | name, cells, what the check says  |
//!   +-----------+-----------------------+
//!   | contour   |                       |
//!   +-----------+  surface, shaded,     |
//!   | trajectory|  from far to near     |
//!   +-----------+                       |
//!   | laws      |                       |
//!   +-----------+-----------------------+
//! ```
//!
//! The page is an SVG of 1200 x 900 pixels that refers to no other file. Space is seen in parallel projection
//! from the front, slightly from the right and from above. The same object gives the same page.

mod contour;
mod course;
pub mod drawn;
mod laws;
mod page;
mod surface;

use crate::check::{Finding, Severity, short, summary};
use crate::grid::GridMesh;
use crate::sampling::Object;
pub use drawn::Drawn;
use glam::DVec2;
use page::{Anchor, Area, HEIGHT, Page, WIDTH, ink};

/// Space around the panels, in pixels.
const MARGIN: f64 = 24.0;

/// Width of the left column, in pixels.
const LEFT: f64 = 396.0;

/// Largest number of characters in a line of the header.
const LINE: usize = 178;

/// Returns the page of an object as SVG, with its grids and the findings of the check.
#[must_use]
pub fn svg(object: &Object, grids: &[GridMesh], findings: &[Finding]) -> String {
    let mut page = Page::new();
    header(&mut page, object, grids, findings);
    let parts = object.parts();
    let top = 92.0;
    let gap = 14.0;
    let height = HEIGHT - MARGIN - top;
    let laws = laws::any(parts);
    let law_height = if laws { 168.0 } else { 0.0 };
    let rest = height - law_height - if laws { 2.0 * gap } else { gap };
    let panel = |y, height| Area::new(MARGIN, y, LEFT, height);
    contour::draw(&mut page, panel(top, 0.5 * rest), parts);
    course::draw(&mut page, panel(top + 0.5 * rest + gap, 0.5 * rest), parts);
    if laws {
        laws::draw(&mut page, panel(top + rest + 2.0 * gap, law_height), parts);
    }
    let left = MARGIN + LEFT + gap;
    let whole = Area::new(left, top, WIDTH - MARGIN - left, height);
    surface::draw(&mut page, whole, parts, grids);
    page.finish()
}

fn header(page: &mut Page, object: &Object, grids: &[GridMesh], findings: &[Finding]) {
    let name = cut(object.name(), 60);
    page.text(DVec2::new(MARGIN, 44.0), 25.0, ink::TEXT, Anchor::Start, &name);
    let count = |severity| findings.iter().filter(|one| one.severity == severity).count();
    let worst = findings.iter().max_by_key(|one| one.severity);
    let (wrong, hints) = (count(Severity::Wrong), count(Severity::Hint));
    let parts = object.parts();
    let sizes = match (parts, grids) {
        ([sweep], [grid]) => {
            let words = summary(sweep, grid);
            let words = words.split_once(": ").map_or("", |(_, words)| words).to_owned();
            if sweep.trajectory().is_rotation() {
                words
            } else {
                format!("{words}, {} long", short(sweep.trajectory().length()))
            }
        }
        _ => {
            let cells: usize = parts.iter().map(|sweep| sweep.rows() * sweep.cols()).sum();
            format!("{} parts, {cells} cells", parts.len())
        }
    };
    let right = DVec2::new(WIDTH - MARGIN, 42.0);
    page.text(right, 14.0, ink::MUTED, Anchor::End, &sizes);
    // Remarks are no faults: the first of the most severe findings above a remark is shown.
    let (color, words) = match worst.filter(|worst| worst.severity > Severity::Remark) {
        None => (ink::START, "check: nothing wrong".to_owned()),
        Some(worst) => {
            let color = if wrong > 0 { ink::FOLD } else { "#a86a12" };
            let more = wrong + hints - 1;
            let more = if more > 0 { format!(" (and {more} more)") } else { String::new() };
            let first = findings.iter().find(|one| one.severity == worst.severity);
            let first = first.unwrap_or(worst).to_string();
            (color, format!("{}{more}", cut(&first, LINE - more.len())))
        }
    };
    page.text(DVec2::new(MARGIN, 72.0), 13.0, color, Anchor::Start, &words);
}

/// Returns the text, shortened to `most` characters.
fn cut(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    text.chars().take(most.saturating_sub(3)).chain("...".chars()).collect()
}
