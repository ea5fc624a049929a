//! Tables, trees and charts of a scene, for another scene that has equal textures and meshes.
//!
//! The frames of an animation, and the states of a scene that is edited, are scenes of their own, and mostly differ in a few
//! numbers. A scene takes from the scene before what was built for an equal texture or an equal mesh at the same index.
//! Pictures do not depend on a stock, since equal inputs have equal tables, trees and charts.

use crate::accel::Planted;
use crate::filter::{Detached, Filter, FilteredTexture};
use crate::scene::Scene;
use crate::shape::{Charts, Mesh, Shape};
use crate::texture::Texture;

/// Data of a scene without the scene, which the next scene takes out.
#[derive(Debug, Default)]
pub struct Stock {
    /// Tables of each of [`Filter::ALL`], by texture.
    pub(crate) tables: Vec<Vec<Option<Detached>>>,
    /// Trees of meshes.
    pub(crate) trees: Planted,
    /// Charts of the objects that show a picture; those of others are empty.
    pub(crate) charts: Vec<Charts>,
}

impl Stock {
    /// Drops the data of all textures and objects but those that are the same in the next scene. The closures take the
    /// index of a texture, and that of an object.
    #[must_use]
    pub fn of_same(
        mut self,
        same_texture: impl Fn(usize) -> bool,
        same_mesh: impl Fn(usize) -> bool,
    ) -> Self {
        for tables in &mut self.tables {
            for (_, table) in tables.iter_mut().enumerate().filter(|(k, _)| !same_texture(*k)) {
                *table = None;
            }
        }
        for (_, charts) in self.charts.iter_mut().enumerate().filter(|(k, _)| !same_mesh(*k)) {
            *charts = Charts::default();
        }
        Self { trees: self.trees.of_same(same_mesh), ..self }
    }

    /// Drops the data of the textures and meshes of one scene that are not equal to those of the next.
    #[must_use]
    pub fn between(self, before: &Scene, after: &Scene) -> Self {
        let texture = |k: usize| {
            before.textures.get(k).zip(after.textures.get(k)).is_some_and(|(a, b)| a == b)
        };
        let meshes = [before, after].map(|scene| {
            scene.objects.iter().map(|object| mesh_of(&object.shape)).collect::<Vec<_>>()
        });
        let [a, b] = &meshes;
        let mesh = |k: usize| a.get(k).is_some_and(|a| a.is_some() && b.get(k) == Some(a));
        self.of_same(texture, mesh)
    }

    /// Takes out the tables of the textures of a scene.
    pub(crate) fn take_tables<'a>(
        &mut self,
        textures: &'a [Texture],
        filter: Filter,
    ) -> Vec<Option<FilteredTexture<'a>>> {
        let mut tables = self.tables.get_mut(filter as usize);
        let mut table = |k: usize| tables.as_mut()?.get_mut(k)?.take();
        let all = textures.iter().enumerate();
        all.map(|(k, texture)| table(k).map(|table| table.attach(texture))).collect()
    }

    /// Takes out the charts of an object.
    pub(crate) fn take_charts(&mut self, object: usize) -> Option<Charts> {
        let charts = std::mem::take(self.charts.get_mut(object)?);
        (charts != Charts::default()).then_some(charts)
    }
}

/// The mesh of a shape that is one, or an instance of one.
fn mesh_of(shape: &Shape) -> Option<&Mesh> {
    match shape {
        Shape::Mesh(mesh) => Some(mesh),
        Shape::Instance(instance) => Some(instance.mesh()),
        _ => None,
    }
}
