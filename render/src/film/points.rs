//! Single rays without areas: the brute force that other pictures are measured by.

use super::Settings;
use super::exposure::Exposure;
use crate::color::Color;
use crate::filter::Filter;
use crate::footprint::Alone;
use crate::prepared::Prepared;
use crate::shade::ShadeWork;
use crate::trace::tree::IntersectionTree;
use crate::trace::{RayCounts, Tracer};
use glam::DVec2;

/// Traces and shades single rays. Textures are interpolated and not averaged.
#[derive(Debug)]
pub struct Points<'a> {
    exposure: Exposure<'a>,
}

/// Memory for the work on one ray after another, and their counts.
#[derive(Debug, Default)]
pub struct PointWork {
    tree: IntersectionTree,
    rays: RayCounts,
    shading: ShadeWork,
}

impl PointWork {
    /// Rays from the eye so far.
    #[must_use]
    pub fn rays(&self) -> u64 {
        self.rays.primary
    }
}

impl<'a> Points<'a> {
    /// Takes scene and camera. Of the settings, the size of the film and the structure are used.
    #[must_use]
    pub fn new(prepared: &'a Prepared<'_>, settings: &'a Settings) -> Self {
        let (shader, _) = prepared.shader(settings.accel, Filter::Bilinear);
        let tracer = Tracer::new(prepared.scene(), shader.accel, shader.volumes);
        let tracer = tracer.seen_by(settings.camera);
        Self { exposure: Exposure { tracer, shader, settings, go_on: &|| true } }
    }

    /// Returns the light at a position on the film, in pixels from the upper left corner, as linear
    /// RGB.
    pub fn color(&self, position: DVec2, work: &mut PointWork) -> Color {
        self.exposure.trace(position, &mut work.tree, &mut work.rays);
        let sight = Alone::of(&work.tree);
        self.exposure.shader.shade(&sight, &mut work.shading, &mut ())
    }
}
