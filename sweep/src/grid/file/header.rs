//! The header line: everything about a grid except its rows.

use super::line::{Endian, Line};
use super::{Encoding, GridError, Patch, stranger};
use crate::grid::GridMesh;
use crate::grid::row::{self, Fault, check_parameter};
use crate::grid::{Fold, Lid, PlacedArea, Seam, Tolerance, Unit, UvLayout, area, seam};
use files::json::{BYTES_OF_A_BYTE, Document};
use files::{JsonError, memory};
use serde::Deserialize;
use serde_json::Value;
use std::io::{self, BufRead, Read};

/// The `format` of the header line.
const FORMAT: &str = "tb-grid";
/// First bytes of a header line, as the writer of this module writes them.
const START: &[u8] = br#"{"format":"tb-grid","#;
/// The `version` of the header line.
const VERSION: u64 = 1;
/// Largest number of columns, which limits the memory for a file that is not trusted yet. A row of this length is 36 MiB.
pub(crate) const MAX_COLS: usize = 1 << 20;
/// Largest number of rows: rows are counted with 32 bits, as in the OBJ made from them.
const MAX_ROWS: usize = u32::MAX as usize;
/// Longest header line in bytes: [`MAX_COLS`] numbers of 24 characters, and a name.
const MAX_LINE: usize = 32 << 20;

/// Everything about a grid except its rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Header {
    /// The object's name.
    pub name: String,
    /// Number of this patch in its object.
    pub patch: Patch,
    /// Number of rows, which are stations.
    pub rows: usize,
    /// How the last column leads back to the first.
    pub seam_u: Seam,
    /// How the last row leads back to the first.
    pub seam_v: Seam,
    /// Shift in columns between the last row and the first; see [`Seam`].
    pub shift: usize,
    /// The texture id, if the patch has its own.
    pub texture: Option<u32>,
    /// The surface id, if the patch has its own.
    pub surface: Option<u32>,
    /// Areas with textures of their own; later areas cover earlier ones.
    pub areas: Vec<PlacedArea>,
    /// Flat ends of this patch and of patches before it.
    pub lids: Vec<Lid>,
    /// True if the first, and if the last row is pressed to a line.
    pub pressed: [bool; 2],
    /// Where the surface folds back on itself, if that was measured.
    pub fold: Option<Fold>,
    /// The requested and the measured distance from the surface, if requested.
    pub tolerance: Option<Tolerance>,
    /// The unit of length, if the spec states one.
    pub unit: Option<Unit>,
    /// How texture coordinates lie on the surface.
    pub uv: UvLayout,
    /// `u` of each column, not decreasing, in `[0, 1]`.
    pub u: Vec<f64>,
}

/// The format and version that a JSON text states; everything else in it is ignored.
#[derive(Debug, Deserialize)]
struct Claim {
    #[serde(default)]
    format: Value,
    #[serde(default)]
    version: Value,
}

impl Header {
    /// Returns the header of a grid in memory, as the only patch of its object.
    #[must_use]
    pub fn of(grid: &GridMesh) -> Self {
        Self {
            name: grid.name.clone(),
            patch: Patch::WHOLE,
            rows: grid.rows(),
            seam_u: grid.seam_u,
            seam_v: grid.seam_v,
            shift: grid.shift,
            texture: grid.texture,
            surface: grid.surface,
            areas: grid.placed_areas(),
            lids: grid.lids.clone(),
            pressed: grid.pressed,
            fold: grid.fold,
            tolerance: grid.tolerance,
            unit: grid.unit,
            uv: grid.uv,
            u: grid.u.clone(),
        }
    }

