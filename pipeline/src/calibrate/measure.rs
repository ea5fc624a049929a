//! Requests errors of one scene, and compares what was stated with what is true.

use cpu_time::ProcessTime;
use render::accuracy::census::Census;
use render::accuracy::{Request, audit};
use render::film::{PixelFilter, THRESHOLD};
use render::filter::Filter;
use render::{Prepared, Sampling, Scene, Settings};

/// The requested errors, root mean square in linear light.
pub const REQUESTS: [f64; 4] = [0.05, 0.02, 0.01, 0.005];

/// Standard deviations of the truth by which an error must exceed a bound to count as above it
/// for certain.
const CERTAIN: f64 = 3.0;

/// A picture that was made for a request, or by a method and then audited.
#[derive(Debug, Clone)]
pub struct Case {
    /// The requested error; `None` for an audit without a request.
    pub requested: Option<f64>,
    /// Rays of the picture, in words.
    pub method: String,
    /// The stated error.
    pub stated: f64,
    /// The stated bound.
    pub bound: f64,
    /// True if the request was reported as not reached.
    pub missed: bool,
    /// The true error, by brute force on all pixels.
    pub truth: f64,
    /// True if the true error is above the bound, by the estimate.
    pub above: bool,
    /// True if the true error is above the bound by more than the noise of the truth.
    pub certainly_above: bool,
    /// Rays from the eye per pixel, for the picture and for the audit.
    pub rays: [f64; 2],
    /// Processor time of the picture and its audit, in seconds.
    pub seconds: f64,
}

/// All cases of a scene.
#[derive(Debug, Clone)]
pub struct SceneCases {
    /// Name of the scene.
    pub name: String,
    /// The cases, those of [`REQUESTS`] first.
    pub cases: Vec<Case>,
}

/// Methods whose pictures are audited without a request.
fn methods() -> [(&'static str, Filter, Sampling); 3] {
    let area = |threshold| Sampling::Area { samples: 1, pixel_filter: PixelFilter::Box, threshold };
    [
        ("thesis, tent", Filter::Tent, Sampling::regular(1)),
        ("exact, whole pixels", Filter::Exact, area(None)),
        ("exact", Filter::Exact, area(Some(THRESHOLD))),
    ]
}

/// Measures a scene in pictures of `side` x `side` pixels.
#[must_use]
pub fn scene(name: &str, scene: &Scene, side: u32) -> SceneCases {
    let prepared = Prepared::new(scene);
    let base = Settings::new(side, side, Filter::Exact);
    // Half of the smallest request: the noise of the truth is then far below it.
    let census = Census::take(&prepared, &base, 0.5 * REQUESTS[REQUESTS.len() - 1]);
    let mut cases = Vec::new();
    for requested in REQUESTS {
        let started = ProcessTime::now();
        let reached = Request::new(&prepared, &base, PixelFilter::Box).reach(requested);
        let seconds = started.elapsed().as_secs_f64();
        let method = in_words(reached.settings.sampling);
        let statement = &reached.statement;
        cases.push(case(&census, Some(requested), method, statement, &reached.picture, seconds));
    }
    for (method, filter, sampling) in methods() {
        let settings = Settings { sampling, ..Settings::new(side, side, filter) };
        let started = ProcessTime::now();
        let (picture, mut stats) = render::render(&prepared, &settings, &|_, _| {});
        let statement = audit(&prepared, &settings, &picture, &mut stats);
        let seconds = started.elapsed().as_secs_f64();
        cases.push(case(&census, None, method.into(), &statement, &picture, seconds));
    }
    SceneCases { name: name.into(), cases }
}

fn case(
    census: &Census,
    requested: Option<f64>,
    method: String,
    statement: &render::accuracy::Statement,
    picture: &render::Picture,
    seconds: f64,
) -> Case {
    let squared = census.squared_error(picture);
    let over = squared.mean - statement.bound * statement.bound;
    Case {
        requested,
        method,
        stated: statement.error,
        bound: statement.bound,
        missed: statement.missed.is_some(),
        truth: squared.mean.max(0.0).sqrt(),
        above: over > 0.0,
        certainly_above: over > CERTAIN * squared.deviation,
        rays: [statement.rays, statement.audit],
        seconds,
    }
}

/// Returns the rays of a pixel in words.
fn in_words(sampling: Sampling) -> String {
    match sampling {
        Sampling::Area { samples, threshold: Some(threshold), .. } => {
            format!("{samples} x {samples}, split {threshold}")
        }
        Sampling::Area { samples, .. } => format!("{samples} x {samples}, whole"),
        Sampling::Grid { samples, .. } => format!("thesis, {samples} x {samples}"),
        Sampling::Supersample(_) => "thesis, nine".into(),
    }
}
