//! Tables, trees and charts of a scene, for another scene that has equal textures and meshes.
//!
//! The frames of an animation are scenes of their own, and mostly differ in a few numbers. A frame takes from the frame
//! before what was built for an equal texture or an equal mesh at the same index. Pictures do not depend on a stock, since equal
//! inputs have equal tables and trees.

use crate::accel::{Accel, MeshTree};
use crate::filter::{Detached, Filter, FilteredTexture};
use crate::scene::Scene;
use crate::shape::{Charts, Shape};
use crate::texture::Texture;
use std::collections::BTreeMap;

/// Data of a scene without the scene.
#[derive(Debug, Default)]
pub struct Parts {
    /// Tables of each of [`Filter::ALL`], by texture.
    pub(crate) tables: Vec<Vec<Option<Detached>>>,
    /// Trees of the objects that are meshes.
    pub(crate) trees: BTreeMap<usize, Vec<MeshTree>>,
    /// Charts of all objects.
    pub(crate) charts: Vec<Charts>,
}

/// Data of a scene, which the next scene takes out.
#[derive(Debug, Default)]
pub struct Stock {
    textures: Vec<Texture>,
    shapes: Vec<Shape>,
    parts: Parts,
}

impl Stock {
    /// Returns the data that were built for a scene.
    #[must_use]
    pub fn new(scene: Scene, parts: Parts) -> Self {
        let shapes = scene.objects.into_iter().map(|object| object.shape).collect();
        Self { textures: scene.textures, shapes, parts }
    }

    /// Takes out the tables of all textures of a scene that equal those of the stock. The others are `None`.
    pub(crate) fn tables<'a>(
        &mut self,
        textures: &'a [Texture],
        filter: Filter,
    ) -> Vec<Option<FilteredTexture<'a>>> {
        let mut tables = self.parts.tables.get_mut(filter as usize);
        let mut table = |k: usize, texture: &'a Texture| {
            let own = tables.as_mut()?.get_mut(k)?;
            let is_equal = own.is_some() && self.textures.get(k)? == texture;
            if is_equal { own.take().map(|own| own.attach(texture)) } else { None }
        };
        textures.iter().enumerate().map(|(k, texture)| table(k, texture)).collect()
    }

    /// Takes out the trees of a shape.
    pub(crate) fn trees(&mut self, object: usize, shape: &Shape) -> Option<Vec<MeshTree>> {
        if self.has(object, shape) { self.parts.trees.remove(&object) } else { None }
    }

    /// Takes out the charts of a shape.
    pub(crate) fn charts(&mut self, object: usize, shape: &Shape) -> Option<Charts> {
        if !self.has(object, shape) {
            return None;
        }
        let charts = std::mem::take(self.parts.charts.get_mut(object)?);
        (charts != Charts::default()).then_some(charts)
    }

    /// Returns whether an object is a mesh that equals the one of the stock.
    fn has(&self, object: usize, shape: &Shape) -> bool {
        match (self.shapes.get(object), shape) {
            (Some(Shape::Mesh(own)), Shape::Mesh(mesh)) => own == mesh,
            _ => false,
        }
    }
}

impl Parts {
    /// Returns the trees of a structure.
    pub(crate) fn trees_of(accel: Option<Accel<'_>>) -> BTreeMap<usize, Vec<MeshTree>> {
        accel.map(Accel::into_trees).unwrap_or_default()
    }
}
