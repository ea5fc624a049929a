//! The memory that a picture takes, computed from sizes before any of it is allocated.

use super::encode::Format;
use super::{Crop, Layer, Sampling, Settings};
use crate::filter::Filter;
use crate::procedural::Bump;
use crate::scene::Scene;
use files::memory::{Budget, MemoryError, Reserved};

/// Bytes per triangle, an estimate. A mesh with its own vertices takes 88 bytes. The structure
/// takes about 130, and about as much again while it is built. Textured meshes also have charts.
const OF_TRIANGLE: u64 = 600;

/// Reserves the memory for a scene that was read and for its picture: textures, the tables or
/// pyramids of those that some surface shows, meshes, and the structure that finds hits. The
/// picture takes its pixels with all layers and, if it is written, the file of the given format.
///
/// Temporary memory for single rays and tiles is not included; it is small.
///
/// # Errors
/// With the first of these for which no memory is left beside the others.
pub fn reserve<'b>(
    scene: &Scene,
    settings: &Settings,
    format: Option<Format>,
    budget: &'b Budget,
) -> Result<Reserved<'b>, MemoryError> {
    let mut reserved = budget.reserve(scene.texture_bytes(), || "the scene's textures".into())?;
    add_tables(&mut reserved, scene, settings.filter)?;
    reserved.grow(scene.procedural.lattice_bytes(), || "noise".into())?;
    if matches!(settings.sampling, Sampling::Area { .. }) {
        let moments = scene.procedural.bumps.iter().map(Bump::moments_bytes).sum();
        reserved.grow(moments, || "the slopes of bumps".into())?;
    }
    let triangles = scene.triangles();
    let meshes = || format!("the scene with its {triangles} triangles");
    reserved.grow(triangles.saturating_mul(OF_TRIANGLE), meshes)?;
    let crop = Crop::of(settings);
    let pixels = u64::from(crop.width) * u64::from(crop.height);
    let channels = settings.layers.iter().map(|layer| layer.channels().len()).sum();
    let picture = pixels.saturating_mul(of_pixel(channels, format));
    reserved.grow(picture, || of_size(&crop, &settings.layers))?;
    Ok(reserved)
}

/// Reserves the memory for the tables or pyramids of one filter. A prepared scene keeps them for
/// the pictures that follow.
///
/// # Errors
/// With the first texture for whose table no memory is left.
pub fn reserve_tables<'b>(
    scene: &Scene,
    filter: Filter,
    budget: &'b Budget,
) -> Result<Reserved<'b>, MemoryError> {
    let mut reserved = budget.reserve(0, String::new)?;
    add_tables(&mut reserved, scene, filter)?;
    Ok(reserved)
}

/// Reserves the memory for the tables or pyramids of one filter, for the textures that some surface
/// shows.
fn add_tables(
    reserved: &mut Reserved<'_>,
    scene: &Scene,
    filter: Filter,
) -> Result<(), MemoryError> {
    for (texture, shown) in scene.textures.iter().zip(scene.shown_textures()) {
        let table = if shown { filter.bytes_for(texture) } else { 0 };
        reserved.grow(table, || {
            let (width, height) = (texture.width, texture.height);
            let name = files::words::shown(&texture.name);
            format!("texture {name}: the data of the {filter} filter for {width}x{height} texels")
        })?;
    }
    Ok(())
}

/// Returns the bytes per pixel with this many numbers besides its colour, including the encoding of
/// its file.
#[must_use]
pub fn of_pixel(channels: usize, format: Option<Format>) -> u64 {
    let linear = 12 + 4 * channels as u64;
    match format {
        None => linear,
        // Three channels, one byte each: once as a picture and at most twice as a growing file.
        Some(Format::Png) => linear + 3 * 3,
        // The sorted channels, and a file that compression may not make smaller.
        Some(Format::Exr) => 3 * linear,
    }
}

/// Returns a description of a picture, for messages.
fn of_size(crop: &Crop, layers: &[Layer]) -> String {
    let size = format!("a picture of {}x{} pixels", crop.width, crop.height);
    match layers.len() {
        0 => size,
        1 => format!("{size} with a layer"),
        count => format!("{size} with {count} layers"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_with_all_layers_has_fourteen_numbers() {
        let channels: usize = Layer::ALL.iter().map(|layer| layer.channels().len()).sum();
        assert_eq!(of_pixel(channels, None), 14 * 4);
        assert_eq!(of_pixel(channels, Some(Format::Exr)), 3 * 56);
        assert_eq!(of_pixel(0, Some(Format::Png)), 21);
    }
}
