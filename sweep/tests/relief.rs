//! Reliefs made from a picture: their surfaces, and their faults.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use files::{Disk, Exit, Failure};
use glam::DVec3;
use image::{ImageBuffer, Luma, Rgb};
use serde_json::{Value, json};
use std::path::Path;
use sweep::{Sweep, SweepError};

fn read(folder: &Path, image: &Value, mode: &str) -> Result<Sweep, SweepError> {
    let spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "contour": {"circle": 2},
        "trajectory": {"line": [[0, 0, 0], [0, 0, 3]]}, "mesh": {"rows": 24, "cols": 16},
        "depth": {"mode": mode, "image": image},
    });
    let text = spec.to_string();
    Sweep::read_in(
        &Document::new("test", text.as_bytes()).unwrap(),
        folder,
        &Disk,
        &sweep::spec::Resolution::default(),
    )
}

/// Returns hills of 16 bits, twelve texels across and nine up.
fn hills() -> ImageBuffer<Luma<u16>, Vec<u16>> {
    ImageBuffer::from_fn(12, 9, |x, y| Luma([((x * x * 7 + y * 13 + x * y * 5) % 97) as u16 * 600]))
}

#[test]
fn the_middle_of_a_texel_has_its_height_to_16_bits() {
    let folder = tempfile::tempdir().unwrap();
    let picture = hills();
    picture.save(folder.path().join("hills.png")).unwrap();
    let image = json!({"file": "hills.png", "amp": 0.3, "zero": 0.25});
    let sweep = read(folder.path(), &image, "offset").unwrap();
    for (x, y, grey) in picture.enumerate_pixels() {
        let (u, v) = ((f64::from(x) + 0.5) / 12.0, 1.0 - (f64::from(y) + 0.5) / 9.0);
        let radius = sweep.at(u, v).0.truncate().length();
        let expected = 2.0 + 0.3 * (f64::from(grey.0[0]) / 65535.0 - 0.25);
        assert!((radius - expected).abs() < 1e-12, "{radius} for {expected}");
    }
}

#[test]
fn normals_on_a_picture_agree_with_differences() {
    let folder = tempfile::tempdir().unwrap();
    hills().save(folder.path().join("hills.png")).unwrap();
    for mode in ["factor", "offset"] {
        let image = json!({"file": "hills.png", "amp": 0.2, "repeat": [2, 1.5]});
        let sweep = read(folder.path(), &image, mode).unwrap();
        // The step stays within one texel, where the splines are polynomials.
        let h = 2.5e-4;
        for i in 0..20 {
            let (u, v) = (f64::from(i) / 24.0, (f64::from(i % 12) + 0.5) / 13.5);
            let slope =
                |f: &dyn Fn(f64) -> DVec3| (f(h) - f(-h)) * 8.0 - (f(2.0 * h) - f(-2.0 * h));
            let along_u = slope(&|d| sweep.at((u + d + 1.0) % 1.0, v).0);
            let along_v = slope(&|d| sweep.at(u, v + d).0);
            let error = (along_u.cross(along_v).normalize() - sweep.at(u, v).1).length();
            // Error of differences of order 4: the fifth derivative, some 1e7, times h^4 / 30.
            assert!(error < 1e-8, "{mode} at {u} {v}: {error:e}");
        }
    }
}

#[test]
fn pictures_have_their_complaints() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    hills().save(path("hills.png")).unwrap();
    ImageBuffer::from_pixel(2, 2, Rgb([9_u8, 8, 9])).save(path("colour.png")).unwrap();
    std::fs::write(path("text.png"), "no picture").unwrap();
    ImageBuffer::from_pixel(1 << 15, 513, Luma([0_u8])).save(path("large.png")).unwrap();
    for (image, message, exit) in [
        (json!({"file": "none.png", "amp": 1}), "depth.image.file: cannot read", Exit::ReadWrite),
        (json!({"file": "text.png", "amp": 1}), "found no picture in", Exit::Malformed),
        (
            json!({"file": "colour.png", "amp": 1}),
            "found a colour at texel (0, 0)",
            Exit::Malformed,
        ),
        (json!({"file": "large.png", "amp": 1}), "found 32768 x 513 texels", Exit::Resource),
        (json!({"file": "hills.png"}), "missing key `amp`", Exit::Malformed),
        (
            json!({"file": "hills.png", "amp": 1, "repeat": [1.5, 1]}),
            "depth.image.repeat[0]: found 1.5 repeats, expected a whole number",
            Exit::Malformed,
        ),
        (
            json!({"file": "hills.png", "amp": 3}),
            "depth.image.amp: found heights that add up to",
            Exit::Geometry,
        ),
    ] {
        let error = read(folder.path(), &image, "factor").unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
        assert_eq!(error.exit(), exit, "{error}");
    }
}
