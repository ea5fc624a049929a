//! A picture with one ray for each cell, from which pictures with any threshold are made.
//!
//! The rays of the cells do not depend on the threshold. A picture that is wanted with several
//! thresholds, as the search for an accuracy wants it, traces them once. Single pixels can be
//! finished alone, and they equal those of the whole picture to the last bit.

use super::area::{Area, Base};
use super::exposure::{Exposed, Exposure, Film};
use super::lattice::Lattice;
use super::{
    Course, Crop, GoOn, Picture, PixelFilter, Sampling, Settings, TILE_SAMPLES, render_in_tiles,
    with_exposure,
};
use crate::prepared::Prepared;
use crate::stats::Stats;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A picture with one ray for each cell, and the estimated errors of its pixels.
#[derive(Debug)]
pub struct BasePicture<'p, 's> {
    prepared: &'p Prepared<'s>,
    settings: Settings,
    tiles: Vec<(Crop, Base)>,
    /// The picture, of which no cell is split.
    pub picture: Picture,
    /// Estimated error of each pixel of [`BasePicture::picture`], root mean square of linear RGB.
    pub errors: Vec<f32>,
    /// For each pixel whether edges cause its estimated error.
    pub edges: Vec<bool>,
    /// Counts and times of all work on the picture so far.
    pub stats: Stats,
}

/// A pixel that was finished alone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pixel {
    /// Colour as in the picture, linear RGB.
    pub color: [f32; 3],
    /// Rays from the eye that the pixel takes in the picture.
    pub rays: u64,
    /// Rays from the eye that were traced now. They include those around the pixel.
    pub traced: u64,
}

impl<'p, 's> BasePicture<'p, 's> {
    /// Bytes that are kept for each pixel besides its colour.
    #[must_use]
    pub fn of_pixel(pixel_filter: PixelFilter) -> u64 {
        let cells = Area::new(1, pixel_filter, None).cells().per_pixel().unsigned_abs().pow(2);
        cells * Base::OF_CELL + size_of::<f32>() as u64
    }

    /// Traces and shades one ray for each cell: one in each pixel, or four under a pixel filter that
    /// reaches beyond the pixel. The sampling of `settings` is not used, and without a least weight
    /// all rays are followed. Once the course does not go on, the tiles that follow are left out, and the
    /// result is of no use but for its picture.
    pub fn new(
        prepared: &'p Prepared<'s>,
        settings: &Settings,
        pixel_filter: PixelFilter,
        course: &Course<'_>,
    ) -> Self {
        let sampling = Sampling::Area { samples: 1, pixel_filter, threshold: None };
        let least_weight = Some(settings.least_weight.unwrap_or(0.0));
        let settings = Settings { sampling, least_weight, ..settings.clone() };
        let area = Area::new(1, pixel_filter, None);
        let (tiles, picture, (errors, edges), stats) =
            with_exposure(prepared, &settings, course.go_on, |shared, stats| {
                let started = Instant::now();
                let crop = Crop::of(&settings);
                let tiles = crop.tiles(shared.tile_side(TILE_SAMPLES));
                let film = Mutex::new(Film::new(crop, Picture::of(&settings), stats));
                let bases =
                    tiles.par_iter().with_max_len(1).filter(|_| (course.go_on)()).filter_map(
                        |tile| {
                            let mut exposed = shared.unexposed(tile);
                            let base = area.base(shared, tile, &mut exposed, true);
                            area.develop(shared, &base, tile, &mut exposed, &mut ());
                            exposed.keep_work(&settings);
                            if !(course.go_on)() {
                                return None;
                            }
                            course.show(tile, &exposed);
                            let mut film = film.lock().unwrap_or_else(PoisonError::into_inner);
                            (course.progress)(film.take(tile, &exposed), tiles.len());
                            Some((*tile, base, exposed.work))
                        },
                    );
                let bases: Vec<_> = bases.collect();
                let (mut picture, mut stats) =
                    film.into_inner().unwrap_or_else(PoisonError::into_inner).developed();
                stats.not_finite = picture.remove_not_finite();
                let mut errors = vec![0.0; picture.pixels.len()];
                let mut edges = vec![false; errors.len()];
                let mut kept = Vec::with_capacity(bases.len());
                for (tile, base, work) in bases {
                    let places = tile.rows().flat_map(|y| tile.columns().map(move |x| (x, y)));
                    for ((x, y), work) in places.zip(&work) {
                        let place =
                            (y - crop.y) as usize * crop.width as usize + (x - crop.x) as usize;
                        errors[place] = work.error_squared.sqrt() as f32;
                        edges[place] = work.edge_squared > 0.5 * work.error_squared;
                    }
                    kept.push((tile, base));
                }
                stats.picture_time = started.elapsed();
                (kept, picture, (errors, edges), stats)
            });
        Self { prepared, settings, tiles, picture, errors, edges, stats }
    }

    /// The settings of the picture, with the sampling of its first rays.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the settings with another sampling.
    #[must_use]
    pub fn with(&self, sampling: Sampling) -> Settings {
        Settings { sampling, ..self.settings.clone() }
    }

