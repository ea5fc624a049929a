//! Materials and textures that nothing shows.

use super::subject::Subject;
use super::{Finding, Severity};

/// One remark for each name that no surface has.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let parts = || subject.items.iter().flat_map(|item| &item.object.parts);
    let materials = subject.materials.iter().enumerate().filter_map(|(index, [_, path])| {
        let used = parts().any(|part| part.material == index);
        (!used).then(|| Finding::new(Severity::Remark, path, "no surface is made of this material"))
    });
    let textures = subject.textures.iter().filter_map(|(texture, [_, path])| {
        let bound = || parts().filter(|part| part.texture == Some(*texture));
        let shows = |material: usize| subject.scene.materials[material].shows_color();
        if bound().next().is_none() {
            return Some(Finding::new(Severity::Remark, path, "no surface has this texture"));
        }
        let message = "it is only on materials without ambient and diffuse light, which do not \
                       show it";
        let hidden = !bound().any(|part| shows(part.material));
        hidden.then(|| Finding::new(Severity::Hint, path, message))
    });
    materials.chain(textures).collect()
}
