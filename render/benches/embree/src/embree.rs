//! The part of the C interface of Embree 4 that the comparison needs.
//!
//! The layouts are those of version 4.4. A hit has grown since 4.2 by the number of an instance in an
//! array of instances. The structure here ends with room for more, so that a library with more levels
//! of instances does not write beyond it.

use libloading::Library;
use std::error::Error;
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::path::Path;

/// A ray as Embree reads it. Embree sets `tfar` to the distance of the hit, or to minus infinity if
/// something occludes the ray.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(16))]
pub struct RtcRay {
    pub org: [f32; 3],
    pub tnear: f32,
    pub dir: [f32; 3],
    pub time: f32,
    pub tfar: f32,
    pub mask: u32,
    pub id: u32,
    pub flags: u32,
}

/// A ray and its hit.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(16))]
pub struct RtcRayHit {
    pub ray: RtcRay,
    pub normal: [f32; 3],
    pub uv: [f32; 2],
    pub triangle: u32,
    pub geometry: u32,
    pub rest: [u32; 21],
}

/// Marks the absence of a geometry.
pub const NONE: u32 = u32::MAX;

impl RtcRay {
    /// Returns a ray that ends at `tfar`.
    pub fn new(org: [f32; 3], dir: [f32; 3], tfar: f32) -> Self {
        Self { org, tnear: 0.0, dir, time: 0.0, tfar, mask: u32::MAX, id: 0, flags: 0 }
    }
}

