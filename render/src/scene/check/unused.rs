//! Materials and textures that no surface shows.

use super::subject::Subject;
use super::{Finding, Severity};
use std::collections::HashMap;

/// Returns a finding for each material and texture that no surface shows.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let mut used = vec![false; subject.scene.materials.len()];
    // For each texture that is on a surface: true if a material shows it.
    let mut shown = HashMap::new();
    for part in subject.items.iter().flat_map(|item| &item.object.parts) {
        used[part.material] = true;
        if let Some(texture) = part.texture {
            let shows = subject.scene.materials[part.material].shows_color();
            *shown.entry(texture).or_insert(false) |= shows;
        }
    }
    let unused = subject.materials.iter().zip(used).filter(|(_, used)| !used);
    let materials = unused.map(|([_, path], _)| {
        Finding::new(Severity::Remark, path, "no surface is made of this material")
    });
    let textures = subject.textures.iter().filter_map(|(texture, [_, path])| {
        let message = "the texture is only on materials without ambient and diffuse light, which do not \
                       show it";
        match shown.get(texture) {
            None => Some(Finding::new(Severity::Remark, path, "no surface has this texture")),
            Some(false) => Some(Finding::new(Severity::Hint, path, message)),
            Some(true) => None,
        }
    });
    materials.chain(textures).collect()
}
