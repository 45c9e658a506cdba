//! Bed, structure and particle domain together.

use super::bathymetry;
use super::bed::{self, Flume};
use super::domain::{self, Domain};
use super::structure::{self, Room};
use crate::case::file::CaseFile;
use crate::case::reading::check::Checker;

/// Materials of the ground, indices into `Case::materials`.
#[derive(Debug, Clone, Copy)]
pub struct GroundMaterials<'a> {
    /// Material of the bed.
    pub bed: Option<usize>,
    /// Material of the mound, if it has its own.
    pub mound: Option<usize>,
    /// Material of each part of the structure, if it has its own.
    pub parts: &'a [Option<usize>],
}

/// Validates bed, structure and domain of the flume case `name`. Returns what is valid.
pub fn validate(
    file: &CaseFile,
    name: &str,
    materials: GroundMaterials,
    check: &mut Checker,
) -> (Option<Flume>, Option<Domain>) {
    let Some(mut flume) = bed::validate(&file.flume, [materials.bed, materials.mound], check) else {
        domain::validate(&file.domain, None, file.numerics.smoothing_factor, check);
        return (None, None);
    };
    let room = Room::of(&file.domain, name);
    let parts = structure::place_on_bed(&file.structure, materials.parts, &mut flume, &room, check);
    let terrain = match &file.flume.terrain {
        Some(_) if file.structure.iter().any(|part| part.porous.is_some()) => {
            let advice = "write the terrain as `flume.bed_m`, or the porous parts as solid ones";
            check.reject("flume.terrain", "beside porous parts", "left out with porous parts", advice);
            None
        }
        Some(terrain) => bathymetry::place(terrain, name, &mut flume, &room, check),
        None => Some(None),
    };
    let domain = domain::validate(&file.domain, Some(&flume), file.numerics.smoothing_factor, check);
    let (Some(parts), Some(terrain), Some(domain)) = (parts, terrain, domain) else { return (Some(flume), None) };
    match structure::validate(parts, &file.structure, &file.domain.obstacles, &flume, domain.width, &room, check) {
        Some(parts) => {
            flume.parts = parts;
            if let Some(terrain) = terrain {
                bathymetry::check_place(&terrain, &flume, &domain, &room, check);
                flume.parts.push(terrain);
            }
            (Some(flume), Some(domain))
        }
        None => (Some(flume), None),
    }
}
