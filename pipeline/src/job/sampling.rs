//! The keys of a mode that choose the rays of a pixel, and the areas that they stand for.

use super::requested::Requested;
use files::JsonError;
use files::json::Document;
use render::Sampling;
use render::accuracy;
use render::film::{
    MOST_SAMPLES, PatternName, PixelFilter, SPLITS, SamplingMethod, Supersample, THRESHOLD,
};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::borrow::Cow;
use std::fmt;

/// The keys of a mode that choose the rays of a pixel. Keys that are left out are `None`.
#[derive(Debug, Clone, Copy)]
pub(super) struct SamplingKeys {
    pub sampling: Option<SamplingMethod>,
    pub error: Option<Requested>,
    pub samples: Option<u32>,
    pub split: Option<Split>,
    pub pattern: Option<PatternName>,
    pub seed: Option<u64>,
    pub pixel_filter: Option<PixelFilter>,
    pub supersample: Option<Supersample>,
}

impl SamplingKeys {
    /// Returns number, position and weight of the rays of a pixel, for the mode at `path`.
    ///
    /// # Errors
    /// When a value is out of its range, or a key belongs to another sampling method.
    pub fn check(&self, document: &Document<'_>, path: &str) -> Result<Sampling, JsonError> {
        let fault =
            |(key, message): (&str, String)| document.fault(&format!("{path}.{key}"), message);
        if let Some(error) = self.error {
            accuracy::check(error.number()).map_err(|expected| {
                fault(("error", format!("found {}, {expected}", error.number())))
            })?;
            if let Some(other) = self.beside_error() {
                let message = format!("found error beside {other}, expected one of them");
                return Err(fault(("error", message)));
            }
        }
        let samples = self.samples.unwrap_or(1);
        if !(1..=MOST_SAMPLES).contains(&samples) {
            let message = format!("found {samples}, expected 1 to {MOST_SAMPLES}");
            return Err(fault(("samples", message)));
        }
        let sampling = match self.sampling.unwrap_or_default() {
            SamplingMethod::Area => self.area(samples),
            SamplingMethod::Thesis => self.thesis(samples),
        };
        sampling.map_err(fault)
    }

    /// Returns a key that chooses the rays as well as `error` does, if there is one.
    fn beside_error(&self) -> Option<&'static str> {
        let others = [
            ("samples", self.samples.is_some()),
            ("split", self.split.is_some()),
            ("sampling", self.sampling == Some(SamplingMethod::Thesis)),
            ("pattern", self.pattern.is_some()),
            ("seed", self.seed.is_some()),
            ("supersample", self.supersample.is_some()),
        ];
        others.into_iter().find(|(_, there)| *there).map(|(key, _)| key)
    }

    /// Returns area sampling, or the wrong key and a complaint about it.
    fn area(&self, samples: u32) -> Result<Sampling, (&'static str, String)> {
        let of_thesis = [
            ("pattern", self.pattern.is_some()),
            ("seed", self.seed.is_some()),
            ("supersample", self.supersample.is_some()),
        ];
        if let Some((key, _)) = of_thesis.into_iter().find(|(_, there)| *there) {
            let message = format!("found {key}, expected it beside \"sampling\": \"thesis\"");
            return Err((key, message));
        }
        let threshold = self.split.map_or(Some(THRESHOLD), |Split(threshold)| threshold);
        if let Some(found) = threshold.filter(|threshold| !SPLITS.contains(threshold)) {
            let (least, most) = (SPLITS.start(), SPLITS.end());
            let message = format!("found {found}, expected {least} to {most}, or \"none\"");
            return Err(("split", message));
        }
        let pixel_filter = self.pixel_filter.unwrap_or_default();
        Ok(Sampling::Area { samples, pixel_filter, threshold })
    }

    /// Returns the thesis's sampling, or the wrong key and a complaint about it.
    fn thesis(&self, samples: u32) -> Result<Sampling, (&'static str, String)> {
        if self.split.is_some() {
            return Err(("split", "found split, expected it beside \"sampling\": \"area\"".into()));
        }
        if let Some(nine) = self.supersample {
            let others = [
                ("samples", self.samples.is_some()),
                ("pattern", self.pattern.is_some()),
                ("seed", self.seed.is_some()),
                ("pixel_filter", self.pixel_filter.is_some()),
            ];
            return match others.into_iter().find(|(_, there)| *there) {
                Some((key, _)) => {
                    Err((key, format!("found {key} beside supersample, expected one of them")))
                }
                None => Ok(Sampling::Supersample(nine)),
            };
        }
        let Some(pattern) = self.pattern.unwrap_or_default().pattern(self.seed) else {
            let message = "found a seed, expected it beside \"pattern\": \"jitter\"";
            return Err(("seed", message.into()));
        };
        let pixel_filter = self.pixel_filter.unwrap_or_default();
        let wide = match pixel_filter {
            PixelFilter::Box => None,
            PixelFilter::Tent => Some("tent"),
            PixelFilter::Gaussian => Some("gaussian"),
        };
        match wide {
            Some(name) if samples < 2 => {
                let message = format!("found {name}, expected it beside samples of 2 or more");
                Err(("pixel_filter", message))
            }
            _ => Ok(Sampling::Grid { samples, pattern, pixel_filter }),
        }
    }
}

