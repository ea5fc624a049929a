//! A scene prepared for any number of pictures.
//!
//! A [`Prepared`] scene keeps the data that does not depend on a picture: the structure that finds
//! the hits, the volumes that transparent objects bound, the charts of texture coordinates, and the
//! tables of each filter. Volumes are found at once. The rest is built when the first picture needs
//! it and is kept for the pictures that follow. It is shared by the modes of a page, the two
//! pictures of a truth, the blocks of a refined picture, and `--pixel`.

use crate::accel::{Accel, Planted, Structure};
use crate::filter::{Filter, FilteredTexture, Table};
use crate::scene::Scene;
use crate::shade::{Shader, View};
use crate::shape::Charts;
use crate::trace::medium::Media;
use crate::trace::volume::Volumes;
use rayon::prelude::*;
use std::sync::{Mutex, OnceLock, PoisonError};
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
    /// Trees of meshes from an earlier scene, which the first structure takes.
    planted: Mutex<Planted>,
}

/// The data of a scene that another scene with the same textures can take over.
#[derive(Debug)]
pub struct Leftover {
    /// For each of [`Filter::ALL`], the tables by texture index.
    tables: [Option<Vec<Option<Table>>>; Filter::ALL.len()],
    planted: Planted,
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
        Self {
            scene,
            volumes: Volumes::of(scene),
            structures: std::array::from_fn(|_| OnceLock::new()),
            textures: std::array::from_fn(|_| OnceLock::new()),
            charts: OnceLock::new(),
            no_charts: vec![Charts::default(); scene.objects.len()],
            around_lights: OnceLock::new(),
            planted: Mutex::default(),
        }
    }

    /// Returns the data that a later scene can take over.
    #[must_use]
    pub fn leftover(self) -> Leftover {
        let tables = self.textures.map(|textures| {
            let textures = textures.into_inner()?;
            Some(textures.into_iter().map(|one| one.map(FilteredTexture::into_table)).collect())
        });
        let [trees, ..] = self.structures;
        let unused = self.planted.into_inner().unwrap_or_else(PoisonError::into_inner);
        let planted = trees.into_inner().map_or(unused, Accel::into_planted);
        Leftover { tables, planted }
    }

    /// Prepares a scene with what is left of an earlier one, whose textures have the same texels and are shown by the
    /// same surfaces. `is_same` tells of each object that is a mesh, or an instance of one, whether the mesh is that of the
    /// object with this index in the earlier scene.
    #[must_use]
    pub fn after(leftover: Leftover, scene: &'a Scene, is_same: impl Fn(usize) -> bool) -> Self {
        let mut prepared = Self::new(scene);
        let shown = scene.shown_textures();
        for (tables, own) in leftover.tables.into_iter().zip(&mut prepared.textures) {
            let Some(tables) = tables.filter(|tables| tables.len() == scene.textures.len()) else {
                continue;
            };
            if tables.iter().map(Option::is_some).ne(shown.iter().copied()) {
                continue;
            }
            let again = scene.textures.iter().zip(tables);
            let again = again.map(|(texture, table)| {
                table.map(|table| FilteredTexture::with_table(texture, table))
            });
            *own = OnceLock::from(again.collect::<Vec<_>>());
        }
        prepared.planted = Mutex::new(leftover.planted.of_same(is_same));
        prepared
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
            let textures = self.filtered(filter);
            let tables = textures.iter().flatten().filter(|texture| texture.table_bytes() > 0);
            built.tables = tables.count() as u64;
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
            Structure::Bvh => {
                std::mem::take(&mut *self.planted.lock().unwrap_or_else(PoisonError::into_inner))
            }
            Structure::Grid | Structure::None => Planted::default(),
        };
        Accel::build_over(shapes.collect(), structure, planted)
    }

    /// Prepares the textures that surfaces show for a filter.
    fn filtered(&self, filter: Filter) -> Vec<Option<FilteredTexture<'a>>> {
        let shown = self.scene.shown_textures();
        let textures = self.scene.textures.par_iter().zip(&shown);
        textures
            .map(|(texture, &shown)| shown.then(|| FilteredTexture::new(texture, filter)))
            .collect()
    }

    /// Builds the charts of the objects that show a picture. Those of other objects stay empty.
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
