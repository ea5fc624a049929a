//! Objects of several patches, in memory, through files and from the command line.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use fixtures::program::{self, said};
use shapes::{cylinder, sphere, torus};
use std::fs;
use std::path::Path;
use std::process::Output;
use sweep::GridMesh;
use sweep::grid::file::{Encoding, GridReader, write_all};
use sweep::grid::{Fold, Tolerance};
use triangulate::{Material, MeshReport, Options, Patches, TriMesh, mesh, write_obj};

/// Returns a tube, a ring on the tube, and a ball; the ring has its own ids.
fn patches() -> Vec<GridMesh> {
    let named = |name: &str, grid| GridMesh { name: name.into(), ..grid };
    let ring = GridMesh { texture: Some(4), surface: Some(1), ..torus(6, 5) };
    vec![named("my tube", cylinder(4, 9)), named("ring", ring), named("ball", sphere(8, 5))]
}

fn file_of(grids: &[GridMesh]) -> Vec<u8> {
    let mut file = Vec::new();
    write_all(grids, Encoding::Binary, &mut file).unwrap();
    file
}

fn run(arguments: &[&str], folder: &Path) -> Output {
    program::run(env!("CARGO_BIN_EXE_triangulate").as_ref(), arguments, folder, b"")
}

/// Corners of a triangle by their values, not their numbers.
type Corners = [([f32; 3], [f32; 2], [f32; 3]); 3];

fn corners(mesh: &TriMesh) -> Vec<Corners> {
    let of_one = |t: &triangulate::Triangle| {
        [0, 1, 2].map(|k| {
            let [p, uv, n] = [t.position[k], t.uv[k], t.normal[k]].map(|index| index as usize);
            (mesh.positions[p], mesh.uvs[uv], mesh.normals[n])
        })
    };
    mesh.triangles.iter().map(of_one).collect()
}

#[test]
fn the_patches_of_a_mesh_are_the_meshes_of_the_patches() {
    let grids = patches();
    let whole = mesh(grids.as_slice(), &Options::default()).unwrap();
    assert_eq!(whole.validate(), Vec::<String>::new());
    let single: Vec<TriMesh> =
        grids.iter().map(|grid| mesh(grid, &Options::default()).unwrap()).collect();
    assert_eq!(corners(&whole), single.iter().flat_map(corners).collect::<Vec<_>>());
    assert_eq!(whole.name, "my_tube");
    for (number, single) in single.iter().enumerate() {
        let patch = whole.of_patch(number);
        assert_eq!((&patch.name, corners(&patch)), (&single.name, corners(single)));
        assert_eq!(patch.materials(), single.materials());
    }
}

#[test]
fn file_and_memory_give_the_same_mesh() {
    let (grids, options) = (patches(), Options { texture: None, surface: Some(3) });
    let (mut from_memory, mut from_file) = (Vec::new(), Vec::new());
    let counts = write_obj(grids.as_slice(), &options, &mut from_memory).unwrap();
    let file = file_of(&grids);
    let mut reader = GridReader::open("a", file.as_slice()).unwrap();
    assert_eq!(write_obj(&mut reader, &options, &mut from_file).unwrap(), counts);
    assert!(from_memory == from_file);
    let mut reader = GridReader::open("a", file.as_slice()).unwrap();
    let (read, _) = reader.run(&options, TriMesh::default()).unwrap();
    assert_eq!(read, mesh(grids.as_slice(), &options).unwrap());
}

#[test]
fn an_obj_has_an_object_for_each_patch_and_indices_run_on() {
    let mut obj = Vec::new();
    let counts = write_obj(patches().as_slice(), &Options::default(), &mut obj).unwrap();
    let text = String::from_utf8(obj.clone()).unwrap();
    let named: Vec<&str> =
        text.lines().filter(|line| line.starts_with("o ") || line.starts_with("usemtl ")).collect();
    let expected = [
        "o my_tube",
        "usemtl tex0_surf0",
        "o ring",
        "usemtl tex4_surf1",
        "o ball",
        "usemtl tex0_surf0",
    ];
    assert_eq!(named, expected);
    assert!(text.ends_with(&format!("# end {} {}\n", counts.positions, counts.triangles)));

    let no_materials = |_: &Path| tobj::load_mtl_buf(&mut &b""[..]);
    let (models, _) =
        tobj::load_obj_buf(&mut &*obj, &tobj::LoadOptions::default(), no_materials).unwrap();
    assert_eq!(models.len(), 3);
    for (model, grid) in models.iter().zip(patches()) {
        let single = mesh(&grid, &Options::default()).unwrap();
        assert_eq!(model.name, single.name);
        let found = model.mesh.indices.iter().map(|&index| {
            let at = 3 * index as usize;
            [model.mesh.positions[at], model.mesh.positions[at + 1], model.mesh.positions[at + 2]]
        });
        let expected = single.triangles.iter().flat_map(|triangle| triangle.position);
        assert!(found.eq(expected.map(|index| single.positions[index as usize])), "{}", model.name);
    }
}

