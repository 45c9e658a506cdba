//! STL surfaces: reading ASCII and binary files, writing binary ones.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{BufWriter, Cursor, Write};
use std::path::{Path, PathBuf};

use glam::DVec3;
use thiserror::Error;

use super::solid::{Solid, SolidError};
use super::terrain::{Terrain, TerrainError};

/// Why an STL file could not be read or written.
#[derive(Debug, Error)]
pub enum StlError {
    /// The file cannot be opened, read or written.
    #[error("{path}: {source}")]
    Io { path: PathBuf, source: std::io::Error },
    /// The file is not a complete STL file.
    #[error("{path}: not a readable STL file: {reason}")]
    Format { path: PathBuf, reason: String },
    /// The surface in the file does not bound a body.
    #[error("{path}: {source}")]
    Surface { path: PathBuf, source: SolidError },
    /// Units cannot stand on the surface in the file.
    #[error("{path}: {source}")]
    Terrain { path: PathBuf, source: TerrainError },
}

/// Body inside the surface in an STL file, ASCII or binary, its lengths multiplied by `scale` (0.001 for a file in mm).
pub fn read(path: &Path, scale: f64) -> Result<Solid, StlError> {
    let bytes = fs::read(path).map_err(|source| StlError::Io { path: path.to_owned(), source })?;
    parse(&bytes, path, scale)
}

/// The same from the file's content; `path` is its name in messages.
///
/// Corner points with the same coordinates become one vertex; triangles that use one twice are left out.
pub fn parse(bytes: &[u8], path: &Path, scale: f64) -> Result<Solid, StlError> {
    let (vertices, triangles) = facets(bytes, path, scale)?;
    Solid::new(vertices, triangles).map_err(|source| StlError::Surface { path: path.to_owned(), source })
}

/// The surface in a file's content as one to stand on, open or closed.
pub fn parse_terrain(bytes: &[u8], path: &Path, scale: f64) -> Result<Terrain, StlError> {
    let (vertices, triangles) = facets(bytes, path, scale)?;
    Terrain::new(vertices, triangles).map_err(|source| StlError::Terrain { path: path.to_owned(), source })
}

/// Corner points and triangles.
type Facets = (Vec<DVec3>, Vec<[u32; 3]>);

fn facets(bytes: &[u8], path: &Path, scale: f64) -> Result<Facets, StlError> {
    let format = |reason: String| StlError::Format { path: path.to_owned(), reason };
    let mut file = Cursor::new(bytes);
    let facets = stl_io::create_stl_reader(&mut file).map_err(|e| format(e.to_string()))?;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    for (index, facet) in facets.enumerate() {
        let facet = facet.map_err(|e| format(format!("triangle {index}: {e}")))?;
        let corners = facet.vertices.map(|v| {
            // Adding zero turns -0 into +0, which has other bits.
            let [x, y, z] = v.0.map(|c| c + 0.0);
            *known.entry([x.to_bits(), y.to_bits(), z.to_bits()]).or_insert_with(|| {
                vertices.push(scale * DVec3::new(x.into(), y.into(), z.into()));
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

/// Writes a surface as binary STL: to a temporary name beside it first, then renamed, so that a file under the final
/// name is always complete.
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

/// 80 bytes of header, the count, then normal, corners and an attribute of two bytes for each triangle.
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
    fn a_written_unit_reads_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tetrapod.stl");
        let unit = ArmourUnit::tetrapod(0.077, 0.05).unwrap();
        write(&path, unit.solid().vertices(), unit.solid().triangles()).unwrap();
        let back = read(&path, 1.0).unwrap();
        assert_eq!(back.triangles().len(), unit.solid().triangles().len());
        // Coordinates are stored with 24 bits, 6e-8 of their size.
        let ratio = back.volume_properties().volume / unit.solid().volume_properties().volume;
        assert!((ratio - 1.0).abs() < 1e-6);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file is gone");
    }

    #[test]
    fn ascii_in_millimetres_is_scaled() {
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
        // Rounding of the sum only.
        assert!((volume / 6e-6 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn broken_files_give_errors_that_name_them() {
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
