//! What there is in a scene, and what is wrong or suspicious about it, in words for people.
//!
//! | module         | looks at                                                                  |
//! |----------------|---------------------------------------------------------------------------|
//! | [`subject`]    | the scene beside its files: what each object is called and where it stands |
//! | [`inventory`]  | what there is, a line for each thing                                      |
//! | [`unused`]     | materials and textures that nothing shows                                 |
//! | [`camera`]     | where the eye stands and what it cannot see                               |
//! | [`lights`]     | lights shut in                                                            |
//! | [`meshes`]     | triangles, normals and rims                                               |
//! | [`glass`]      | what light goes through                                                   |
//! | [`coincident`] | surfaces in the same place                                                |
//! | [`boxes`]      | which of many boxes a search meets                                        |
//! | [`planes`]     | which flat objects may lie in one plane                                   |
//! | [`solid`]      | what those need to know of a shape: its box, its inside, its surface      |
//!
//! Nothing here changes a scene, and no picture needs it.

pub mod boxes;
pub mod camera;
pub mod coincident;
pub mod glass;
pub mod inventory;
pub mod lights;
pub mod meshes;
pub mod planes;
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

/// What `--check` says.
#[derive(Debug, Clone)]
pub struct Report {
    /// What there is, a line for each thing.
    pub inventory: Vec<String>,
    /// What is wrong or suspicious, from the worst to the least.
    pub findings: Vec<Finding>,
}

impl Report {
    /// How many findings say that something is wrong.
    #[must_use]
    pub fn wrong(&self) -> usize {
        self.findings.iter().filter(|finding| finding.severity == Severity::Wrong).count()
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let findings = self.findings.iter().map(Finding::to_string);
        // Names are those of files: none of them may begin a line or fill a page.
        let mut lines = self.inventory.iter().cloned().chain(findings);
        lines.try_for_each(|line| writeln!(f, "{}", words::line(&line)))
    }
}

/// Everything that can be said of a scene: `scene` was made of `draft`, and is to fill a picture
/// `aspect` times as wide as high. `table_bytes` says how much memory the tables of a texture take.
///
/// # Errors
/// When the draft's files are not those of a scene.
pub fn check(
    draft: &Draft<'_>,
    scene: &Scene,
    aspect: f64,
    table_bytes: &dyn Fn(&Texture) -> u64,
) -> Result<Report, SceneError> {
    let sheets = draft.sheets()?;
    let subject = Subject::new(draft, &sheets, scene, aspect);
    let mut findings = camera::findings(&subject);
    findings.extend(meshes::findings(&subject));
    findings.extend(glass::findings(&subject));
    findings.extend(lights::findings(&subject));
    findings.extend(coincident::findings(&subject).findings);
    findings.extend(unused::findings(&subject));
    findings.sort_by_key(|finding| Reverse(finding.severity));
    Ok(Report { inventory: inventory::lines(&subject, table_bytes), findings })
}

/// A point in four digits.
fn point(p: glam::DVec3) -> String {
    format!("({}, {}, {})", short(p.x), short(p.y), short(p.z))
}

/// A number of things, in words.
fn count(number: usize, one: &str, many: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {many}") }
}