type New = unsafe extern "C" fn(*const c_char) -> *mut c_void;
type Child = unsafe extern "C" fn(*mut c_void) -> *mut c_void;
type Typed = unsafe extern "C" fn(*mut c_void, c_int) -> *mut c_void;
type Set = unsafe extern "C" fn(*mut c_void, c_int);
type Property = unsafe extern "C" fn(*mut c_void, c_int) -> isize;
type Buffer = unsafe extern "C" fn(*mut c_void, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
type Act = unsafe extern "C" fn(*mut c_void);
type Attach = unsafe extern "C" fn(*mut c_void, *mut c_void) -> c_uint;
type Intersect = unsafe extern "C" fn(*mut c_void, *mut RtcRayHit, *mut c_void);
type Occluded = unsafe extern "C" fn(*mut c_void, *mut RtcRay, *mut c_void);
type Monitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;
type SetMonitor = unsafe extern "C" fn(*mut c_void, Monitor, *mut c_void);

/// The loaded library with a device of one thread.
#[derive(Debug)]
pub struct Embree {
    library: Library,
    device: *mut c_void,
    bytes: *mut isize,
}

/// A committed scene of one mesh.
#[derive(Debug)]
pub struct EmbreeScene {
    scene: *mut c_void,
    intersect: Intersect,
    occluded: Occluded,
    /// Memory that building took and kept, in bytes.
    pub bytes: isize,
}

unsafe extern "C" fn count(total: *mut c_void, bytes: isize, _: bool) -> bool {
    // SAFETY: `total` is the counter of an `Embree`; one thread builds.
    unsafe { *total.cast::<isize>() += bytes };
    true
}

impl Embree {
    /// Loads a shared library.
    ///
    /// # Errors
    /// If the library cannot be loaded or is no Embree 4.4.
    pub fn load(path: &Path) -> Result<Self, Box<dyn Error>> {
        // SAFETY: the caller names an Embree library; its initialization has no requirements. The
        // types are those of the C headers of version 4.4.
        unsafe {
            let library = Library::new(path)?;
            let new = *library.get::<New>(b"rtcNewDevice\0")?;
            let device = new(c"threads=1".as_ptr());
            if device.is_null() {
                return Err("found no device, expected Embree to make one".into());
            }
            let bytes = Box::into_raw(Box::new(0isize));
            library.get::<SetMonitor>(b"rtcSetDeviceMemoryMonitorFunction\0")?(
                device,
                count,
                bytes.cast(),
            );
            let embree = Self { library, device, bytes };
            let version = embree.version()?;
            if version / 100 != 404 {
                return Err(format!("found version {version}, expected 404xx").into());
            }
            Ok(embree)
        }
    }

    /// Returns the version as a number, 40400 for 4.4.0.
    ///
    /// # Errors
    /// If the library lacks the function.
    pub fn version(&self) -> Result<isize, Box<dyn Error>> {
        // SAFETY: the device lives as long as this value.
        unsafe { Ok(self.library.get::<Property>(b"rtcGetDeviceProperty\0")?(self.device, 0)) }
    }

    /// Builds a scene of one mesh with medium quality; `robust` sets the flag of that name.
    ///
    /// # Errors
    /// If the library lacks a function.
    pub fn build(
        &self,
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        robust: bool,
    ) -> Result<EmbreeScene, Box<dyn Error>> {
        let library = &self.library;
        // SAFETY: the handles come from this library and live as long as the device. The buffers
        // hold as many bytes as are copied.
        unsafe {
            let scene = library.get::<Child>(b"rtcNewScene\0")?(self.device);
            library.get::<Set>(b"rtcSetSceneFlags\0")?(scene, if robust { 4 } else { 0 });
            library.get::<Set>(b"rtcSetSceneBuildQuality\0")?(scene, 1);
            let geometry = library.get::<Typed>(b"rtcNewGeometry\0")?(self.device, 0);
            let buffer = library.get::<Buffer>(b"rtcSetNewGeometryBuffer\0")?;
            let corners = buffer(geometry, 1, 0, 0x9003, 12, positions.len());
            corners.copy_from_nonoverlapping(positions.as_ptr().cast(), 12 * positions.len());
            let indices = buffer(geometry, 0, 0, 0x5003, 12, triangles.len());
            indices.copy_from_nonoverlapping(triangles.as_ptr().cast(), 12 * triangles.len());
            library.get::<Act>(b"rtcCommitGeometry\0")?(geometry);
            library.get::<Attach>(b"rtcAttachGeometry\0")?(scene, geometry);
            library.get::<Act>(b"rtcReleaseGeometry\0")?(geometry);
            let before = *self.bytes;
            library.get::<Act>(b"rtcCommitScene\0")?(scene);
            Ok(EmbreeScene {
                scene,
                intersect: *library.get::<Intersect>(b"rtcIntersect1\0")?,
                occluded: *library.get::<Occluded>(b"rtcOccluded1\0")?,
                bytes: *self.bytes - before,
            })
        }
    }

    /// Frees a scene.
    ///
    /// # Errors
    /// If the library lacks the function.
    pub fn free(&self, scene: EmbreeScene) -> Result<(), Box<dyn Error>> {
        // SAFETY: the scene is not used again.
        unsafe { self.library.get::<Act>(b"rtcReleaseScene\0")?(scene.scene) };
        Ok(())
    }
}

impl EmbreeScene {
    /// Returns the distance and the triangle of the closest hit, or [`NONE`].
    #[inline]
    pub fn closest(&self, ray: &RtcRay) -> (f32, u32) {
        let mut hit = RtcRayHit {
            ray: *ray,
            normal: [0.0; 3],
            uv: [0.0; 2],
            triangle: NONE,
            geometry: NONE,
            rest: [NONE; 21],
        };
        // SAFETY: the scene is committed, and the structure is larger than Embree's.
        unsafe { (self.intersect)(self.scene, &raw mut hit, std::ptr::null_mut()) };
        (hit.ray.tfar, hit.triangle)
    }

    /// Returns whether a triangle lies on the ray.
    #[inline]
    pub fn any(&self, ray: &RtcRay) -> bool {
        let mut ray = *ray;
        // SAFETY: the scene is committed.
        unsafe { (self.occluded)(self.scene, &raw mut ray, std::ptr::null_mut()) };
        ray.tfar < 0.0
    }
}
