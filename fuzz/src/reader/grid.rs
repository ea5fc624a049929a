//! Reads grid files and does the work that follows a grid: its file, its triangles, and the mesh
//! that `render` reads.

use crate::verdict::{Stop, Tried, broken, hold, refused};
use render::scene::obj;
use render::shape::Mesh;
use render::shape::mesh::Triangle;
use std::fmt::Debug;
use sweep::GridMesh;
use sweep::grid::file::{Encoding, GridReader, read_all, write_all};
use triangulate::{MeshReport, Options, TriMesh, TriangulateError};

/// Reads a grid in memory and row by row, and does the work that follows a grid.
///
/// # Errors
/// When the grid is refused, the two readers differ, or the work that follows fails.
pub fn read(bytes: &[u8]) -> Tried {
    let whole = read_all("a.grid", bytes);
    let mut reader = match GridReader::open("a.grid", bytes) {
        Ok(reader) => reader,
        Err(error) => {
            hold(whole.is_err(), "a grid is read whole and not row by row")?;
            return Err(refused(error));
        }
    };
    let by_rows = triangulate::mesh(&mut reader, &Options::default());
    match (whole, by_rows) {
        (Ok(grids), Ok(_)) => follow(&grids),
        (Err(error), Err(_)) => Err(refused(error)),
        // Triangles fail where f32 cannot hold a number.
        (Ok(_), Err(error)) => match error {
            TriangulateError::Grid(error) => {
                Err(broken("a grid is read whole and not row by row")(&error))
            }
            error => Err(refused(error)),
        },
        (Err(error), Ok(_)) => Err(broken("a grid is read by rows and not whole")(&error)),
    }
}

/// Writes grids and reads them back, triangulates them, and reads their OBJ as `render` does.
///
/// # Errors
/// When f32 does not hold the points, as a refusal; or when one of these steps fails.
pub fn follow(grids: &[GridMesh]) -> Tried {
    for encoding in [Encoding::Binary, Encoding::Json] {
        let mut bytes = Vec::new();
        write_all(grids, encoding, &mut bytes)
            .map_err(|error| broken("a grid is not written")(&error))?;
        let again = read_all("a.grid", &bytes[..])
            .map_err(|error| broken("a grid that was written is refused")(&error))?;
        hold(again == grids, "a grid that was written is read as another one")?;
    }
    let mesh = triangulate::mesh(grids, &Options::default()).map_err(refused)?;
    let mut file = Vec::new();
    let counts = triangulate::write_obj(grids, &Options::default(), &mut file)
        .map_err(|error| broken("triangles in memory are not written")(&error))?;
    valid(&mesh)?;
    let report = MeshReport::of(&mesh, &counts);
    report.write(&mut Vec::new()).map_err(|error| broken("a report is not written")(&error))?;
    if mesh.triangles.is_empty() {
        return Ok(());
    }
    let read = obj::read("a.obj", &file)
        .map_err(|error| broken("a mesh that was written is refused")(&error))?;
    let direct = pipeline::mesh::for_render(mesh);
    same("normals", &read.normals, &direct.normals)?;
    same("picture coordinates", &read.uvs, &direct.uvs)?;
    hold(read.surfaces == direct.surfaces, "surfaces in the file and in memory differ")?;
    same("triangles", &corners(&read), &corners(&direct))
}

/// Returns the triangles with their points. The reader of OBJ files omits points of no triangle, so
/// indices are not compared.
fn corners(mesh: &Mesh) -> Vec<([[f32; 3]; 3], Triangle)> {
    let of = |triangle: &Triangle| {
        let points = triangle.position.map(|index| mesh.positions[index as usize]);
        (points, Triangle { position: [0; 3], ..*triangle })
    };
    mesh.triangles.iter().map(of).collect()
}

/// Checks that a mesh has the same numbers in a file and in memory.
fn same<T: PartialEq + Debug>(what: &str, file: &[T], memory: &[T]) -> Tried {
    hold(file.len() == memory.len(), &format!("a file has another number of {what}"))?;
    match file.iter().zip(memory).find(|(file, memory)| file != memory) {
        Some(pair) => {
            Err(Stop::Broken(format!("{what} in the file and in memory differ: {pair:?}")))
        }
        None => Ok(()),
    }
}

/// Checks a mesh. Edges used twice are no fault, since grids may fold. Normals are as long as those
/// of the grid, so their length is not checked either.
fn valid(mesh: &TriMesh) -> Tried {
    let complaints = mesh.validate();
    let wrong = complaints
        .into_iter()
        .find(|complaint| !["edge", "normal"].iter().any(|word| complaint.contains(word)));
    wrong.map_or(Ok(()), |complaint| Err(Stop::Broken(format!("the mesh: {complaint}"))))
}