    /// Returns the sampling's method if it has the same first rays as the picture.
    fn shares(&self, sampling: Sampling) -> Option<Area> {
        let area = area_of(sampling)?;
        let own = area_of(self.settings.sampling)?;
        (area.cells() == own.cells()).then_some(area)
    }

    /// Finishes pixels alone, each with the same sampling. Their columns and rows count in the whole
    /// picture and lie in the crop. They are of no use once `go_on` has returned false.
    #[must_use]
    pub fn pixels(
        &self,
        sampling: Sampling,
        pixels: &[(u32, u32)],
        go_on: &GoOn<'_>,
    ) -> Vec<Pixel> {
        // Layers are of no use here.
        let settings = Settings { layers: Vec::new(), ..self.with(sampling) };
        let Some(area) = self.shares(sampling) else {
            return pixels
                .par_iter()
                .map(|&pixel| {
                    if !go_on() {
                        return Pixel::default();
                    }
                    let (picture, work, rays) =
                        expose_pixel_with_work(self.prepared, &settings, pixel);
                    Pixel { color: picture.pixels[0], rays: work, traced: rays }
                })
                .collect();
        };
        let crop = Crop::of(&settings);
        let tile_side = self.tiles.first().map_or(1, |(tile, _)| tile.width.max(tile.height));
        let per_row = crop.width.div_ceil(tile_side);
        with_exposure(self.prepared, &settings, go_on, |shared, _| {
            let one = |&(x, y): &(u32, u32)| {
                if !go_on() {
                    return Pixel::default();
                }
                let index = (y - crop.y) / tile_side * per_row + (x - crop.x) / tile_side;
                let tile = Crop { x, y, width: 1, height: 1 };
                let exposed = self.developed(shared, area, &tile, &self.tiles[index as usize].1);
                let mut alone = Picture::black(1, 1);
                alone.place(0, 0, 1, &exposed.pixels);
                alone.remove_not_finite();
                let traced = exposed.rays.primary;
                Pixel { color: alone.pixels[0], rays: exposed.work[0].rays, traced }
            };
            pixels.par_iter().map(one).collect()
        })
    }

    fn developed(&self, shared: &Exposure<'_>, area: Area, tile: &Crop, base: &Base) -> Exposed {
        let mut exposed = shared.unexposed(tile);
        area.develop(shared, base, tile, &mut exposed, &mut ());
        exposed.keep_work(shared.settings);
        exposed
    }

    /// Returns whether a sampling has the first rays of this picture.
    #[must_use]
    pub fn shares_rays(&self, sampling: Sampling) -> bool {
        self.shares(sampling).is_some()
    }

    /// Makes the whole picture with a sampling. It equals the picture that [`super::render`] makes with
    /// [`BasePicture::with`], to the last bit. The counts are those of all work on both pictures.
    ///
    /// Once the course does not go on, the tiles that follow are left out. Their pixels are those of
    /// [`BasePicture::picture`], and [`Stats::unfinished`] is their number.
    #[must_use]
    pub fn finish(&self, sampling: Sampling, course: &Course<'_>) -> (Picture, Stats) {
        let settings = self.with(sampling);
        let Some(area) = self.shares(sampling) else {
            let over = (TILE_SAMPLES, self.picture.clone());
            let (picture, mut stats) = render_in_tiles(self.prepared, &settings, over, course);
            stats.include(&self.stats);
            return (picture, stats);
        };
        with_exposure(self.prepared, &settings, course.go_on, |shared, _| {
            let started = Instant::now();
            let crop = Crop::of(&settings);
            let film = Mutex::new(Film::new(crop, self.picture.clone(), Stats::default()));
            let tiles = self.tiles.par_iter().with_max_len(1).filter(|_| (course.go_on)());
            tiles.for_each(|(tile, base)| {
                let exposed = self.developed(shared, area, tile, base);
                if !(course.go_on)() {
                    return;
                }
                course.show(tile, &exposed);
                let done = film.lock().unwrap_or_else(PoisonError::into_inner).take(tile, &exposed);
                (course.progress)(done, self.tiles.len());
            });
            let (mut picture, mut stats) =
                film.into_inner().unwrap_or_else(PoisonError::into_inner).developed();
            stats.not_finite = picture.remove_not_finite();
            stats.picture_time = started.elapsed();
            let broken = stats.not_finite;
            stats.include(&self.stats);
            stats.not_finite = broken;
            (picture, stats)
        })
    }
}

/// Returns the method of area sampling.
fn area_of(sampling: Sampling) -> Option<Area> {
    match sampling {
        Sampling::Area { samples, pixel_filter, threshold } => {
            Some(Area::new(samples, pixel_filter, threshold))
        }
        Sampling::Grid { .. } | Sampling::Supersample(_) => None,
    }
}