#[test]
fn a_report_has_the_whole_and_every_patch() {
    let mut grids = patches();
    let fold = |worst, rows| Some(Fold { worst, rows, fits: Some(0.5) });
    (grids[0].fold, grids[2].fold) = (fold(-0.25, 4), fold(0.5, 0));
    grids[1].tolerance = Some(Tolerance { asked: Some(0.1), ..Tolerance::default() });
    let file = file_of(&grids);
    let mut reader = GridReader::open("a", file.as_slice()).unwrap();
    let (mesh, counts) = reader.run(&Options::default(), TriMesh::default()).unwrap();
    let report = MeshReport::of(&mesh, &counts);
    assert_eq!((report.euler, report.boundary_loops, report.closed), (2, 2, false));
    assert_eq!(report.faces as u64, counts.triangles);
    assert_eq!((report.folds, report.tolerance), (fold(-0.25, 4), grids[1].tolerance));
    assert_eq!(report.patches[2].folds, fold(0.5, 0));
    let of_patches = report.patches.iter().map(|p| (p.object.as_str(), p.euler, p.boundary_loops));
    assert!(of_patches.eq([("my_tube", 0, 2), ("ring", 0, 0), ("ball", 2, 0)]));
    assert_eq!(report.patches.iter().map(|patch| patch.vertices).sum::<usize>(), report.vertices);
    let of_materials = report.materials.iter().map(|m| (m.texture, m.surface, m.faces));
    assert!(of_materials.eq([(0, 0, 2 * 3 * 9 + 8 * 6), (4, 1, 2 * 6 * 5)]));
}

#[test]
fn every_format_takes_all_patches_and_flags_stand_in_for_their_ids() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("a.grid"), file_of(&patches())).unwrap();
    let made = run(&["a.grid", "-o", "a.stl"], folder.path());
    assert_eq!(made.status.code(), Some(0), "{}", said(&made));
    let faces = mesh(patches().as_slice(), &Options::default()).unwrap().triangles.len();
    assert_eq!(fs::read(path("a.stl")).unwrap().len(), 84 + 50 * faces);

    let made = run(&["a.grid", "-o", "a.ply"], folder.path());
    assert_eq!(made.status.code(), Some(0), "{}", said(&made));
    let ply = fs::read(path("a.ply")).unwrap();
    let header = String::from_utf8_lossy(&ply[..600]).into_owned();
    assert!(header.contains("comment object my_tube\ncomment object ring\ncomment object ball\n"));
    assert!(header.contains("comment texture 0 surface 0\ncomment texture 4 surface 1\n"));
    assert!(header.contains("vertex_indices\nproperty uint texture\nproperty uint surface\nend"));
    // The last face belongs to the ball, without a texture; each face has its list and two ids.
    assert_eq!(ply[ply.len() - 8..], [0; 8]);
    let lists: Vec<&[u8]> = ply[ply.len() - 21 * faces..].chunks(21).collect();
    assert!(lists.iter().all(|face| face[0] == 3));
    assert_eq!(lists.iter().filter(|face| face[13..] == [4, 0, 0, 0, 1, 0, 0, 0]).count(), 60);

    let made = run(&["a.grid", "-o", "a.obj", "--mtl", "--surface", "2"], folder.path());
    assert_eq!(made.status.code(), Some(0), "{}", said(&made));
    let mtl = fs::read_to_string(path("a.mtl")).unwrap();
    let names: Vec<&str> = mtl.lines().filter_map(|line| line.strip_prefix("newmtl ")).collect();
    assert_eq!(names, ["tex0_surf2", "tex4_surf2"]);
    let made = run(&["a.grid", "--texture", "0", "--surface", "0"], folder.path());
    let text = String::from_utf8(made.stdout).unwrap();
    assert_eq!(text.matches("usemtl tex0_surf0\n").count(), 3);
}

#[test]
fn a_pipe_cut_between_two_patches_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let file = file_of(&patches());
    let start = b"{\"format\"";
    let last = file.windows(start.len()).rposition(|window| window == start).unwrap();
    fs::write(folder.path().join("a.grid"), &file[..last]).unwrap();
    for output in ["a.obj", "a.stl", "-"] {
        let made = run(&["a.grid", "-o", output, "--format", "obj"], folder.path());
        assert_eq!(made.status.code(), Some(3));
        assert_eq!(
            said(&made),
            "triangulate: a.grid: patch 3 of 3 is missing, the grid is cut short: the program \
             that wrote it stopped early\n"
        );
        assert!(!String::from_utf8(made.stdout).unwrap().contains("# end"));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn materials_are_named_by_their_ids() {
    assert_eq!(Material { texture: 7, surface: 12 }.name(), "tex7_surf12");
}
