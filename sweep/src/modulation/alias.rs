//! What a resolution is too coarse for: waves and turns that fall between the rows and columns.

use super::Modulation;

/// Turn of the contour from one row to the next, in degrees, beyond which its way cannot be seen.
const MOST_TURN_DEG: f64 = 90.0;

/// Places at which the twist's rate is looked at.
const PLACES: u32 = 256;

/// A key of the spec that asks for more than the cells can show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alias {
    /// The key, as `depth.terms[0].u`.
    pub key: String,
    /// What was found and what it takes.
    pub message: String,
}

impl Modulation {
    /// What `rows` cells along the trajectory and `cols` along the contour are too few for.
    #[must_use]
    pub fn aliases(&self, rows: usize, cols: usize) -> Vec<Alias> {
        let mut found = Vec::new();
        for (i, term) in self.depth.iter().flat_map(|depth| &depth.terms).enumerate() {
            for (key, waves, cells) in [("u", term.u, cols), ("v", term.v, rows)] {
                let fewest = 2.0 * waves.abs();
                if fewest > cells as f64 {
                    found.push(Alias {
                        key: format!("depth.terms[{i}].{key}"),
                        message: format!(
                            "found {waves} waves along {cells} cells, expected at least {} cells",
                            fewest.ceil()
                        ),
                    });
                }
            }
        }
        if let Some(law) = &self.twist {
            let rate = |place| law.at(f64::from(place) / f64::from(PLACES)).1.abs();
            let fastest = (0..=PLACES).map(rate).fold(0.0, f64::max);
            if fastest > MOST_TURN_DEG * rows as f64 {
                let (turn, fewest) = (fastest / rows as f64, (fastest / MOST_TURN_DEG).ceil());
                found.push(Alias {
                    key: "twist".into(),
                    message: format!(
                        "found a turn of {turn:.0} degrees from row to row of {rows}, expected at \
                         least {fewest} rows"
                    ),
                });
            }
        }
        found
    }
}
