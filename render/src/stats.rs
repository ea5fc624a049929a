//! Statistics of rendering one picture.

use crate::shade::ShadeCounts;
use crate::trace::RayCounts;
use serde::Serialize;
use std::fmt;
use std::time::Duration;

/// Counts, memory and wall-clock time per stage of one picture.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Stats {
    /// Rays from the eye. With an area filter they include the rays of the halos around tiles.
    pub primary_rays: u64,
    /// Mirrored rays.
    pub reflected_rays: u64,
    /// Refracted rays.
    pub refracted_rays: u64,
    /// Shadow rays sent to lights.
    pub shadow_rays: u64,
    /// Primary, reflected and refracted rays that hit a surface.
    pub hits: u64,
    /// Texture averages over an area.
    pub texture_areas: u64,
    /// Texture lookups at a point.
    pub texture_points: u64,
    /// Texels or table entries read for averages and lookups together. An average over an area
    /// counts the nominal number of reads ([`crate::filter::FilteredTexture::reads`]).
    pub texels: u64,
    /// Lookups of solid textures.
    pub solid_points: u64,
    /// Memory of the structure that finds the hits, in bytes ([`crate::accel::Accel::bytes`]).
    pub accel_bytes: u64,
    /// Structures built for this picture to find hits: 0 or 1. Pictures of one prepared scene share
    /// them.
    pub structures: u64,
    /// Prefiltered tables and pyramids built for this picture.
    pub tables: u64,
    /// Memory of the tables and pyramids that the picture uses, in bytes.
    pub table_bytes: u64,
    /// Memory of the noise lattice, in bytes; 0 if nothing in the scene uses noise.
    pub lattice_bytes: u64,
    /// Pixels that were NaN or infinite and were made black. There should be none.
    pub not_finite: u64,
    /// Pixels that were left out because the picture was ended early.
    pub unfinished: u64,
    /// Rays from the eye of the audit, and of pixels that were tried alone for an accuracy.
    pub audit_rays: u64,
    /// Time to read the scene, its meshes and its textures.
    #[serde(rename = "read_seconds", serialize_with = "seconds")]
    pub read_time: Duration,
    /// Time to build the structure that finds the hits.
    #[serde(rename = "accel_seconds", serialize_with = "seconds")]
    pub accel_time: Duration,
    /// Time to build tables, pyramids and charts.
    #[serde(rename = "table_seconds", serialize_with = "seconds")]
    pub table_time: Duration,
    /// Time to trace and shade.
    #[serde(rename = "picture_seconds", serialize_with = "seconds")]
    pub picture_time: Duration,
    /// Time of the audit, and of pixels that were tried alone for an accuracy.
    #[serde(rename = "audit_seconds", serialize_with = "seconds")]
    pub audit_time: Duration,
    /// Time to encode and write the file.
    #[serde(rename = "write_seconds", serialize_with = "seconds")]
    pub write_time: Duration,
}

fn seconds<S: serde::Serializer>(time: &Duration, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(time.as_secs_f64())
}

impl Stats {
    /// Adds the counts of one tile.
    pub fn add(&mut self, rays: &RayCounts, shading: &ShadeCounts) {
        self.primary_rays += rays.primary;
        self.reflected_rays += rays.reflected;
        self.refracted_rays += rays.refracted;
        self.hits += rays.hits;
        self.shadow_rays += shading.shadow;
        self.texture_areas += shading.areas;
        self.texture_points += shading.points;
        self.texels += shading.texels;
        self.solid_points += shading.solids;
    }

    /// Adds the counts and times of the first rays of the same picture.
    pub fn include(&mut self, first: &Self) {
        self.primary_rays += first.primary_rays;
        self.reflected_rays += first.reflected_rays;
        self.refracted_rays += first.refracted_rays;
        self.shadow_rays += first.shadow_rays;
        self.hits += first.hits;
        self.texture_areas += first.texture_areas;
        self.texture_points += first.texture_points;
        self.texels += first.texels;
        self.solid_points += first.solid_points;
        self.accel_bytes = first.accel_bytes;
        self.structures += first.structures;
        self.tables += first.tables;
        self.table_bytes = first.table_bytes;
        self.lattice_bytes = first.lattice_bytes;
        self.accel_time += first.accel_time;
        self.table_time += first.table_time;
        self.picture_time += first.picture_time;
    }
}

impl fmt::Display for Stats {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = [
            ("primary rays", self.primary_rays),
            ("reflected rays", self.reflected_rays),
            ("refracted rays", self.refracted_rays),
            ("shadow rays", self.shadow_rays),
            ("hits", self.hits),
            ("texture areas", self.texture_areas),
            ("texture points", self.texture_points),
            ("texels read", self.texels),
            ("solid points", self.solid_points),
            ("accel bytes", self.accel_bytes),
            ("structures built", self.structures),
            ("tables built", self.tables),
            ("table bytes", self.table_bytes),
            ("lattice bytes", self.lattice_bytes),
        ];
        for (name, count) in counts {
            writeln!(f, "{name:<16}{count:>14}")?;
        }
        if self.audit_rays > 0 {
            writeln!(f, "{:<16}{:>14}", "audit rays", self.audit_rays)?;
        }
        if self.not_finite > 0 {
            writeln!(f, "{:<16}{:>14}", "not finite", self.not_finite)?;
        }
        if self.unfinished > 0 {
            writeln!(f, "{:<16}{:>14}", "unfinished", self.unfinished)?;
        }
        let times = [
            ("read", self.read_time),
            ("accelerate", self.accel_time),
            ("build tables", self.table_time),
            ("trace and shade", self.picture_time),
            ("write", self.write_time),
        ];
        let audit = (self.audit_time > Duration::ZERO).then_some(("audit", self.audit_time));
        for (name, time) in times.into_iter().chain(audit) {
            writeln!(f, "{name:<16}{:>12.3} s", time.as_secs_f64())?;
        }
        Ok(())
    }
}
