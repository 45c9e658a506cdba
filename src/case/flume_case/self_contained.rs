//! Makes the case file that a run stores: it refers only to files in the run folder.

use crate::case::breakage::BreakageSettings;
use crate::case::file::{CaseFile, ExternalWaveFile, StopFile, VelxFile, WaveFile, WaveSourceFile};
use crate::case::flume::bed::Flume;
use crate::case::flume::terrain::SiteTerrain;
use crate::case::reference::Reference;
use crate::case::units::Units;
use crate::case::wave::Wave;
use crate::case::wave::external_wave::ROWS_FILE;

/// Returns the case as a run stores it, and the bytes read from other files. The stored case refers only to files in
/// the run folder, so that a run can resume after its folder was moved. Wave files become one file that the run writes.
/// STL files, mesh and reference folder become copies. A placement file becomes poses in the case.
pub(super) fn self_contained(
    file: &CaseFile,
    flume: &Flume,
    wave: &Wave,
    units: Option<&Units>,
    breakage: Option<&BreakageSettings>,
) -> (CaseFile, Vec<u8>) {
    let (mut kept, mut read) = (file.clone(), Vec::new());
    if let Wave::External(wave) = wave {
        let source = WaveSourceFile::Dualsphysics(VelxFile { path: ROWS_FILE.into(), origin_z_m: None });
        kept.wave = WaveFile::File(ExternalWaveFile { source, celerity_m_s: wave.celerity });
        read = wave.rows_text();
    }
    // Parts from STL files become polygons and boxes, or have copies of their files.
    let parts = file.structure.iter().zip(&flume.parts);
    kept.structure =
        parts.map(|(file, part)| if file.stl.is_some() { part.entry(file) } else { file.clone() }).collect();
    flume.files().for_each(|(_, content)| read.extend(content));
    if let Some(terrain) = &mut kept.flume.terrain {
        SiteTerrain::FILE.clone_into(&mut terrain.path);
    }
    kept.reference = kept.reference.as_ref().map(|_| Reference::FOLDER.to_owned());
    if let (Some(file), Some(units)) = (&mut kept.units, units) {
        units.make_self_contained(file, &mut read);
    }
    if let Some(settings) = breakage {
        kept.breakage = kept.breakage.as_ref().map(BreakageSettings::entry);
        read.extend(&settings.mesh_file);
    }
    (kept, read)
}

/// Returns the case file without the key `$schema` and without [`KEYS_FREE_AT_START`](super::Case::KEYS_FREE_AT_START).
pub(super) fn without_keys_free_at_start(file: &CaseFile) -> CaseFile {
    let stop = StopFile { at_rest: None, ..file.stop.clone() };
    let (title, assumptions, friction) = (String::new(), Vec::new(), Vec::new());
    CaseFile { schema: None, title, assumptions, reference: None, friction, stop, ..file.clone() }
}