/// The value of `split`: a threshold, or `None` for `"none"`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Split(Option<f64>);

impl JsonSchema for Split {
    fn schema_name() -> Cow<'static, str> {
        "Split".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let (least, most) = (SPLITS.start(), SPLITS.end());
        json_schema!({
            "description": "A threshold, or `none`.",
            "anyOf": [{ "type": "number", "minimum": least, "maximum": most }, { "const": "none" }],
        })
    }
}

impl<'de> Deserialize<'de> for Split {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SplitVisitor)
    }
}

struct SplitVisitor;

impl Visitor<'_> for SplitVisitor {
    type Value = Split;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or \"none\"")
    }

    fn visit_f64<E: de::Error>(self, threshold: f64) -> Result<Split, E> {
        Ok(Split(Some(threshold)))
    }

    fn visit_u64<E: de::Error>(self, threshold: u64) -> Result<Split, E> {
        self.visit_f64(threshold as f64)
    }

    fn visit_i64<E: de::Error>(self, threshold: i64) -> Result<Split, E> {
        self.visit_f64(threshold as f64)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Split, E> {
        match text {
            "none" => Ok(Split(None)),
            _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::file::ModeFile;
    use super::*;
    use render::film::Pattern;

    /// Returns the sampling of a mode with these keys, or the complaint about them.
    fn sampling(keys: &str) -> Result<Sampling, String> {
        let text = format!(r#"{{"name": "a", "filter": "box", {keys}}}"#);
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let file: Result<ModeFile, JsonError> = document.parse();
        let sampling = file.and_then(|file| file.sampling_keys().check(&document, "mode"));
        sampling.map_err(|error| error.to_string())
    }

    fn area(samples: u32, pixel_filter: PixelFilter, threshold: Option<f64>) -> Sampling {
        Sampling::Area { samples, pixel_filter, threshold }
    }

    #[test]
    fn areas_are_the_default_and_take_a_threshold() {
        for (keys, samples, pixel_filter, threshold) in [
            (r#""accel": "bvh""#, 1, PixelFilter::Box, Some(THRESHOLD)),
            (r#""sampling": "area", "samples": 3"#, 3, PixelFilter::Box, Some(THRESHOLD)),
            (r#""split": "none", "pixel_filter": "tent""#, 1, PixelFilter::Tent, None),
            (r#""split": 0.02, "pixel_filter": "gaussian""#, 1, PixelFilter::Gaussian, Some(0.02)),
            (r#""split": 1"#, 1, PixelFilter::Box, Some(1.0)),
        ] {
            assert_eq!(sampling(keys), Ok(area(samples, pixel_filter, threshold)), "{keys}");
        }
    }

    #[test]
    fn an_error_stands_alone() {
        for keys in [r#""error": 0.01"#, r#""error": "8bit", "pixel_filter": "box""#] {
            assert_eq!(sampling(keys), Ok(area(1, PixelFilter::Box, Some(THRESHOLD))), "{keys}");
        }
        for (keys, expected) in [
            (r#""error": 0"#, "mode.error: found 0, expected a number above 0 and below 1"),
            (r#""error": 1e-9"#, "texels of 16 bits represent nothing finer"),
            (r#""error": "9bit""#, "expected a number, or \"8bit\""),
            (r#""error": 0.1, "samples": 2"#, "mode.error: found error beside samples"),
            (r#""error": 0.1, "split": 0.1"#, "mode.error: found error beside split"),
            (r#""error": 0.1, "sampling": "thesis""#, "mode.error: found error beside sampling"),
        ] {
            let complaint = sampling(keys).unwrap_err();
            assert!(complaint.contains(expected), "{keys}: {complaint}");
        }
    }

    #[test]
    fn the_sampling_of_the_thesis_is_chosen_by_its_name() {
        let thesis = |keys: &str| sampling(&format!(r#""sampling": "thesis"{keys}"#));
        assert_eq!(thesis(""), Ok(Sampling::regular(1)));
        let nine = Sampling::Supersample(Supersample::Rays);
        assert_eq!(thesis(r#", "supersample": "rays""#), Ok(nine));
        let keys = r#", "samples": 2, "pattern": "jitter", "seed": 9, "pixel_filter": "gaussian""#;
        let pattern = Pattern::Jitter { seed: 9 };
        let pixel_filter = PixelFilter::Gaussian;
        assert_eq!(thesis(keys), Ok(Sampling::Grid { samples: 2, pattern, pixel_filter }));
    }

    #[test]
    fn a_key_of_the_other_method_and_a_value_out_of_range_are_refused() {
        let beside_thesis = |key: &str| {
            format!("mode.{key}: found {key}, expected it beside \"sampling\": \"thesis\"")
        };
        for (keys, expected) in [
            (r#""pattern": "jitter""#, beside_thesis("pattern")),
            (r#""seed": 1"#, beside_thesis("seed")),
            (r#""sampling": "area", "supersample": "rays""#, beside_thesis("supersample")),
            (
                r#""sampling": "thesis", "split": "none""#,
                "mode.split: found split, expected it beside \"sampling\": \"area\"".into(),
            ),
            (r#""split": 0"#, "mode.split: found 0, expected 0.0001 to 1, or \"none\"".into()),
            (r#""split": -1.5"#, "mode.split: found -1.5, expected 0.0001 to 1".into()),
            (r#""split": "nine""#, "split: found the string \"nine\", expected a number".into()),
            (r#""split": []"#, "expected a number, or \"none\"".into()),
            (r#""sampling": "aera""#, "did you mean `area`?".into()),
            (r#""samples": 257"#, "mode.samples: found 257, expected 1 to 256".into()),
            (
                r#""sampling": "thesis", "seed": 1"#,
                "mode.seed: found a seed, expected it beside \"pattern\": \"jitter\"".into(),
            ),
            (
                r#""sampling": "thesis", "pixel_filter": "tent""#,
                "mode.pixel_filter: found tent, expected it beside samples".into(),
            ),
            (
                r#""sampling": "thesis", "pixel_filter": "gaussian", "samples": 1"#,
                "mode.pixel_filter: found gaussian, expected it beside samples".into(),
            ),
            (
                r#""sampling": "thesis", "supersample": "rays", "samples": 1"#,
                "mode.samples: found samples beside supersample".into(),
            ),
            (r#""sampling": "thesis", "supersample": "ray""#, "did you mean `rays`?".into()),
            (r#""pattern": "jiter""#, "did you mean `jitter`?".into()),
        ] {
            let complaint = sampling(keys).unwrap_err();
            assert!(complaint.starts_with("a.json:1:"), "{complaint}");
            assert!(complaint.contains(&expected), "{keys}: {complaint}");
        }
    }
}
