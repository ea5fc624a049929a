//! A scene prepared for any number of pictures.
//!
//! A [`Prepared`] scene keeps the data that does not depend on a picture: the structure that finds
//! the hits, the volumes that transparent objects bound, the charts of texture coordinates, and the
//! tables of each filter. Volumes are found at once. The rest is built when the first picture needs
//! it and is kept for the pictures that follow. It is shared by the modes of a page, the two
//! pictures of a truth, the blocks of a refined picture, and `--pixel`. A [`Stock`] passes it on to another scene.

use crate::accel::{Accel, Planted, Structure};
use crate::filter::{Filter, FilteredTexture};
use crate::scene::Scene;
use crate::shade::{Shader, View};
use crate::shape::Charts;
use crate::stock::Stock;
use crate::trace::medium::Media;
use crate::trace::volume::Volumes;
use rayon::prelude::*;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// A scene and the data that pictures of it share.
///
/// Pictures may be rendered one after another from any threads. If two pictures start at the same
/// time in tasks of one rayon pool, one may wait for data that the other builds. The pool must have
/// a thread left for this work. Start such pictures from different pools, or one after the other.
#[derive(Debug)]
pub struct Prepared<'a> {
    scene: &'a Scene,
    volumes: Volumes,
    /// One structure for each of [`Structure::ALL`].
    structures: [OnceLock<Accel<'a>>; Structure::ALL.len()],
    /// Textures for each of [`Filter::ALL`], by texture index; `None` if no surface shows the
    /// texture.
    textures: [OnceLock<Vec<Option<FilteredTexture<'a>>>>; Filter::ALL.len()],
    /// Charts of each object, for filters that average over areas.
    charts: OnceLock<Vec<Charts>>,
    /// Empty charts for each object, for filters that average over points only.
    no_charts: Vec<Charts>,
    /// The volumes that contain each light.
    around_lights: OnceLock<Vec<Media>>,
    /// Data of a scene before.
    stock: Mutex<Stock>,
}

/// The data that was built for one picture because no earlier picture needed it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Built {
    /// Number of structures that find hits: 0 or 1.
    pub structures: u64,
    /// Time to build the structure.
    pub structure_time: Duration,
    /// Number of tables and pyramids of textures.
    pub tables: u64,
    /// Time to build tables, charts and the volumes around lights.
    pub table_time: Duration,
}

impl<'a> Prepared<'a> {
    /// Prepares a scene. Only its volumes are found here.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        Self::stocked(scene, Stock::default())
    }

    /// Prepares a scene with the tables, trees and charts that a scene before has left. The stock holds only those of textures
    /// and meshes that both scenes have: [`Stock::of_same`], [`Stock::between`].
    #[must_use]
    pub fn stocked(scene: &'a Scene, stock: Stock) -> Self {
        Self {
            scene,
            volumes: Volumes::of(scene),
            structures: std::array::from_fn(|_| OnceLock::new()),
            textures: std::array::from_fn(|_| OnceLock::new()),
            charts: OnceLock::new(),
            no_charts: vec![Charts::default(); scene.objects.len()],
            around_lights: OnceLock::new(),
            stock: Mutex::new(stock),
        }
    }

    /// Returns the data that were built, for another scene, and what is left of the stock.
    #[must_use]
    pub fn into_stock(self) -> Stock {
        let mut stock = self.stock.into_inner().unwrap_or_else(PoisonError::into_inner);
        stock.tables.resize_with(Filter::ALL.len(), Vec::new);
        for (textures, tables) in self.textures.into_iter().zip(&mut stock.tables) {
            if let Some(textures) = textures.into_inner() {
                let detached = |texture: Option<FilteredTexture<'a>>| Some(texture?.detach());
                *tables = textures.into_iter().map(detached).collect();
            }
        }
        let [trees, ..] = self.structures;
        if let Some(accel) = trees.into_inner() {
            stock.trees = accel.into_planted();
        }
        if let Some(charts) = self.charts.into_inner() {
            stock.charts = charts;
        }
        stock
    }

    fn stock(&self) -> MutexGuard<'_, Stock> {
        self.stock.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The volumes of the scene.
    #[must_use]
    pub fn volumes(&self) -> &Volumes {
        &self.volumes
    }

    /// Returns a shader for pictures with one structure and one filter, and a record of what was
    /// built for it.
    ///
    /// Runs on the threads of the current rayon pool.
    #[must_use]
    pub fn shader(&self, structure: Structure, filter: Filter) -> (Shader<'_>, Built) {
        let mut built = Built::default();
        let started = Instant::now();
        let accel = self.structures[structure as usize].get_or_init(|| {
            built.structures = 1;
            self.structured(structure)
        });
        built.structure_time = started.elapsed();
        let started = Instant::now();
        let textures = self.textures[filter as usize].get_or_init(|| {
            let (textures, tables) = self.filtered(filter);
            built.tables = tables;
            textures
        });
        let wants_area = filter.wants_area() && textures.iter().any(Option::is_some);
        let charts =
            if wants_area { self.charts.get_or_init(|| self.charted()) } else { &self.no_charts };
        let around_lights =
            self.around_lights.get_or_init(|| self.volumes.around_lights(self.scene, accel));
        built.table_time = started.elapsed();
        let volumes = &self.volumes;
        let scene = self.scene;
        let has_masks = scene.has_masks();
        let view = View::Whole;
        let shader = Shader {
            scene,
            accel,
            textures,
            charts,
            wants_area,
            volumes,
            around_lights,
            has_masks,
            view,
        };
        (shader, built)
    }

    /// Returns a structure that finds the hits of rays.
    #[must_use]
    pub fn accel(&self, structure: Structure) -> &Accel<'a> {
        self.structures[structure as usize].get_or_init(|| self.structured(structure))
    }

    /// Builds a structure over all objects.
    fn structured(&self, structure: Structure) -> Accel<'a> {
        let shapes = self.scene.objects.iter().map(|object| &object.shape);
        let planted = match structure {
            Structure::Bvh => std::mem::take(&mut self.stock().trees),
            Structure::Grid | Structure::None => Planted::default(),
        };
        Accel::build_over(shapes.collect(), structure, planted)
    }

    /// Prepares the textures that surfaces show for a filter. Returns them with the number of tables and pyramids that were
    /// built.
    fn filtered(&self, filter: Filter) -> (Vec<Option<FilteredTexture<'a>>>, u64) {
        let shown = self.scene.shown_textures();
        let all = &self.scene.textures;
        let kept = self.stock().take_tables(all, filter);
        let textures = all.par_iter().zip(&shown).zip(kept).map(|((texture, &shown), kept)| {
            let is_kept = kept.is_some();
            let texture =
                shown.then(|| kept.unwrap_or_else(|| FilteredTexture::new(texture, filter)));
            let has_table = texture.as_ref().is_some_and(|texture| texture.table_bytes() > 0);
            (texture, u64::from(has_table && !is_kept))
        });
        let (textures, built): (Vec<_>, Vec<u64>) = textures.unzip();
        (textures, built.into_iter().sum())
    }

    /// Builds the charts of the objects that show a picture. Those of other objects stay empty.
    fn charted(&self) -> Vec<Charts> {
        let objects = self.scene.objects.iter().enumerate();
        objects
            .map(|(number, object)| {
                let textured = object.parts.iter().any(|part| part.picture().is_some());
                let kept = || self.stock().take_charts(number);
                let charts = || kept().unwrap_or_else(|| object.shape.charts());
                if textured { charts() } else { Charts::default() }
            })
            .collect()
    }
}
