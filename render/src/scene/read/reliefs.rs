//! The bumps that the materials of libraries and of mesh files have.

use super::libraries::{Libraries, remark};
use super::{Reader, SceneError};
use crate::procedural::{Bump, Placement, Relief};
use crate::scene::mtl::{Map, ReliefColors, ReliefMap};
use crate::scene::{Material, Scene};
use crate::texture::Wrap;
use glam::DVec2;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The relief of a material of a library.
#[derive(Debug, Clone)]
pub(super) struct Carved {
    pub(super) relief: ReliefMap,
    /// The library that names the picture.
    pub(super) library: PathBuf,
}

/// A material without its relief, the picture of the relief, and the bits of its place.
type Key = (usize, PathBuf, ReliefColors, [u64; 5]);

/// Indices of the materials with reliefs so far. Materials whose picture cannot be read stay as they are.
#[derive(Debug, Default)]
pub(super) struct CarvedMaterials(BTreeMap<Key, usize>);

/// Returns how often a relief is laid, and its offset, over texture coordinates that were moved for the
/// picture `under` it.
fn laid(map: &Map, under: Option<&Map>) -> [DVec2; 2] {
    let Some(under) = under else { return [map.scale, map.offset] };
    let repeat = map.scale / under.scale;
    // A picture that is stretched without bound leaves no coordinates.
    let repeat = DVec2::select(repeat.is_finite_mask(), repeat, DVec2::ZERO);
    [repeat, map.offset - repeat * under.offset]
}

impl Reader<'_> {
    /// Returns the index of `material` with the bump of a library. `under` is the map by which the
    /// texture coordinates of the surface were moved. A picture that cannot be read is a fault if the scene names
    /// the library, at the JSON path `at`; otherwise it is a remark, and there is no bump.
    pub(super) fn carved(
        &self,
        (at, named): (&str, bool),
        material: usize,
        carved: &Carved,
        under: Option<&Map>,
        libraries: &mut Libraries,
        scene: &mut Scene,
    ) -> Result<usize, SceneError> {
        let Carved { relief: ReliefMap { map, colors }, library } = carved;
        let folder = library.parent().unwrap_or(Path::new(""));
        let [repeat, offset] = laid(map, under);
        let bits = [repeat.x, repeat.y, offset.x, offset.y, map.strength].map(f64::to_bits);
        let key = (material, folder.join(&map.path), *colors, bits);
        if let Some(&known) = libraries.carved.0.get(&key) {
            return Ok(known);
        }
        let file = files::input::name_of(library);
        let mut say = |sentence: String| scene.remarks.push(remark(&file, &[sentence]));
        let path = self.found_path(folder, map);
        let relief = self.relief(at, &path, *colors, (repeat, offset, map.wrap));
        let index = match relief {
            Ok((relief, seen)) => {
                if path != folder.join(&map.path) {
                    say(format!("{} is taken for {}", path.display(), map.path));
                }
                if seen != *colors {
                    say(format!("{} is taken as a normal map, by its colours", map.path));
                }
                if map.wrap == Wrap::Clamp {
                    say(format!("the bump {} repeats beyond its edges", map.path));
                }
                let placement = Placement::default();
                scene.procedural.bumps.push(Bump { relief, strength: map.strength, placement });
                let bump = Some(scene.procedural.bumps.len() - 1);
                let own = Material { bump, ..scene.materials[material].clone() };
                scene.materials.push(own);
                scene.names.materials.push(scene.names.materials[material].clone());
                scene.materials.len() - 1
            }
            Err(error) if named => return Err(error),
            Err(error) => {
                say(format!("no bump: {error}"));
                material
            }
        };
        libraries.carved.0.insert(key, index);
        Ok(index)
    }

    /// Reads a picture as a relief. Returns what its colours were taken for.
    fn relief(
        &self,
        at: &str,
        path: &Path,
        colors: ReliefColors,
        (repeat, offset, wrap): (DVec2, DVec2, Wrap),
    ) -> Result<(Relief, ReliefColors), SceneError> {
        let (picture, _reserved) = self.picture(at, path)?;
        let are_normals = colors == ReliefColors::Normals || super::bumps::are_normals(&picture);
        if are_normals {
            let map = self.normals_of(at, &picture, repeat, wrap == Wrap::Mirror)?;
            return Ok((Relief::Normals(map.moved(offset)), ReliefColors::Normals));
        }
        let heights = self.heights_of(at, picture, repeat, wrap == Wrap::Mirror)?;
        Ok((Relief::Picture(heights.moved(offset)), ReliefColors::Heights))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_relief_lies_where_its_own_options_say() {
        let relief = Map::read("-s 3 2 -o 0.25 -1 a.png").unwrap();
        for under in ["b.png", "-s 2 -4 b.png", "-s 0.5 0.5 -o 0.3 0.7 b.png"] {
            let under = Map::read(under).unwrap();
            let [repeat, offset] = laid(&relief, Some(&under));
            for uv in [[0.0, 0.0], [0.5, 0.25], [-1.0, 3.0]] {
                let moved = under.moved(uv).map(f64::from);
                let found = repeat * DVec2::from(moved) + offset;
                let truth = DVec2::from(relief.moved(uv).map(f64::from));
                assert!(found.abs_diff_eq(truth, 1e-6), "{found} {truth}");
            }
        }
        assert_eq!(laid(&relief, None), [relief.scale, relief.offset]);
        let flat = Map::read("-s 0 1 b.png").unwrap();
        assert_eq!(laid(&relief, Some(&flat))[0], DVec2::new(0.0, 2.0));
    }
}