/// The cells over which a pixel of a sampling averages, along one axis: edges in pixels from the
/// left side of the pixel, and for each cell its part of the weight.
///
/// A pixel filter is a smooth function, and samples see steps of it. Its steps are 1/64 of a pixel
/// here. The nine weights of the thesis have no such function and keep their own steps.
#[must_use]
pub fn aperture(sampling: Sampling) -> (Vec<f64>, Vec<f64>) {
    let fine = |pixel_filter| {
        let cells = if pixel_filter == PixelFilter::Box { 1 } else { 64 };
        (Lattice::grid(cells, super::Pattern::Regular, pixel_filter), 0.0)
    };
    let (lattice, shift) = match sampling {
        Sampling::Grid { pixel_filter, .. } | Sampling::Area { pixel_filter, .. } => {
            fine(pixel_filter)
        }
        // A sample of the nine lies in the middle of its cell.
        Sampling::Supersample(method) => (Lattice::supersample(method), -0.25),
    };
    let columns = lattice.under(0..1);
    let side = 1.0 / lattice.per_pixel() as f64;
    let edges = (columns.start..=columns.end).map(|x| x as f64 * side + shift).collect();
    let whole = lattice.whole() as f64;
    (edges, lattice.weights().iter().map(|&weight| weight as f64 / whole).collect())
}

/// Exposes one pixel, and returns its colour, the rays that it takes in a picture, and the rays that
/// were traced.
fn expose_pixel_with_work(
    prepared: &Prepared<'_>,
    settings: &Settings,
    (x, y): (u32, u32),
) -> (Picture, u64, u64) {
    with_exposure(prepared, settings, &|| true, |exposure, stats| {
        let tile = Crop { x, y, width: 1, height: 1 };
        let mut film = Film::new(tile, Picture::with_layers(1, 1, &settings.layers), stats);
        let exposed = exposure.expose(&tile, &mut ());
        film.take(&tile, &exposed);
        film.picture.remove_not_finite();
        (film.picture, exposed.work[0].rays, exposed.rays.primary)
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::scene;
    use super::*;
    use crate::film::{Layer, render};
    use crate::filter::Filter;

    /// Settings with a crop that cuts tiles, and with all layers.
    fn settings() -> Settings {
        let crop = Some(Crop { x: 3, y: 2, width: 70, height: 67 });
        Settings { crop, layers: Layer::ALL.into(), ..Settings::new(77, 70, Filter::Exact) }
    }

    fn silent() -> Course<'static> {
        Course::told(&|_, _| {})
    }

    /// One sampling that has the first rays of the base, and one that has not.
    fn samplings(pixel_filter: PixelFilter) -> [Sampling; 3] {
        [(1, Some(0.02)), (1, None), (2, Some(0.1))].map(|(samples, threshold)| Sampling::Area {
            samples,
            pixel_filter,
            threshold,
        })
    }

    #[test]
    fn a_finished_picture_is_the_rendered_one() {
        let scene = scene();
        let prepared = Prepared::new(&scene);
        for pixel_filter in [PixelFilter::Box, PixelFilter::Tent] {
            let base = BasePicture::new(&prepared, &settings(), pixel_filter, &silent());
            for sampling in samplings(pixel_filter) {
                let expected = render(&prepared, &base.with(sampling), &|_, _| {}).0;
                let finished = base.finish(sampling, &silent()).0;
                // The layer of estimated errors is empty in a picture that compares no neighbours.
                let unsplit = matches!(sampling, Sampling::Area { threshold: None, .. });
                assert!(finished.pixels == expected.pixels, "{sampling:?}");
                assert!(unsplit || finished == expected, "{sampling:?}");
            }
        }
    }

    #[test]
    fn pixels_alone_are_those_of_the_picture() {
        let scene = scene();
        let prepared = Prepared::new(&scene);
        let places: Vec<(u32, u32)> = (2..69).flat_map(|y| [(3, y), (40, y), (72, y)]).collect();
        for pixel_filter in [PixelFilter::Box, PixelFilter::Gaussian] {
            let base = BasePicture::new(&prepared, &settings(), pixel_filter, &silent());
            for sampling in samplings(pixel_filter) {
                let (picture, _) = base.finish(sampling, &silent());
                let rays = picture.channels.iter().find(|channel| channel.name == "rays.N");
                let pixels = base.pixels(sampling, &places, &|| true);
                for (&(x, y), pixel) in places.iter().zip(&pixels) {
                    let place = (y as usize - 2) * 70 + (x as usize - 3);
                    assert_eq!(pixel.color, picture.pixels[place], "{sampling:?}, {x},{y}");
                    assert_eq!(Some(pixel.rays as f32), rays.map(|rays| rays.values[place]));
                }
            }
        }
    }

    #[test]
    fn apertures_hold_all_weight() {
        let thesis = Sampling::Supersample(crate::film::Supersample::Image);
        for (sampling, from, to) in [
            (samplings(PixelFilter::Box)[0], 0.0, 1.0),
            (samplings(PixelFilter::Tent)[0], -0.5, 1.5),
            (samplings(PixelFilter::Gaussian)[0], -1.0, 2.0),
            (thesis, -0.25, 1.25),
        ] {
            let (edges, weights) = aperture(sampling);
            assert_eq!(edges.len(), weights.len() + 1);
            assert_eq!((edges[0], edges[edges.len() - 1]), (from, to), "{sampling:?}");
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{sampling:?}");
        }
    }
}
