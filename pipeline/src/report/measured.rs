//! What a report measures: plain numbers, before they become tables, curves and sentences.

use crate::compare::Difference;
use render::filter::Filter;
use render::{Picture, Sampling};
use serde::Serialize;

/// All that was measured of the pages.
#[derive(Debug)]
pub struct Measured {
    /// The pages, in the order asked for.
    pub pages: Vec<PageMeasured>,
    /// Threads that made each picture.
    pub threads: usize,
    /// Whether it was made in haste: small pictures, few methods.
    pub quick: bool,
    /// What else was measured, of the modeler and the filters by themselves.
    pub tables: Vec<Table>,
}

/// Measurements that accompany those of the pages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// What its file is called, without the extension.
    pub name: &'static str,
    /// What it is about, in a line.
    pub title: String,
    /// What was measured, in a few sentences.
    pub about: String,
    /// The command that measures it again, when it was measured elsewhere than here.
    pub command: Option<&'static str>,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
    /// A drawing of it: an SVG document.
    pub drawing: Option<&'static str>,
}

/// A page: its truth, its regions, and what each method made of it.
#[derive(Debug)]
pub struct PageMeasured {
    /// The job's name.
    pub name: String,
    /// The job's title.
    pub title: String,
    /// Pixels across and down.
    pub size: (u32, u32),
    /// The picture that the others are held against.
    pub truth: Truth,
    /// Parts of the picture that are judged by themselves; those without pixels are left out.
    pub regions: Vec<Region>,
    /// One for each method, cheapest first within a filter.
    pub trials: Vec<Trial>,
}

/// A picture made of so many rays that it counts as right, and how right it is.
#[derive(Debug)]
pub struct Truth {
    /// The mean of the pictures of two seeds, in linear light.
    pub picture: Picture,
    /// Jittered, unfiltered rays in each pixel, along each side, for each of the two seeds: at least.
    pub samples: u32,
    /// The same where the picture is hardest: at most.
    pub most_samples: u32,
    /// Half the root mean square difference between the pictures of the two seeds: about the error
    /// of their mean.
    pub noise: f64,
    /// The same within each of the page's regions, in their order.
    pub noise_by_region: Vec<f64>,
    /// Whether the pictures of the two seeds differ by at most a fifth of the smallest error reported of
    /// the whole picture.
    pub settled: bool,
}

/// Pixels that have something in common.
#[derive(Debug, Clone)]
pub struct Region {
    /// One of `far floor`, `in mirrors`, `through glass`, `silhouettes`.
    pub name: &'static str,
    /// For each pixel, row by row from the top, whether it belongs.
    pub mask: Vec<bool>,
}

/// A way to make a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Method {
    /// How textures are averaged.
    pub filter: Filter,
    /// How a pixel is made of rays.
    pub sampling: Sampling,
}

/// A picture by a method: what it cost, and how wrong it is.
#[derive(Debug)]
pub struct Trial {
    /// How it was made.
    pub method: Method,
    /// Its cost.
    pub cost: Cost,
    /// Its error over the whole picture. Of the root mean square, here and by region, the noise of the truth
    /// is taken out.
    pub whole: Difference,
    /// Its error in each of the page's regions, in their order.
    pub by_region: Vec<Difference>,
    /// The picture, where it is to be shown.
    pub picture: Option<Picture>,
}

/// What a picture cost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cost {
    /// Wall-clock time of tables, structure and picture, without reading and writing; in seconds.
    pub wall: f64,
    /// Processor time of the same, over all threads; in seconds.
    pub cpu: f64,
    /// Of `wall`, the time for tables and pyramids of textures.
    pub tables: f64,
    /// Rays of all kinds, shadows too.
    pub rays: u64,
    /// Texels or table entries read.
    pub texels: u64,
    /// Most memory held at once beyond that of the scene, in bytes.
    pub peak_bytes: usize,
}
