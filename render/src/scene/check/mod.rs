//! The report of `--check`: the contents of a scene, and its faults and suspicious values.
//!
//! | module         | contents                                                                   |
//! |----------------|----------------------------------------------------------------------------|
//! | [`subject`]    | the scene with the name and JSON path of each object                       |
//! | [`inventory`]  | a line for each light, texture and object                                  |
//! | [`unused`]     | materials and textures that no surface shows                               |
//! | [`camera`]     | an eye inside an object, and objects outside the picture                   |
//! | [`lights`]     | lights inside opaque objects                                               |
//! | [`meshes`]     | triangles without area, normals, stretched textures                        |
//! | [`glass`]      | transparent objects                                                        |
//! | [`coincident`] | flat objects that coincide with each other or with meshes                  |
//! | [`coplanar`]   | triangles of meshes and faces of boxes that overlap in one plane           |
//! | [`boxes`]      | search among many boxes                                                    |
//! | [`planes`]     | flat objects that may lie in one plane                                     |
//! | [`skin`]       | rims and volume of a mesh                                                  |
//! | [`solid`]      | bounding box, inside and height of a shape                                 |
//!
//! No check changes a scene, and no picture needs a check.

pub mod boxes;
pub mod camera;
pub mod coincident;
pub mod coplanar;
pub mod glass;
pub mod inventory;
pub mod lights;
pub mod meshes;
pub mod planes;
pub mod skin;
pub mod solid;
pub mod subject;
pub mod unused;

use super::Scene;
use super::read::{Draft, SceneError};
use crate::texture::Texture;
use files::check::short;
use files::words;
use std::cmp::Reverse;
use std::fmt::{self, Display};
use subject::Subject;

pub use files::check::{Finding, Severity};

/// The report of `--check`.
#[derive(Debug, Clone)]
pub struct Report {
    /// A line for each light, texture and object.
    pub inventory: Vec<String>,
    /// Findings, the most severe first.
    pub findings: Vec<Finding>,
}

impl Report {
    /// Number of findings of severity [`Severity::Wrong`].
    #[must_use]
    pub fn wrong(&self) -> usize {
        self.findings.iter().filter(|finding| finding.severity == Severity::Wrong).count()
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let findings = self.findings.iter().map(Finding::to_string);
        // Names come from files, so that line breaks and long names are shortened.
        let mut lines = self.inventory.iter().cloned().chain(findings);
        lines.try_for_each(|line| writeln!(f, "{}", words::line(&line)))
    }
}

/// Checks a scene. `scene` was resolved from `draft`. `aspect` is the width of the picture over its
/// height, positive. `table_bytes` returns the memory of a texture's tables, in bytes.
///
/// # Errors
/// If the draft's files are not those of a scene.
pub fn check(
    draft: &Draft<'_>,
    scene: &Scene,
    aspect: f64,
    table_bytes: &dyn Fn(&Texture) -> u64,
) -> Result<Report, SceneError> {
    let texts = draft.texts()?;
    let subject = Subject::new(draft, &texts, scene, aspect);
    let mut findings = camera::findings(&subject);
    findings.extend(meshes::findings(&subject));
    findings.extend(glass::findings(&subject));
    findings.extend(lights::findings(&subject));
    findings.extend(coincident::findings(&subject).findings);
    findings.extend(coplanar::findings(&subject).0);
    findings.extend(unused::findings(&subject));
    findings.extend(scene.remarks.iter().cloned());
    findings.sort_by_key(|finding| Reverse(finding.severity));
    Ok(Report { inventory: inventory::lines(&subject, table_bytes), findings })
}

/// Formats a point, each coordinate with four digits.
fn point(p: glam::DVec3) -> String {
    format!("({}, {}, {})", short(p.x), short(p.y), short(p.z))
}

/// Writes a count with its noun, in the singular for 1.
fn count(number: usize, one: &str, many: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {many}") }
}
