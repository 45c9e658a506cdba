//! STL surfaces: reads text and binary files, writes binary files.

mod triangles;

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use glam::DVec3;
use thiserror::Error;

use super::solid::{Solid, SolidError};
use super::terrain::{Terrain, TerrainError};

/// Error while reading or writing an STL file.
#[derive(Debug, Error)]
pub enum StlError {
    /// The file cannot be opened, read or written.
    #[error("{path}: {source}")]
    Io { path: PathBuf, source: std::io::Error },
    /// The file is incomplete or not an STL file.
    #[error("{path} is not a complete STL file: {reason}")]
    Format { path: PathBuf, reason: String },
    /// The surface does not bound a body.
    #[error("{path}: {source}")]
    Surface { path: PathBuf, source: SolidError },
    /// The surface cannot serve as ground.
    #[error("{path}: {source}")]
    Terrain { path: PathBuf, source: TerrainError },
}

/// Reads the body from an ASCII or binary STL file; lengths are multiplied by `scale` (0.001 for a file in mm).
pub fn read(path: &Path, scale: f64) -> Result<Solid, StlError> {
    let bytes = fs::read(path).map_err(|source| StlError::Io { path: path.to_owned(), source })?;
    parse(&bytes, path, scale)
}

/// Reads the body from the content of an STL file; error messages name the file `path`.
///
/// Corner points with equal coordinates become one vertex. Triangles that use a vertex twice are left out.
pub fn parse(bytes: &[u8], path: &Path, scale: f64) -> Result<Solid, StlError> {
    let (vertices, triangles) = facets(bytes, path, scale)?;
    Solid::new(vertices, triangles).map_err(|source| StlError::Surface { path: path.to_owned(), source })
}

/// Reads an open or closed ground surface from the content of an STL file.
pub fn parse_terrain(bytes: &[u8], path: &Path, scale: f64) -> Result<Terrain, StlError> {
    let (vertices, triangles) = facets(bytes, path, scale)?;
    Terrain::new(vertices, triangles).map_err(|source| StlError::Terrain { path: path.to_owned(), source })
}

/// Vertices [m] and triangles as vertex indices.
type Facets = (Vec<DVec3>, Vec<[u32; 3]>);

fn facets(bytes: &[u8], path: &Path, scale: f64) -> Result<Facets, StlError> {
    let read = triangles::triangles(bytes).map_err(|reason| StlError::Format { path: path.to_owned(), reason })?;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let mut known: HashMap<[u64; 3], u32> = HashMap::new();
    for corners in read {
        let corners = corners.map(|corner| {
            // Adding zero changes -0 to +0. Otherwise two equal coordinates could have different bits.
            *known.entry((corner + 0.0).to_array().map(f64::to_bits)).or_insert_with(|| {
                vertices.push(scale * corner);
                (vertices.len() - 1) as u32
            })
        });
        let [a, b, c] = corners;
        if a != b && b != c && c != a {
            triangles.push(corners);
        }
    }
    Ok((vertices, triangles))
}

/// Writes a surface as a binary STL file. A temporary file is written and renamed, so the file is always complete.
pub fn write(path: &Path, vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), StlError> {
    let io = |source| StlError::Io { path: path.to_owned(), source };
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let temporary = path.with_file_name(name);
    let mut out = BufWriter::new(File::create(&temporary).map_err(io)?);
    write_facets(&mut out, vertices, triangles).map_err(io)?;
    let file = out.into_inner().map_err(|e| io(e.into_error()))?;
    file.sync_all().map_err(io)?;
    fs::rename(&temporary, path).map_err(io)
}

/// Writes 80 bytes of header and the number of triangles, then normal, corners and a two-byte attribute per triangle.
fn write_facets(out: &mut impl Write, vertices: &[DVec3], triangles: &[[u32; 3]]) -> std::io::Result<()> {
    out.write_all(&[0; 80])?;
    let count = u32::try_from(triangles.len()).map_err(std::io::Error::other)?;
    out.write_all(&count.to_le_bytes())?;
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| vertices[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for vector in [normal, a, b, c] {
            for coordinate in vector.to_array() {
                out.write_all(&(coordinate as f32).to_le_bytes())?;
            }
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::armour_unit::ArmourUnit;
    use crate::geometry::solid::tests::cuboid;

    #[test]
    fn written_unit_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tetrapod.stl");
        let unit = ArmourUnit::tetrapod(0.077, 0.05).unwrap();
        write(&path, unit.solid().vertices(), unit.solid().triangles()).unwrap();
        let back = read(&path, 1.0).unwrap();
        assert_eq!(back.triangles().len(), unit.solid().triangles().len());
        // Coordinates are stored with 24 bits, so their relative error is up to 6e-8.
        let ratio = back.volume_properties().volume / unit.solid().volume_properties().volume;
        assert!((ratio - 1.0).abs() < 1e-6);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file was not removed");
    }

    #[test]
    fn ascii_file_in_millimetres_is_scaled() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("box.stl");
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::new(10.0, 20.0, 30.0));
        let mut text = String::from("solid box\n");
        for triangle in triangles {
            text.push_str("facet normal 0 0 0\n outer loop\n");
            for v in triangle.map(|v| vertices[v as usize]) {
                text.push_str(&format!("  vertex {} {} {}\n", v.x, v.y, v.z));
            }
            text.push_str(" endloop\nendfacet\n");
        }
        text.push_str("endsolid box\n");
        std::fs::write(&path, text).unwrap();
        let volume = read(&path, 1e-3).unwrap().volume_properties().volume;
        // 1e-9 allows for the rounding errors of the sum.
        assert!((volume / 6e-6 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn errors_name_the_broken_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("broken.stl");
        let unit = ArmourUnit::tetrapod(0.077, 0.05).unwrap();
        write(&path, unit.solid().vertices(), unit.solid().triangles()).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for content in
            [&b""[..], b"solid x\nfacet normal", b"garbage", &whole[..whole.len() / 2], &whole[..90], &[255; 400]]
        {
            std::fs::write(&path, content).unwrap();
            let error = read(&path, 1.0).unwrap_err().to_string();
            assert!(error.contains("broken.stl"), "{error}");
        }
        assert!(read(&folder.path().join("none.stl"), 1.0).is_err());
    }
}
