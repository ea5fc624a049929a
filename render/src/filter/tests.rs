//! Tests of all filters together.

use super::*;

#[test]
fn filters_are_read_by_the_names_that_they_show() {
    for filter in Filter::ALL {
        let name = format!("\"{filter}\"");
        assert_eq!(serde_json::from_str::<Filter>(&name).ok(), Some(filter));
    }
}

#[test]
fn every_filter_stays_within_the_texture_wherever_it_looks() {
    let texels = (0..6u16).map(|k| [k * 40, 255 - k, 7]).collect();
    let texture = Texture { width: 3, height: 2, texels, white: 255, ..Texture::default() };
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e18, 1e9, 0.0, -0.4];
    for filter in Filter::ALL {
        let ready = FilteredTexture::new(&texture, filter);
        for (u, half) in odd.iter().flat_map(|&u| odd.map(|half| (u, half))) {
            let center = DVec2::new(u, 0.3);
            let rectangle = Footprint::Rectangle { center, half: DVec2::new(0.1, half) };
            for footprint in [Footprint::Point(center), rectangle] {
                let found = ready.average(&footprint);
                let within = found.min_element() >= -1e-9 && found.max_element() <= 1.0 + 1e-9;
                assert!(within, "{filter} at {u} with {half}: {found}");
                assert!((found.z - 7.0 / 255.0).abs() < 1e-9, "{filter}: {found}");
            }
        }
    }
}