    /// Returns the number of columns, which are points of a station.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.u.len()
    }

    /// Returns a message about the fault of the seams or the shift; `None` if they are valid.
    #[must_use]
    pub fn seam_fault(&self) -> Option<String> {
        let fault = seam::check([self.seam_u, self.seam_v], self.shift, self.cols()).err();
        fault.map(|fault| fault.to_string())
    }

    /// Returns the header line with its newline.
    pub(super) fn line(&self, encoding: Encoding) -> io::Result<Vec<u8>> {
        let line = Line {
            schema: None,
            format: FORMAT.into(),
            version: VERSION,
            encoding,
            endian: Endian::Little,
            name: self.name.clone(),
            patch: self.patch,
            rows: self.rows,
            cols: self.cols(),
            seam_u: self.seam_u,
            seam_v: self.seam_v,
            shift: self.shift,
            texture: self.texture,
            surface: self.surface,
            areas: self.areas.clone(),
            lids: self.lids.clone(),
            pressed: self.pressed,
            fold: self.fold,
            tolerance: self.tolerance,
            unit: self.unit,
            uv: self.uv,
            u: self.u.clone(),
        };
        let mut bytes = serde_json::to_vec(&line)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// Checks the values, as far as their types do not.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let Patch { number, of } = self.patch;
        if !(1..=of).contains(&number) {
            let message = format!(
                "found [{number}, {of}], expected the patch's number, from 1, and the number of \
                 patches"
            );
            return Err(Fault { subject: "patch".into(), message });
        }
        for (subject, count, seam, limit) in [
            ("rows", self.rows, self.seam_v, MAX_ROWS),
            ("cols", self.cols(), self.seam_u, MAX_COLS),
        ] {
            let least = if seam.joins() { 3 } else { 2 };
            if !(least..=limit).contains(&count) {
                let message = format!("found {count}, expected from {least} to {limit}");
                return Err(Fault { subject: subject.into(), message });
            }
        }
        seam::check([self.seam_u, self.seam_v], self.shift, self.cols())?;
        let finite = [
            ("fold", self.fold.is_none_or(|fold| fold.is_finite())),
            ("tolerance", self.tolerance.is_none_or(|tolerance| tolerance.is_finite())),
        ];
        if let Some((subject, _)) = finite.into_iter().find(|(_, finite)| !finite) {
            let message = "found a number that is not finite, expected finite numbers".into();
            return Err(Fault { subject: subject.into(), message });
        }
        for (i, found) in self.uv.repeat.iter().enumerate() {
            if !(found.is_finite() && *found > 0.0) {
                let message = format!("found {}, expected a positive number", row::number(*found));
                return Err(Fault { subject: format!("uv.repeat[{i}]"), message });
            }
        }
        for (i, lid) in self.lids.iter().enumerate() {
            lid.check(number).map_err(|Fault { subject, message }| Fault {
                subject: format!("lids[{i}].{subject}"),
                message,
            })?;
        }
        let mut before = None;
        for (i, &found) in self.u.iter().enumerate() {
            check_parameter(found, before, self.seam_u)
                .map_err(|message| Fault { subject: format!("u[{i}]"), message })?;
            before = Some(found);
        }
        self.check_areas()
    }

    /// Checks areas, as far as possible without the rows.
    fn check_areas(&self) -> Result<(), Fault> {
        let cols = area::edges(&self.u, self.seam_u).len().max(1) - 1;
        let rows = if self.seam_v.joins() { self.rows } else { self.rows.saturating_sub(1) };
        for (i, PlacedArea { area, v }) in self.areas.iter().enumerate() {
            if let Some((key, message)) = area.fault([rows, cols]) {
                return Err(Fault { subject: format!("areas[{i}].area.{key}"), message });
            }
            if !(v[0] >= 0.0 && v[0] < v[1] && v[1] <= 1.0) {
                let message = format!("found {v:?}, expected two rising numbers from 0 to 1");
                return Err(Fault { subject: format!("areas[{i}].v"), message });
            }
        }
        Ok(())
    }
}

/// Reads and checks the header line, which follows `lines` other lines. Also returns the line's bytes with
/// the newline, for the checksum.
pub(super) fn read(
    name: &str,
    lines: usize,
    input: &mut impl BufRead,
) -> Result<(Header, Encoding, Vec<u8>), GridError> {
    let read_error = |source| GridError::Read { name: name.into(), source };
    let not_a_grid = |found| GridError::NotAGrid { name: name.into(), found };

    // A grid starts with a brace; a few bytes suffice to identify any other file.
    let mut bytes = Vec::new();
    input.by_ref().take(1).read_to_end(&mut bytes).map_err(read_error)?;
    if bytes.is_empty() {
        return Err(GridError::Empty { name: name.into() });
    }
    if bytes != b"{" {
        input.by_ref().take(63).read_to_end(&mut bytes).map_err(read_error)?;
        return Err(not_a_grid(stranger::described(&bytes)));
    }
    let mut limited = input.by_ref().take(MAX_LINE as u64 - 1);
    limited.read_until(b'\n', &mut bytes).map_err(read_error)?;
    let needed = BYTES_OF_A_BYTE.saturating_mul(bytes.len() as u64);
    memory::of_process().check(needed, || format!("{name}: its header line"))?;
    let whole = bytes.ends_with(b"\n");
    if !whole && bytes.len() == MAX_LINE {
        let expected = "the header line of a grid";
        return Err(GridError::LongLine {
            name: name.into(),
            line: lines + 1,
            limit: MAX_LINE,
            expected,
        });
    }

    // The stated format is checked before the other values.
    let cut = || GridError::HeaderCut { name: name.into(), bytes: bytes.len() };
    match serde_json::from_slice::<Claim>(&bytes) {
        Err(error) if !whole && (error.is_eof() || bytes.starts_with(START)) => return Err(cut()),
        Ok(claim) if claim.format == FORMAT => {
            if !whole {
                return Err(cut());
            }
            if let Some(found) = claim.version.as_u64().filter(|&found| found != VERSION) {
                return Err(GridError::Version { name: name.into(), found, expected: VERSION });
            }
        }
        // A grid of this format, but damaged: the strict parser below reports the position.
        _ if bytes.starts_with(START) => {}
        _ => return Err(not_a_grid(stranger::OTHER_JSON.into())),
    }

    let placed = |error: JsonError| JsonError { line: lines + error.line, ..error };
    let document = Document::new(name, &bytes).map_err(placed)?;
    let Line {
        schema: _,
        format: _,
        version: _,
        encoding,
        endian: _,
        name,
        patch,
        rows,
        cols,
        seam_u,
        seam_v,
        shift,
        texture,
        surface,
        areas,
        lids,
        pressed,
        fold,
        tolerance,
        unit,
        uv,
        u,
    } = document.parse().map_err(placed)?;
    if cols != u.len() {
        let message = format!("found {cols}, expected {}, the number of values in u", u.len());
        return Err(placed(document.fault("cols", message)).into());
    }
    let header = Header {
        name,
        patch,
        rows,
        seam_u,
        seam_v,
        shift,
        texture,
        surface,
        areas,
        lids,
        pressed,
        fold,
        tolerance,
        unit,
        uv,
        u,
    };
    header.check().map_err(|fault| placed(document.fault(&fault.subject, fault.message)))?;
    Ok((header, encoding, bytes))
}
