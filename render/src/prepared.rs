//! A scene made ready for any number of pictures.
//!
//! A [`Prepared`] scene keeps what does not depend on a picture: the structure that finds the hits, the
//! volumes that transparent objects bound, how texture coordinates hang together, and the tables of each
//! filter. Volumes are found at once. The rest is built when the first picture needs it and stays for the
//! pictures that follow, so that the modes of a page, the two pictures of a truth, the blocks of a refined
//! one and `--pixel` share it.

use crate::accel::{Accel, Structure};
use crate::filter::{Filter, FilteredTexture};
use crate::scene::Scene;
use crate::shade::Shader;
use crate::shape::Charts;
use crate::trace::medium::Media;
use crate::trace::volume::Volumes;
use rayon::prelude::*;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// A scene, and what pictures of it share.
///
/// Pictures may be made one after another from any threads. Of two that start at the same time from tasks
/// of one rayon pool, one may wait for what the other builds, and the pool must have a thread left for that:
/// start them from different pools, or one after the other.
#[derive(Debug)]
pub struct Prepared<'a> {
    scene: &'a Scene,
    volumes: Volumes,
    /// By [`Structure::ALL`].
    structures: [OnceLock<Accel<'a>>; Structure::ALL.len()],
    /// By [`Filter::ALL`]; for each texture of the scene, nothing if no surface shows it.
    textures: [OnceLock<Vec<Option<FilteredTexture<'a>>>>; Filter::ALL.len()],
    /// For each object how its texture coordinates hang together, for filters that look at areas.
    charts: OnceLock<Vec<Charts>>,
    /// For each object nothing, for filters that look at points.
    no_charts: Vec<Charts>,
    /// For each light the volumes that it lies in.
    around_lights: OnceLock<Vec<Media>>,
}

/// What was built for one picture, because no picture before it needed it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Built {
    /// Structures that find hits: 0 or 1.
    pub structures: u64,
    /// Time to build it.
    pub structure_time: Duration,
    /// Tables and pyramids of textures.
    pub tables: u64,
    /// Time to build tables and charts.
    pub table_time: Duration,
}

impl<'a> Prepared<'a> {
    /// Prepares a scene. Only its volumes are found here.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            volumes: Volumes::of(scene),
            structures: std::array::from_fn(|_| OnceLock::new()),
            textures: std::array::from_fn(|_| OnceLock::new()),
            charts: OnceLock::new(),
            no_charts: vec![Charts::default(); scene.objects.len()],
            around_lights: OnceLock::new(),
        }
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

    /// A shader for pictures of one structure and filter, and what had to be built for it.
    ///
    /// Runs on the threads of the current rayon pool.
    #[must_use]
    pub fn shader(&self, structure: Structure, filter: Filter) -> (Shader<'_>, Built) {
        let mut built = Built::default();
        let started = Instant::now();
        let accel = self.structures[structure as usize].get_or_init(|| {
            built.structures = 1;
            let shapes = self.scene.objects.iter().map(|object| &object.shape);
            Accel::build(shapes.collect(), structure)
        });
        built.structure_time = started.elapsed();
        let started = Instant::now();
        let textures = self.textures[filter as usize].get_or_init(|| {
            let textures = self.filtered(filter);
            let tables = textures.iter().flatten().filter(|texture| texture.table_bytes() > 0);
            built.tables = tables.count() as u64;
            textures
        });
        // Only neighbours that are averaged need to be unwrapped.
        let charts = if filter.wants_area() {
            self.charts.get_or_init(|| self.charted())
        } else {
            &self.no_charts
        };
        let around_lights =
            self.around_lights.get_or_init(|| self.volumes.around_lights(self.scene, accel));
        built.table_time = started.elapsed();
        let volumes = &self.volumes;
        (Shader { scene: self.scene, accel, textures, charts, volumes, around_lights }, built)
    }

    /// The textures that surfaces show, ready for a filter.
    fn filtered(&self, filter: Filter) -> Vec<Option<FilteredTexture<'a>>> {
        let shown = self.scene.shown_textures();
        let textures = self.scene.textures.par_iter().zip(&shown);
        textures
            .map(|(texture, &shown)| shown.then(|| FilteredTexture::new(texture, filter)))
            .collect()
    }

    /// The charts of the objects that show a picture; those of others are left empty.
    fn charted(&self) -> Vec<Charts> {
        let objects = self.scene.objects.iter();
        objects
            .map(|object| {
                let textured = object.parts.iter().any(|part| part.picture().is_some());
                if textured { object.shape.charts() } else { Charts::default() }
            })
            .collect()
    }
}
