//! The results of a report's measurements as plain numbers, before they become tables, curves and
//! sentences.

use compare::Difference;
use render::filter::Filter;
use render::{Picture, Sampling};
use serde::Serialize;

/// All measurements of a report.
#[derive(Debug)]
pub struct Measured {
    /// The pages, in the requested order.
    pub pages: Vec<PageMeasured>,
    /// Number of threads that rendered each picture.
    pub threads: usize,
    /// True if the report was made quickly, with small pictures and few methods.
    pub quick: bool,
}

/// A page with its truth, its regions, and the trial of each method.
#[derive(Debug)]
pub struct PageMeasured {
    /// The job's name.
    pub name: String,
    /// The job's title.
    pub title: String,
    /// Width and height of the pictures, in pixels.
    pub size: (u32, u32),
    /// The truth, with which all pictures are compared.
    pub truth: Truth,
    /// Parts of the picture that are judged separately; those without pixels are left out.
    pub regions: Vec<Region>,
    /// One trial for each method: those on the thesis's lattice by filter, then those by areas.
    pub trials: Vec<Trial>,
}

/// A picture of so many rays that it counts as right, and its remaining noise.
#[derive(Debug)]
pub struct Truth {
    /// The mean of the pictures of two seeds, in linear RGB.
    pub picture: Picture,
    /// Least number of jittered, unfiltered rays along each side of a pixel, for each of the two seeds.
    pub samples: u32,
    /// Largest number of such rays, in the noisiest block of the picture.
    pub most_samples: u32,
    /// Half the root mean square difference between the pictures of the two seeds, in linear light.
    /// This number estimates the error of the mean of the two pictures.
    pub noise: f64,
    /// The noise within each of the page's regions, in their order.
    pub noise_by_region: Vec<f64>,
    /// True if the pictures of the two seeds differ by at most a fifth of the smallest error
    /// reported for the whole picture.
    pub settled: bool,
    /// True if the picture was given. It has no noise then, and the numbers of its rays are 0.
    pub given: bool,
}

/// A set of pixels with a common property.
#[derive(Debug, Clone)]
pub struct Region {
    /// One of `far floor`, `in mirrors`, `through glass`, `silhouettes`.
    pub name: &'static str,
    /// For each pixel, row by row from the top, whether the region contains it.
    pub mask: Vec<bool>,
}

/// A method of rendering a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// The texture filter.
    pub filter: Filter,
    /// The rays of a pixel, and the areas that they stand for.
    pub sampling: Sampling,
}

/// The trial of a method: its picture, the cost, and the error.
#[derive(Debug)]
pub struct Trial {
    /// The method that rendered the picture.
    pub method: Method,
    /// The cost of the picture.
    pub cost: Cost,
    /// The error over the whole picture. The noise of the truth is subtracted from all root mean
    /// squares, here and in `by_region`.
    pub whole: Difference,
    /// The error in each of the page's regions, in their order.
    pub by_region: Vec<Difference>,
    /// The picture, if the report shows it.
    pub picture: Option<Picture>,
}

impl Cost {
    /// Returns the processor time of the first picture with `scale` times as many pixels, in seconds. What is spent
    /// once stays, and the rest grows with the pixels.
    #[must_use]
    pub fn cpu_at(&self, scale: f64) -> f64 {
        self.once_cpu + scale * (self.cpu - self.once_cpu).max(0.0)
    }
}

/// The cost of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cost {
    /// Wall-clock time of tables, structure and picture, without reading and writing; in seconds.
    pub wall: f64,
    /// Processor time of the same work over all threads, in seconds.
    pub cpu: f64,
    /// The part of `wall` that is spent once for a scene and a method, however large its pictures are and however
    /// many: tables, structure and charts; in seconds.
    pub once_wall: f64,
    /// The part of `cpu` that is spent once, in seconds.
    pub once_cpu: f64,
    /// The part of `once_wall` that texture tables and pyramids took, in seconds.
    pub tables: f64,
    /// Number of rays from the eye.
    pub primary_rays: u64,
    /// Number of rays of all kinds, including shadow rays.
    pub rays: u64,
    /// Number of texels or table entries read.
    pub texels: u64,
    /// Most memory held at once beyond that of the scene, in bytes.
    pub peak_bytes: usize,
}
