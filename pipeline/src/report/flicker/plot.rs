//! Plots a pan: the changing part of the error against processor time.

use super::{PanMeasured, Trial, sixteen_rays};
use crate::number::{error, seconds};
use crate::report::plot::{Axis, Band, Chart, Look, Point, Series, Unit};
use render::filter::Filter;

/// Part of the changing part of 16 rays that is the goal for exact averages at equal time.
pub(super) const GOAL: f64 = 0.1;

impl PanMeasured {
    /// Returns the plot of the pan.
    #[must_use]
    pub fn chart(&self) -> Chart {
        let trials = || self.trials.iter();
        let changing = |trial: &Trial| trial.parts.changing.rms;
        let least = trials().map(|trial| trial.parts.changing.least).fold(f64::INFINITY, f64::min);
        let goal = self.of(sixteen_rays()).map(|rays| GOAL * changing(rays));
        let up = trials().map(changing).chain(goal);
        let of = |filter: Filter| trials().filter(move |trial| trial.method.filter == filter);
        let filters = [Filter::Point, Filter::Mip, Filter::Tent, Filter::Bilinear, Filter::Exact];
        let mut series: Vec<Series> = Vec::new();
        for filter in filters {
            let look = Look::filter(filter);
            let splits =
                |trial: &&Trial| trial.method.areas().is_none_or(|(samples, _)| samples == 1);
            let (line, alone): (Vec<&Trial>, Vec<&Trial>) = of(filter).partition(splits);
            let name = match filter {
                Filter::Bilinear => "16 rays".to_string(),
                filter => filter.to_string(),
            };
            let joined = filter == Filter::Exact;
            let points = line.into_iter().map(point).collect();
            series.push(Series { name, look, joined, points });
            let points = alone.into_iter().map(point).collect();
            series.push(Series { name: String::new(), look: look.hollow(), joined: false, points });
        }
        Chart {
            title: Some(format!("{}: the part of the error that changes", self.title)),
            across: Axis::around(
                "processor time of a frame",
                Unit::Seconds,
                trials().map(|trial| trial.cpu),
            ),
            up: Axis::around("changing part of the error, RMS in linear light", Unit::Plain, up),
            series,
            band: goal.map(|goal| Band { up_to: goal, label: "a tenth of that of 16 rays".into() }),
            front: Vec::new(),
            key: vec![(
                Look::filter(Filter::Exact).hollow(),
                format!("2 x 2 areas; noise {}", error(least)),
            )],
        }
    }
}

fn point(trial: &Trial) -> Point {
    let (x, y) = (trial.cpu, trial.parts.changing.rms);
    let name = format!("{}: changing part {}, {}", trial.method.name(), error(y), seconds(x));
    let note = trial.method.areas().and_then(|(_, threshold)| Some(threshold?.to_string()));
    Point { x, y, name, note }
}
